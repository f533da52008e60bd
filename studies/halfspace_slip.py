"""Which way does a slip ring slip, by the theory and by boundary elements?

python studies/halfspace_slip.py    a minute; draws docs/figures/halfspace_slip.png
"""

from pathlib import Path

import numpy as np
from halfspace_plan import GRIDS, SOLID, shared
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray

import carom
from carom.dimensionless.fields.surface import slip_shape
from carom.halfspace.compliance import Materials
from carom.halfspace.solution import HalfspaceSolution, Snapshot, solve

Array = NDArray[np.float64]

TARGET = Path(__file__).parents[1] / "docs" / "figures" / "halfspace_slip.png"
PSI, TIME = 0.5, 2.2  # psi_1; d_max/V_1, while a ring slips
COLORS = {0.3: "#0072B2", 0.5: "#D55E00"}


def impact(poisson: float, elements: int) -> HalfspaceSolution:
    """Return a solid sphere's impact on a half-space of the same material."""
    kappa = shared(poisson)
    return solve(PSI, SOLID * kappa, Materials(kappa), GRIDS[elements])


def turned(along: Array, across: Array) -> Array:
    """Return the angle of slip from the line of the motion, in degrees, either way."""
    return np.asarray(np.degrees(np.arctan(across / along)))


def by_theory(poisson: float, kept: Snapshot, radii: Array, angles: Array) -> tuple[Array, float]:
    """Return the theory's angle of slip at places in the ring, and the radius of its stick zone."""
    exact = carom.solve(PSI, SOLID * shared(poisson))
    front = float(exact.at(np.array([kept.entry.time])).stick_radius[0])
    shapes = np.array([slip_shape(front, r) for r in radii.ravel()])
    one, two = np.moveaxis(shapes, -1, 0).reshape(2, *radii.shape)
    lateral = poisson / (2.0 - poisson) * two
    along, across = one - lateral * np.cos(2.0 * angles), -lateral * np.sin(2.0 * angles)
    slips = np.where(radii > front, along, np.nan)  # inside nothing slips
    return turned(slips, across), front


def polar(found: HalfspaceSolution) -> tuple[Array, Array]:
    """Return distance from the centre and polar angle of every element, both (x, y)."""
    x, y = np.meshgrid(found.patch.grid.line, found.patch.grid.line, indexing="ij")
    return np.hypot(x, y), np.arctan2(y, x)


def pulled(found: HalfspaceSolution, kept: Snapshot) -> tuple[Array, NDArray[np.bool_]]:
    """Return the traction on the whole grid, and where it is as large as friction allows."""
    grid = found.patch.grid
    return grid.whole_vector(kept.step.state.traction), grid.whole(kept.step.slips)


def draw_map(axis: Axes, angle: Array, inside: NDArray[np.bool_], found: HalfspaceSolution) -> None:
    """Colour the elements that slip by the angle of slip, the others grey."""
    line = found.patch.grid.line
    edges = np.append(line, line[-1] + line[1] - line[0]) - 0.5 * (line[1] - line[0])
    axis.pcolormesh(edges, edges, np.where(inside, 1.0, np.nan).T, cmap="Greys", vmin=0, vmax=4)
    image = axis.pcolormesh(edges, edges, angle.T, cmap="RdBu_r", vmin=-20.0, vmax=20.0)
    bar = axis.figure.colorbar(image, ax=axis, orientation="horizontal", shrink=0.8, pad=0.02)
    bar.set_label("angle between slip and motion (degrees)")
    axis.set_aspect("equal")
    axis.set_xlim(-0.95, 0.95)
    axis.set_ylim(-0.95, 0.95)
    axis.set_xlabel("$x/a_{max}$ (motion along x)")
    axis.set_ylabel("$y/a_{max}$")


def draw_maps(full: Axes, theory: Axes, found: HalfspaceSolution) -> None:
    """Draw the angle of slip over the contact, by both solutions, nu = 0.5."""
    kept, (radii, angles) = found.snapshot(TIME), polar(found)
    inside = found.patch.grid.whole(kept.step.touching)
    pull, slipping = pulled(found, kept)
    slips = np.where(slipping, pull[0], np.nan)
    draw_map(full, turned(slips, pull[1]), inside, found)
    angle, front = by_theory(0.5, kept, radii, angles)
    round_contact = radii <= np.sqrt(kept.step.state.depth)
    draw_map(theory, np.where(round_contact, angle, np.nan), round_contact, found)
    for axis in (full, theory):
        axis.add_patch(Circle((0.0, 0.0), front, fill=False, lw=1.0, ls="--"))
    full.set_title(r"(a) three-dimensional, $\nu$ = 0.5", loc="left")
    theory.set_title(r"(b) what the theory neglects, $\nu$ = 0.5", loc="left")


def draw_directions(axis: Axes, poisson: float, found: HalfspaceSolution) -> None:
    """Draw the angle at 45 degrees to the motion, from the front to the edge, by both solutions."""
    kept, (radii, angles) = found.snapshot(TIME), polar(found)
    pull, slipping = pulled(found, kept)
    near = np.abs(np.abs(np.abs(angles) - 0.5 * np.pi) - 0.25 * np.pi) < np.radians(5.0)
    seen = near & slipping
    edge = np.sqrt(kept.step.state.depth)
    sizes = -np.sign(np.sin(2.0 * angles[seen])) * turned(pull[0][seen], pull[1][seen])
    label = rf"$\nu$ = {poisson:g}"
    axis.plot(radii[seen] / edge, sizes, "o", color=COLORS[poisson], ms=4, label=label)
    front = by_theory(poisson, kept, np.array([0.0]), np.array([0.0]))[1]
    line = np.linspace(front * (1.0 + 1e-9), edge, 400)
    angle, _ = by_theory(poisson, kept, line, np.full(400, 0.25 * np.pi))
    axis.plot(line / edge, -angle, color=COLORS[poisson], lw=1.4)
    limit = np.degrees(np.arcsin(poisson / (2.0 - poisson)))
    axis.plot(front / edge, limit, "x", color=COLORS[poisson], ms=6)
    print(f"nu {poisson}: front {front:.3f}, largest {sizes.max():.2f} degrees")


def main() -> None:
    """Compute and draw."""
    figure = Figure(figsize=(12.5, 4.6), layout="constrained")
    full, theory, line = figure.subplots(1, 3)
    for poisson in COLORS:
        found = impact(poisson, 64)
        draw_directions(line, poisson, found)
    draw_maps(full, theory, found)
    line.set_xlabel("distance from the centre / radius of the contact")
    line.set_ylabel("angle of slip, 45° to the motion (degrees)")
    title = "circles: three-dimensional\nlines: theory, x: its bound"
    line.legend(frameon=False, title=title, alignment="left", loc="upper left")
    line.set_title("(c)", loc="left")
    line.axhline(0.0, color="0.6", linewidth=0.6)
    line.set_ylim(-5.0, 32.0)
    figure.savefig(TARGET, dpi=150)
    print(f"wrote {TARGET.name}")


if __name__ == "__main__":
    main()
