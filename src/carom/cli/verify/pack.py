"""`carom verify pack`: the benchmark pack for developers of DEM codes."""

import json
from typing import Annotated

import typer


def pack_command(
    folder: Annotated[str, typer.Argument(help="A new or empty folder, e.g. bench.")],
    as_json: Annotated[
        bool, typer.Option("--json", help="Print JSON instead of a summary.")
    ] = False,
) -> None:
    """Write reference impacts with error bars, and inputs of DEM codes for them, into a folder.

    Frozen: a version of the pack has the same numbers, to the last byte, wherever it is written.

    Example: carom verify pack bench
    """
    from carom.verify.pack import VERSION, write_pack

    files = write_pack(folder)
    if as_json:
        typer.echo(json.dumps({"version": VERSION, "folder": folder, "files": files}, indent=2))
        return
    typer.echo(f"benchmark pack {VERSION}: {len(files)} files in {folder}; start with README.md")
