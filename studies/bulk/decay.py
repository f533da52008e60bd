"""A packing at rest is boosted: how much of the kinetic energy is left, in time."""

from itertools import product
from pathlib import Path

import numpy as np

from bulk.contact_laws import BESIDE, COARSE, LAWS, Setting, duration, named, overlap, pairs, secant
from bulk.packings import BEGIN, packing
from bulk.simulations import Found, Run, run

PRESSURE, TEMPERATURE = 1e-4, 1e-7
SPEED = (2 * np.pi * TEMPERATURE) ** 0.5  # at which spheres meet: 1.4 times the mean in a gas
STEPS, CONTACTS = 60, 200  # time steps of an impact, length in impacts
SIZE, SEEDS = 1000, (1, 2, 3, 4)
SPRINGS = 64  # contacts at rest tremble by less than 16 of them resolve

INPUT = (
    BEGIN
    + """\
velocity all create {temperature} {seed} dist gaussian
compute turning all erotate/sphere
variable moving equal ke
variable turned equal c_turning/atoms
fix told all ave/time {every} {often} {window} v_moving v_turned file energies.txt
run {run}
"""
)


def runs() -> list[Run]:
    """Return the simulations of the experiment."""
    found = [
        Run("decay", law.name, friction, e, 0.0, seed, SIZE)
        for e, friction, law, seed in product((1.0, 0.9), (0.1, 0.3, 0.5), LAWS, SEEDS)
    ]
    found += [Run("decay", COARSE.name, 0.3, 1.0, 0.0, seed, SIZE) for seed in (1, 2)]
    found += [Run("decay", BESIDE.name, 0.3, e, 0.0, s, SIZE) for e in (1.0, 0.9) for s in SEEDS]
    for law in LAWS[:2]:
        found += [Run("decay", law.name, 0.3, 1.0, 0.0, seed, SIZE, 0.5) for seed in (1, 2)]
        found += [Run("decay", law.name, 0.3, 1.0, 0.0, seed, 4 * SIZE) for seed in (1, 2)]
    return found


def compute(asked: Run, packings: Path, folder: Path) -> list[Found]:
    """Return the kinetic energy that is left, averaged over two durations of an impact each."""
    law = named(asked.law)
    spring, springs = 0.8 * secant(overlap(SPEED)), 16 if law == COARSE else SPRINGS
    file = packing(packings, asked.size, asked.seed, PRESSURE, law.linear * spring)
    window = round(2 * STEPS / asked.step)
    text = INPUT.format(
        packing=file,
        law=pairs(law, Setting(asked.friction, asked.restitution, SPEED, spring, springs)),
        step=asked.step * duration(SPEED) / STEPS,
        temperature=TEMPERATURE,
        seed=1000 + asked.seed,
        every=window // 20,
        often=20,
        window=window,
        run=window * CONTACTS // 2,
    )
    run(text, folder)
    _, moving, turning = np.loadtxt(folder / "energies.txt").T
    time = 2.0 * np.arange(1, len(moving) + 1) - 1.0  # in durations of an impact
    first = 1.5 * TEMPERATURE
    kept = [0, 1, 2, 4, 7, 12, 24, 49, 74, 99]
    return [Found("kinetic", time[i], (moving[i] + turning[i]) / first) for i in kept]
