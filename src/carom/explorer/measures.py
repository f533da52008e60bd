"""Measured rebounds on the page: those that come along, or a file, and their fit."""

import json
import logging
from base64 import b64decode
from binascii import Error as NotBase64
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import xarray as xr
from dash import ClientsideFunction, Dash, Input, Output, State, dcc, html, no_update

from carom import datasets
from carom.explorer.charts import BLUE, CHART, GREY, VERMILION, Figure, axes_of, line
from carom.explorer.stages import short
from carom.explorer.views import OF_BODIES, View
from carom.fitting import Fit, fit
from carom.io.tables import read_table
from carom.plots.style import prefixed
from carom.quantities.glossary import GLOSSARY
from carom.quantities.units import InputError, refusal

LINES = {
    "exact": (BLUE, "solid", 2.2),
    "Walton": ("#009e73", "dot", 1.4),
    "rigid Coulomb": (GREY, "dash", 1.4),
}
log = logging.getLogger(__name__)
LARGEST_UPLOAD = 1_000_000  # bytes
MOST_ROWS = 2000
LONGEST_NAME = 80


def fitted(found: Fit) -> list[Any]:
    """Return what the page shows of a fit."""
    dataset = found.to_dataset()
    figures = [_chart(dataset.sel(response=n), str(n)) for n in dataset["response"].values]
    how: Any = {"config": CHART, "responsive": True, "className": "carom-chart"}
    text = html.Pre(str(found), className="carom-code", tabIndex="0")
    return [text, *(dcc.Graph(figure=figure, **how) for figure in figures)]


def _chart(one: xr.Dataset, name: str) -> Figure:
    scale, unit = _scale(name, one["measured"].values)
    along = np.degrees(one["curve_incidence"].values)
    traces: list[Figure] = [
        line(along, scale * one["curve_expected"].sel(law=law).values, str(law), *LINES[str(law)])
        for law in one["law"].values
    ]
    traces.append(_points(one, scale))
    text = name.replace("_", " ") + (f" ({unit})" if unit != "1" else "")
    return axes_of(traces, "incidence of the contact point (deg)", text)


def _points(one: xr.Dataset, scale: float) -> Figure:
    error = {"type": "data", "array": short(scale * one["error"].values), "thickness": 1}
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "measured",
        "x": short(np.degrees(one["incidence"].values)),
        "y": short(scale * one["measured"].values),
        "error_y": error,
        "marker": {"color": VERMILION, "size": 6},
        "hovertemplate": "%{y:.4g}",
    }


def _scale(name: str, values: Any) -> tuple[float, str]:
    unit = GLOSSARY[name].unit if name in GLOSSARY else "1"
    return (float(np.degrees(1.0)), "deg") if unit == "rad" else prefixed(values, unit)


def connect_measures(app: Dash) -> None:
    """Fit what is chosen or uploaded; the last of both counts."""
    bodies = json.dumps(("given", *OF_BODIES))
    app.clientside_callback(
        f"(...sent) => dash_clientside.controls.accept({bodies}, {LARGEST_UPLOAD}, ...sent)",
        Output("file", "data"),
        Output("fit-notice", "children"),
        Output("data", "value", allow_duplicate=True),
        Output("upload", "contents"),
        Input("upload", "contents"),
        State("upload", "filename"),
        State("query", "data"),
        prevent_initial_call=True,
    )
    app.clientside_callback(
        ClientsideFunction("controls", "dismiss"),
        Output("file", "data", allow_duplicate=True),
        Input("data", "value"),
        prevent_initial_call=True,
    )
    app.clientside_callback(
        f"(...now) => dash_clientside.controls.refit({bodies}, ...now)",
        Output("file", "data", allow_duplicate=True),
        Input("query", "data"),
        State("file", "data"),
        prevent_initial_call=True,
    )

    @app.callback(
        Output("fit", "children"),
        Output("fit-notice", "children", allow_duplicate=True),
        Input("data", "value"),
        Input("file", "data"),
        State("query", "data"),
        running=[(Output("fit-progress", "children"), "fitting ...", "")],
        prevent_initial_call=True,
    )
    def measure(data: str, file: dict[str, str] | None, query: str | None) -> list[Any]:
        try:
            if data:
                return [fitted(fit_of(data)), ""]
            if file is None:
                return [None, no_update]
            found = fit_of_upload(View.of(query or ""), file["contents"], file["name"])
            said = f"{shown_name(file['name'])}: fitted, the link does not hold the file"
            return [fitted(found), said]
        except InputError as error:
            return [None, str(error)]
        except Exception as error:  # not a word of the page's own notice, which is the impact's
            log.exception("fit")
            return [None, f"failed, {type(error).__name__}"]


def fit_of(name: str) -> Fit:
    """Return the fit of measured rebounds that come along."""
    return fit(datasets.path(name))


def fit_of_upload(view: View, contents: str, name: str) -> Fit:
    """Return the fit of a file as the browser sends it; bodies of the view unless it tells them.

    Raises InputError if it is too large, no table, or cannot be fitted.
    """
    text = _decoded(contents)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "upload.csv"
        file.write_bytes(text)
        try:
            return _fitted(view, file)
        except InputError as error:
            raise InputError(str(error).replace(str(file), shown_name(name))) from None


def shown_name(name: str) -> str:
    """Return the name of a user's file, fit to be shown."""
    last = str(name).replace("\\", "/").rpartition("/")[2]
    return "".join(letter for letter in last if letter.isprintable())[:LONGEST_NAME] or "file"


def _decoded(contents: str) -> bytes:
    if not isinstance(contents, str):
        raise InputError("file: it did not arrive; choose it again")
    try:
        found = b64decode(contents.partition(",")[2], validate=True)
    except NotBase64:
        raise InputError("file: it did not arrive whole; choose it again") from None
    if len(found) > LARGEST_UPLOAD:
        allowed = f"must be at most {LARGEST_UPLOAD} bytes; leave out what is not needed"
        raise refusal("file", f"{len(found)} bytes", allowed)
    return found


def _fitted(view: View, file: Path) -> Fit:
    table = read_table(file)
    if len(table.rows) > MOST_ROWS:
        allowed = f"must be at most {MOST_ROWS} rows; use carom fit for more"
        raise refusal("file", f"{len(table.rows)} rows", allowed)
    if table.case is None and view.in_numbers:
        raise InputError("bodies: the file does not tell them; choose bodies on the left")
    return fit(file, pair=view.pair if table.case is None else None)
