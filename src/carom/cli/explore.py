"""`carom explore`: the page."""

import json
import os
import signal
import sys
import webbrowser
from contextlib import suppress
from threading import Thread

import typer

from carom.cli import heard
from carom.cli.options import checking, described, whole_option
from carom.io.paths import checked_folder
from carom.quantities.units import whole

OPTIONS = {
    "host": "Address of the page; 127.0.0.1 is for this machine only, 0.0.0.0 for others, too.",
    "port": whole_option("Port of the page; 0 takes any free port."),
    "open_browser": typer.Option(
        "--open/--no-open", help="Open the page in a browser, or only print its address."
    ),
    "export": typer.Option(
        metavar="FOLDER",
        help="Write a copy of the page that needs no server, e.g. for a course, and end.",
    ),
    "as_json": typer.Option(
        "--json", help="Print the address of the page, or with --export where the copy is, as JSON."
    ),
}


@described(OPTIONS)
def explore_command(
    host: str = "127.0.0.1",
    port: str = "8050",
    open_browser: bool = True,
    export: str | None = None,
    as_json: bool = False,
) -> None:
    """Explore impacts on a page in the browser.

    Sliders change the impact while you watch the ball, the contact, the forces and the energies.
    The page also compares contact laws of DEM codes and fits your measurements. It runs until you
    press Ctrl-C, which ends it with exit code 0. What --export writes runs in the browser alone,
    without laws, fits and files.

    \b
    Example: carom explore
    A machine without a screen: carom explore --no-open --port 0
    A copy for a web site: carom explore --export impact-page
    """
    with checking() as faults:
        number = faults.trying(whole, "port", port, 0, 65535)
        if export is not None:
            faults.trying(checked_folder, export)
    if export is not None:
        _export(export, as_json)
        return
    from carom.page import address

    bound = address.listening(host, number)
    with bound, suppress(KeyboardInterrupt, SystemExit):
        url = address.url_of(bound, host)
        words = f"{url}  (press Ctrl-C to stop the page)"
        typer.echo(json.dumps({"url": url}) if as_json else words)
        sys.stdout.flush()
        if open_browser:  # it starts while the rest is loaded, and waits
            Thread(target=webbrowser.open, args=(url,), daemon=True).start()
        from carom.page.serving import serving

        serving(bound, host).serve()
    code = 128 + heard[0] if heard and heard[0] != signal.SIGINT else 0  # Ctrl-C is its end
    os._exit(code)  # without waiting for threads that are at work


def _export(folder: str, as_json: bool) -> None:
    from carom.page.export import export

    copy = export(folder)
    size = f"{copy.bytes / 1e6:.1f} MB in {copy.files} files"
    words = f"{copy.folder}/index.html  ({size}, no server)"
    typer.echo(json.dumps(copy._asdict()) if as_json else words)
