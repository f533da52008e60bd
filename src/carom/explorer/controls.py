"""How the controls hold together: a link sets them, sliders follow numbers, all become a query."""

import json
from dataclasses import replace
from math import isfinite
from typing import Any

from dash import ClientsideFunction, Dash, Input, Output, State, no_update

from carom.explorer.layout import CONTROLS, SLIDERS
from carom.explorer.scenes import impact_of
from carom.explorer.views import BODIES, OF_NUMBERS, View
from carom.quantities.refusals import InputError

CARRIED = 6  # digits of what is carried over
FIELDS = ("numbers", "motion", "bodies", "second_radius-field")  # hidden unless of use
FILES = ("patch-png-item", "history-png-item")  # hidden unless there are bodies


def connect_controls(app: Dash) -> None:
    """Let links, sliders and numbers say the same."""
    _restore(app)
    _gather(app)
    _carry(app)


def _restore(app: Dash) -> None:
    """Set the controls to what a link says, when the page opens or the browser goes back."""

    @app.callback(
        [Output(name, "value") for name in CONTROLS],
        Output("link-notice", "children"),
        Output("restored", "data"),
        Input("url", "search"),
    )
    def restore(search: str | None) -> list[Any]:
        view, wrong = View.with_complaints(search or "")
        values = [getattr(view, name) for name in CONTROLS]
        return [*map(_plain, values), "; ".join(map(str, wrong.values())), [view.query()]]


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value


def _gather(app: Dash) -> None:
    """Keep sliders and numbers equal, show what is of use, gather all as the query of a link."""
    for name in SLIDERS:
        app.clientside_callback(
            ClientsideFunction("controls", "follow"),
            Output(name, "value", allow_duplicate=True),
            Output(f"{name}-slider", "value"),
            Input(name, "value"),
            Input(f"{name}-slider", "value"),
            prevent_initial_call=True,
        )
    app.clientside_callback(
        f"(...values) => dash_clientside.controls.query({json.dumps(CONTROLS)}, values)",
        Output("view", "data"),
        [Input(name, "value") for name in CONTROLS],
        prevent_initial_call=True,
    )
    app.clientside_callback(
        ClientsideFunction("controls", "hide"),
        [Output(field, "hidden") for field in (*FIELDS, *FILES)],
        Input("given", "value"),
        Input("against", "value"),
    )


def _carry(app: Dash) -> None:
    """Keep the impact of the bodies when numbers are chosen; a link keeps the numbers it tells."""
    app.clientside_callback(
        ClientsideFunction("controls", "leaves_bodies"),
        Output("carried", "data"),
        Input("given", "value"),
        State("restored", "data"),
        State("view", "data"),
        prevent_initial_call=True,
    )

    @app.callback(
        [Output(name, "value", allow_duplicate=True) for name in OF_NUMBERS],
        Input("carried", "data"),
        prevent_initial_call=True,
    )
    def carry(query: str) -> list[Any]:
        try:
            hit = impact_of(replace(View.with_complaints(query)[0], given=BODIES))
        except InputError:
            return [no_update, no_update]
        return [
            float(f"{value:.{CARRIED}g}") if isfinite(value) else no_update
            for value in (hit.psi_in, hit.pair.chi)
        ]
