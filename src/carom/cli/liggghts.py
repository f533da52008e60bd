"""`carom liggghts`: the exact contact law in LIGGGHTS."""

import json
from pathlib import Path
from typing import Annotated

import typer

from carom.cli.cases import Json
from carom.cli.once import Commands

app = Commands(
    name="liggghts",
    help=(
        "The exact contact law in LIGGGHTS: tangential carom.\n\n"
        "Example: carom liggghts build --source liggghts_3.8.0.orig.tar.xz"
    ),
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
)


@app.callback()
def _group() -> None:
    """Keep `build` a command of its own, although it is the only one."""


@app.command("build")
def build_command(
    source: Annotated[
        Path, typer.Option(metavar="PATH", help="LIGGGHTS-PUBLIC 3.8.0: its folder or tarball.")
    ],
    folder: Annotated[
        Path | None,
        typer.Option(help="Where the program goes (where carom verify liggghts finds it)."),
    ] = None,
    as_json: Json = False,
) -> None:
    """Compile LIGGGHTS with tangential model carom, without MPI and VTK; this takes minutes.

    Debian's package of sources is a tarball that fits: apt-get source --download-only liggghts.

    Example: carom liggghts build --source liggghts_3.8.0.orig.tar.xz
    """
    from carom.adapters import liggghts

    target = liggghts.program().parent if folder is None else folder
    built = liggghts.build(source, target)
    if as_json:
        told = {"file": str(built.path), "version": built.version, "command": list(built.command)}
        typer.echo(json.dumps(told, indent=2))
        return
    typer.echo(f"built LIGGGHTS {built.version} with tangential model carom: {built.path}")
    typer.echo("in an input: pair_style gran model hertz tangential carom")
