"""A granular gas cools: by time stepping, and by events with `carom.collide`.

Both start from the same spheres. What they share is the exact impact; what they do not is all the
rest: forces in small steps here, hard spheres that meet at an instant there.
"""

from math import pi, sqrt
from pathlib import Path

import numpy as np

from bulk.contact_laws import BESIDE, LAWS, Setting, duration, named, overlap, pairs, secant
from bulk.events import cool
from bulk.simulations import Found, Run, run

FRACTION, TEMPERATURE, SIZE = 0.05, 4e-8, 1000
SPEED = sqrt(pi * TEMPERATURE)  # mean normal speed at which spheres meet
STEPS = 50  # in an impact at this speed
FREE = sqrt(pi / TEMPERATURE) / (24 * FRACTION * (1 - FRACTION / 2) / (1 - FRACTION) ** 3)  # Enskog
TIMES = tuple(range(2, 41, 2))  # in mean free times of the start, FREE
SEEDS = {0.1: (1, 2), 0.3: (1, 2, 3, 4), 0.5: (1, 2)}  # by friction
EVENTS = "collide"  # what the law is called where spheres meet at an instant

START = """\
boundary p p p
region box block 0 {side} 0 {side} 0 {side}
create_box 1 box
create_atoms 1 random {size} {seed} NULL overlap 1.0 maxtry 1000
set group all diameter 1.0 density $(6/PI)
velocity all create {temperature} {seed} dist gaussian
"""
DUMP = (
    "run 0\nwrite_dump all custom start.txt id x y z vx vy vz modify sort id format float %.17g\n"
)
COOL = """\
neighbor 0.5 bin
{law}
timestep {step}
fix motion all nve/sphere
compute turning all erotate/sphere
variable moving equal ke
variable turned equal c_turning/atoms
fix told all ave/time {every} 1 {every} v_moving v_turned file energies.txt
run {run}
"""


def runs() -> list[Run]:
    """Return the simulations of the experiment."""
    laws = [EVENTS, *(law.name for law in LAWS)]
    found = [
        Run("gas", law, friction, 1.0, FRACTION, seed, SIZE)
        for friction, seeds in SEEDS.items()
        for law in (laws if friction == 0.3 else laws[:2])
        for seed in seeds
    ]
    found += [Run("gas", EVENTS, mu, 1.0, FRACTION, s, SIZE) for mu in SEEDS for s in range(5, 13)]
    found += [Run("gas", BESIDE.name, 0.3, 1.0, FRACTION, seed, SIZE) for seed in (1, 2)]
    found += [Run("gas", LAWS[0].name, 0.3, 1.0, FRACTION, seed, SIZE, 0.5) for seed in (1, 2)]
    return found + [Run("gas", EVENTS, 0.3, 1.0, FRACTION, seed, 4 * SIZE) for seed in (1, 2)]


def compute(asked: Run, packings: Path, folder: Path) -> list[Found]:
    """Return translational and rotational energy over that of the start."""
    del packings
    side = (asked.size * pi / 6 / FRACTION) ** (1 / 3)
    start = START.format(
        side=side, size=asked.size, seed=4000 + asked.seed, temperature=TEMPERATURE
    )
    means = (_events if asked.law == EVENTS else _steps)(asked, start, side, folder)
    first = 1.5 * TEMPERATURE
    return [
        Found(name, time, mean / first)
        for name, column in zip(("translational", "rotational"), means, strict=True)
        for time, mean in zip(TIMES, column, strict=True)
    ]


def _steps(asked: Run, start: str, side: float, folder: Path) -> np.ndarray:
    """Return mean energies of a sphere at the TIMES, (2, n), by time stepping."""
    del side
    spring = 0.8 * secant(overlap(SPEED))
    every = round(TIMES[0] * FREE / (duration(SPEED) / STEPS * asked.step))
    setting = Setting(asked.friction, asked.restitution, SPEED, spring)
    text = start + COOL.format(
        law=pairs(named(asked.law), setting),
        step=TIMES[0] * FREE / every,
        every=every,
        run=every * len(TIMES),
    )
    run(text, folder)
    return np.loadtxt(folder / "energies.txt")[1:, 1:].T


def _events(asked: Run, start: str, side: float, folder: Path) -> np.ndarray:
    """Return the same by events."""
    run(start + "pair_style zero 1.0\npair_coeff * *\n" + DUMP, folder)
    state = np.loadtxt(folder / "start.txt", skiprows=9)[:, 1:]
    times = FREE * np.array(TIMES)
    return cool(state[:, :3], state[:, 3:], side, asked.friction, times)
