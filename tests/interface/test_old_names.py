"""Names of version 0.2: each works, says once what it is called now, and is shown to nobody."""

import subprocess
import sys
from importlib import import_module
from pkgutil import resolve_name

import pytest

import carom
from carom.old_names import NEW_NAMES, NEW_PLACES

SPRING = carom.dem.LinearSpring()
PUBLIC = """
BoundaryElements CollisionStatus Collisions Cup EdemHertzMindlin ElasticPlastic Fit FunctionLaw
FunctionRebound Grid HalfSpace HalfspaceImpact HardSphere HertzLinearHistory Impact InputError
JudgedCollisions Judgement KelvinVoigt LammpsMindlin LatinHypercube LiggghtsHertz LinearSpring
LoadPath Material MemoryLaw MixtureLaw Pair PointStatus ReboundLaw RoughLaw SmoothLaw Solution
Sphere StandardLinearSolid Status StrongeLaw Table ThorntonLaw WaltonBraunLaw WaltonFit WaltonLaw
YadeMindlin classical collide convert curve datasets fit fit_walton get_include get_library impact
load_path material material_sources materials plots read rebound regime_map save solve strength
sweep verify wear verify.Bench verify.CATALOGUE verify.EngineError verify.Entry verify.Experiment
verify.Lammps verify.Liggghts verify.Ranking verify.Score verify.Tuning verify.Yade
verify.advised_steps verify.bench verify.damping verify.error_map verify.force_error
verify.poisson_from_kappa verify.rank verify.recipes verify.restitution verify.run verify.score
verify.step_error verify.stiffnesses verify.tune verify.write_pack
"""


@pytest.mark.first_case
@pytest.mark.parametrize("name", PUBLIC.split())
def test_every_public_name_of_0_2_is_there(name):
    home, _, last = f"carom.{name}".rpartition(".")
    old = f"carom.{name}" in NEW_PLACES
    module = import_module(home)
    vars(module).pop(last, None) if old else None
    if old:
        with pytest.warns(DeprecationWarning, match=rf"^{home}\.{last} is now carom\."):
            assert getattr(module, last) is not None
    assert getattr(module, last) is not None  # without a second warning
    assert (last in dir(module)) is not old


@pytest.mark.parametrize(("old", "new"), NEW_NAMES.items())
@pytest.mark.filterwarnings("ignore:carom")
def test_an_old_name_is_the_new_thing(old, new):
    assert resolve_name(old) is resolve_name(new)


@pytest.mark.filterwarnings("ignore:carom")
def test_what_is_called_otherwise_is_the_same():
    assert carom.verify.catalogue() == carom.verify.CATALOGUE
    assert carom.material_sources("steel") == carom.material("steel").sources
    assert carom.material_sources("rigid") == {}
    law = carom.MixtureLaw(1.2, 1.3)
    assert law.chi == (1.2, 1.3)
    assert law(0.7, 1.25) == carom.laws.ReboundLaw((1.2, 1.3))(0.7, 1.25)


def test_the_warning_is_where_the_name_stands():
    script = "import carom\nfrom carom import MemoryLaw\nMemoryLaw(8)\ncarom.MemoryLaw(8)\n"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    lines = [line for line in done.stderr.splitlines() if "DeprecationWarning" in line]
    assert done.returncode == 0
    (line,) = lines
    assert line.startswith("<string>:2:")
    assert "carom.MemoryLaw is now carom.dem.ExactContactLaw" in line


def test_a_name_that_never_was_is_no_attribute():
    with pytest.raises(AttributeError):
        carom.MemoryLaws  # noqa: B018


def test_the_old_name_of_psi_1_works():
    calls = (
        lambda **psi: carom.rebound(chi=1.44, **psi),
        lambda **psi: carom.solve(chi=1.44, **psi).psi_out,
        lambda **psi: carom.dem.LinearSpring().rebound(chi=1.44, **psi),
        lambda **psi: carom.curve(1.44, **psi).psi_out.item(),
        carom.laws.ReboundLaw(1.44),
        carom.laws.ReboundLaw(1.44).impulse,
        carom.laws.ReboundLaw(1.44).dissipation,
        lambda **psi: carom.verify.force_error(SPRING, chi=1.44, **psi),
        lambda **psi: carom.verify.error_map(SPRING, chi=1.44, **psi).error.item(),
        lambda **psi: carom.verify.step_error(SPRING, 100, **psi),
        lambda **psi: carom.verify.advised_steps(SPRING, 0.01, **psi),
        lambda **psi: carom.verify.rank(SPRING, **psi).standings[0].max_error,
        lambda **psi: carom.verify.tune(SPRING, chi=1.44, **psi).advice[0].value,
    )
    for call in calls:
        with pytest.warns(DeprecationWarning, match=r"^psi=, a keyword of \w+, is now psi_1=; "):
            assert call(psi=0.5) == call(psi_1=0.5)
    with pytest.raises(carom.InputError, match=r"^psi_in: no keyword of solve; "):
        carom.solve(psi_in=0.5, chi=1.44)
    both = pytest.raises(
        carom.InputError, match=r"^psi: the old name of psi_1, which is given as well"
    )
    with pytest.warns(DeprecationWarning, match="psi_1"), both:
        carom.rebound(psi=3.0, psi_1=1.0, chi=1.44)


def test_old_fields_work(hit):
    ranking = carom.verify.rank(SPRING, psi_1=[0.5, 1.0])
    with pytest.warns(DeprecationWarning, match=r"^Ranking\.psi is now psi_in; "):
        assert ranking.psi == ranking.psi_in == (0.5, 1.0)
    assert "psi" not in dir(ranking)
    finding = hit.validity.findings[0]
    with pytest.warns(DeprecationWarning, match=r"^Finding\.told is now label; "):
        assert finding.told == finding.label
    with pytest.raises(AttributeError, match="Ranking has no attribute 'psi_3'"):
        ranking.psi_3  # noqa: B018


def test_the_old_names_of_the_instant_work(pair, hit):
    path = carom.load_path(pair, normal_force=10.0, tangential_force=[0.0, 1.0])
    for result, old, at in ((hit, "time", 0.5 * hit.duration), (path, "step", 0)):
        for name in ("contact", "fields", "stress", "radial"):
            with pytest.warns(
                DeprecationWarning, match=rf"^{old}=, a keyword of {name}, is now at="
            ):
                answer = getattr(result, name)(**{old: at})
            assert type(answer) is type(getattr(result, name)(at))
    solution = carom.solve(0.5, 1.44)
    for name in ("memory", "phase_at", "slip_rate", "traction", "slid"):
        where = {"radii": [0.5]} if name in ("traction", "slid") else {}
        with pytest.warns(DeprecationWarning, match=rf"^time=, a keyword of {name}, is now at="):
            getattr(solution, name)(time=1.0, **where)
