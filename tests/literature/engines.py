"""What the tests of DEM programs share: pairs, impacts, and how far a program is from our record.

Impacts at 0.1 mm/s: the contact point of the programs lies below R by up to d, which costs a few
d/R. All are computed in one process, a folder an experiment.
"""

import subprocess

import numpy as np
import pytest

import carom
from carom.dem.base import ContactLaw
from carom.verify.engines.experiments import Experiment, Outcomes, psi_out
from carom.verify.engines.running import run

INCIDENCES = np.array([0.1, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6])
SPEED = 1e-4
STEEL = carom.material("steel")
GLASSY = carom.Material(young="70 GPa", poisson=0.1, density=2500)
POLYMER = carom.Material(young="5 GPa", poisson=0.45, density=1200)
BALL, BEAD = (
    carom.Sphere(radius=radius, material=stuff)
    for radius, stuff in (("5 mm", STEEL), ("3 mm", GLASSY))
)
LARGE = carom.Sphere(radius="9 mm", material=GLASSY)
PAIRS = {
    "wall": carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2),
    "low Poisson's ratio": carom.Pair(BEAD, carom.HalfSpace(material=GLASSY), friction=0.3),
    "unlike": carom.Pair(BEAD, carom.HalfSpace(material=POLYMER), friction=0.4),
    "rigid wall": carom.Pair(BEAD, carom.HalfSpace(material="rigid"), friction=0.4),
    "equal spheres": carom.Pair(BALL, BALL, friction=0.2),
    "unequal spheres": carom.Pair(BALL, LARGE, friction=0.2),
}

Case = tuple  # name of the pair, law, steps, and what a program needs to know beside
Results = dict[Case, tuple[Experiment, Outcomes]]


def experiment(name: str, law: ContactLaw, steps: int, *_: object) -> Experiment:
    """Return the impacts at all incidences: first without spin, then by spin alone."""
    pair = PAIRS[name]
    velocity = INCIDENCES * pair.scales(SPEED).tangential_speed
    rest = np.zeros_like(velocity)
    return Experiment(
        pair=pair,
        law=law,
        normal_speed=SPEED,
        tangential_speed=tuple(np.append(velocity, rest)),
        spin=tuple(np.append(rest, velocity / pair.first.radius)),
        steps=steps,
    )


def run_all(program, folder, wanted, files, script, lines, **options) -> Results:
    """Return all experiments with their outcomes, run by one script of lines for each folder."""
    text = []
    for number, (case, impacts) in enumerate(wanted.items()):
        place = folder / str(number)
        place.mkdir()
        for name, content in files(case, impacts).items():
            (place / name).write_text(content)
        text += lines(place)
    (folder / script).write_text("\n".join(text) + "\n")
    command = program.command(folder)
    subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=120, **options)
    return {
        case: (impacts, program.outcomes(folder / str(number), impacts))
        for number, (case, impacts) in enumerate(wanted.items())
    }


def deviation(actual: Results, case: Case, *, steps: int | None) -> float:
    """Return how far psi_2 of the program is from that of the record."""
    impacts, outcomes = actual[case]
    pair = impacts.pair
    expected = impacts.law.rebound(impacts.psi_in, pair.chi, kappa=pair.kappa, steps=steps)
    return float(np.abs(psi_out(impacts, outcomes) - expected).max())


def assert_same_alone(program, actual: Results, case: Case, version: str) -> None:
    """An experiment that is run alone comes out the same to the last digit."""
    impacts, expected = actual[case]
    alone = run(program, impacts)
    assert alone.version == version
    for mine, theirs in zip(alone.outcomes, expected, strict=True):
        assert np.array_equal(mine, theirs)


def assert_absent(program, name: str, law: ContactLaw) -> None:
    """A program that is not there is said to be missing, with its path."""
    with pytest.raises(carom.InputError, match=f"{name}: '/nowhere/.*' is not an executable"):
        run(program, experiment("wall", law, 100))
