"""YADE itself as the truth: our records of its laws rebound as its impacts do."""

import os
from dataclasses import dataclass

import pytest
from tests.literature import engines

from carom.dem import LammpsMindlin, LinearSpring, YadeMindlin
from carom.dem.damping import thornton_damping
from carom.quantities.refusals import InputError
from carom.verify.engines.experiments import Experiment, psi_out
from carom.verify.engines.running import run
from carom.verify.engines.yade import MINDLIN, RESULT, SCRIPT, Yade

FORCE = LammpsMindlin("mindlin/force")
FINE: engines.Case = ("wall", FORCE, 40_000, MINDLIN)
ELASTIC: list[engines.Case] = [
    (name, FORCE, 2000, MINDLIN) for name in ("unlike", "unequal spheres")
]
SPRINGS: engines.Case = ("equal spheres", LinearSpring(2 / 7), 2000, "")
DAMPED: list[engines.Case] = [
    (name, YadeMindlin(e), 2000, MINDLIN)
    for name in ("wall", "unlike", "unequal spheres")
    for e in (1.0, 0.9, 0.5)
]
LINEAR_SHEAR: engines.Case = (
    *("wall", FORCE, 1000),
    "Law2_ScGeom_MindlinPhys_HertzWithLinearShear(nonLin=1)",
)
DERESIEWITZ: engines.Case = ("wall", FORCE, 200, "Law2_ScGeom_MindlinPhys_MindlinDeresiewitz()")

engine = pytest.mark.engine
present = pytest.mark.skipif(Yade().executable() is None, reason="YADE is not installed")


@dataclass(frozen=True)
class Otherwise(Yade):
    """YADE with another of its laws in the script."""

    functor: str = ""

    def files(self, impacts: Experiment) -> dict[str, str]:
        """Return the script with the law replaced."""
        text = super().files(impacts)[SCRIPT]
        assert text.count(f"[{MINDLIN}]") == (1 if self.functor else 0)
        return {SCRIPT: text.replace(f"[{MINDLIN}]", f"[{self.functor}]")}


@pytest.fixture(scope="module")
def actual(tmp_path_factory: pytest.TempPathFactory) -> engines.Results:
    """Return all experiments with their outcomes."""
    cases = [FINE, *ELASTIC, SPRINGS, *DAMPED, LINEAR_SHEAR, DERESIEWITZ]
    return engines.run_all(
        Yade(),
        tmp_path_factory.mktemp("yade"),
        {case: engines.experiment(*case) for case in cases},
        lambda case, impacts: Otherwise(functor=case[-1]).files(impacts),
        SCRIPT,
        lambda place: [
            f"import os; os.chdir({str(place)!r})",
            f"O.reset(); exec(open({SCRIPT!r}).read())",
        ],
        env=os.environ | {"OMP_NUM_THREADS": "1"},
    )


@engine
@present
def test_mindlin_on_a_wall(actual: engines.Results) -> None:
    """LammpsMindlin("mindlin/force") is YADE's Mindlin to 1e-4 at a step that is fine enough."""
    assert engines.PAIRS["wall"].chi == pytest.approx(1.4412, abs=1e-4)
    assert engines.deviation(actual, FINE, steps=None) < 1e-4


@engine
@present
@pytest.mark.parametrize("case", ELASTIC, ids=str)
def test_mindlin_step_for_step(actual: engines.Results, case: engines.Case) -> None:
    """Step for step the record agrees for unlike materials and for unlike spheres."""
    assert engines.deviation(actual, case, steps=2000) < 5e-5


@engine
@present
@pytest.mark.parametrize("case", DAMPED, ids=str)
def test_damped_mindlin_step_for_step(actual: engines.Results, case: engines.Case) -> None:
    """YadeMindlin is YADE's Mindlin with e_n = e_s = e, and e is what it leaves."""
    name, law, _, _ = case
    assert engines.deviation(actual, case, steps=2000) < (
        5e-5 if name == "unequal spheres" else 1e-5
    )
    speed = actual[case][1].normal_speed
    assert speed == pytest.approx(law.restitution * engines.SPEED, rel=2e-4)


def test_damping_of_thornton() -> None:
    """beta is what YADE 2023.02a prints as betan for e_n = 0.9 and 0.5; none for 1."""
    assert thornton_damping(0.9) == pytest.approx(0.031306565990159, rel=1e-12)
    assert thornton_damping(0.5) == pytest.approx(0.233024857683442, rel=1e-12)
    assert thornton_damping(1.0) == 0.0


@engine
@present
def test_linear_springs(actual: engines.Results) -> None:
    """LinearSpring is YADE's CundallStrack with k_n and k_s given, here of equal spheres."""
    assert engines.deviation(actual, SPRINGS, steps=2000) < 5e-5


@engine
@present
def test_hertz_with_linear_shear(actual: engines.Results) -> None:
    """HertzWithLinearShear is the same law as Mindlin if nonLin is 1."""
    assert engines.deviation(actual, LINEAR_SHEAR, steps=1000) < 5e-5


@engine
@present
def test_known_defect_of_mindlin_deresiewitz(actual: engines.Results) -> None:
    """MindlinDeresiewitz of YADE sets no shear force: no impact changes psi."""
    impacts, outcomes = actual[DERESIEWITZ]
    assert psi_out(impacts, outcomes) == pytest.approx(impacts.psi_in, abs=1e-12)


@engine
@present
def test_one_run_alone(actual: engines.Results) -> None:
    engines.assert_same_alone(Yade(), actual, DAMPED[1], "2023.02a")


def test_what_it_has() -> None:
    """Only laws that YADE has are taken; others are refused by name."""
    assert Yade().supports(LinearSpring())
    assert Yade().supports(YadeMindlin(0.5))
    others = (
        LinearSpring(restitution=0.9),
        LammpsMindlin("mindlin"),
        LammpsMindlin("mindlin/force", stiffness=0.5),
        LammpsMindlin("mindlin/force", restitution=0.9),
    )
    assert not any(Yade().supports(law) for law in others)
    with pytest.raises(InputError, match="YADE does not have it"):
        run(Yade(), engines.experiment("wall", others[0], 100))


def test_absent_program() -> None:
    engines.assert_absent(Yade("/nowhere/yade"), "YADE", FORCE)


def test_script_is_python_that_has_every_impact() -> None:
    """The script compiles, and its impacts are those asked for, to the last digit."""
    impacts = engines.experiment("unequal spheres", FORCE, 100)
    text = Yade().files(impacts)[SCRIPT]
    compile(text, SCRIPT, "exec")
    _, _, table = text.partition("impacts = [\n")
    rows = [eval(line.strip().rstrip(",")) for line in table.partition("]")[0].splitlines()]
    assert rows == list(zip(impacts.tangential_speed, impacts.spin, strict=True))
    assert f"O.dt = {impacts.time_step!r} " in text
    assert "NewtonIntegrator(damping=0)" in text


def test_results_of_a_run_that_did_not_finish(tmp_path) -> None:
    """Bodies that still touch are no results."""
    impacts = engines.experiment("wall", FORCE, 100)
    (tmp_path / RESULT).write_text("0 0.004999 0.1 0.2 0.3\n" * 30)
    with pytest.raises(ValueError, match="still touch"):
        Yade().outcomes(tmp_path, impacts)
