"""`carom explore`: the page."""

import json
import os
import signal
import webbrowser
from contextlib import suppress
from typing import Annotated

import typer

from carom.cli.cases import whole_option
from carom.quantities.units import whole


def explore_command(
    host: Annotated[
        str, typer.Option(help="Address to listen at; the default answers this machine only.")
    ] = "127.0.0.1",
    port: Annotated[str, whole_option("Port to listen at, 0 for any that is free.")] = "8050",
    open_browser: Annotated[
        bool, typer.Option("--open/--no-open", help="Whether to open a browser.")
    ] = True,
    as_json: Annotated[bool, typer.Option("--json", help="Print the address as JSON.")] = False,
) -> None:
    """Explore impacts on a page in the browser: sliders, films, contact laws, fits; Ctrl-C ends it.

    Example: carom explore

    On a machine without a screen: carom explore --no-open --port 0
    """
    from carom.explorer import explorer

    page = explorer(host=host, port=whole("port", port, 0, 65535))
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends like Ctrl-C
    with suppress(KeyboardInterrupt):
        typer.echo(json.dumps({"url": page.url}) if as_json else f"{page.url}  (Ctrl-C ends it)")
        if open_browser:
            webbrowser.open(page.url)
        page.serve()
    os._exit(0)  # without waiting for threads that are at work
