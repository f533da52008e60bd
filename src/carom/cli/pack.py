"""`carom verify pack`: the benchmark pack for developers of DEM codes."""

import json

import typer

from carom.cli.options import checking, described
from carom.io.paths import new_folder

PACK_OPTIONS = {
    "folder": typer.Argument(help="New or empty folder, e.g. bench.", metavar="FOLDER"),
    "as_json": typer.Option("--json", help="Print JSON instead of a summary."),
}


@described(PACK_OPTIONS)
def pack_command(folder: str, as_json: bool = False) -> None:
    """Write the benchmark pack for developers of DEM codes.

    Use this command to test a DEM code that you write. The pack holds reference impacts with error
    bars, and inputs of DEM codes for them. A version of the pack has the same numbers, to the last
    byte, wherever it is written.

    \b
    Example: carom verify pack bench
    """
    from carom.verify.pack import VERSION, write_pack

    with checking() as faults:
        if folder is not None:
            faults.trying(new_folder, folder)
    files = write_pack(folder)
    record = {"version": VERSION, "folder": folder, "files": files}
    what = f"benchmark pack {VERSION}, {len(files)} files, into {folder}"
    words = f"Carom has written {what}. Start with its README.md."
    typer.echo(json.dumps(record, indent=2) if as_json else words)
