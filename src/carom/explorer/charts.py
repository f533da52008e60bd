"""The charts of the page as plotly takes them: plain dictionaries, colours that suit any theme."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from carom.dimensionless.rebounds import regime_borders
from carom.explorer.overlays import LawCurve
from carom.explorer.scenes import OF_CONTACT, Scene
from carom.explorer.stages import short
from carom.plots.bands import SIGNS, mirrored
from carom.plots.impact import ENERGIES, LOST
from carom.quantities.arrays import Array

Figure = dict[str, Any]
Laws = Sequence[LawCurve | None]  # None: not solved yet

BLUE, VERMILION, ORANGE, GREEN, GREY = "#2b8cc4", "#d55e00", "#e69f00", "#009e73", "#8a8f98"
CHART: Any = {"displayModeBar": False, "responsive": True}
LAW_COLORS = (GREEN, "#cc79a7", ORANGE, "#8d6fc1", "#7f8a00", "#b0793d", "#56b4e9")
DASHES = ("dash", "dot", "dashdot", "longdash")
PHASE_FILLS = {
    ("stick", 0): "rgba(86, 180, 233, 0.22)",
    ("slip", 1): "rgba(230, 159, 0, 0.20)",
    ("slip", -1): "rgba(240, 200, 40, 0.28)",
    ("gross slip", 1): "rgba(213, 94, 0, 0.20)",
    ("gross slip", -1): "rgba(204, 121, 167, 0.24)",
}
REGIME_FILLS = {
    "stick": PHASE_FILLS["stick", 0],
    "slide, stick": PHASE_FILLS["slip", 1],
    "slide, slip": PHASE_FILLS["gross slip", 1],
    "slide": "rgba(138, 143, 152, 0.16)",
}
ENERGY_FILLS = {  # colour and pattern
    "normal_kinetic_energy": ("#c9d3dd", ""),
    "tangential_kinetic_energy": ("#8db9dc", "."),
    "contact_kinetic_energy": ("#8db9dc", "."),
    "spin_kinetic_energy": (BLUE, ""),
    "normal_elastic_energy": ("#ecd9a4", "/"),
    "tangential_elastic_energy": (ORANGE, ""),
    "frictional_work": ("#7d838b", "\\"),
    "normal_loss": ("#e3b5cd", "x"),
    "shear_loss": ("#b07aa1", "-"),
}
ENERGY_NAMES = {name: label for name, (label, *_) in (ENERGIES | LOST).items()} | OF_CONTACT
HEADROOM = 1.25  # of the forces: above them the phases have their names
ROOM = 1.12  # of the shares of energy: above them the phases have their names
NAMED = 3  # laws that a legend has room for; of more the table of results is the key
NARROW = 0.07  # of the axis: a band below that goes without its name


def forces(scene: Scene, laws: Laws = ()) -> Figure:
    """Return F_x between its limits against time, phases shaded."""
    drawn = styles(laws)
    time = scene.share * scene.duration
    name = f"friction on the second body, F_x ({scene.force_unit})"
    traces = [
        line(time, scene.limit, "± µ F_z, exact", GREY, "dash", 1.2, group="limit"),
        line(time, -scene.limit, "± µ F_z", GREY, "dash", 1.2, group="limit", shown=False),
        line(time, scene.force, "F_x", BLUE, "solid", 2.4),
        *(line(law.share * scene.duration, law.force, law.label, *style) for law, style in drawn),
    ]
    figure = axes_of(traces, f"time ({scene.time_unit})", name, scene)
    limits = [scene.limit, *(law.force for law, _ in drawn)]
    most = max(float(np.abs(part).max(initial=0.0)) for part in limits) or 1.0
    figure["layout"]["yaxis"]["range"] = [-1.1 * most, HEADROOM * most]
    figure["layout"]["showlegend"] = len(drawn) <= NAMED
    longest = max([1.0, *(float(law.share.max(initial=0.0)) for law, _ in drawn)])
    figure["layout"]["xaxis"]["range"] = [0.0, longest * scene.duration]
    return figure


def styles(laws: Laws) -> list[tuple[LawCurve, tuple[str, str]]]:
    """Return the laws that are solved with colour and dash, which depend on their places."""
    return [(law, _style(row)) for row, law in enumerate(laws) if law is not None]


def energies(scene: Scene) -> Figure:
    """Return how the energy is shared in time, phases shaded."""
    time = short(scene.share * scene.duration)
    traces = [
        {
            "type": "scatter",
            "mode": "lines",
            "stackgroup": "energy",
            "name": ENERGY_NAMES[name],
            "x": time,
            "y": short(part),
            "line": {"width": 0.8, "color": GREY},
            "fillcolor": ENERGY_FILLS[name][0],
            "fillpattern": {
                "shape": ENERGY_FILLS[name][1],
                "bgcolor": ENERGY_FILLS[name][0],
                "fgcolor": "#5d646e",
                "size": 6,
            },
            "hovertemplate": "%{y:.1%}",
        }
        for name, part in scene.energies.items()
        if np.any(part > 0.0)
    ]
    figure = axes_of(traces, f"time ({scene.time_unit})", "share of energy", scene)
    room = {"range": [0.0, ROOM], "tickformat": ".0%", "tickvals": [0.0, 0.25, 0.5, 0.75, 1.0]}
    figure["layout"]["yaxis"] |= room
    names = figure["layout"]["annotations"]  # turned ones would run into the stack
    figure["layout"]["annotations"] = [name for name in names if not name["textangle"]]
    figure["layout"]["shapes"] += [_border(scene.duration * p.start) for p in scene.phases[1:]]
    return figure


def _border(time: float) -> Figure:
    """Return the line of a change of phase over what hides the bands."""
    place = {"x0": time, "x1": time, "y0": 0.0, "y1": 1.0, "xref": "x", "yref": "paper"}
    return {"type": "line", **place, "line": {"width": 0.8, "color": "#5d646e", "dash": "dot"}}


def rebounds(scene: Scene, curve: tuple[Array, Array], laws: Laws = ()) -> Figure:
    """Return psi_2 against psi_1 with the bands of the regimes and the present point."""
    (psi, out), drawn = curve, styles(laws)
    traces = [
        line(psi, out, "exact", BLUE, "solid", 2.4),
        *(line(law.psi_in, law.psi_out, law.label, *style) for law, style in drawn),
        *(
            _point(scene.psi_in, law.at, law.label, color, "x")
            for law, (color, _) in drawn
            if np.isfinite(law.at)
        ),
    ]
    if np.isfinite(scene.psi_in):
        traces.append(_point(scene.psi_in, scene.psi_out, "this impact", VERMILION, "circle"))
    figure = axes_of(traces, "ψ₁ before", "ψ₂ after")
    figure["layout"]["showlegend"] = len(drawn) <= NAMED
    figure["layout"] |= _bands(_regimes(scene, psi), float(psi[0]), float(psi[-1]))
    figure["layout"]["xaxis"]["range"] = [float(psi[0]), float(psi[-1])]
    return figure


def _regimes(scene: Scene, psi: Array) -> Iterator[tuple[float, float, str, str]]:
    ends = [0.0, *regime_borders(scene.chi, scene.restitution).tolist(), np.inf]
    for name, start, end in mirrored(REGIME_FILLS, ends, psi[0], psi[-1]):
        yield float(start), float(end), name, REGIME_FILLS[name]


def line(
    x: Array,
    y: Array,
    name: str,
    color: str,
    dash: str,
    width: float = 1.6,
    *,
    group: str = "",
    shown: bool = True,
) -> Figure:
    """Return a line."""
    return {
        "type": "scatter",
        "mode": "lines",
        "name": name,
        "x": short(x),
        "y": short(y),
        "line": {"color": color, "dash": dash, "width": width},
        "legendgroup": group,
        "showlegend": shown,
        "hovertemplate": "%{y:.4g}",
    }


def _point(x: float, y: float, name: str, color: str, symbol: str) -> Figure:
    return {
        "type": "scatter",
        "mode": "markers",
        "name": name,
        "x": [x],
        "y": [y],
        "marker": {"color": color, "size": 11 if symbol == "circle" else 9, "symbol": symbol},
        "showlegend": symbol == "circle",
        "hovertemplate": "ψ₁ = %{x:.4g}<br>ψ₂ = %{y:.5g}",
    }


def _style(row: int) -> tuple[str, str]:
    return LAW_COLORS[row % len(LAW_COLORS)], DASHES[row % len(DASHES)]


def axes_of(traces: list[Figure], x: str, y: str, scene: Scene | None = None) -> Figure:
    """Return a figure without colours of its own for paper, text and grid: the theme has them."""
    axis = {"zeroline": False, "automargin": True, "ticks": "outside", "ticklen": 4}
    layout: Figure = {
        "xaxis": {**axis, "title": {"text": x}},
        "yaxis": {**axis, "title": {"text": y}},
        "margin": {"l": 52, "r": 10, "t": 8, "b": 40},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "hovermode": "x unified",
        "legend": {"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 0.0},
        "font": {"size": 12},
        "uirevision": "same",  # a zoom outlives a change
        "shapes": [],
    }
    if scene is not None:
        layout |= _bands(_phases(scene), 0.0, scene.duration)
        layout["xaxis"]["range"] = [0.0, scene.duration]
    return {"data": traces, "layout": layout}


def _phases(scene: Scene) -> Iterator[tuple[float, float, str, str]]:
    for phase in scene.phases:
        name = phase.kind + SIGNS[phase.sign]
        fill = PHASE_FILLS[phase.kind, phase.sign]
        yield phase.start * scene.duration, phase.end * scene.duration, name, fill


def _bands(
    bands: Iterable[tuple[float, float, str, str]], first: float, last: float
) -> dict[str, Any]:
    """Return shaded bands with their names, the names where there is room."""
    shapes, names = [], []
    for start, end, name, fill in bands:
        if end <= start:
            continue
        place = {"xref": "x", "yref": "paper", "y0": 0.0, "y1": 1.0, "x0": start, "x1": end}
        line = {"width": 0.6, "color": GREY}
        shapes.append({"type": "rect", **place, "fillcolor": fill, "line": line, "layer": "below"})
        if end - start > NARROW * (last - first):
            at = {"x": 0.5 * (start + end), "y": 0.99, "xref": "x", "yref": "paper"}
            turned = -90 if end - start < 2.5 * NARROW * (last - first) else 0
            look = {"showarrow": False, "yanchor": "top", "textangle": turned}
            names.append({"text": name, **at, **look})
    return {"shapes": shapes, "annotations": names}
