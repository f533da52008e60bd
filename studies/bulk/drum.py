"""A rough drum turns, then stops: the slope of what is in it, by its centre of mass."""

from itertools import product
from math import pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bulk.contact_laws import BESIDE, LAWS, Setting, named, pairs, secant
from bulk.simulations import Found, Run, run

GRAVITY, STEP, DEPTH = 3e-5, 0.2, 3e-3  # at the bottom of the bed spheres overlap by some DEPTH
RADIUS, WIDTH, FILLED = 8.0, 4, 0.4
FROUDE = 1e-3
TURNS = 0.9, 1.8  # radians to set in, and to measure
BLOCKS, OFTEN = 9, 50  # windows of the mean, looks in each
SEEDS, FRICTIONS = (1, 2), (0.1, 0.3, 0.5)

INPUT = """\
boundary f f p
neighbor 0.1 bin
region box block {low} {high} {low} {high} 0 {width}
create_box 2 box
{glued}
region inside cylinder z 0 0 {inner} 0 {width}
create_atoms 1 random {count} {seed} inside overlap 0.9 maxtry 10000
set group all diameter 1.0 density $(6/PI)
group wall type 2
group grains type 1
neigh_modify exclude group wall wall
{law}
timestep {step}
fix motion grains nve/sphere
fix weight grains gravity {gravity} vector 0 -1 0
fix drag grains viscous 1e-3
compute middle grains com
run {settle}
unfix drag
fix told all ave/time {every} {often} {window} c_middle[1] c_middle[2] file middle.txt
fix turn wall move rotate 0 0 0 0 0 1 {period}
run {turning}
unfix turn
velocity wall set 0 0 0
set group wall omega 0 0 0
fix drag grains viscous 1e-4
run {settle}
"""


def runs() -> list[Run]:
    """Return the simulations of the experiment."""
    found = [
        Run("drum", law.name, friction, 0.9, FROUDE, seed, round(2 * RADIUS))
        for friction, law, seed in product(FRICTIONS, LAWS, SEEDS)
    ]
    size = round(2 * RADIUS)
    found += [Run("drum", BESIDE.name, 0.3, 0.9, FROUDE, seed, size) for seed in SEEDS]
    for law in LAWS[:2]:
        found += [Run("drum", law.name, 0.3, 0.9, FROUDE, seed, 16, 0.5) for seed in SEEDS]
        found += [Run("drum", law.name, 0.3, 0.9, FROUDE, seed, 24) for seed in SEEDS]
    return found


def glued(radius: float) -> str:
    """Return the lines that make the wall: spheres on a circle, the rows shifted by a half."""
    around = round(2 * pi * radius / 1.05)
    places = [
        (2 * pi * (i + 0.5 * (row % 2)) / around, row + 0.5)
        for row in range(WIDTH)
        for i in range(around)
    ]
    return "\n".join(
        f"create_atoms 2 single {radius * np.cos(a):.12g} {radius * np.sin(a):.12g} {z:g} units box"
        for a, z in places
    )


class Times(NamedTuple):
    """Numbers of steps: to settle, to begin with, of a window of the mean."""

    settle: int
    begin: int
    window: int

    @property
    def turned(self) -> int:
        """After how many steps it stops."""
        return self.settle + self.begin + BLOCKS * self.window


def _speed(radius: float) -> float:
    """Return the angular velocity."""
    return sqrt(FROUDE * GRAVITY / radius)


def _times(radius: float, step: float) -> Times:
    radian = 1 / _speed(radius) / step
    window = OFTEN * round(TURNS[1] * radian / BLOCKS / OFTEN)
    settle = round(150 * sqrt(radius / 8 / GRAVITY) / step)
    return Times(settle, window * round(TURNS[0] * radian / window), window)


def _input(asked: Run, times: Times) -> str:
    radius, law = asked.size / 2, named(asked.law)
    return INPUT.format(
        low=-radius - 1,
        high=radius + 1,
        width=WIDTH,
        glued=glued(radius + 0.5),
        inner=radius - 0.6,
        count=round(FILLED * pi * radius**2 * WIDTH * 0.58 / (pi / 6)),
        seed=asked.seed,
        law=pairs(law, Setting(asked.friction, asked.restitution, sqrt(GRAVITY), secant(DEPTH))),
        step=STEP * asked.step,
        gravity=GRAVITY,
        settle=times.settle,
        every=times.window // OFTEN,
        often=OFTEN,
        window=times.window,
        period=2 * pi / _speed(radius),
        turning=times.turned - times.settle,
    )


def compute(asked: Run, packings: Path, folder: Path) -> list[Found]:
    """Return the angle of the centre of mass from below, in degrees, turning and at rest."""
    del packings
    times = _times(asked.size / 2, STEP * asked.step)
    run(_input(asked, times), folder)
    when, x, y = np.loadtxt(folder / "middle.txt").T
    angle = np.degrees(np.arctan2(x, -y))
    last = np.searchsorted(when, times.turned, side="right")
    turning = angle[last - BLOCKS : last]
    return [
        Found("turning", FROUDE, turning.mean()),
        Found("turning_error", FROUDE, turning.std() / sqrt(BLOCKS - 1)),
        Found("rest", FROUDE, angle[-1]),
    ]
