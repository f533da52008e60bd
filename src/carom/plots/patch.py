"""The contact patch seen from above: shading, zones, slip arrows."""

from typing import Any, NamedTuple, Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Annulus, Circle

from carom.plots import style
from carom.plots.bands import APART, is_apart, moment, slip_band
from carom.plots.drawing import Drawable, at_instant, draws
from carom.plots.look import Look
from carom.quantities.arrays import Array
from carom.quantities.refusals import one_of

SLIP = 2  # the zone's number in a fields dataset
MARGIN = 1.12  # of the map around the contact
ARROWS_ACROSS = 8  # the diameter of the contact
FEWEST_ARROWS = 3  # where the contact is small on the map
ROOM = 0.3  # the stick zone with a word in it, in contact radii
RING_ARROWS = 28  # along a ring too narrow for rows of them
NARROW_RING = 1.5  # in distances between arrows
THINNEST_RING = 0.06  # in contact radii: in a thinner one no arrow fits
LONGEST_ARROW = 0.8  # in distances between arrows
ROUNDING = 1e-9  # relative, of an arrow that ends on the border
ZONES = ("contact", "stick")
MAPPED = ("traction_x", "pressure")


@draws(
    "the fields of a contact on a grid of x and y, what Impact.fields or LoadPath.fields returns",
    *("pressure", "traction_x", "zone", "x", "y", *(f"{name}_radius" for name in ZONES)),
    take=at_instant("fields"),
)
def plot_patch(
    dataset: Drawable, variable: str = "traction_x", *, at: Any = None, **look: Unpack[Look]
) -> Figure:
    """Draw the contact from above: traction or pressure, stick and slip zones, slip velocities.

    The zone that slips is hatched; its arrows are the velocity of the first surface on the second.
    At the first touch and at separation nothing is pressed, and the map says "apart".

    Parameters
    ----------
    variable : str
        What the shading tells: "traction_x" or "pressure".

    Raises
    ------
    InputError
        If the fields are not on a grid, or the variable is another.

    Examples
    --------
    >>> carom.plots.plot_patch(hit.fields("21 us")).axes[0].get_title().splitlines()[1]
    'longest arrow: 277\\xa0mm/s'
    """
    one_of("variable", variable, MAPPED)
    style.check_grid(dataset, "pressure", "y", "x")
    title = patch_title(dataset)
    height = 64.0 + 4.0 * len(title.splitlines())  # the map is square
    figure, axis = style.single_axis(height=height)
    scale, unit = style.prefixed(dataset[variable].values, style.unit_of(dataset, variable))
    colours = style.colours(variable, dataset[variable].values * scale)
    shading = patch_panel(axis, dataset, variable, scale, **colours)
    figure.colorbar(shading, ax=axis, label=style.label(variable, unit), pad=0.02, aspect=28)
    axis.set_title(title)
    return figure


def patch_panel(
    axis: Axes,
    dataset: xr.Dataset,
    variable: str,
    scale: float,
    *,
    reach: float | None = None,
    word: str = "stick",
    **colours: Any,
) -> Any:
    """Draw the patch on axes to `reach` in m, the variable times `scale`; return its shading."""
    reach = reach or _reach(dataset)
    x, unit, length = style.scaled(dataset, "x", like=reach)
    y = dataset["y"].values * length
    contact, stick = (float(dataset[name]) * length for name in ("contact_radius", "stick_radius"))
    how: Any = {"shading": "gouraud", "rasterized": True, **colours}
    shading = axis.pcolormesh(x, y, dataset[variable] * scale, **how)
    shading.set_clip_path(Circle((0.0, 0.0), contact, transform=axis.transData))
    ink = "0.5" if colours["cmap"] == style.SIGNED_MAP else "white"
    _draw_zones(axis, contact, stick, slip_band(dataset).hatch, ink)
    if is_apart(dataset):
        word = word and APART
    if stick > ROOM * contact or is_apart(dataset):
        style.stroke_white(axis.text(0.0, 0.0, word, ha="center", va="center"))
    _draw_arrows(axis, arrows(dataset, reach), length)
    axis.set_aspect("equal")
    ends = (-reach * length, reach * length)
    axis.set(xlim=ends, ylim=ends, xlabel=style.label("x", unit), ylabel=style.label("y", unit))
    return shading


def patch_title(dataset: xr.Dataset, reach: float | None = None, like: Any = None) -> str:
    """Return phase and time, in a unit that suits `like`, and the speed of the longest arrow."""
    fastest = arrows(dataset, reach).fastest
    scale, unit = style.prefixed(fastest, dataset[f"{_slip(dataset)}_x"].units)
    key = f"longest arrow: {fastest * scale:.3g}\u00a0{unit}" if fastest else ""
    return "\n".join([moment(dataset, like), key]).strip()


def _reach(dataset: xr.Dataset) -> float:
    around = MARGIN * float(dataset["contact_radius"]) or np.inf  # at the first touch: the grid
    return min(around, float(np.abs(dataset["x"].values).max()))


def _draw_zones(axis: Axes, contact: float, stick: float, hatch: str, ink: str) -> None:
    if contact > stick:
        ring = Annulus((0, 0), contact, contact - stick) if stick else None
        marked: Any = ring or Circle((0, 0), contact)
        marked.set(fill=False, hatch=hatch[:3], edgecolor=ink, alpha=0.6, lw=0.0)
        axis.add_patch(marked)
    if 0.0 < stick < contact:
        for color, width, dash in (("white", 1.6, "-"), ("black", 0.9, (0, (4, 2)))):
            axis.add_patch(Circle((0, 0), stick, fill=False, ec=color, lw=width, ls=dash))
    axis.add_patch(Circle((0, 0), contact, fill=False, ec="black", lw=1.0))


class Arrows(NamedTuple):
    """Where surfaces slip, and how fast, in SI units; `longest` m is drawn for the fastest."""

    x: Array
    y: Array
    along: Array
    across: Array
    longest: float

    @property
    def fastest(self) -> float:
        """The largest speed, 0 if there are no arrows."""
        return float(np.hypot(self.along, self.across).max(initial=0.0))


def arrows(dataset: xr.Dataset, reach: float | None = None) -> Arrows:
    """Return slip velocities, or slips, at points of the slip zone that fit on a map to `reach`."""
    x, y = dataset["x"].values, dataset["y"].values
    contact, stick = (float(dataset[f"{name}_radius"]) for name in ZONES)
    room = min(MARGIN * contact / (reach or _reach(dataset)), 1.0)
    count = max(FEWEST_ARROWS, round(ARROWS_ACROSS * room))
    at_x, at_y, longest = _places(contact, stick, count)
    rows, columns = _nearest(y, at_y), _nearest(x, at_x)
    inside = np.hypot(np.abs(at_x) + 0.5 * longest, at_y) < contact * (1.0 + ROUNDING)
    inside &= np.hypot(at_x, at_y) >= stick
    inside &= dataset["zone"].values[rows, columns] == SLIP
    name = _slip(dataset)
    along, across = (dataset[f"{name}_{axis}"].values[rows, columns] for axis in "xy")
    return Arrows(at_x[inside], at_y[inside], along[inside], across[inside], longest)


def _slip(dataset: xr.Dataset) -> str:
    """Return what arrows show: slip velocities, or slips where there is no time."""
    return "slip_velocity" if "slip_velocity_x" in dataset else "slip"


def _places(contact: float, stick: float, count: int) -> tuple[Array, Array, float]:
    """Return points of a lattice, or inside a ring too narrow for it, and the length of arrows."""
    spacing = 2.0 * contact / count
    if stick > 0.0 and contact - stick < NARROW_RING * spacing:
        around = count * RING_ARROWS // ARROWS_ACROSS
        angles = 2.0 * np.pi * (np.arange(around) + 0.5) / around
        middle = 0.5 * (contact + stick)
        longest = min(LONGEST_ARROW * middle * 2.0 * np.pi / around, contact - stick)
        angles = angles if contact - stick > THINNEST_RING * contact else angles[:0]
        return middle * np.cos(angles), middle * np.sin(angles), longest
    line = spacing * (np.arange(count) - 0.5 * (count - 1))
    x, y = np.meshgrid(line, line)
    return x.ravel(), y.ravel(), LONGEST_ARROW * spacing


def _nearest(grid: Array, places: Array) -> Any:
    return np.abs(grid[:, np.newaxis] - places).argmin(axis=0)


def _draw_arrows(axis: Axes, arrows: Arrows, length: float) -> None:
    if arrows.fastest == 0.0:
        return
    unit = arrows.longest * length / arrows.fastest
    vectors = arrows.x * length, arrows.y * length, arrows.along * unit, arrows.across * unit
    scale: Any = {"angles": "xy", "scale_units": "xy", "scale": 1.0, "pivot": "mid"}
    shape: Any = {"width": 0.01, "headwidth": 3.6, "headlength": 4.0, "headaxislength": 3.6}
    colors: Any = {"fc": "black", "ec": "white", "lw": 0.3, "zorder": 4}
    axis.quiver(*vectors, units="width", **scale, **shape, **colors)
