"""The page: what can be chosen on the left, what comes of it on the right."""

from collections.abc import Iterable
from typing import Any

from dash import dcc, html

from carom.explorer.charts import CHART
from carom.explorer.views import (
    BODIES,
    CHOICES,
    KNOBS,
    NUMBERS,
    OF_BODIES,
    OF_BOTH,
    OF_MOTION,
    OF_NUMBERS,
    View,
)
from carom.verify.catalogue import CATALOGUE

LABELS = {
    "radius": "Radius of the ball",
    "material": "Material of the ball",
    "against": "It strikes a",
    "second_radius": "Radius of the second body",
    "second_material": "Material of the second body",
    "friction": "Friction, µ",
    "restitution": "Restitution, e (1: no losses but friction)",
    "speed": "Speed of approach, V",
    "angle": "Incidence from the normal",
    "spin": "Spin (positive: backspin)",
    "psi": "ψ₁, dimensionless velocity before",
    "chi": "χ, ratio of inertia to stiffness",
    "law": "Contact laws laid over",
    "data": "Measured rebounds that come along",
}
STORES = ("view", "scene", "query", "late", "figures", "carried", "file", "restored")
CONTROLS = ("given", *OF_BODIES, *OF_BOTH, *OF_MOTION, *OF_NUMBERS, "law", "data")
SLIDERS = tuple(name for name in CONTROLS if name in KNOBS and KNOBS[name].slider)
FILES = {
    "history.csv": "History, CSV",
    "history.nc": "History, NetCDF",
    "history.png": "Histories, PNG",
    "curve.png": "Rebound curve, PNG",
    "patch.png": "Contact, PNG",
    "view.py": "Python",
}
PACES = (2, 5, 10, 30)  # seconds that a film takes
LIVE: Any = {"aria-live": "polite"}


def page() -> html.Div:
    """Return the whole page, as it opens."""
    return html.Div(
        id="page",
        children=[
            dcc.Location(id="url", refresh=False),
            *(dcc.Store(id=name) for name in STORES),
            _head(),
            html.Aside(className="carom-controls", children=_controls()),
            html.Main(className="carom-panels", children=list(_panels())),
        ],
    )


def _head() -> html.Header:
    return html.Header(
        className="carom-head",
        children=[
            html.H1("Carom"),
            html.P("An elastic sphere strikes at an angle: how it leaves, and what happens inside"),
            html.Div(
                className="carom-link",
                children=[
                    html.Div(id="link-box"),
                    html.Button("Theme: auto", id="theme", type="button"),
                ],
            ),
            html.P(id="link-notice", className="carom-notice", role="alert"),
            html.P(id="notice", className="carom-notice", role="alert"),
        ],
    )


def _controls() -> list[Any]:
    opens = View()
    given = {BODIES: "bodies", NUMBERS: "ψ₁ and χ"}
    return [
        html.Details(
            className="carom-fold",
            open=True,
            children=[
                html.Summary("What strikes what"),
                html.Fieldset(
                    className="carom-field",
                    children=[
                        html.Legend("Given are"),
                        dcc.RadioItems(
                            id="given",
                            options=[{"value": key, "label": text} for key, text in given.items()],
                            value=opens.given,
                            inline=True,
                        ),
                    ],
                ),
                html.Div(id="numbers", children=[_control(name, opens) for name in OF_NUMBERS]),
                html.Div(id="motion", children=[_control(name, opens) for name in OF_MOTION]),
                *(_control(name, opens) for name in OF_BOTH),
                html.Div(id="bodies", children=[_control(name, opens) for name in OF_BODIES]),
                html.Fieldset(
                    className="carom-field carom-laws",
                    children=[
                        html.Legend(LABELS["law"]),
                        dcc.Checklist(id="law", options=_laws(), value=list(opens.law)),
                    ],
                ),
            ],
        )
    ]


def _laws() -> list[dict[str, str]]:
    """Return the contact laws to choose from, each with who uses it as a hint."""
    return [
        {"value": entry.label, "label": entry.label, "title": f"used by: {entry.used_by}"}
        for entry in CATALOGUE
    ]


def _control(name: str, opens: View) -> html.Div:
    """Return a labelled control: a choice, or a number with its slider."""
    value = getattr(opens, name)
    if name in CHOICES:
        label = html.Label(LABELS[name], htmlFor=name)
        return html.Div([label, _choice(name, CHOICES[name], value)], className="carom-field")
    knob = KNOBS[name]
    unit = f" ({knob.unit})" if knob.unit else ""
    parts: list[Any] = [
        html.Label(LABELS[name] + unit, htmlFor=name),
        # of type "number" a browser drops what it does not know, and 1,5 becomes 15
        dcc.Input(id=name, type="text", value=value, autoComplete="off"),
    ]
    if knob.slider is not None:
        low, high, step = knob.slider
        parts.append(
            dcc.Input(id=f"{name}-slider", type="range", value=value, min=low, max=high, step=step)
        )
    return html.Div(parts, className="carom-field", id=f"{name}-field")


def _choice(name: str, known: Iterable[str], value: str) -> dcc.Dropdown:
    options = [{"value": key, "label": key or "none"} for key in known]
    return dcc.Dropdown(id=name, options=options, value=value, clearable=False)


def _panels() -> Iterable[Any]:
    yield _panel(
        "The rebound",
        html.Canvas(id="stage", **_described("The bodies before, during and after the contact")),
        html.Div(
            className="carom-clock",
            children=[
                html.Button("Play", id="play", type="button"),
                html.Div(id="time-box"),  # the page keeps time itself
                html.Output(id="clock"),
                html.Label("Seconds a film", htmlFor="pace"),
                html.Select(
                    id="pace",
                    children=[html.Option(f"{pace} s", value=str(pace)) for pace in PACES],
                ),
            ],
        ),
    )
    yield _panel(
        "The contact from above",
        html.Canvas(id="patch", **_described("Traction, stick and slip in the contact")),
    )
    yield _panel("ψ₂ against ψ₁", _chart("rebounds"))
    yield _panel("Force", _chart("forces", "carom-history"))
    yield _panel("Energy", _chart("energies", "carom-history"))
    yield _panel("The result", html.Div(id="results", **LIVE))
    yield _panel("Measured rebounds", *_measured())
    yield _panel("Take it along", *_downloads())


def _panel(title: str, *children: Any) -> html.Section:
    return html.Section([html.H2(title), *children], className="carom-panel")


def _described(text: str) -> dict[str, Any]:
    return {"role": "img", "aria-label": text}


def _chart(name: str, classes: str = "") -> html.Div:
    graph = dcc.Graph(id=name, config=CHART, responsive=True, className="carom-chart")
    return html.Div(graph, className=classes)


def _measured() -> Iterable[Any]:
    yield html.P(
        "Friction, stiffness ratio and restitution from a table: one row an impact, e.g. with the "
        "columns angle [deg] and contact_restitution, as in the result above, or spin_out. The "
        "bodies are those chosen here, unless the file tells."
    )
    yield _control("data", View())
    yield dcc.Upload(
        id="upload",
        className="carom-drop",
        accept=".csv,text/csv,text/plain",
        children=html.Button("Choose or drop a CSV file", id="upload-button", type="button"),
    )
    yield html.P(id="fit-progress", role="status")
    yield html.P(id="fit-notice", className="carom-notice", role="alert")
    yield html.Div(id="fit")


def _downloads() -> Iterable[Any]:
    yield html.P("Every state of the page is the link above; these files tell the same state.")
    yield html.Ul(
        className="carom-downloads",
        children=[
            html.Li(_file(name, text), id=f"{name.replace('.', '-')}-item")
            for name, text in FILES.items()
        ],
    )
    yield html.Pre(id="code", className="carom-code", tabIndex="0")


def _file(name: str, text: str) -> html.A:
    what: Any = {"className": "carom-download", "download": name}
    what["data-path"] = f"/{name}"  # a link once there is a state to tell
    return html.A(text, id=name.replace(".", "-"), **what)
