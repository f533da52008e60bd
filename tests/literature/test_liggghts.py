"""LIGGGHTS itself as the truth: our records of its laws rebound as its impacts do."""

from math import sqrt

import numpy as np
import pytest
from tests.literature import engines

from carom.dem import EdemHertzMindlin, LammpsMindlin, LiggghtsHertz, LinearSpring
from carom.quantities.refusals import InputError
from carom.verify.engines.arrangement import touching, young_moduli
from carom.verify.engines.experiments import psi_out
from carom.verify.engines.liggghts import INPUT, RESULT, SPHERES, Liggghts
from carom.verify.engines.running import run

HERTZ: list[engines.Case] = [(name, LiggghtsHertz(), 4000) for name in engines.PAIRS]
SPRINGS: list[engines.Case] = [
    (name, law, 1000)
    for name in ("unlike", "unequal spheres")
    for law in (LinearSpring(), LinearSpring(2 / 7, restitution=0.7))
]
DAMPED: list[engines.Case] = [
    ("wall", LiggghtsHertz(e), n) for e in (0.9, 0.5) for n in (2000, 40_000)
]
STRONGLY_DAMPED: engines.Case = ("unlike", LiggghtsHertz(0.06), 2000)

engine = pytest.mark.engine
present = pytest.mark.skipif(Liggghts().executable() is None, reason="LIGGGHTS is not installed")


@pytest.fixture(scope="module")
def actual(tmp_path_factory: pytest.TempPathFactory) -> engines.Results:
    """Return all experiments with their outcomes."""
    program, cases = Liggghts(), [*HERTZ, *SPRINGS, *DAMPED, STRONGLY_DAMPED]
    return engines.run_all(
        program,
        tmp_path_factory.mktemp("liggghts"),
        {case: engines.experiment(*case) for case in cases},
        lambda case, impacts: program.files(impacts),
        INPUT,
        lambda place: [f"shell cd {place}", f"include {INPUT}", "clear"],
    )


@engine
@present
@pytest.mark.parametrize("case", HERTZ, ids=engines.PAIRS)
def test_hertz_with_history(actual: engines.Results, case: engines.Case) -> None:
    """LiggghtsHertz is LIGGGHTS's hertz to 1e-4 for walls and spheres, by speed or by spin."""
    assert engines.deviation(actual, case, steps=None) < 5e-5


@engine
@present
def test_is_not_another_variant(actual: engines.Results) -> None:
    """LIGGGHTS stores the displacement: a law that stores the force is off by 0.2 and more."""
    impacts, outcomes = actual[HERTZ[0]]
    assert engines.PAIRS["wall"].chi == pytest.approx(1.4412, abs=1e-4)
    other = LammpsMindlin("mindlin/force").rebound(impacts.psi_in, engines.PAIRS["wall"].chi)
    assert np.abs(psi_out(impacts, outcomes) - other).max() > 0.1


@engine
@present
@pytest.mark.parametrize("case", DAMPED, ids=str)
def test_damped_hertz(actual: engines.Results, case: engines.Case) -> None:
    """With damping the record agrees step for step, and the limit of small steps with it."""
    _, law, steps = case
    assert engines.deviation(actual, case, steps=steps) < 1e-5
    if steps == 40_000:
        assert engines.deviation(actual, case, steps=None) < 1e-4
        speed = actual[case][1].normal_speed
        assert speed == pytest.approx(law.restitution * engines.SPEED, rel=1e-5)


@engine
@present
def test_strong_damping_is_run_until_all_have_parted(actual: engines.Results) -> None:
    """At e = 0.06 the contact lasts 1.7 times as long; the step costs 1e-3 of the speed."""
    assert engines.deviation(actual, STRONGLY_DAMPED, steps=2000) < 5e-5
    speed = actual[STRONGLY_DAMPED][1].normal_speed
    assert speed == pytest.approx(0.06 * engines.SPEED, rel=5e-3)


@engine
@present
@pytest.mark.parametrize("case", SPRINGS, ids=str)
def test_linear_springs(actual: engines.Results, case: engines.Case) -> None:
    """LinearSpring is LIGGGHTS's hooke/stiffness step for step, with a dashpot too."""
    assert engines.deviation(actual, case, steps=1000) < 5e-5


@engine
@present
def test_one_run_alone(actual: engines.Results) -> None:
    engines.assert_same_alone(Liggghts(), actual, SPRINGS[-1], "3.8.0")


def test_what_it_has() -> None:
    """Only laws that LIGGGHTS has are taken; others are refused by name."""
    program = Liggghts()
    assert program.supports(LinearSpring(restitution=0.5))
    assert not program.supports(LinearSpring(restitution=0.5, tangential_damping=0.5))
    assert not program.supports(EdemHertzMindlin(0.9))
    with pytest.raises(InputError, match="LIGGGHTS does not have it"):
        run(program, engines.experiment("wall", LammpsMindlin(), 100))


def test_absent_program() -> None:
    engines.assert_absent(Liggghts("/nowhere/liggghts"), "LIGGGHTS", LiggghtsHertz())


def test_inputs_are_what_was_asked() -> None:
    """The data file moves each body as the experiment says, to the last digit."""
    impacts = engines.experiment("unequal spheres", LiggghtsHertz(), 100)
    files = Liggghts().files(impacts)
    _, _, velocities = files[SPHERES].partition("Velocities\n\n")
    rows = np.array([line.split()[1:] for line in velocities.splitlines()], dtype=float)
    first, second = rows[:30], rows[30:]
    assert (first - second)[:, 0] == pytest.approx(np.array(impacts.tangential_speed), rel=1e-15)
    assert (first - second)[:, 2] == pytest.approx(np.full(30, -engines.SPEED), rel=1e-15)
    assert np.array_equal(first[:, 4], -np.array(impacts.spin))
    assert not second[:, 4].any()
    masses = impacts.pair.first.mass, impacts.pair.second.mass
    momentum = masses[0] * first[:, [0, 2]] + masses[1] * second[:, [0, 2]]
    assert np.abs(momentum).max() < 1e-15 * masses[0] * np.abs(first[:, 0]).max()
    assert f"timestep        {impacts.time_step!r} " in files[INPUT]


def test_a_rigid_wall_is_a_stiff_one() -> None:
    """What does not deform is given as so stiff that its share of 1/E* is below 1e-8."""
    ball, wall = young_moduli(engines.PAIRS["rigid wall"])
    assert ball == engines.GLASSY.young
    assert ball / wall < 1e-8
    assert np.isfinite(wall)


def test_results_of_a_run_that_did_not_finish(tmp_path) -> None:
    """Bodies that still touch, or a cut file, are no results."""
    impacts = engines.experiment("wall", LiggghtsHertz(), 100)
    row = f"0 {touching(engines.PAIRS['wall']) * (1 - 1e-9)!r} 0.1 {sqrt(2)!r} 0.3"
    table = "\n".join(f"{number} {row}" for number in range(1, 31))
    (tmp_path / RESULT).write_text(f"ITEM: ATOMS id x z vx vz omegay\n{table}\n")
    with pytest.raises(ValueError, match="still touch"):
        Liggghts().outcomes(tmp_path, impacts)
    (tmp_path / RESULT).write_text("ITEM: TIMESTEP\n0\n")
    with pytest.raises(ValueError, match="0 by 5, not 30 by 5"):
        Liggghts().outcomes(tmp_path, impacts)
