"""Files of a view: histories, pictures, and the lines of Python, each at an address of its own."""

from collections.abc import Callable, Mapping
from dataclasses import fields
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from types import MappingProxyType
from typing import TYPE_CHECKING
from urllib.parse import parse_qs

import numpy as np
from flask import Flask, Response, request

from carom.curves import curve
from carom.dimensionless.solution import solve
from carom.dimensionless.states import History
from carom.explorer.scenes import TIMES, impact_of
from carom.explorer.scripts import script
from carom.explorer.views import View
from carom.plots import plot_curve, plot_impact, plot_patch, save_figure
from carom.quantities import InputError, refusal
from carom.results import labelled_dataset
from carom.storage import save

if TYPE_CHECKING:
    import xarray as xr

KINDS = MappingProxyType(
    {
        ".csv": "text/csv; charset=utf-8",
        ".nc": "application/x-netcdf",
        ".png": "image/png",
        ".py": "text/x-python; charset=utf-8",
    }
)
POINTS = 241  # of a curve

_drawing = Lock()  # matplotlib's settings are those of the whole process


def add_downloads(server: Flask) -> None:
    """Let the server answer with files of a view at /history.csv and so on, ?... as in a link."""
    for name in WRITERS:
        server.add_url_rule(f"/{name}", name, _answer(name))


def _answer(name: str) -> Callable[[], Response]:
    def answer() -> Response:
        query = request.query_string.decode("ascii", "replace")
        with TemporaryDirectory() as folder:
            file = Path(folder) / name
            WRITERS[name](View.of(query), _time(query), file)
            content = file.read_bytes()
        attached = {"Content-Disposition": f"attachment; filename={name}"}
        return Response(content, headers=attached, content_type=KINDS[file.suffix])

    return answer


def _time(query: str) -> float:
    """Return the time in a link, within the contact, as a share of its duration."""
    text = parse_qs(query).get("time", ["0.5"])[-1]
    try:
        return min(max(float(text), 0.0), 1.0)
    except ValueError:
        raise refusal("time", text, "must be a share of the duration, e.g. 0.5") from None


def _history(view: View, _: float, file: Path) -> None:
    if view.in_numbers:
        save(dimensionless_history(view), file)
    else:
        save(impact_of(view).history(TIMES), file)


def _picture(view: View, _: float, file: Path) -> None:
    with _drawing:
        if view.in_numbers:
            most = max(4.0 * view.chi, abs(view.psi))
            figure = plot_curve(curve(view.chi, np.linspace(0.0, most, POINTS)))
        else:
            figure = plot_impact(impact_of(view).history(TIMES))
        save_figure(figure, file)


def _patch(view: View, time: float, file: Path) -> None:
    if view.in_numbers:
        raise InputError("patch.png: fields have units; choose bodies instead of psi_1 and chi")
    hit = impact_of(view)
    with _drawing:
        save_figure(plot_patch(hit.fields(time * hit.duration)), file)


def _lines(view: View, time: float, file: Path) -> None:
    file.write_text(script(view, time), encoding="utf-8")


WRITERS: Mapping[str, Callable[[View, float, Path], None]] = MappingProxyType(
    {
        "history.csv": _history,
        "history.nc": _history,
        "history.png": _picture,
        "patch.png": _patch,
        "view.py": _lines,
    }
)


def dimensionless_history(view: View) -> "xr.Dataset":
    """Return the history of an impact that psi_1 and chi tell, in the units of `carom.solve`."""
    solution = solve(view.psi, view.chi)
    history = solution.history(TIMES)
    columns = {
        field.name: ("time", getattr(history, field.name), {"long_name": field.name, "units": "1"})
        for field in fields(History)
    }
    time = columns.pop("time")
    numbers = {"psi_in": view.psi, "chi": view.chi, "psi_out": solution.psi_out}
    title = {"title": "oblique impact, in the units of carom.solve"}
    return labelled_dataset({**columns, **numbers}, {"time": time}, title)
