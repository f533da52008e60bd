"""LIGGGHTS itself as the truth: our records of its laws rebound as its impacts do.

Impacts at 0.1 mm/s: the contact point of LIGGGHTS lies at R - d/2, which costs a few d/R.
"""

from math import sqrt

import numpy as np
import pytest

import carom
from carom.laws.dem import ContactLaw, EdemHertzMindlin, LammpsMindlin, LiggghtsHertz, LinearSpring
from carom.quantities import InputError
from carom.verify.engines.experiments import Experiment, psi_out
from carom.verify.engines.liggghts import RESULTS, Liggghts, start_height, young_moduli
from carom.verify.engines.running import run

INCIDENCES = np.array([0.1, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6])
SPEED = 1e-4
STEEL = carom.material("steel")
GLASSY = carom.Material(young="70 GPa", poisson=0.1, density=2500)
POLYMER = carom.Material(young="5 GPa", poisson=0.45, density=1200)
BALL = carom.Sphere(radius="5 mm", material=STEEL)
ON_WALL = carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2)
PAIRS = {
    "wall": ON_WALL,
    "low Poisson's ratio": carom.Pair(
        carom.Sphere(radius="3 mm", material=GLASSY), carom.HalfSpace(material=GLASSY), friction=0.3
    ),
    "unlike": carom.Pair(
        carom.Sphere(radius="3 mm", material=GLASSY),
        carom.HalfSpace(material=POLYMER),
        friction=0.4,
    ),
    "rigid wall": carom.Pair(
        carom.Sphere(radius="3 mm", material=GLASSY),
        carom.HalfSpace(material="rigid"),
        friction=0.4,
    ),
    "equal spheres": carom.Pair(BALL, BALL, friction=0.2),
    "unequal spheres": carom.Pair(BALL, carom.Sphere(radius="9 mm", material=GLASSY), friction=0.2),
}

engine = pytest.mark.engine
present = pytest.mark.skipif(Liggghts().executable() is None, reason="LIGGGHTS is not installed")


def experiment(pair: carom.Pair, law: ContactLaw, steps: int) -> Experiment:
    """Return the impacts at all incidences: first without spin, then by spin alone."""
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


def deviation(impacts: Experiment, *, steps: int | None) -> float:
    """Return how far psi_2 of LIGGGHTS is from that of the record."""
    pair = impacts.pair
    found = psi_out(impacts, run(Liggghts(), impacts).outcomes)
    expected = impacts.law.rebound(impacts.psi_in, pair.chi, kappa=pair.kappa, steps=steps)
    return float(np.abs(found - expected).max())


@engine
@present
@pytest.mark.parametrize("pair", PAIRS.values(), ids=PAIRS)
def test_hertz_with_history(pair: carom.Pair) -> None:
    """LiggghtsHertz is LIGGGHTS's hertz to 1e-4 for walls and spheres, by speed or by spin."""
    assert deviation(experiment(pair, LiggghtsHertz(), 4000), steps=None) < 5e-5


@engine
@present
def test_is_not_another_variant() -> None:
    """LIGGGHTS stores the displacement: a law that stores the force is off by 0.2 and more."""
    impacts = experiment(ON_WALL, LiggghtsHertz(), 1000)
    found = psi_out(impacts, run(Liggghts(), impacts).outcomes)
    assert ON_WALL.chi == pytest.approx(1.4412, abs=1e-4)
    other = LammpsMindlin("mindlin/force").rebound(impacts.psi_in, ON_WALL.chi)
    assert np.abs(found - other).max() > 0.1


@engine
@present
@pytest.mark.parametrize("restitution", [0.9, 0.5])
def test_damped_hertz(restitution: float) -> None:
    """With damping the record agrees step for step, and the limit of small steps with it."""
    law = LiggghtsHertz(restitution)
    assert deviation(experiment(ON_WALL, law, 2000), steps=2000) < 1e-5
    impacts = experiment(ON_WALL, law, 40_000)
    outcomes = run(Liggghts(), impacts).outcomes
    expected = law.rebound(impacts.psi_in, ON_WALL.chi, kappa=ON_WALL.kappa)
    assert np.abs(psi_out(impacts, outcomes) - expected).max() < 1e-4
    assert outcomes.normal_speed == pytest.approx(restitution * SPEED, rel=1e-5)


@engine
@present
@pytest.mark.parametrize("law", [LinearSpring(), LinearSpring(2 / 7, restitution=0.7)])
@pytest.mark.parametrize("name", ["unlike", "unequal spheres"])
def test_linear_springs(name: str, law: LinearSpring) -> None:
    """LinearSpring is LIGGGHTS's hooke/stiffness step for step, with a dashpot too."""
    assert deviation(experiment(PAIRS[name], law, 1000), steps=1000) < 5e-5


def test_what_it_has() -> None:
    """Only laws that LIGGGHTS has are taken; others are refused by name."""
    program = Liggghts()
    assert program.supports(LinearSpring(restitution=0.5))
    assert not program.supports(LinearSpring(restitution=0.5, tangential_damping=0.5))
    assert not program.supports(EdemHertzMindlin(0.9))
    with pytest.raises(InputError, match="LIGGGHTS does not have it"):
        run(program, experiment(ON_WALL, LammpsMindlin(), 100))


def test_absent_program() -> None:
    """A program that is not there is said to be missing, with its path."""
    with pytest.raises(InputError, match="LIGGGHTS: '/nowhere/liggghts' is not there"):
        run(Liggghts("/nowhere/liggghts"), experiment(ON_WALL, LiggghtsHertz(), 100))


def test_inputs_are_what_was_asked() -> None:
    """The data file moves each body as the experiment says, to the last digit."""
    pair = PAIRS["unequal spheres"]
    impacts = experiment(pair, LiggghtsHertz(), 100)
    files = Liggghts().files(impacts)
    _, _, velocities = files["bodies.data"].partition("Velocities\n\n")
    rows = np.array([line.split() for line in velocities.splitlines()], dtype=float)
    assert np.array_equal(rows[:30, 1], impacts.tangential_speed)
    assert np.array_equal(rows[:30, 5], -np.array(impacts.spin))
    assert np.all(rows[:30, 3] == -SPEED)
    assert not rows[30:, 1:].any()
    assert f"timestep        {impacts.time_step!r} " in files["in.liggghts"]


def test_a_rigid_wall_is_a_stiff_one() -> None:
    """What does not deform is given as so stiff that its share of 1/E* is below 1e-8."""
    ball, wall = young_moduli(PAIRS["rigid wall"])
    assert ball == GLASSY.young
    assert ball / wall < 1e-8
    assert np.isfinite(wall)


def test_results_of_a_run_that_did_not_finish(tmp_path) -> None:
    """Bodies that still touch, or a cut file, are no results."""
    impacts = experiment(ON_WALL, LiggghtsHertz(), 100)
    row = f"0 {start_height(ON_WALL) * (1 - 1e-9)!r} 0.1 {sqrt(2)!r} 0.3"
    table = "\n".join(f"{number} {row}" for number in range(1, 31))
    (tmp_path / RESULTS).write_text(f"ITEM: ATOMS id x z vx vz omegay\n{table}\n")
    with pytest.raises(ValueError, match="still in contact"):
        Liggghts().outcomes(tmp_path, impacts)
    (tmp_path / RESULTS).write_text("ITEM: TIMESTEP\n0\n")
    with pytest.raises((ValueError, IndexError)):
        Liggghts().outcomes(tmp_path, impacts)
