"""What the page shows of a fit: its words, and a chart of every response."""

from functools import cache
from typing import Any

import numpy as np
import xarray as xr

from carom import datasets
from carom.explorer.charts import BLUE, GREY, VERMILION, Figure, axes_of, line
from carom.explorer.stages import short
from carom.fitting import Fit, fit
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import prefixed

LINES = {
    "exact": (BLUE, "solid", 2.2),
    "Walton": ("#009e73", "dot", 1.4),
    "rigid Coulomb": (GREY, "dash", 1.4),
}


@cache
def fit_of(name: str) -> dict[str, Any]:
    """Return the fit of measured rebounds that come along."""
    return shown_fit(fit(datasets.path(name)))


def shown_fit(found: Fit) -> dict[str, Any]:
    """Return the words and charts of a fit, as JSON can hold them."""
    dataset = found.to_dataset()
    if found.losses is not None and found.best.model.problem.is_normal:
        return {"words": str(found), "figures": [_drops(dataset)]}
    figures = [_chart(dataset.sel(response=n), str(n)) for n in dataset["response"].values]
    return {"words": str(found), "figures": figures}


def _chart(one: xr.Dataset, name: str) -> Figure:
    scale, unit = _scale(name, one["measured"].values)
    along = np.degrees(one["curve_incidence"].values)
    traces: list[Figure] = [
        line(along, scale * one["curve_expected"].sel(law=law).values, str(law), *LINES[str(law)])
        for law in one["law"].values
    ]
    values, errors = (scale * one[key].values for key in ("measured", "error"))
    traces.append(_measured(np.degrees(one["incidence"].values), values, errors))
    text = name.replace("_", " ") + (f" ({unit})" if unit != "1" else "")
    return axes_of(traces, "incidence of the contact point (deg)", text)


def _drops(dataset: xr.Dataset) -> Figure:
    """Return restitution against speed, measured and by laws of losses."""
    speeds = dataset["loss_speed"].values
    traces: list[Figure] = [
        line(speeds, dataset["loss_restitution"].sel(loss_law=law).values, str(law), *style)
        for law, style in zip(dataset["loss_law"].values, LINES.values(), strict=True)
    ]
    columns = ("normal_speed", "restitution", "restitution_error")
    traces.append(_measured(*(dataset[name].values for name in columns)))
    return axes_of(traces, "normal speed before (m/s)", "restitution")


def _measured(x: Array, y: Array, errors: Array) -> Figure:
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "measured",
        "x": short(x),
        "y": short(y),
        "error_y": {"type": "data", "array": short(errors), "thickness": 1},
        "marker": {"color": VERMILION, "size": 6},
        "hovertemplate": "%{y:.4g}",
    }


def _scale(name: str, values: Any) -> tuple[float, str]:
    unit = GLOSSARY[name].unit if name in GLOSSARY else "1"
    return (float(np.degrees(1.0)), "deg") if unit == "rad" else prefixed(values, unit)
