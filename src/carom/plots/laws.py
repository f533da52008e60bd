"""Contact laws against the exact impact: their rebounds and errors side by side, and error maps."""

import json
import textwrap
from collections.abc import Iterator
from typing import Any, Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from carom.plots import style
from carom.plots.bands import MINUS
from carom.plots.drawing import Drawable, draws
from carom.plots.legends import legend_outside
from carom.plots.look import AXES, Look
from carom.plots.regimes import ABOVE, draw_borders
from carom.quantities.refusals import refusal, refuse
from carom.quantities.units import pure_number

SKY = "#56B4E9"
COLORS = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE, SKY)
STYLES: Any = [{"color": c, "ls": d} for c, d in zip(COLORS, (*style.DASHES[1:], "-"), strict=True)]
EXACT: Any = {"color": style.BLACK, "lw": 1.6, "zorder": 2}
POINT: Any = {"marker": "o", "ms": 1.4}
SAME_PSI = 1e-6  # laws closer than this in psi_2 share a line
SAMPLE = (-0.085, -0.015)  # where a bar shows its line, in widths of its axes
LABEL_WIDTH = 32  # in characters
PITCH, EDGE = 5.6, 22.0  # height of a bar and of what is around them, in mm
BESIDE = 0.2  # of the width: room for the name of a border, if no layout makes it
NOTED = 0.1  # an error that is outlined
CONTOURS: Any = {"colors": "0.25", "linewidths": 0.6, "linestyles": ["--", "-"]}
LARGEST_LIMIT = 1e100
LEAST = 1e-3  # a colour scale ends no nearer to zero
PLAIN = {  # parameters of elastic laws, not worth a mention
    "stiffness": 1.0,
    "restitution": 1.0,
    "damping": "coeff_restitution",
    "tangential_damping": 0.0,
    "initial_state": 0.0,
    "normal": "hertz",
    "normal_speed": 0.1,
}


@draws(
    "a ranking, what carom.verify.rank(...).to_dataset() returns",
    *("max_error", "rms_error", "psi_out", "psi_out_exact", "chi"),
    along="law",
)
def plot_laws(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw psi_2 of contact laws beside that of the exact impact, and their errors, best first.

    A row holds up to five different rebounds on the left and, in the same colours, their largest
    errors as bars on the right; the dark part is the root mean square.

    Examples
    --------
    >>> ranking = carom.verify.rank(carom.verify.catalogue()[:2], psi_1=[0.5, 1.0, 3.0])
    >>> axis = carom.plots.plot_laws(ranking.to_dataset()).axes[1]
    >>> [text.get_text() for text in axis.get_yticklabels()]
    ['linear spring, $k_t/k_n$ = $\\\\kappa$', 'linear spring, $k_t/k_n$ = 2/7']
    """
    kinds = _kinds(dataset["psi_out"].values)
    groups = np.array_split(np.arange(kinds.max() + 1), -(-(kinds.max() + 1) // len(STYLES)))
    members = [np.flatnonzero(np.isin(kinds, group)) for group in groups]
    most = max(len(rows) for rows in members)
    height = len(groups) * max(PITCH * most, 30.0) + EDGE
    size: Any = {"width": style.DOUBLE, "height": height, "width_ratios": (1.0, 0.85)}
    size["keep_height"] = True  # a bar has the height of its name
    figure, axes = style.new_figure(len(groups), 2, sharex="col", **size)
    for (left, right), rows in zip(axes, members, strict=True):
        styles = [STYLES[kind] for kind in kinds[rows] - kinds[rows].min()]
        _draw_rebounds(left, dataset, rows, styles)
        _draw_bars(right, dataset, rows, styles, most)
    axes[0, 1].set_xlim(0.0, 1.14 * axes[0, 1].get_xlim()[1])  # room for the numbers
    axes[-1, 0].set_xlabel(style.label("psi_in"))
    axes[-1, 1].set_xlabel(r"|error in $\psi_2$|")
    legend_outside(figure, list(_key(dataset)), 4)
    return figure


def _kinds(curves: Any) -> Any:
    """Return which rebound each law has, counted from 0 in their order; equal ones are one."""
    kinds: list[int] = []
    for row, curve in enumerate(curves):
        same = (k for k in range(row) if np.allclose(curves[k], curve, rtol=0.0, atol=SAME_PSI))
        twin = next(same, None)
        kinds.append(max(kinds, default=-1) + 1 if twin is None else kinds[twin])
    return np.array(kinds)


def _draw_rebounds(axis: Axes, dataset: xr.Dataset, rows: Any, styles: list[Any]) -> None:
    order = np.argsort(dataset["psi_in"].values)
    psi = dataset["psi_in"].values[order]
    style.zero_line(axis)
    exact = np.atleast_2d(dataset["psi_out_exact"].values)  # one, or one for each law
    for curve in exact if len(exact) == 1 else exact[rows]:
        axis.plot(psi, curve[order], **EXACT, **POINT)
    for row, stroke in zip(rows, styles, strict=True):
        out = dataset["psi_out"].values[row][order]
        axis.plot(psi, out, lw=0.9, zorder=3, **stroke, **POINT)
    axis.set_ylabel(style.label("psi_out"))


def _draw_bars(axis: Axes, dataset: xr.Dataset, rows: Any, styles: list[Any], most: int) -> None:
    largest, rms = (dataset[name].values[rows] for name in ("max_error", "rms_error"))
    places = np.arange(len(rows))
    colors = [stroke["color"] for stroke in styles]
    axis.barh(places, largest, height=0.62, color=colors, alpha=0.4, lw=0)
    axis.barh(places, rms, height=0.62, color=colors, lw=0)
    for place, value, stroke in zip(places, largest, styles, strict=True):
        text = f"{value:.3f}" if np.isfinite(value) else "no limit"
        at = value if np.isfinite(value) else 0.0
        beside: Any = {"xytext": (2, 0), "textcoords": "offset points", "va": "center"}
        axis.annotate(text, (at, place), fontsize="small", **beside)
        sample = Line2D(SAMPLE, (place, place), lw=1.2, clip_on=False, **stroke)
        sample.set_transform(axis.get_yaxis_transform())
        sample.set_in_layout(False)
        axis.add_line(sample)
    names = [str(name).replace("$", r"\$") for name in dataset["law"].values[rows]]
    lines = (textwrap.fill(name, LABEL_WIDTH, break_long_words=False) for name in names)
    axis.set_yticks(places, map(style.with_formulas, lines))
    axis.tick_params(axis="y", length=0.0, pad=15.0)
    axis.set_ylim(most - 0.5, -0.5)
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)


def _key(dataset: xr.Dataset) -> Iterator[Any]:
    yield Line2D([], [], label=rf"exact, $\chi$ = {float(dataset['chi']):.5g}", **EXACT)
    yield Line2D([], [], color="0.4", ls=style.DASHES[1], lw=0.9, label="law, as beside its bar")
    yield Patch(fc="0.75", label=r"max |error in $\psi_2$|")
    yield Patch(fc="0.4", label="root mean square")


@draws("an error map, what carom.verify.error_map returns", "error", "psi_in", "chi")
def plot_error_map(dataset: Drawable, limit: float | None = None, **look: Unpack[Look]) -> Figure:
    """Draw the error of a contact law in psi_2 over psi_1 and chi, white where there is none.

    Thin lines are errors of 0.1, dashed where negative; thick ones the borders 1, 2 chi, 4 chi - 1
    of the regimes. Where the law has no answer the map is grey.

    Parameters
    ----------
    limit : float, optional
        End of the colour scale; by default the largest |error|.

    Raises
    ------
    InputError
        If the dataset is another one, has no grid of two by two values, or the limit is not
        positive.

    Examples
    --------
    >>> found = carom.verify.error_map(carom.dem.LinearSpring(), [0.5, 1.0, 3.0], [1.2, 1.4])
    >>> carom.plots.plot_error_map(found).axes[1].get_ylabel()
    'error in $\\\\psi_2$'
    """
    style.check_grid(dataset, "error", "chi", "psi_in")
    psi, chi, error = (dataset[name].values for name in ("psi_in", "chi", "error"))
    finite = np.abs(error[np.isfinite(error)])
    most = max(LEAST, float(finite.max(initial=0.0)))
    if limit is not None:
        allowed = f"must be positive, at most {LARGEST_LIMIT:g}"
        most = pure_number("limit", limit, allowed)
        refuse(not 0.0 < most <= LARGEST_LIMIT and refusal("limit", limit, allowed))
    figure, axis = style.single_axis(height=66.0)
    axis.set_facecolor("0.8")
    colors: Any = {"cmap": style.SIGNED_MAP, "vmin": -most, "vmax": most}
    colors["shading"] = "gouraud" if finite.size == error.size else "nearest"
    drawn = axis.pcolormesh(psi, chi, error, rasterized=True, **colors)
    keys = [Line2D([], [], color="black", lw=1.0, label="thick: borders of the regimes")]
    if finite.size and finite.max() > NOTED:
        axis.contour(psi, chi, error, levels=[-NOTED, NOTED], **CONTOURS)
        for dash, level in zip(CONTOURS["linestyles"], (-NOTED, NOTED), strict=True):
            if not np.nanmin(error) < level < np.nanmax(error):
                continue
            stroke: Any = {"color": CONTOURS["colors"], "lw": CONTOURS["linewidths"], "ls": dash}
            keys.append(Line2D([], [], label=f"error {level:+g}".replace("-", MINUS), **stroke))
    style.span(axis, psi, chi)
    axis.set(xlabel=style.label("psi_in"), ylabel=style.label("chi"))
    draw_borders(axis)
    over = limit is not None and bool(finite.size) and finite.max() > most
    plain = AXES.get() is not None and figure.get_layout_engine() is None
    apart: Any = {"pad": BESIDE} if plain else {}
    bar = figure.colorbar(drawn, ax=axis, extend="both" if over else "neither", aspect=30, **apart)
    bar.set_label(r"error in $\psi_2$")
    title = style.with_formulas(_title(dataset))
    above: Any = {"bbox_to_anchor": (-0.02, ABOVE)} if AXES.get() else {}
    legend_outside(figure, keys, 3, title=title, alignment="left", **above)
    return figure


def _title(dataset: xr.Dataset) -> str:
    """Return the law with its parameters, as far as the dataset tells them."""
    parameters = json.loads(dataset.attrs.get("law_parameters", "{}"))
    values = [
        f"{name.replace('_', ' ')} {value:.4g}" if isinstance(value, float) else str(value)
        for name, value in parameters.items()
        if value is not None and value != PLAIN.get(name)
    ]
    words = ", ".join([dataset.attrs.get("law", ""), *values])
    return textwrap.fill(words.replace("$", r"\$"), 60)  # no formula of matplotlib's
