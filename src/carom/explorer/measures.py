"""Measured rebounds on the page: those that come along, or a file, and their fit."""

import json
import logging
from typing import Any

from dash import ClientsideFunction, Dash, Input, Output, State, no_update

from carom.explorer.fits import fitted
from carom.explorer.uploads import LARGEST_UPLOAD, fit_of, fit_of_upload, shown_name
from carom.explorer.views import OF_BODIES, View
from carom.quantities import InputError

log = logging.getLogger(__name__)


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
