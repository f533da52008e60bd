"""The contact through one impact: small multiples of the patch above the course of the force."""

from collections.abc import Iterable
from itertools import pairwise
from string import ascii_lowercase
from typing import Any, Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from carom.plots import style
from carom.plots.bands import moment, phases
from carom.plots.drawing import Drawable, checked_dataset, documented, looking
from carom.plots.impact import FORCES, HISTORY, RADII, force_at, forces_panel, phase_handles
from carom.plots.legends import legend_outside
from carom.plots.look import WIDTH, Look
from carom.plots.patch import patch_panel
from carom.plots.profiles import profile_panel
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import counted

RIM, ROOM = 0.95, 1.1  # in contact radii; around the largest traction
MARGIN = 1.08  # around the largest contact
NARROWEST = 26.0  # mm, of a patch
SIDES = (8.0, 60.0)  # of a patch, in mm
USUAL, MOST = 6, 9  # patches beside each other
BESIDE, PROFILE, FORCE, TEXTS = 20.0, 16.0, 34.0, 42.0  # mm, of what is beside and below them
FIELDS = "the fields of a contact on a grid of x and y, what Impact.fields returns"
ON_PATCH = ("traction_x", "pressure", "zone", "friction", "tangential_force", "time", *RADII[:2])
BARS = (1.0, 2.0, 5.0)  # lengths of the scale bar, times powers of ten
BAR = 0.5  # its longest, in radii of the largest contact


@documented
def plot_contact(
    history: Drawable,
    frames: Iterable[xr.Dataset] | None = None,
    *,
    count: int | None = None,
    **look: Unpack[Look],
) -> Figure:
    """Draw the contact patch at several instants, its traction along the middle, and the force.

    Colours are the tangential traction on one scale, hatched rings slip, arrows are slip velocities
    (of each patch on its own scale), and the dashed lines are the limits of friction. Without
    frames the instants are the middles of the phases and others between them.

    Parameters
    ----------
    history : impact or xarray.Dataset
        The impact, or what `Impact.history` returns; then the frames are needed, too.
    frames : iterable of xarray.Dataset, optional
        What `Impact.fields` returns, on a grid, at the instants to be shown, from 1 to 9.
    count : int, optional
        How many instants are chosen, by default six, or as many as the width has room for.

    Raises
    ------
    InputError
        If it is another dataset, there are no frames or too many, or they lie on no grid.

    Examples
    --------
    >>> figure = carom.plots.plot_contact(hit, count=3)
    >>> len(figure.axes)  # patches, profiles below them, the force, and the key to the colours
    8
    """
    with looking(look, "plot_contact", ("history", "frames", "count")):
        course, shown = _read(history, frames, count)
        return _draw(course, shown)


def _read(result: Any, frames: Any, count: int | None) -> tuple[xr.Dataset, list[xr.Dataset]]:
    """Return the history and the frames, those of a result if it is one."""
    has_history = not hasattr(result, "data_vars") and hasattr(result, "history")
    course = result.history() if has_history else result
    needed = (*FORCES, *RADII, "max_pressure")
    checked_dataset(course, f"plot_contact draws {HISTORY}", needed, ("time",))
    if frames is not None:
        if count is not None:
            raise InputError("count: the frames that are given are shown; leave one of both out")
        shown = _frames(frames)
    elif has_history:
        shown = [result.fields(time) for time in _instants(course, _checked(count))]
    else:
        raise InputError(f"plot_contact draws {HISTORY}; give the fields of its instants, too")
    if not 1 <= len(shown) <= MOST:
        raise refusal("frames", len(shown), f"must be the fields of 1 to {MOST} instants")
    for fields in shown:
        checked_dataset(fields, f"plot_contact draws {FIELDS}", ON_PATCH)
        style.check_grid(fields, "traction_x", "y", "x")
    return course, shown


def _frames(frames: Any) -> list[Any]:
    """Return frames as a list; a dataset alone is one."""
    if hasattr(frames, "data_vars"):
        return [frames]
    if not isinstance(frames, Iterable) or isinstance(frames, str):
        raise refusal("frames", frames, f"must be the fields of 1 to {MOST} instants")
    return list(frames)


def _checked(count: int | None) -> int:
    if count is None:
        return int(np.clip(style.room(style.DOUBLE) // NARROWEST, 1, USUAL))
    return counted("count", count, 1, MOST)


def _instants(course: xr.Dataset, count: int) -> list[float]:
    """Return the middles of the longest phases, and of the largest gaps between them."""
    longest = sorted(phases(course), key=lambda phase: phase.start - phase.end)[:count]
    times = sorted(0.5 * (phase.start + phase.end) for phase in longest)
    while len(times) < count:
        gaps = pairwise([0.0, *times, float(course["time"][-1])])
        start, end = max(gaps, key=lambda gap: gap[1] - gap[0])
        times = sorted([*times, 0.5 * (start + end)])
    return times


def _largest(shown: list[xr.Dataset]) -> tuple[float, bool]:
    """Return the largest traction but at rims, which may have no bound, and if those have more."""
    inside, everywhere = 0.0, 0.0
    for fields in shown:
        traction = np.abs(fields["traction_x"].values)
        distance = np.hypot(fields["y"].values[:, np.newaxis], fields["x"].values)
        rim = distance > RIM * float(fields["contact_radius"])
        inside = max(inside, float(np.where(rim, 0.0, traction).max()))
        everywhere = max(everywhere, float(traction.max()))
    return inside or everywhere or 1.0, everywhere > ROOM * inside > 0.0


def _draw(course: xr.Dataset, shown: list[xr.Dataset]) -> Figure:
    side = np.clip(((WIDTH.get() or style.DOUBLE) - BESIDE) / len(shown), *SIDES)
    heights = (side, max(PROFILE, 0.5 * side), FORCE)
    figure = style.blank_figure(style.DOUBLE, sum(heights) + TEXTS, keep_height=True)
    grid = figure.add_gridspec(3, len(shown), height_ratios=heights)
    patches = [figure.add_subplot(grid[0, i]) for i in range(len(shown))]
    below: list[Axes] = []
    for i in range(len(shown)):
        shared: Any = {"sharey": below[0]} if below else {}
        below.append(figure.add_subplot(grid[1, i], **shared))
    force = figure.add_subplot(grid[2, :])
    largest, over = _largest(shown)
    scale, unit = style.prefixed(largest, style.unit_of(shown[0], "traction_x"))
    reach = MARGIN * float(course["contact_radius"].max())
    for i, fields in enumerate(shown):
        shading = _patch(patches[i], fields, course, scale, reach, largest)
        profile_panel(below[i], fields, reach, scale)
        at_corner: Any = {"transform": patches[i].transAxes, "va": "top", "weight": "bold"}
        patches[i].text(0.0, 1.0, ascii_lowercase[i], **at_corner)
        below[i].tick_params(labelleft=i == 0)
    below[0].set_ylabel(style.label("traction_x", unit))
    below[0].set_ylim(-ROOM * largest * scale, ROOM * largest * scale)
    _scale_bar(patches[0], reach, style.unit_of(shown[0], "x"))
    more: Any = {"extend": "both" if over else "neither"}
    bar = figure.colorbar(shading, ax=patches, aspect=18, pad=0.01, shrink=0.9, **more)
    bar.set_label(style.label("traction_x", unit))
    forces_panel(force, course)
    _mark(force, course, shown)
    legend_outside(figure, phase_handles(course), 5)
    return figure


def _patch(
    axis: Axes, fields: xr.Dataset, course: xr.Dataset, scale: float, reach: float, largest: float
) -> Any:
    colours = style.colours("traction_x", largest * scale)
    shading = patch_panel(axis, fields, "traction_x", scale, reach=reach, word="", **colours)
    axis.set(xticks=[], yticks=[], xlabel="", ylabel="")
    axis.set_title(moment(fields, like=course["time"].values).replace(", ", ",\n"))
    for side in axis.spines.values():
        side.set_visible(False)
    return shading


def _scale_bar(axis: Axes, reach: float, unit: str) -> None:
    """Draw a length of one significant digit below the first patch."""
    length, unit = style.prefixed(reach, unit)
    most = BAR * reach * length
    power = 10.0 ** np.floor(np.log10(most))
    bar = max(power * step for step in BARS if power * step <= most)
    left, low = -reach * length, -reach * length
    axis.plot([left, left + bar], [low, low], color=style.BLACK, lw=1.5, clip_on=False)
    text = f"{bar:g}\u00a0{unit}"
    note: Any = {"xytext": (0, 2), "textcoords": "offset points", "fontsize": "small"}
    style.stroke_white(axis.annotate(text, (left, low), **note))


def _mark(axis: Axes, course: xr.Dataset, shown: list[xr.Dataset]) -> None:
    """Mark the instants of the patches in the course of the force."""
    for letter, fields in zip(ascii_lowercase, shown, strict=False):
        place = force_at(course, fields)
        axis.plot(*place, "o", color=style.BLACK, ms=4.0, zorder=5)
        near: Any = {"xytext": (3, 3), "textcoords": "offset points", "weight": "bold"}
        style.stroke_white(axis.annotate(letter, place, zorder=6, **near))
