"""A fit: of rebounds or of normal drops, data, curves, residuals; samples of its parameters."""

from textwrap import fill
from typing import Any, Unpack

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from carom.io.extras import extra
from carom.plots import style
from carom.plots.bands import mirrored, shade
from carom.plots.drawing import Drawable, draws
from carom.plots.legends import legend_outside
from carom.plots.look import Look
from carom.plots.regimes import REGIMES
from carom.quantities.glossary import GLOSSARY

ONE_INCIDENCE = 1e-9  # rad, between incidences that are drawn as one
ACROSS, TWO_COLUMNS = 2, 130.0  # responses side by side; mm that they need
UPPER, LOWER = 48.0, 20.0  # heights of curves and residuals, in mm
PER_SET = 8.0  # height of a set in mm
WORDS = {"kappa": "ratio of stiffnesses", "chi": "inertia to stiffness"}
LABEL = 30  # letters on a line of a label
OUTLIERS: Any = {"marker": "o", "ls": "none", "ms": 4.0, "zorder": 6}
OUTLIERS |= {"color": style.VERMILION, "mfc": "white"}
LAW_STYLES: dict[str, Any] = {
    "exact": {"color": style.BLACK, "lw": 1.3, "zorder": 4},
    "rigid Coulomb": {"color": style.VERMILION, "lw": 0.9, "ls": (0, (5, 1.5)), "zorder": 3},
    "Walton": {"color": style.BLUE, "lw": 0.9, "ls": (0, (1.5, 1)), "zorder": 3},
}
LOSS_STYLES: dict[str, Any] = {
    "constant": {"color": style.GREEN, "ls": (0, (1.5, 1))},
    "KelvinVoigt": {"color": style.BLUE, "ls": (0, (5, 1.5))},
    "ElasticPlastic": {"color": style.VERMILION, "ls": "-"},
    "Metal": {"color": style.PURPLE, "ls": (0, (4, 1.5, 1, 1.5))},
    "ZenerPlate": {"color": style.BLACK, "ls": "-"},
}


@draws(
    "a fit, what carom.fit(...).to_dataset() returns",
    *("measured", "residual", "curve_expected", "incidence"),
)
def plot_fit(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw what was measured against incidence, the fitted curve with its band, and residuals.

    Error bars are standard deviations, with the part that comes from the motion before; the band is
    that of the parameters, to first order. Regimes of the exact law are shaded. Outliers are marked
    with their rows; those that would make the others unreadable are triangles at the edge.

    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> angles = [10.0, 25.0, 40.0, 55.0, 70.0]
    >>> data = {"angle [deg]": angles, "impulse_ratio": [0.1, 0.2, 0.19, 0.21, 0.2]}
    >>> len(plot_fit(carom.fit(data, pair=pair, fixed={"restitution": 1.0}).to_dataset()).axes)
    2
    """
    names = [str(name) for name in dataset["response"].values]
    across = min(ACROSS if style.room(style.DOUBLE) > TWO_COLUMNS else 1, len(names))
    down = -(-len(names) // across)
    width, height = style.SINGLE if across == 1 else style.DOUBLE, down * (UPPER + LOWER) + 18.0
    shared: Any = {"sharex": "col", "height_ratios": [UPPER, LOWER] * down}
    figure, axes = style.new_figure(2 * down, across, width=width, height=height, **shared)
    for place, name in enumerate(names):
        row, column = divmod(place, across)
        _draw_response(axes[2 * row : 2 * row + 2, column], dataset, name)
    for spare in axes[2 * down - 2 :, len(names) - across * (down - 1) :].flat:
        spare.set_axis_off()
    spinning = bool(dataset.attrs.get("spinning", 1))
    incidence = "incidence of the contact point" if spinning else "angle of incidence"
    for column in range(across):
        last = axes[2 * ((len(names) - 1 - column) // across) + 1, column]
        last.set_xlabel("row" if _is_one(dataset) else f"{incidence} (deg)")
        last.tick_params(labelbottom=True)
    laws: list[Any] = [Line2D([], [], label=law, **stroke) for law, stroke in LAW_STYLES.items()]
    bands = [band.key(name) for name, band in REGIMES.items()]
    if _is_one(dataset):
        laws, bands = laws[:1], []
    marks = [Line2D([], [], label="outlier, with its row", **OUTLIERS)]
    legend_outside(figure, [*laws, *bands, *marks[: int(_outliers(dataset).sum())]], across + 1)
    return figure


@draws(
    "a fit of normal impacts, what carom.fit(...).to_dataset() returns",
    *("restitution", "normal_speed", "loss_speed", "loss_restitution"),
)
def plot_drops(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw measured restitutions against normal speed, and the laws of losses fitted to them.

    Error bars are standard deviations; of the laws the one that is likeliest comes first. Outliers
    are marked with their rows.

    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> drops = {"drop_height": [0.1, 0.2, 0.4, 0.8], "rebound_height": [0.06, 0.1, 0.17, 0.29]}
    >>> len(plot_drops(carom.fit(drops, pair=pair).to_dataset()).axes)
    1
    """
    figure, axis = style.single_axis()
    for law in dataset["loss_law"].values:
        curve = dataset["loss_restitution"].sel(loss_law=law)
        axis.plot(dataset["loss_speed"], curve, lw=1.1, label=str(law), **LOSS_STYLES[str(law)])
    speeds, values = dataset["normal_speed"].values, dataset["restitution"].values
    error, outliers = dataset["restitution_error"].values, _outliers(dataset).any(axis=1)
    _points(axis, speeds, values, error, dataset["row"].values, outliers, label="measured")
    axis.set(xlabel=_label("normal_speed", "m/s"), ylabel=_label("normal_restitution", "1"))
    axis.legend(loc="best")
    return figure


@draws(
    "parameters of several sets, what carom.joint_fit(...).to_dataset() returns",
    *("value", "low", "high"),
    along=("set", "parameter"),
)
def plot_sets(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw the parameters of several sets with their intervals, what they share only once."""
    names = [str(name) for name in dataset["parameter"].values]
    sets = [str(name) for name in dataset["set"].values]
    shared = str(dataset.attrs.get("shared", "")).split()
    rows = [*sets, *(["all sets"] if shared else [])]
    across = len(names) if style.room(style.DOUBLE) > TWO_COLUMNS else 1
    size: Any = {"width": style.DOUBLE if across > 1 else style.SINGLE, "keep_height": True}
    size["height"] = (18.0 + PER_SET * len(rows)) * len(names) // across
    figure, axes = style.new_figure(len(names) // across, across, sharey=True, **size)
    for axis, name in zip(axes.flat, names, strict=True):
        own = dataset.sel(parameter=name)
        own = own.isel(set=slice(0, 1)) if name in shared else own
        places = np.arange(len(sets), len(rows)) if name in shared else np.arange(len(sets))
        scale, unit = _scale(name, own["value"].values)
        value, low, high = (scale * own[key].values for key in ("value", "low", "high"))
        seen = np.isfinite(low)
        reach = np.where(np.isfinite(high), high, value)
        bars = np.stack([value - low, reach - value])[:, seen]
        axis.errorbar(value[seen], places[seen], xerr=bars, **style.POINTS)
        axis.set(xlabel=_label(name, unit), yticks=range(len(rows)), ylim=(len(rows) - 0.4, -0.6))
        axis.set_yticklabels(rows)
        axis.locator_params(axis="x", nbins=4)
    return figure


@draws("samples of parameters, what carom.fit(...).posterior() returns", "sample", along="sample")
def plot_corner(samples: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw samples of the posterior, parameter by parameter and pair by pair."""
    corner = extra("corner", "a corner plot", "fit")
    names = [str(name) for name in samples.data_vars if name != "chi"]  # not beside kappa
    side = max(style.SINGLE, 45.0 * len(names))
    figure = style.blank_figure(side, side)
    figure.set_layout_engine("none")
    values = np.stack([samples[name].values for name in names], axis=1)
    labels = [GLOSSARY[name].symbol if name in GLOSSARY else name for name in names]
    marks: Any = {"color": style.BLUE, "quantiles": (0.025, 0.5, 0.975), "max_n_ticks": 4}
    corner.corner(values, labels=labels, fig=figure, quiet=True, **marks)
    return figure


def _draw_response(axes: Any, dataset: xr.Dataset, name: str) -> None:
    upper, lower = axes
    data = dataset.sel(response=name)
    scale, unit = _scale(name, data["measured"].values)
    if _is_one(dataset):
        x = data["row"].values
        upper.plot(x, scale * data["expected"].values, **LAW_STYLES["exact"])
    else:
        x = np.degrees(data["incidence"].values)
        _draw_curves(axes, data, scale)
    error, outliers = scale * data["error"].values, _outliers(data)
    for axis, quantity in ((upper, "measured"), (lower, "residual")):
        axis.margins(y=0.08)
        values = scale * data[quantity].values
        _points(axis, x, values, error, data["row"].values, outliers, zorder=5)
    lower.axhline(0.0, color=style.BLACK, lw=0.6, zorder=1)
    upper.set_ylabel(_label(name, unit))
    lower.set_ylabel("residual")


def _draw_curves(axes: Any, data: xr.Dataset, scale: float) -> None:
    """Draw regimes, what laws give against incidence, and the band of the exact one."""
    upper = axes[0]
    line = np.degrees(data["curve_incidence"].values)
    ends = np.degrees([0.0, *data["border"].values, 0.5 * np.pi])
    for axis in axes:
        for regime, start, end in mirrored(REGIMES, ends, line[0], line[-1]):
            shade(axis, start, end, REGIMES[regime])
    for law, stroke in LAW_STYLES.items():
        upper.plot(line, scale * data["curve_expected"].sel(law=law).values, **stroke)
    band = (scale * data[f"curve_{end}"].values for end in ("low", "high"))
    upper.fill_between(line, *band, color="0.4", alpha=0.35, lw=0.0, zorder=2)
    upper.set_xlim(float(line[0]), float(line[-1]))


def _is_one(dataset: xr.Dataset) -> bool:
    """Tell whether all impacts have one incidence, and are drawn row by row."""
    return bool(np.ptp(dataset["incidence"].values) < ONE_INCIDENCE)


def _outliers(data: xr.Dataset) -> Any:
    """Return which values are outliers."""
    return data["outlier"].values == 1


def _points(
    axis: Any, x: Any, y: Any, error: Any, rows: Any, outliers: Any, **options: Any
) -> None:
    """Draw values; mark outliers with rows, within the range of the others and half of it more."""
    axis.errorbar(x, np.where(outliers, np.nan, y), error, **style.POINTS, **options)
    low, high = axis.get_ylim()
    reach = 0.5 * (high - low)
    for place, value, row in zip(*(each[outliers] for each in (x, y, rows)), strict=True):
        shown = float(np.clip(value, low - reach, high + reach))
        mark = "o" if shown == value else "^" if value > shown else "v"
        axis.plot(place, shown, **{**OUTLIERS, "marker": mark})
        beside: Any = {"textcoords": "offset points", "fontsize": "x-small", "va": "center"}
        axis.annotate(f"{row}", (place, shown), (4, 0), color=style.VERMILION, **beside)


def _scale(name: str, values: Any) -> tuple[float, str]:
    """Return by what to multiply a response, and its unit then; angles are in degrees."""
    unit = GLOSSARY[name].unit if name in GLOSSARY else "1"
    if unit == "rad":
        return float(np.degrees(1.0)), "deg"
    return style.prefixed(values, unit)


def _label(name: str, unit: str) -> str:
    """Return a name in words with its symbol and unit."""
    words, short = name.replace("_", " "), GLOSSARY[name].symbol if name in GLOSSARY else ""
    words = WORDS.get(name, words)
    return fill(f"{words} {short}", LABEL) + ("" if unit == "1" else f"\u00a0({unit})")
