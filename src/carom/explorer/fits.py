"""A fit to measured rebounds as it is shown: a chart for each response, and the words."""

from typing import TYPE_CHECKING, Any

import numpy as np
from dash import dcc, html

from carom.explorer.charts import BLUE, CHART, GREY, VERMILION, Figure, axes_of, line
from carom.explorer.stages import short
from carom.fitting import Fit
from carom.glossary import GLOSSARY
from carom.plots.style import prefixed

if TYPE_CHECKING:
    import xarray as xr

LINES = {
    "exact": (BLUE, "solid", 2.2),
    "Walton": ("#009e73", "dot", 1.4),
    "rigid Coulomb": (GREY, "dash", 1.4),
}


def fitted(found: Fit) -> list[Any]:
    """Return what the page shows of a fit."""
    dataset = found.to_dataset()
    return [
        html.Pre(str(found), className="carom-code", tabIndex="0"),
        *(
            dcc.Graph(
                figure=_chart(dataset.sel(response=name), str(name)),
                config=CHART,
                responsive=True,
                className="carom-chart",
            )
            for name in dataset["response"].values
        ),
    ]


def _chart(one: "xr.Dataset", name: str) -> Figure:
    scale, unit = _scale(name, one["measured"].values)
    along = np.degrees(one["curve_incidence"].values)
    traces: list[Figure] = [
        line(along, scale * one["curve_expected"].sel(law=law).values, str(law), *LINES[str(law)])
        for law in one["law"].values
    ]
    traces.append(_points(one, scale))
    text = name.replace("_", " ") + (f" ({unit})" if unit != "1" else "")
    return axes_of(traces, "incidence of the contact point (deg)", text)


def _points(one: "xr.Dataset", scale: float) -> Figure:
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
