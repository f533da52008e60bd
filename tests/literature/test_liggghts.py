"""LIGGGHTS itself as the truth: our records of its laws rebound as its impacts do.

Impacts at 0.1 mm/s: the contact point of LIGGGHTS lies at R - d/2, which costs a few d/R. All are
computed in one process, a folder an experiment.
"""

import subprocess
from math import sqrt

import numpy as np
import pytest

import carom
from carom.dem import EdemHertzMindlin, LammpsMindlin, LiggghtsHertz, LinearSpring
from carom.dem.base import ContactLaw
from carom.quantities.refusals import InputError
from carom.verify.engines.arrangement import touching, young_moduli
from carom.verify.engines.experiments import Experiment, Outcomes, psi_out
from carom.verify.engines.liggghts import INPUT, RESULT, SPHERES, Liggghts
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

Case = tuple[str, ContactLaw, int]  # name of the pair, law, steps

HERTZ: list[Case] = [(name, LiggghtsHertz(), 4000) for name in PAIRS]
SPRINGS: list[Case] = [
    (name, law, 1000)
    for name in ("unlike", "unequal spheres")
    for law in (LinearSpring(), LinearSpring(2 / 7, restitution=0.7))
]
DAMPED: list[Case] = [("wall", LiggghtsHertz(e), n) for e in (0.9, 0.5) for n in (2000, 40_000)]
STRONGLY_DAMPED: Case = ("unlike", LiggghtsHertz(0.06), 2000)

engine = pytest.mark.engine
present = pytest.mark.skipif(Liggghts().executable() is None, reason="LIGGGHTS is not installed")


def experiment(name: str, law: ContactLaw, steps: int) -> Experiment:
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


Found = dict[Case, tuple[Experiment, Outcomes]]


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Found:
    """Return all experiments with their outcomes."""
    program, folder = Liggghts(), tmp_path_factory.mktemp("liggghts")
    cases = [*HERTZ, *SPRINGS, *DAMPED, STRONGLY_DAMPED]
    wanted = {folder / str(number): experiment(*case) for number, case in enumerate(cases)}
    lines = []
    for place, impacts in wanted.items():
        place.mkdir()
        for file, text in program.files(impacts).items():
            (place / file).write_text(text)
        lines += [f"shell cd {place}", f"include {INPUT}", "clear"]
    (folder / INPUT).write_text("\n".join(lines) + "\n")
    subprocess.run(program.command(folder), cwd=folder, check=True, capture_output=True, timeout=60)
    results = [(impacts, program.outcomes(place, impacts)) for place, impacts in wanted.items()]
    return dict(zip(cases, results, strict=True))


def deviation(found: Found, case: Case, *, steps: int | None) -> float:
    """Return how far psi_2 of LIGGGHTS is from that of the record."""
    impacts, outcomes = found[case]
    pair = impacts.pair
    expected = impacts.law.rebound(impacts.psi_in, pair.chi, kappa=pair.kappa, steps=steps)
    return float(np.abs(psi_out(impacts, outcomes) - expected).max())


@engine
@present
@pytest.mark.parametrize("case", HERTZ, ids=PAIRS)
def test_hertz_with_history(found: Found, case: Case) -> None:
    """LiggghtsHertz is LIGGGHTS's hertz to 1e-4 for walls and spheres, by speed or by spin."""
    assert deviation(found, case, steps=None) < 5e-5


@engine
@present
def test_is_not_another_variant(found: Found) -> None:
    """LIGGGHTS stores the displacement: a law that stores the force is off by 0.2 and more."""
    impacts, outcomes = found[HERTZ[0]]
    assert ON_WALL.chi == pytest.approx(1.4412, abs=1e-4)
    other = LammpsMindlin("mindlin/force").rebound(impacts.psi_in, ON_WALL.chi)
    assert np.abs(psi_out(impacts, outcomes) - other).max() > 0.1


@engine
@present
@pytest.mark.parametrize("case", DAMPED, ids=str)
def test_damped_hertz(found: Found, case: Case) -> None:
    """With damping the record agrees step for step, and the limit of small steps with it."""
    _, law, steps = case
    assert deviation(found, case, steps=steps) < 1e-5
    if steps == 40_000:
        assert deviation(found, case, steps=None) < 1e-4
        speed = found[case][1].normal_speed
        assert speed == pytest.approx(law.restitution * SPEED, rel=1e-5)


@engine
@present
def test_strong_damping_is_run_until_all_have_parted(found: Found) -> None:
    """At e = 0.06 the contact lasts 1.7 times as long; the step costs 1e-3 of the speed."""
    assert deviation(found, STRONGLY_DAMPED, steps=2000) < 5e-5
    speed = found[STRONGLY_DAMPED][1].normal_speed
    assert speed == pytest.approx(0.06 * SPEED, rel=5e-3)


@engine
@present
@pytest.mark.parametrize("case", SPRINGS, ids=str)
def test_linear_springs(found: Found, case: Case) -> None:
    """LinearSpring is LIGGGHTS's hooke/stiffness step for step, with a dashpot too."""
    assert deviation(found, case, steps=1000) < 5e-5


@engine
@present
def test_one_run_alone(found: Found) -> None:
    """An experiment that is run alone comes out the same to the last digit."""
    impacts, expected = found[SPRINGS[-1]]
    alone = run(Liggghts(), impacts)
    assert alone.version == "3.8.0"
    for mine, theirs in zip(alone.outcomes, expected, strict=True):
        assert np.array_equal(mine, theirs)


def test_what_it_has() -> None:
    """Only laws that LIGGGHTS has are taken; others are refused by name."""
    program = Liggghts()
    assert program.supports(LinearSpring(restitution=0.5))
    assert not program.supports(LinearSpring(restitution=0.5, tangential_damping=0.5))
    assert not program.supports(EdemHertzMindlin(0.9))
    with pytest.raises(InputError, match="LIGGGHTS does not have it"):
        run(program, experiment("wall", LammpsMindlin(), 100))


def test_absent_program() -> None:
    """A program that is not there is said to be missing, with its path."""
    with pytest.raises(InputError, match="LIGGGHTS: '/nowhere/liggghts' is not an executable"):
        run(Liggghts("/nowhere/liggghts"), experiment("wall", LiggghtsHertz(), 100))


def test_inputs_are_what_was_asked() -> None:
    """The data file moves each body as the experiment says, to the last digit."""
    impacts = experiment("unequal spheres", LiggghtsHertz(), 100)
    files = Liggghts().files(impacts)
    _, _, velocities = files[SPHERES].partition("Velocities\n\n")
    rows = np.array([line.split()[1:] for line in velocities.splitlines()], dtype=float)
    first, second = rows[:30], rows[30:]
    assert (first - second)[:, 0] == pytest.approx(np.array(impacts.tangential_speed), rel=1e-15)
    assert (first - second)[:, 2] == pytest.approx(np.full(30, -SPEED), rel=1e-15)
    assert np.array_equal(first[:, 4], -np.array(impacts.spin))
    assert not second[:, 4].any()
    masses = impacts.pair.first.mass, impacts.pair.second.mass
    momentum = masses[0] * first[:, [0, 2]] + masses[1] * second[:, [0, 2]]
    assert np.abs(momentum).max() < 1e-15 * masses[0] * np.abs(first[:, 0]).max()
    assert f"timestep        {impacts.time_step!r} " in files[INPUT]


def test_a_rigid_wall_is_a_stiff_one() -> None:
    """What does not deform is given as so stiff that its share of 1/E* is below 1e-8."""
    ball, wall = young_moduli(PAIRS["rigid wall"])
    assert ball == GLASSY.young
    assert ball / wall < 1e-8
    assert np.isfinite(wall)


def test_results_of_a_run_that_did_not_finish(tmp_path) -> None:
    """Bodies that still touch, or a cut file, are no results."""
    impacts = experiment("wall", LiggghtsHertz(), 100)
    row = f"0 {touching(ON_WALL) * (1 - 1e-9)!r} 0.1 {sqrt(2)!r} 0.3"
    table = "\n".join(f"{number} {row}" for number in range(1, 31))
    (tmp_path / RESULT).write_text(f"ITEM: ATOMS id x z vx vz omegay\n{table}\n")
    with pytest.raises(ValueError, match="still touch"):
        Liggghts().outcomes(tmp_path, impacts)
    (tmp_path / RESULT).write_text("ITEM: TIMESTEP\n0\n")
    with pytest.raises(ValueError, match="0 by 5, not 30 by 5"):
        Liggghts().outcomes(tmp_path, impacts)
