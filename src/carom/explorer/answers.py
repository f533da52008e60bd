"""What happens when something on the page changes."""

import json
import logging
from math import isfinite
from typing import Any

from dash import ClientsideFunction, Dash, Input, Output, State, ctx, html, no_update
from dash.exceptions import PreventUpdate

from carom.explorer import charts
from carom.explorer.fits import fitted
from carom.explorer.layout import CONTROLS, OF_BODIES, OF_NUMBERS, SLIDERS
from carom.explorer.overlays import LawCurve, exact_curve, law_curves
from carom.explorer.scenes import Scene, scene_of
from carom.explorer.uploads import LARGEST_UPLOAD, fit_of, fit_of_upload, shown_name
from carom.explorer.views import View
from carom.quantities import InputError
from carom.results import MARKS

log = logging.getLogger(__name__)

EQUAL = 1e-6  # laws are solved to 1e-8
PROMPT = 0.03  # s that an answer waits for the contact laws; what is not solved then follows
WITH_LAWS = (("forces", "figure"), ("rebounds", "figure"), ("results", "children"))
DRAWN = (  # what a view is drawn into
    *WITH_LAWS,
    ("scene", "data"),
    ("query", "data"),
    ("late", "data"),
    ("energies", "figure"),
    ("numbers", "hidden"),
    ("motion", "hidden"),
    ("bodies", "hidden"),
    ("second_radius-field", "hidden"),
    ("patch-png-item", "hidden"),
    ("history-png-item", "hidden"),
)


def connect(app: Dash) -> None:
    """Let the controls of the page do what they say."""
    _restore(app)
    _gather(app)
    _answer(app)
    _measure(app)


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
        return [*map(_plain, values), "; ".join(map(str, wrong)), [view.query()]]


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value


def _gather(app: Dash) -> None:
    """Keep sliders and numbers equal, and gather all controls as the query of a link."""
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
        ClientsideFunction("controls", "carry"),
        [Output(name, "value", allow_duplicate=True) for name in OF_NUMBERS],
        Input("given", "value"),
        State("restored", "data"),
        prevent_initial_call=True,
    )


def _answer(app: Dash) -> None:
    """Solve the impact of the view and draw it."""

    @app.callback(
        [Output(*part) for part in DRAWN],
        Output("notice", "children"),
        Output("link-notice", "children", allow_duplicate=True),
        Input("view", "data"),
        State("restored", "data"),
        prevent_initial_call=True,
    )
    def answer(query: str | None, restored: list[str] | None) -> list[Any]:
        try:
            view = View.of(query or "")
            return [*_drawn(view), "", no_update if [view.query()] == restored else ""]
        except InputError as error:
            return [*[no_update for _ in DRAWN], str(error), no_update]

    @app.callback(
        [Output(*part, allow_duplicate=True) for part in WITH_LAWS],
        Input("late", "data"),
        State("query", "data"),
        prevent_initial_call=True,
    )
    def follow(late: list[str], query: str) -> list[Any]:
        if not late:  # what an earlier view still waits for is dropped all the same
            raise PreventUpdate
        view = View.of(query)
        scene = scene_of(view)
        return _with_laws(scene, law_curves(scene, view.law))

    app.clientside_callback(
        ClientsideFunction("carom", "show"), Input("scene", "data"), prevent_initial_call=True
    )
    app.clientside_callback(
        ClientsideFunction("carom", "link"), Input("query", "data"), prevent_initial_call=True
    )


def _drawn(view: View) -> list[Any]:
    """Return what goes into `DRAWN`."""
    scene = scene_of(view)
    laws = law_curves(scene, view.law, PROMPT)
    return [
        *_with_laws(scene, laws),
        scene.moving(),
        view.query(),
        [label for label, law in zip(view.law, laws, strict=True) if law is None],
        charts.energies(scene),
        not view.in_numbers,
        view.in_numbers,
        view.in_numbers,
        view.against == "half-space",
        view.in_numbers,
        view.in_numbers,
    ]


def _with_laws(scene: Scene, laws: list[LawCurve | None]) -> list[Any]:
    """Return what goes into `WITH_LAWS`."""
    return [
        charts.forces(scene, laws),
        charts.rebounds(scene, exact_curve(scene), laws),
        _table(scene, laws),
    ]


def _table(scene: Scene, laws: list[LawCurve | None]) -> list[Any]:
    rows = dict(scene.results)
    for law in laws:
        if law is not None and isfinite(law.at):
            rows[f"ψ₂ by {law.label}"] = f"{law.at:.6g}, {_off(law.at - scene.psi_out)}"
    body = [html.Tr([html.Th(name, scope="row"), html.Td(text)]) for name, text in rows.items()]
    table = html.Table(html.Tbody(body), className="carom-table")
    return [table, *_findings(scene)]


def _findings(scene: Scene) -> list[Any]:
    """Return the findings, those first and marked in which the theory does not hold."""
    lines = scene.findings.splitlines()
    wrong = [line for line in lines if line.startswith(MARKS[False])]
    right = [line for line in lines if line not in wrong]
    return [
        html.P("\n".join(wrong), className="carom-caution") if wrong else None,
        html.Pre("\n".join(right)),
    ]


def _off(error: float) -> str:
    return f"off by {error:+.3g}" if abs(error) > EQUAL else "exact"


def _measure(app: Dash) -> None:
    """Fit measured rebounds: those that come along, or an uploaded file."""
    bodies = json.dumps(("given", *OF_BODIES))
    app.clientside_callback(
        f"(...sent) => dash_clientside.controls.accept({bodies}, {LARGEST_UPLOAD}, ...sent)",
        Output("file", "data"),
        Output("fit-notice", "children"),
        Input("upload", "contents"),
        State("upload", "filename"),
        State("query", "data"),
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
            if ctx.triggered_id == "file" and file is not None:
                found = fit_of_upload(View.of(query or ""), file["contents"], file["name"])
                said = f"{shown_name(file['name'])}: fitted, the link does not hold the file"
                return [fitted(found), said]
            return [fitted(fit_of(data)) if data else None, ""]
        except InputError as error:
            return [None, str(error)]
        except Exception as error:  # not a word of the page's own notice, which is the impact's
            log.exception("fit")
            return [None, f"failed, {type(error).__name__}"]
