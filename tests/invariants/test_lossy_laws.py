"""Tables and curves of impacts with losses are what the solver says, and never make energy."""

import ctypes
import json
import shutil
import subprocess

import numpy as np
import pytest

import carom
from carom.cli import main
from carom.many.laws.header import c_header

BALL = carom.Sphere(radius="4 mm", material="soda-lime-glass", inner_radius="2.5 mm")
OTHER = carom.Sphere(radius="7 mm", material="steel")
PAIR = carom.Pair(BALL, OTHER, friction=0.2)
LOSSES = carom.KelvinVoigt(restitution=0.8)
ACCURACY = 3e-8


@pytest.fixture(scope="module")
def law():
    return carom.laws.ReboundLaw(PAIR.chi, losses=LOSSES)


def relative_error(law, psi):
    exact = carom.rebound(psi, law.chi, losses=carom.KelvinVoigt(restitution=law.restitution))
    return np.max(np.abs(law(psi) - exact) / np.maximum(1.0, np.abs(psi)))


@pytest.mark.first_case
@pytest.mark.parametrize(("chi", "e"), [(0.3, 0.9), (1.44, 0.5), (1.44, 0.999), (2.2, 0.05)])
def test_equals_the_solver(chi, e):
    """Within 3e-8 max(1, |psi|) of `rebound`, of either sign, at edges, in the tail, near zero."""
    law = carom.laws.ReboundLaw(chi, losses=carom.KelvinVoigt(restitution=e))
    rng = np.random.default_rng(4)
    spread = rng.uniform(0.0, 4.0 * chi * (1.0 + e), 250)
    psi = np.concatenate([spread, 10.0 ** rng.uniform(-7.0, 9.0, 100), law.edges])
    assert relative_error(law, np.concatenate([psi, -psi])) <= ACCURACY


def collisions(count):
    rng = np.random.default_rng(8)
    names = ("velocity1", "velocity2", "spin1", "spin2", "normal")
    scales = (1.0, 1.0, 200.0, 100.0, 1.0)
    motion = {
        name: scale * rng.normal(size=(count, 3)) for name, scale in zip(names, scales, strict=True)
    }
    motion["normal"] /= np.linalg.norm(motion["normal"], axis=1, keepdims=True)
    return motion


def test_collisions_are_impacts(law):
    """Random collisions in space are `impact`s in their planes: V_n' = -e V_n, V_t' to 3e-8."""
    motion = collisions(60)
    after = carom.collide(PAIR, law=law, **motion)

    def contact(velocity1, spin1, velocity2, spin2):
        turning = BALL.radius * spin1 + OTHER.radius * spin2
        return velocity1 - velocity2 + np.cross(turning, motion["normal"])

    before = contact(*(motion[n] for n in ("velocity1", "spin1", "velocity2", "spin2")))
    later = contact(*after[:4])
    checked = 0
    for old, new, n, status in zip(before, later, motion["normal"], after.status, strict=True):
        if status != carom.status.CollisionStatus.COLLIDED:
            continue
        along = old - (old @ n) * n
        hit = carom.impact(
            PAIR, normal_speed=old @ n, tangential_speed=np.linalg.norm(along), losses=LOSSES
        )
        want = hit.contact_velocity_out * along / np.linalg.norm(along) - 0.8 * (old @ n) * n
        size = PAIR.friction / PAIR.kappa * (old @ n) * max(1.0, hit.psi_in)
        np.testing.assert_allclose(new, want, rtol=0.0, atol=ACCURACY * size + 1e-12)
        checked += 1
    assert checked > 20


def test_restitution_one_is_the_elastic_law():
    """To the bit."""
    psi = np.linspace(-9.0, 9.0, 999)
    lossless = carom.laws.ReboundLaw(1.44, losses=carom.KelvinVoigt(restitution=1.0))
    assert np.array_equal(lossless(psi), carom.laws.ReboundLaw(1.44)(psi))


@pytest.mark.parametrize(
    "normal",
    [
        *(carom.KelvinVoigt(loss_time="2 us"), carom.KelvinVoigt(restitution=np.array([0.9, 0.8]))),
        *(carom.ElasticPlastic(yield_velocity="0.1 m/s"), 0.9, "viscous"),
    ],
)
def test_refuses_losses_that_have_no_table(normal):
    """One line that names losses."""
    with pytest.raises(carom.InputError, match=r"^losses: [^\n]+$"):
        carom.laws.ReboundLaw(1.44, losses=normal)


def test_c_header_is_the_law(law, tmp_path):
    """Compiled, to 1e-14 max(1, |psi|); the text says e."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("needs a C compiler, cc, on the path")
    text = c_header([law, carom.laws.ReboundLaw(1.44)])
    assert "e = 0.8;" in text
    assert max(map(len, text.splitlines())) <= 100
    name = text.partition("double carom_rebound_")[2].partition("(")[0]
    assert name.endswith("_e_0_8")
    assert "double carom_rebound_1_44(double psi)" in text
    source, library = tmp_path / "law.c", tmp_path / "law.so"
    source.write_text(
        f"{text}\ndouble f(double x);\ndouble f(double x) "
        f"{{ (void)carom_rebound_1_44; return carom_rebound_{name}(x); }}\n"
    )
    strict = ["-Wall", "-Wextra", "-pedantic", "-Werror", "-std=c99", "-O1"]
    command = [compiler, *strict, "-shared", "-fPIC", str(source), "-o", str(library)]
    subprocess.run(command, check=True)
    function = ctypes.CDLL(str(library)).f
    function.argtypes, function.restype = [ctypes.c_double], ctypes.c_double
    psi = np.concatenate([np.linspace(-12.0, 12.0, 2001), law.edges, [1e300, -1e15]])
    got = np.array([function(each) for each in psi])
    assert np.max(np.abs(got - law(psi)) / np.maximum(1.0, np.abs(psi))) <= 1e-14


def test_curve_of_impacts_with_losses(capsys, tmp_path, monkeypatch):
    """The command prints what `rebound` gives, and the borders of regimes at this e; plots."""
    monkeypatch.chdir(tmp_path)
    arguments = ["--chi", "1.44", "--chi", "2", "--restitution", "0.9", "--points", "7", "--json"]
    assert main(["curve", *arguments, "--plot", "curve.png"]) == 0
    rows = json.loads(capsys.readouterr().out)
    for row in rows:
        assert [*row["borders"].values()] == pytest.approx(
            [1.0, 2.0 * row["chi"], 2.0 * row["chi"] * 1.9 - 0.9]
        )
        want = carom.rebound(row["psi_in"], row["chi"], losses=carom.KelvinVoigt(restitution=0.9))
        np.testing.assert_allclose(row["psi_out"], want, rtol=0.0, atol=1e-12)
    assert (tmp_path / "curve.png").stat().st_size > 1000
    from carom.plots import plot_curve

    axis = plot_curve(carom.curve(1.44, np.linspace(0.0, 6.0, 9), losses=LOSSES)).axes[0]
    entries = [text.get_text() for text in axis.get_legend().get_texts()]
    assert entries[0] == r"$\chi$ = 1.44"
    assert len(entries) == 5  # and the regimes, as without losses
    assert main(["curve", "--chi", "1.44", "--restitution", "1.5"]) == 2
    assert capsys.readouterr().err.startswith("carom: restitution: '1.5' cannot be used")
