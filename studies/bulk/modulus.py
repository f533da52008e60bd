"""A compressed packing is sheared to and fro: its shear modulus and its damping ratio."""

from itertools import product
from pathlib import Path

import numpy as np

from bulk.contact_laws import BESIDE, COARSE, LAWS, Setting, named, pairs, secant
from bulk.packings import BEGIN, packing
from bulk.simulations import Found, Run, run

PRESSURE = 1e-4
DEPTH = 2.8e-3  # mean overlap at this pressure
STEP, PERIOD, CYCLES = 0.3, 3000.0, 3
STRAINS = (1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3)
SIZE, SEEDS = 500, {0.1: (1, 2), 0.3: (1, 2, 3), 0.5: (1, 2)}  # by friction
SPRINGS = 64  # 16 miss a third of the damping at small strains
PHASES = 500  # a cycle is told at so many instants

INPUT = (
    BEGIN
    + """\
compute stress all pressure NULL virial
variable strain equal xy/ly
variable stream atom 2*PI*{strain}/{period}*(y-ylo-ly/2)
velocity all set v_stream 0 0
variable amplitude equal {strain}*ly
fix told all ave/time {every} 1 {every} v_strain c_stress[4] c_stress file stress.txt
fix squeeze all deform 1 xy wiggle ${{amplitude}} {period} remap v
run {run}
"""
)


def runs() -> list[Run]:
    """Return the simulations of the experiment."""
    found = [
        Run("modulus", law.name, friction, 1.0, strain, seed, SIZE)
        for friction, seeds in SEEDS.items()
        for strain, law, seed in product(STRAINS, LAWS, seeds)
    ]
    found += [
        Run("modulus", COARSE.name, 0.3, 1.0, strain, seed, SIZE)
        for strain, seed in product(STRAINS, (1, 2))
    ]
    found += [Run("modulus", BESIDE.name, 0.3, 1.0, 3e-4, seed, SIZE) for seed in (1, 2)]
    for law in LAWS[:2]:
        found += [Run("modulus", law.name, 0.3, 1.0, 3e-4, seed, SIZE, 0.5) for seed in (1, 2)]
        found += [Run("modulus", law.name, 0.3, 1.0, 3e-4, seed, 4 * SIZE) for seed in (1, 2)]
    return found


def compute(asked: Run, packings: Path, folder: Path) -> list[Found]:
    """Return G/E and D = G''/(2 G') of the first harmonic over the last two of three cycles."""
    law = named(asked.law)
    spring, springs = 1.5 * secant(DEPTH), 16 if law == COARSE else SPRINGS
    file = packing(packings, asked.size, asked.seed, PRESSURE, law.linear * spring)
    cycle = round(PERIOD / STEP / asked.step)
    text = INPUT.format(
        packing=file,
        law=pairs(law, Setting(asked.friction, asked.restitution, 1e-3, spring, springs)),
        step=STEP * asked.step,
        strain=asked.at,
        every=cycle // PHASES,
        period=PERIOD,
        run=cycle * CYCLES,
    )
    run(text, folder)
    _, strain, stress, pressure = np.loadtxt(folder / "stress.txt")[-2 * PHASES :].T
    wave = np.exp(-2j * np.pi * np.arange(2 * PHASES) / PHASES)
    modulus = -(stress @ wave) / (strain @ wave)
    return [
        Found("modulus", asked.at, modulus.real),
        Found("damping", asked.at, modulus.imag / (2 * modulus.real)),
        Found("pressure", asked.at, pressure.mean()),
    ]
