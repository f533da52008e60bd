"""Unlike materials pressed together with friction, against solutions of Mossakovski and Spence.

Radial tractions; beta is all that materials enter with. The Abel transforms phi of the traction and
chi of the pressure couple: where nothing slips, phi(x) is beta/pi times the principal value of the
integral of chi/(t - x) over -1 < t < 1 (Spence 1968, Proc. R. Soc. A 305:55). E* = a = 1.
"""

from functools import partial
from math import log, pi, sqrt

import numpy as np
import pytest
from tests.oracles.punches import depth_of_sphere, stick_radius, stiffening

from carom.halfspace.compliance import Materials
from carom.halfspace.quasistatic import Patch
from carom.halfspace.transforms import Mirrors

HERTZ = 4.0 / 3.0
ROUGH = 100.0  # friction under which nothing slips


def indented(elements, steps, materials):
    """Return the patch and the last step of a paraboloid pressed to depth 1."""
    patch = Patch.across(elements, materials)
    state = patch.untouched()
    for radius in np.linspace(0.0, 1.0, steps + 1)[1:]:
        step = patch.advance(state, radius**2, np.zeros(3))
        state = step.state
    return patch, step


def force(patch, step):
    return patch.grid.element * float(step.state.pressure.sum())


def held(step):
    """Return which elements stick."""
    size = np.hypot(*step.state.traction)
    return step.touching & (size < step.state.pressure * (1.0 - 1e-5))


def test_formulas():
    """The closed forms themselves: a rigid punch on nu = 0, ln 3; limits without coupling."""
    assert stiffening(0.5) == pytest.approx(log(3.0), rel=1e-14)
    assert depth_of_sphere(1e-6) == pytest.approx(1.0, abs=1e-6)
    assert stick_radius(10.0) == pytest.approx(4.0 * np.exp(-10.0), rel=1e-3)
    assert 1.0 - stick_radius(0.3) == pytest.approx(2.0 * np.exp(-pi / 0.3), rel=1e-2)


@pytest.mark.parametrize(("beta", "kappa"), [(0.3, 0.8), (-0.3, 0.8), (0.3, 1.0), (0.5, 0.8)])
def test_punch_that_sticks(beta, kappa):
    """P is artanh(beta)/beta of that without friction, for any kappa; errors of first order."""
    errors = []
    for elements in (8, 16, 32):
        entries = []
        for materials in (Materials(kappa), Materials(kappa, beta, ROUGH)):
            patch = Patch.across(elements, materials)
            radii = np.hypot(patch.grid.line[:, None], patch.grid.line)
            patch.grid.apart = np.where(radii < 1.0, 0.0, 99.0)
            entries.append(force(patch, patch.advance(patch.untouched(), 1.0, np.zeros(3))))
        errors.append(entries[1] / entries[0] / stiffening(beta) - 1.0)
    assert np.all(np.abs(errors) <= 0.12 * (stiffening(beta) - 1.0) * np.array([1.0, 0.6, 0.35]))
    assert abs(2.0 * errors[2] - errors[1]) <= 0.01 * (stiffening(beta) - 1.0)


@pytest.mark.first_case
@pytest.mark.parametrize("beta", [0.3, -0.3])
def test_sphere_that_sticks(beta):
    """At a given depth P is (artanh(beta)/beta)/sqrt(d/a^2) of Hertz's: 1.0179 at 0.3."""
    exact = stiffening(beta) / sqrt(depth_of_sphere(beta))
    assert exact == pytest.approx(1.0179, abs=1e-4)
    patch, step = indented(16, 32, Materials(0.8, beta, ROUGH))
    plain, alone = indented(16, 1, Materials(0.8))
    assert force(patch, step) / force(plain, alone) == pytest.approx(exact, abs=8e-4)
    assert np.all(held(step) == step.touching)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [3.0, 1.0])
def test_stick_radius(ratio):
    """With beta and friction of 1 % or so the traction leaves the pressure as it is: Goodman 1962.

    c/a is 0.20 and 0.90; a mean over the loading, in which it is constant.
    """
    patch, entries = Patch.across(48, Materials(0.8, 0.01 * ratio, 0.01), Mirrors(y=True)), []
    state = patch.untouched()
    for radius in np.linspace(0.0, 1.0, 49)[1:]:
        step = patch.advance(state, radius**2, np.zeros(3))
        state = step.state
        if radius > 0.6:
            entries.append(patch.grid.element * np.count_nonzero(held(step)) / (pi * radius**2))
    assert np.sqrt(np.mean(entries)) == pytest.approx(stick_radius(ratio), abs=0.006)


def test_traction_is_radial():
    """Outwards for beta of either sign alike but for the sign, equal at equal radii, no force."""
    tractions = {}
    for beta in (0.2, -0.2):
        patch, step = indented(16, 8, Materials(0.8, beta, 0.3))
        tractions[beta] = step.state.traction
        x, y = patch.grid.line[:, None], patch.grid.line
        radii, traction = np.hypot(x, y), step.state.traction
        radial = (x * traction[0] + y * traction[1]) / radii
        around = (x * traction[1] - y * traction[0]) / radii
        assert np.abs(around).max() <= 0.08 * np.abs(radial).max()
        assert np.abs(traction.sum(axis=(1, 2))).max() <= 1e-9
        touches = step.touching & (radii > 0.3)
        assert np.all(-np.sign(beta) * radial[touches] > 0.0)
    assert np.abs(tractions[0.2] + tractions[-0.2]).max() <= 1e-6


def test_coupling_stiffens():
    """Between none and full friction the force grows with friction; the stick radius, too."""
    forces, shares = [], []
    for friction in (0.05, 0.15, 0.5):
        patch, step = indented(16, 12, Materials(0.8, 0.3, friction))
        forces.append(force(patch, step))
        shares.append(np.count_nonzero(held(step)))
    plain, alone = indented(16, 1, Materials(0.8))
    rises = np.diff([force(plain, alone), *forces])
    assert np.all(rises > 0.0)
    assert np.all(np.diff(shares) > 0)
    assert sum(rises) <= 0.02 * HERTZ


def test_self_similar():
    """Pressed twice as far the stick radius is the same share of the contact, P as d^1.5."""
    shares, scaled = [], []
    patch = Patch.across(24, Materials(0.8, 0.3, 0.2))
    state = patch.untouched()
    radii = partial(np.linspace, num=25)
    for radius in radii(0.0, 1.0)[1:]:
        step = patch.advance(state, radius**2, np.zeros(3))
        state = step.state
        if radius > 0.55:
            shares.append(np.sqrt(np.count_nonzero(held(step)) / np.count_nonzero(step.touching)))
            scaled.append(force(patch, step) / radius**3)
    assert np.ptp(shares) <= 0.08
    assert abs(np.mean(shares[:5]) - np.mean(shares[-5:])) <= 0.02
    assert np.ptp(scaled) <= 5e-3 * scaled[-1]
