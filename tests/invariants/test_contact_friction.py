"""Friction of contacts in C++, whatever the rates, sizes and steps: against the slide, of the right
size, without a gain of energy; where products and sums are fused, and where they are not.
"""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss

pytestmark = pytest.mark.skipif(shutil.which("c++") is None, reason="no C++ compiler here")
SOURCES = Path(__file__).parents[1] / "cpp"
RATES = (0.0, *(sign * 10.0**power for power in range(-30, 1) for sign in (1.0, -1.0)))
FUSED, SEPARATE = ("-O3", "-march=native", "-fno-math-errno"), ("-O2", "-ffp-contract=off")
KINDS = ("elastic single", "elastic double", "viscous single", "viscous double", "ledger single")
RETARDATION, STEP, DEPTH = 1e-3, 2e-5, 2.5e-3  # s, s, m


def built(folder, source, options):
    target = folder / f"{source.stem}{options[0]}"
    words = ["c++", "-std=c++17", *options, f"-I{carom.get_include()}", source, "-o", target]
    subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True)
    return target


def printed(program, *words, text=""):
    ran = subprocess.run([program, *words], input=text, capture_output=True, text=True, check=True)
    return [float(word) for word in ran.stdout.split()]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("friction")


@pytest.fixture(scope="module", params=[FUSED, SEPARATE], ids=["fused", "separate"])
def loads(folder, request):
    """Loads of contacts that move steadily, with E* = 5e5, R* = 0.1, kappa = 0.8."""
    program = built(folder, SOURCES / "loads.cpp", request.param)

    def run(kind, rows):
        if "elastic" in kind:  # its pair has no retardation
            rows = [(friction, 0.0, *motion) for friction, _, *motion in rows]
        text = "\n".join(" ".join(map(repr, row)) for row in rows)
        return np.array(printed(program, kind, text=text)).reshape(-1, 3).T

    return run


def steady(kind, rows):
    """Return the normal force, and the tangential ones of contacts that stick and that slide."""
    mu, retardation, d, rate, slide, step, count, _ = np.array(rows).T
    late = 0.0 if "elastic" in kind else retardation
    whole = d + late * rate
    edge = np.minimum(d, whole)
    radius = np.sqrt(0.1 * edge)
    normal = 2.0 * 5e5 * radius * (whole - edge / 3.0)
    return normal, 2.0 * 0.8 * 5e5 * radius * slide * (count * step + late), mu * normal


@pytest.mark.first_case
@pytest.mark.parametrize("kind", KINDS)
def test_friction_opposes_the_slide_at_any_rate_of_approach(loads, kind):
    """Pressed to DEPTH, at rates from none to those that change it: F = 2 G* a (U + tau U').

    Where the contact grows by 1 % in a step dashpots have the velocity at its end to 3e-6.
    """
    depths = DEPTH * (1.0 + 3e-3 * np.arange(8))
    for slide in (1e-4, 1e3):
        rows = [
            (0.3, RETARDATION, float(depth), rate, slide, STEP, count, 0)
            for count in (1, 3)
            for rate in RATES
            for depth in depths
        ]
        actual, along, across = loads(kind, rows)
        normal, sticking, sliding = steady(kind, rows)
        rtol = 1e-6 if "elastic" in kind else 3e-6
        np.testing.assert_allclose(actual, normal, rtol=rtol)
        if slide > 1.0:
            np.testing.assert_allclose(along, sliding, rtol=rtol)
        else:
            np.testing.assert_allclose(along, sticking, rtol=0.025)
        assert np.abs(across).max() < 1e-6 * along.min()


@pytest.mark.parametrize("kind", KINDS)
def test_no_friction_and_no_slide_is_too_large_or_too_small_to_be_squared(loads, kind):
    """Contacts that clearly stick, and those that clearly slide."""
    rows = [
        (friction, RETARDATION, DEPTH, 0.0, 10.0**power, STEP, 1, 0)
        for friction in (1e-300, 1e-100, 1e-30, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6)
        for power in range(-18, 30)
    ]
    _, along, across = loads(kind, rows)
    _, sticking, sliding = steady(kind, rows)
    sticks, slides = sticking < 0.01 * sliding, sticking > 100.0 * sliding
    assert min(np.count_nonzero(sticks), np.count_nonzero(slides)) > 80
    np.testing.assert_allclose(along[sticks], sticking[sticks], rtol=0.025)
    np.testing.assert_allclose(along[slides], sliding[slides], rtol=1e-6)
    assert np.all(np.abs(across) <= 1e-6 * along)


@pytest.mark.parametrize("kind", KINDS)
def test_a_first_touch_has_coulombs_friction_however_shallow(loads, kind):
    """By a small part of the first cell of springs, which bears nothing that is not rounding."""
    rows = [(0.3, RETARDATION, 10.0**power, 1.0, 1e3, STEP, 1, 0) for power in range(-27, -5)]
    normal, along, across = loads(kind, rows)
    assert np.all(normal > 0.0)
    np.testing.assert_allclose(along, 0.3 * normal, rtol=1e-6)
    assert np.all(np.abs(across) <= 1e-6 * along)


@pytest.mark.first_case
@pytest.mark.parametrize("kind", KINDS[2:])
def test_short_steps_move_springs_in_single_precision(loads, kind):
    """After a time t of sliding, springs are at 1 - exp(-t/tau) of the limit, and stay there.

    Within some steps at rest dashpots, whose velocity lags, take no part any longer.
    """
    for part in (1e-2, 1e-4, 1e-6):
        steps = round(0.7 / part)
        ((_, along, _),) = loads(
            kind, [(0.3, RETARDATION, DEPTH, 0.0, 1e3, part * RETARDATION, steps, 6)]
        ).T
        limit = 0.3 * 4.0 / 3.0 * 5e5 * np.sqrt(0.1) * DEPTH**1.5
        assert along == pytest.approx(-limit * np.expm1(-0.7), rel=5e-4)


def test_the_header_finds_the_loss_of_any_restitution(folder):
    """Up to one, nearer than an impact in steps can tell: alpha as Carom's own solver has it."""
    (folder / "loss.cpp").write_text(
        "#include <carom/impacts.hpp>\n#include <cstdio>\nint main() { double e;\n"
        'while (std::scanf("%lf", &e) == 1) std::printf("%.12g ", carom::loss_of(e)); }\n'
    )
    program = built(folder, folder / "loss.cpp", ("-O1",))
    values = [0.5, *(1.0 - 10.0**power for power in (-4, -6, -10))]
    actual = printed(program, text=" ".join(map(repr, values)))
    np.testing.assert_allclose(actual, [viscous_loss(e) for e in values], rtol=1e-4)


@pytest.mark.slow
def test_no_ball_on_a_level_floor_gains_energy(folder):
    """Thrown, sliding, rolling, spinning, at rest: 3,000 histories. Without losses velocity Verlet
    is off by the square of its step; with them nothing is gained but by rounding."""
    program = built(folder, SOURCES / "histories.cpp", FUSED)
    viscous, double, ledger, elastic = printed(program, "1", "3000", "200")
    assert max(viscous, double, ledger) < 1e-8
    assert elastic < 1e-3
