"""Measured rebounds on the page: those that come along, or a file, and their fit."""

import json
import logging
from typing import Any

from dash import ClientsideFunction, Dash, Input, Output, State, dcc, html, no_update

from carom.explorer.charts import CHART
from carom.explorer.fits import fit_of
from carom.explorer.limits import LARGEST_UPLOAD, Busy
from carom.explorer.uploads import shown_name
from carom.explorer.views import CHOICES, OF_BODIES, View
from carom.explorer.worker import Worker
from carom.quantities.refusals import InputError, refusal

log = logging.getLogger(__name__)


def connect_measures(app: Dash, worker: Worker) -> None:
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
    def measure(data: Any, file: Any, query: Any) -> list[Any]:
        try:
            if not data and file is None:
                return [None, no_update]
            return _shipped(data) if data else _uploaded(worker, file, View.of(query or ""))
        except (InputError, Busy) as error:
            return [None, str(error)]
        except Exception as error:  # not a word of the page's own notice, which is the impact's
            log.error("fit: %s: %s", type(error).__name__, " ".join(str(error).split()))
            return [None, f"failed, {type(error).__name__}"]


def _shipped(name: Any) -> list[Any]:
    if name not in CHOICES["data"]:
        raise refusal("data", name, f"must be one of: {'; '.join(filter(None, CHOICES['data']))}")
    return [_panel(fit_of(name)), ""]


def _uploaded(worker: Worker, file: Any, view: View) -> list[Any]:
    contents, name = (file.get("contents"), file.get("name")) if isinstance(file, dict) else ("", 0)
    if not (isinstance(contents, str) and isinstance(name, str)):
        raise InputError("file: it did not arrive; choose it again")
    found = worker.fit(view.query(), contents, name)
    return [_panel(found), f"{shown_name(name)}: fitted, the link does not hold the file"]


def _panel(found: dict[str, Any]) -> list[Any]:
    """Return a fit as the page shows it."""
    how: Any = {"config": CHART, "responsive": True, "className": "carom-chart"}
    text = html.Pre(found["words"], className="carom-code", tabIndex="0")
    return [text, *(dcc.Graph(figure=figure, **how) for figure in found["figures"])]
