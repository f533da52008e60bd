"""`carom liggghts`: the exact contact law in LIGGGHTS."""

import json
from pathlib import Path

import typer

from carom.cli.cases import Json, described
from carom.cli.once import Commands

app = Commands(
    "liggghts",
    "Use the exact contact law in LIGGGHTS, as tangential carom.\n\n\b\n"
    "Example: carom liggghts build --source liggghts_3.8.0.orig.tar.xz",
)


@app.callback()
def _group() -> None:
    """Keep `build` a command of its own, although it is the only one."""


OPTIONS = {
    "source": typer.Option(metavar="PATH", help="Folder or tarball of LIGGGHTS-PUBLIC 3.8.0."),
    "folder": "Folder for the program (default: that in which carom verify liggghts looks).",
}


@app.command("build")
@described(OPTIONS)
def build_command(source: Path, folder: Path | None = None, as_json: Json = False) -> None:
    """Compile LIGGGHTS with the tangential model carom.

    This takes some minutes and makes a LIGGGHTS without MPI and VTK. The source package of Debian
    is a suitable tarball: apt-get source --download-only liggghts fetches it.

    \b
    Example: carom liggghts build --source liggghts_3.8.0.orig.tar.xz
    """
    from carom.adapters import liggghts

    target = liggghts.program().parent if folder is None else folder
    built = liggghts.build(source, target)
    if as_json:
        told = {"file": str(built.path), "version": built.version, "command": list(built.command)}
        typer.echo(json.dumps(told, indent=2))
        return
    typer.echo(
        f"Carom has built LIGGGHTS {built.version} with tangential model carom: {built.path}"
    )
    typer.echo("Write this into the input: pair_style gran model hertz tangential carom")
