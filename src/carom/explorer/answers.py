"""What a change of the view comes to on the page: pictures, charts, numbers."""

from math import isfinite
from typing import Any

from dash import ClientsideFunction, Dash, Input, Output, State, html, no_update
from dash.exceptions import PreventUpdate

from carom.explorer import charts
from carom.explorer.limits import LAW_SECONDS
from carom.explorer.overlays import LawCurve, exact_curve, followers, law_curves
from carom.explorer.scenes import Scene, scene_of
from carom.explorer.views import View
from carom.io.labels import MARKS
from carom.quantities.refusals import InputError

EQUAL = 1e-6  # laws are solved to 1e-8
PROMPT = 0.03  # s that an answer waits for the contact laws; what is not solved then follows
CHARTS = ("forces", "rebounds", "energies")
WITH_LAWS = (("figures", "data"), ("results", "children"))
DRAWN = (*WITH_LAWS, ("scene", "data"), ("query", "data"), ("late", "data"))


def connect_answers(app: Dash) -> None:
    """Solve the impact of the view and draw it: the moving pictures first, then the charts."""

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
        laws = law_curves(scene, view.laid_over, LAW_SECONDS, followers.joined())
        figures, results = _with_laws(view, scene, laws)
        slow = [label for label, law in zip(view.laid_over, laws, strict=True) if law is None]
        if slow:
            told = f"{', '.join(slow)}: not solved within {LAW_SECONDS:g} s; choose fewer at a time"
            results.append(html.P(told, className="carom-caution"))
        return [figures, results]

    for name, shown in (("show", "scene"), ("link", "query"), ("attach", "view")):
        app.clientside_callback(
            ClientsideFunction("carom", name), Input(shown, "data"), prevent_initial_call=True
        )
    app.clientside_callback(
        ClientsideFunction("carom", "chart"),
        [Output(name, "figure") for name in CHARTS],
        Input("figures", "data"),
        prevent_initial_call=True,
    )


def _drawn(view: View) -> list[Any]:
    """Return what goes into `DRAWN`."""
    scene = scene_of(view)
    laws = law_curves(scene, view.laid_over, PROMPT)
    late = [label for label, law in zip(view.laid_over, laws, strict=True) if law is None]
    return [*_with_laws(view, scene, laws), scene.moving(), view.query(), late]


def _with_laws(view: View, scene: Scene, laws: list[LawCurve | None]) -> list[Any]:
    """Return what goes into `WITH_LAWS`."""
    figures = (
        charts.forces(scene, laws),
        charts.rebounds(scene, exact_curve(scene), laws),
        charts.energies(scene),
    )
    results = _table(scene, laws)
    if view.undamped:
        told = f"{', '.join(view.undamped)}: has no damping, and is not laid over losses"
        results.append(html.P(told, className="carom-caution"))
    return [figures, results]


def _table(scene: Scene, laws: list[LawCurve | None]) -> list[Any]:
    rows = [_row(name, text) for name, text in scene.results.items()]
    for law, (color, dash) in charts.styles(laws):
        if isfinite(law.at):
            key = html.Span(className=f"carom-key carom-{dash}", style={"borderColor": color})
            text = f"{law.at + 0.0:.6g}, {_off(law.at - scene.psi_out)}"
            rows.append(_row([key, f"ψ₂ by {law.label}"], text))
    return [html.Table(html.Tbody(rows), className="carom-table"), *_findings(scene)]


def _row(name: Any, text: str) -> html.Tr:
    return html.Tr([html.Th(name, scope="row"), html.Td(text)])


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
