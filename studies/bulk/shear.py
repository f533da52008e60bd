"""Simple shear at constant pressure: stress ratio and volume fraction by inertial number."""

from itertools import product
from math import pi, sqrt
from pathlib import Path

import numpy as np

from bulk.contact_laws import BESIDE, LAWS, Setting, named, pairs, secant
from bulk.packings import BEGIN, packing
from bulk.simulations import Found, Run, run

PRESSURE, DEPTH, STEP = 1e-3, 1.3e-2, 0.2
LENGTHS = {1e-1: (4.0, 16.0), 1e-2: (2.0, 6.0), 1e-3: (0.5, 1.5), 1e-4: (0.07, 0.4)}  # strains
SIZE, FRICTIONS = 500, (0.1, 0.3, 0.5)
BLOCKS, WINDOWS, OFTEN = 8, 8, 50  # means of so many, windows of a block, looks in a window
FAST = 1e-3  # slower flows begin with this inertial number

INPUT = (
    BEGIN
    + """\
compute stress all pressure NULL virial
variable fraction equal atoms*PI/6/vol
variable stream atom {rate}*y
velocity all set v_stream 0 0
fix told all ave/time {every} {often} {window} c_stress[2] c_stress[4] v_fraction file stress.txt
"""
)
FLOW = """\
fix squeeze all deform/pressure 1 xy erate {rate} y pressure {pressure} {rate} &
    normalize/pressure yes max/rate {fastest} remap v flip yes
fix_modify squeeze press stress
run {run}
"""


def runs() -> list[Run]:
    """Return the simulations of the experiment; the slowest with one friction."""
    cases = [*product(FRICTIONS, (1e-1, 1e-2), (1, 2)), *product(FRICTIONS, (1e-3,), (1,))]
    cases += [(0.3, 1e-3, 2), (0.5, 1e-3, 2), (0.3, 1e-4, 1)]
    found = [
        Run("shear", law.name, friction, 0.9, inertia, seed, SIZE)
        for friction, inertia, seed in cases
        for law in LAWS
    ]
    fast = [(0.3, 1e-2), *((friction, 1e-1) for friction in FRICTIONS)]
    found += [Run("shear", BESIDE.name, mu, 0.9, i, s, SIZE) for mu, i in fast for s in (1, 2)]
    for law in LAWS[:2]:
        found += [Run("shear", law.name, 0.3, 0.9, 1e-2, seed, SIZE, 0.5) for seed in (1, 2)]
        found += [Run("shear", law.name, 0.3, 0.9, 1e-2, seed, 4 * SIZE) for seed in (1, 2)]
    return found


def compute(asked: Run, packings: Path, folder: Path) -> list[Found]:
    """Return means over the last part of the strain, and the scatter of the means of its blocks.

    The inertial number is I = (shear rate) d (density of a sphere/pressure)^(1/2).
    """
    law, spring = named(asked.law), secant(DEPTH)
    file = packing(packings, asked.size, asked.seed, PRESSURE, law.linear * spring)
    setting = Setting(asked.friction, asked.restitution, _rate(max(asked.at, FAST)), spring)
    run(_input(asked, file, pairs(law, setting)), folder)
    _, pressed, sheared, fraction = np.loadtxt(folder / "stress.txt")[-BLOCKS * WINDOWS :].T
    in_blocks = pressed.reshape(BLOCKS, WINDOWS).mean(1)
    ratios = -sheared.reshape(BLOCKS, WINDOWS).mean(1) / in_blocks
    fractions = fraction.reshape(BLOCKS, WINDOWS).mean(1)
    return [
        Found("ratio", asked.at, -sheared.mean() / pressed.mean()),
        Found("ratio_error", asked.at, float(ratios.std() / sqrt(BLOCKS - 1))),
        Found("fraction", asked.at, fraction.mean()),
        Found("fraction_error", asked.at, float(fractions.std() / sqrt(BLOCKS - 1))),
        Found("pressure", asked.at, pressed.mean() / PRESSURE),
    ]


def _rate(inertia: float) -> float:
    """Return the shear rate of an inertial number."""
    return inertia / sqrt(6 / pi / PRESSURE)


def _input(asked: Run, file: Path, law: str) -> str:
    """Return the input: a strain to begin with, for the slowest a fast one before it, the rest."""
    step, rate = STEP * asked.step, _rate(asked.at)
    before, after = LENGTHS[asked.at]
    every = max(1, round(after / rate / step / BLOCKS / WINDOWS / OFTEN))
    window = every * OFTEN
    fast, strain = (rate, before) if asked.at >= FAST else (_rate(FAST), 1.0)
    stages = [(fast, window * round(strain / fast / step / window + 1))]
    if asked.at < FAST:
        stages.append((rate, window * round(before / rate / step / window)))
    stages.append((rate, window * BLOCKS * WINDOWS))
    start = INPUT.format(
        packing=file, law=law, step=step, rate=fast, every=every, often=OFTEN, window=window
    )
    flows = [
        FLOW.format(rate=each, pressure=PRESSURE, fastest=2 * each, run=steps)
        for each, steps in stages
    ]
    return start + "unfix squeeze\n".join(flows)
