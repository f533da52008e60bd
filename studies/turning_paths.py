"""How far off are springs where the direction of the load turns? Against boundary elements.

python studies/turning_paths.py           4 minutes, writes turning_paths.csv, draws it
python studies/turning_paths.py --check   computes three rows again

Circles of displacement at constant load, after a straight way out, and impacts that are kicked
aside. Each path is followed by boundary elements, with so many steps and twice as many, from which
those of no length are extrapolated; by `load_path`; by 32 springs each of which is cut back to its
own limit, as in `carom/contact.hpp`; and by LAMMPS' mindlin_rescale/force. Errors are the largest
difference of forces along the contact, in units of mu P at its largest.
"""

import csv
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from rich.progress import track
from small_pictures import store_small

from carom.dimensionless.load_paths import turning
from carom.dimensionless.numerics.hertz import DURATION, penetration_and_speed
from carom.halfspace.compliance import Materials
from carom.halfspace.quasistatic import Patch
from carom.laws.dem import lattice
from carom.plots import style
from carom.plots.legends import legend_above

TABLE = Path(__file__).with_suffix(".csv")
PICTURE = TABLE.parents[1] / "docs" / "figures" / "turning_paths.png"
RADII = (0.1, 0.2, 0.3, 0.45, 0.6, 0.75, 0.85, 0.9, 0.95, 1.0, 1.1, 1.25, 1.5, 2.0, 3.0)
KAPPA, CHI = 14 / 17, 1.4412  # nu = 0.3
ELEMENTS, PER_TURN, PER_IMPACT, WAY_OUT = 48, 200, 300, 20
PARTS = 20  # of each step, for the laws
KICKS = 24

Array = NDArray[np.float64]


class Way(NamedTuple):
    """Where the bodies go: depths d, shape (n,), and displacements U, shape (n, 2)."""

    depth: Array
    moved: Array

    def parted(self, parts: int) -> "Way":
        """Return the same way with every step cut into equal parts."""
        corners = np.arange(self.depth.size + 1.0)
        at = np.arange(1, parts * self.depth.size + 1) / parts
        depth, *moved = (
            np.interp(at, corners, np.append(0.0, line)) for line in (self.depth, *self.moved.T)
        )
        return Way(depth, np.column_stack(moved))


def circle(radius: float) -> Way:
    """Press, go out along x, go round once."""
    out, turn = np.arange(1, WAY_OUT + 1) / WAY_OUT, np.arange(1, PER_TURN + 1) * 2 * np.pi
    turn = turn / PER_TURN
    moved = [np.zeros((1, 2)), np.outer(radius * out, [1.0, 0.0])]
    moved.append(radius * np.column_stack([np.cos(turn), np.sin(turn)]))
    return Way(np.ones(1 + WAY_OUT + PER_TURN), np.concatenate(moved))


def kicked(psi: float, kick: tuple[float, float], at: float) -> Way:
    """Return the way of an impact at psi that is kicked at a part of its time, by springs."""
    step, n = DURATION / PER_IMPACT, PER_IMPACT - 1
    depth = np.array([penetration_and_speed((i + 1) * step)[0] for i in range(n)])
    moved, velocity, pull = np.zeros((n + 1, 2)), np.array([psi, 0.0]), np.zeros(3)
    memory, load = np.zeros(lattice.places(256)), np.zeros(3)
    for i in range(n):
        velocity = velocity - 0.5 * step * 1.25 * CHI * pull
        if i == int(at * PER_IMPACT):
            velocity = velocity + np.array(kick)
        motion = np.array([(depth[i] - (depth[i - 1] if i else 0.0)) / step, *velocity])
        lattice.step(memory, 256, depth[i], motion, step, 0.0, 0.0, load)
        pull, moved[i + 1] = load[1:].copy(), moved[i] + velocity * step
        velocity = velocity - 0.5 * step * 1.25 * CHI * pull
    return Way(depth, moved[1:])


def by_elements(way: Way) -> Array:
    """Return the force over mu P, from so many steps and twice as many."""
    one, two = (_by_elements(way.parted(parts))[parts - 1 :: parts] for parts in (1, 2))
    return 2.0 * two - one


def _by_elements(way: Way) -> Array:
    patch = Patch.across(ELEMENTS, Materials(kappa=KAPPA))
    state, forces = patch.untouched(), []
    for depth, moved in zip(*way, strict=True):
        state = patch.advance(state, float(depth), np.append(moved, 0.0) / KAPPA).state
        forces.append(state.traction.sum(axis=(1, 2)) / state.pressure.sum())
    return np.array(forces)


def by_load_path(way: Way) -> Array:
    """Return the force over mu P of `carom.load_path`."""
    by_force = np.zeros(way.depth.size, dtype=bool)
    results, _ = turning.follow_path(*way, by_force, lambda _: None)
    return results[:, turning.Q_X : turning.Q_Y + 1] / (2.0 / 3.0 * way.depth**1.5)[:, None]


def by_springs(way: Way, springs: int = 32) -> Array:
    """Return the force over mu P of springs that are cut back one by one."""
    fine, memory, load = way.parted(PARTS), np.zeros(lattice.places(springs)), np.zeros(3)
    forces, depth, moved = [], 0.0, np.zeros(3)
    for to, target in zip(*fine, strict=True):
        motion = np.array([to - depth, *(target - moved)])
        lattice.step(memory, springs, to, motion, 1.0, 0.0, 0.0, load)
        forces.append(load[1:] / load[0])
        depth, moved = to, target
    return np.array(forces)[PARTS - 1 :: PARTS]


def by_mindlin(way: Way) -> Array:
    """Return the force over mu P of Mindlin's stiffness, rescaled as the contact shrinks."""
    fine, force, depth, moved = way.parted(PARTS), np.zeros(3), 0.0, np.zeros(3)
    forces = []
    for to, target in zip(*fine, strict=True):
        force = force * min(1.0, np.sqrt(to / depth) if depth > 0.0 else 1.0)
        force = force + np.sqrt(to) * (target - moved)
        most = 2.0 / 3.0 * to**1.5
        force = force * min(1.0, most / max(float(np.hypot(*force)), 1e-300))
        forces.append(force / most)
        depth, moved = to, target
    return np.array(forces)[PARTS - 1 :: PARTS]


LAWS: dict[str, Callable[[Way], Array]] = {
    "load_path": by_load_path,
    "springs": by_springs,
    "mindlin_rescale/force": by_mindlin,
}
SHOWN = {
    "load_path": "load_path",
    "springs": "32 springs, one by one: contact.hpp",
    "mindlin_rescale/force": "mindlin_rescale/force",
}


def row(name: str) -> dict[str, str]:
    """Return the errors on a path, told by its name."""
    kind, _, numbers = name.partition(" ")
    given = [float(number) for number in numbers.split()]
    way = circle(given[0]) if kind == "circle" else kicked(given[0], tuple(given[1:3]), given[3])
    truth, weight = by_elements(way), (way.depth**1.5)[:, None]
    errors = {
        law: np.hypot(*(weight * (follow(way) - truth)).T).max() for law, follow in LAWS.items()
    }
    return {"path": name} | {law: f"{error:.4f}" for law, error in errors.items()}


def names() -> Iterator[str]:
    """Yield the paths: circles by radius, impacts by psi, kick in psi and part of the time."""
    rng = np.random.default_rng(22)
    yield from (f"circle {radius:g}" for radius in RADII)
    yield "impact 1.5 0 0.5 0.5"
    for _ in range(KICKS - 1):
        psi, at = rng.uniform(0.0, 4.0), rng.uniform(0.2, 0.8)
        kick = rng.uniform(-2.0, 2.0, 2)
        yield f"impact {psi:.2f} {kick[0]:.2f} {kick[1]:.2f} {at:.2f}"


@style.styled
def draw(rows: list[dict[str, str]]) -> None:
    """Draw the errors on circles against their radius."""
    figure, axis = style.single_axis(height=66.0)
    circles = [each for each in rows if each["path"].startswith("circle")]
    radius = [float(each["path"].split()[1]) for each in circles]
    for law, color, dash in zip(LAWS, style.LINES, style.DASHES, strict=False):
        errors = [float(each[law]) for each in circles]
        axis.plot(radius, errors, color=color, ls=dash, marker="o", ms=3.0, label=SHOWN[law])
    axis.set(xscale="log", yscale="log", ylim=(1e-4, 1.0))
    axis.set_xticks([0.1, 0.2, 0.5, 1.0, 2.0, 3.0], ["0.1", "0.2", "0.5", "1", "2", "3"])
    axis.minorticks_off()
    axis.set_xlabel(r"$U \kappa/(\mu d)$")
    axis.set_ylabel(r"largest error of $F/\mu P$")
    legend_above(axis, 1)
    store_small(style.save_figure(figure, PICTURE), PICTURE)


def main() -> None:
    """Make the table, or check three rows of it."""
    if "--check" in sys.argv:
        kept = {each["path"]: each for each in csv.DictReader(TABLE.open())}
        for name in ("circle 0.3", "circle 0.9", "impact 1.5 0 0.5 0.5"):
            found = row(name)
            assert all(abs(float(found[law]) - float(kept[name][law])) < 2e-4 for law in LAWS), (
                found
            )
            print(found)
        return
    paths = list(names())
    with ProcessPoolExecutor() as pool:
        rows = list(track(pool.map(row, paths), "paths", len(paths)))
    with TABLE.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    draw(rows)
    for kind in ("circle", "impact"):
        some = [each for each in rows if each["path"].startswith(kind)]
        for law in LAWS:
            errors = np.array([float(each[law]) for each in some])
            print(f"{kind}, {law}: median {np.median(errors):.4f}, largest {errors.max():.4f}")


if __name__ == "__main__":
    main()
