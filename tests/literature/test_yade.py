"""YADE itself as the truth: our records of its laws rebound as its impacts do.

Impacts at 0.1 mm/s: the contact point of YADE lies below R by up to d, which costs a few d/R.
"""

from dataclasses import dataclass

import numpy as np
import pytest

import carom
from carom.laws.dem import ContactLaw, LammpsMindlin, LinearSpring
from carom.quantities import InputError
from carom.verify.engines.experiments import Experiment, psi_out
from carom.verify.engines.running import run
from carom.verify.engines.yade import RESULTS, SCRIPT, Yade

INCIDENCES = np.array([0.1, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6])
SPEED = 1e-4
FORCE = LammpsMindlin("mindlin/force")
STEEL = carom.material("steel")
GLASSY = carom.Material(young="70 GPa", poisson=0.1, density=2500)
POLYMER = carom.Material(young="5 GPa", poisson=0.45, density=1200)
BALL = carom.Sphere(radius="5 mm", material=STEEL)
ON_WALL = carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2)
UNLIKE = carom.Pair(
    carom.Sphere(radius="3 mm", material=GLASSY), carom.HalfSpace(material=POLYMER), friction=0.4
)
EQUAL = carom.Pair(BALL, BALL, friction=0.2)
UNEQUAL = carom.Pair(BALL, carom.Sphere(radius="9 mm", material=GLASSY), friction=0.2)

engine = pytest.mark.engine
present = pytest.mark.skipif(Yade().executable() is None, reason="YADE is not installed")


@dataclass(frozen=True)
class Otherwise(Yade):
    """YADE with another of its laws in the script."""

    functor: str = ""

    def files(self, impacts: Experiment) -> dict[str, str]:
        """Return the script with the law replaced."""
        text = super().files(impacts)[SCRIPT]
        assert text.count("[Law2_ScGeom_MindlinPhys_Mindlin()]") == 1
        return {SCRIPT: text.replace("Law2_ScGeom_MindlinPhys_Mindlin()", self.functor)}


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


def deviation(impacts: Experiment, *, steps: int | None, program: Yade = Yade()) -> float:  # noqa: B008
    """Return how far psi_2 of YADE is from that of the record."""
    pair = impacts.pair
    found = psi_out(impacts, run(program, impacts).outcomes)
    expected = impacts.law.rebound(impacts.psi_in, pair.chi, kappa=pair.kappa, steps=steps)
    return float(np.abs(found - expected).max())


@engine
@present
def test_mindlin_on_a_wall() -> None:
    """LammpsMindlin("mindlin/force") is YADE's Mindlin to 1e-4 at a step that is fine enough."""
    assert ON_WALL.chi == pytest.approx(1.4412, abs=1e-4)
    assert deviation(experiment(ON_WALL, FORCE, 40_000), steps=None) < 1e-4


@engine
@present
@pytest.mark.parametrize("pair", [UNLIKE, UNEQUAL], ids=["unlike", "unequal spheres"])
def test_mindlin_step_for_step(pair: carom.Pair) -> None:
    """Step for step the record agrees for unlike materials and for unlike spheres."""
    assert deviation(experiment(pair, FORCE, 2000), steps=2000) < 5e-5


@engine
@present
def test_linear_springs() -> None:
    """LinearSpring is YADE's CundallStrack with k_n and k_s given, here of equal spheres."""
    assert deviation(experiment(EQUAL, LinearSpring(2 / 7), 2000), steps=2000) < 5e-5


@engine
@present
def test_hertz_with_linear_shear() -> None:
    """HertzWithLinearShear is the same law as Mindlin if, and only if, nonLin is 1."""
    right = Otherwise(functor="Law2_ScGeom_MindlinPhys_HertzWithLinearShear(nonLin=1)")
    assert deviation(experiment(ON_WALL, FORCE, 1000), steps=1000, program=right) < 5e-5


@engine
@present
def test_known_defect_of_mindlin_deresiewitz() -> None:
    """MindlinDeresiewitz of YADE sets no shear force: no impact changes psi."""
    frictionless = Otherwise(functor="Law2_ScGeom_MindlinPhys_MindlinDeresiewitz()")
    impacts = experiment(ON_WALL, FORCE, 200)
    found = psi_out(impacts, run(frictionless, impacts).outcomes)
    assert found == pytest.approx(impacts.psi_in, abs=1e-12)


def test_what_it_has() -> None:
    """Only laws that YADE has are taken; others are refused by name."""
    assert Yade().supports(LinearSpring())
    others = (
        LinearSpring(restitution=0.9),
        LammpsMindlin("mindlin"),
        LammpsMindlin("mindlin/force", stiffness=0.5),
        LammpsMindlin("mindlin/force", restitution=0.9),
    )
    assert not any(Yade().supports(law) for law in others)
    with pytest.raises(InputError, match="YADE does not have it"):
        run(Yade(), experiment(ON_WALL, others[0], 100))


def test_absent_program() -> None:
    """A program that is not there is said to be missing, with its path."""
    with pytest.raises(InputError, match="YADE: '/nowhere/yade' is not there"):
        run(Yade("/nowhere/yade"), experiment(ON_WALL, FORCE, 100))


def test_script_is_python_that_has_every_impact() -> None:
    """The script compiles, and its impacts are those asked for, to the last digit."""
    impacts = experiment(UNEQUAL, FORCE, 100)
    text = Yade().files(impacts)[SCRIPT]
    compile(text, SCRIPT, "exec")
    _, _, table = text.partition("impacts = [\n")
    rows = [eval(line.strip().rstrip(",")) for line in table.partition("]")[0].splitlines()]
    assert rows == list(zip(impacts.tangential_speed, impacts.spin, strict=True))
    assert f"O.dt = {impacts.time_step!r} " in text
    assert "NewtonIntegrator(damping=0)" in text


def test_results_of_a_run_that_did_not_finish(tmp_path) -> None:
    """Bodies that still touch are no results."""
    impacts = experiment(ON_WALL, FORCE, 100)
    (tmp_path / RESULTS).write_text("0.004999 0.1 0.2 0.3\n" * 30)
    with pytest.raises(ValueError, match="still in contact"):
        Yade().outcomes(tmp_path, impacts)
