"""`carom verify pack`: the benchmark pack for developers of DEM codes."""

import json

import typer

from carom.cli.cases import described

OPTIONS = {
    "folder": typer.Argument(help="New or empty folder for the pack, e.g. bench."),
    "as_json": typer.Option("--json", help="Print JSON instead of a summary."),
}


@described(OPTIONS)
def pack_command(folder: str, as_json: bool = False) -> None:
    """Write the benchmark pack for developers of DEM codes.

    Use this command to test a DEM code that you write. The pack holds reference impacts with error
    bars, and inputs of DEM codes for them. A version of the pack has the same numbers, to the last
    byte, wherever it is written.

    \b
    Example: carom verify pack bench
    """
    from carom.verify.pack import VERSION, write_pack

    files = write_pack(folder)
    if as_json:
        typer.echo(json.dumps({"version": VERSION, "folder": folder, "files": files}, indent=2))
        return
    typer.echo(
        f"Carom has written benchmark pack {VERSION}, {len(files)} files, into {folder}. "
        "Start with its README.md."
    )
