"""The work of friction per area adds up to the work of friction, in every regime."""

import numpy as np
import pytest

import carom
from carom.impacts.wear import _quadrature

SEED = 1953


def cases(count, seed, largest):
    """Give psi_1 and chi: half of them below slip throughout, some tiny, some with many phases."""
    rng = np.random.default_rng(seed)
    for i in range(count):
        chi = 0.05 * (largest / 0.05) ** rng.uniform()
        psi = rng.uniform(-1.0, 1.0) * (4.0 * chi + 2.0)
        if i % 3 == 1:
            psi = rng.uniform(-1.2, 1.2)
        if i % 3 == 2:
            psi = np.copysign(10.0 ** rng.uniform(-9.0, 0.0), psi)
        yield float(psi), float(chi)


def summed(solution):
    """Return the integral over the contact, in units of the ledger."""
    radii, areas = _quadrature(solution)
    return float(solution.friction_work(radii)[:, 0] @ areas) * 3.75 * solution.chi / np.pi


def lost(solution):
    """Return what the tangential motion has lost, but for what viscosity has taken."""
    before, after = solution.psi_in, solution.psi_out
    return 0.5 * (before - after) * (before + after) - solution.shear_lost


@pytest.mark.slow
def test_elastic_impacts_to_1e_8():
    """psi_2 of tiny psi_1 is not known well enough to tell what they lose, the ledger does."""
    kinds = set()
    for psi, chi in cases(60, SEED, 40.0):
        solution = carom.solve(psi, chi)
        kinds.add(tuple(phase.kind for phase in solution.phases))
        ledger = solution.at(solution.duration).dissipated[0]
        assert summed(solution) == pytest.approx(ledger, rel=1e-8, abs=0.0), (psi, chi)
        if abs(psi) > 1e-4:
            assert summed(solution) == pytest.approx(lost(solution), rel=1e-8, abs=0.0), (psi, chi)
    assert len(kinds) > 8


@pytest.mark.first_case
@pytest.mark.parametrize(("psi", "chi"), [(2.0, 100.0), (0.03, 300.0), (5.0, 1000.0)])
def test_many_reversals_of_slip(psi, chi):
    solution = carom.solve(psi, chi)
    assert summed(solution) == pytest.approx(lost(solution), rel=1e-8, abs=0.0)


@pytest.mark.parametrize(("psi", "chi"), [(0.0, 1.44), (0.5, 0.5), (-0.3, 4.0)])
def test_no_work_where_nothing_slips(psi, chi):
    assert np.all(carom.solve(psi, chi).friction_work(np.linspace(0.0, 1.2, 25)) == 0.0)


def test_mirror_image_and_outside():
    radii = np.linspace(0.0, 1.5, 40)
    for psi, chi in cases(12, SEED + 1, 20.0):
        one, other = (carom.solve(sign * psi, chi).friction_work(radii) for sign in (1, -1))
        np.testing.assert_array_equal(one, other)
        assert np.all(one[:, 0] >= 0.0)
        assert np.all(one[radii >= 1.0] == 0.0)


def test_tiny_impacts_are_proportional():
    """The work goes with psi_1 squared."""
    radii = np.linspace(0.0, 0.99, 12)
    one, other = (carom.solve(psi, 1.44).friction_work(radii) / psi**2 for psi in (1e-9, 1e-6))
    np.testing.assert_allclose(one, other, rtol=1e-12)


@pytest.mark.slow
def test_viscoelastic_impacts():
    """To 1e-4 of the work, or 1e-6 of the energy of the contact point where little is lost."""
    rng = np.random.default_rng(SEED)
    for _ in range(6):
        chi, e = 0.1 * 50.0 ** rng.uniform(), rng.uniform(0.1, 0.99)
        psi = rng.uniform(-1.0, 1.0) * (2.0 * chi * (1.0 + e) + 1.0)
        solution = carom.solve(psi, chi, losses=carom.KelvinVoigt(restitution=e))
        actual, values = summed(solution), lost(solution)
        assert actual == pytest.approx(values, rel=1e-4, abs=1e-6 * psi**2), (psi, chi, e)


@pytest.mark.parametrize("psi", [1.5e4, -1e9])
def test_viscoelastic_impacts_that_slide(psi):
    """The pressure times the way, at every radius: that of the mean psi, but for elastic slip."""
    solution = carom.solve(psi, 1.44, losses=carom.KelvinVoigt(restitution=0.7))
    ledger = solution.at(solution.duration).dissipated[0]
    assert summed(solution) == pytest.approx(ledger, rel=1e-9)
    radii = np.linspace(0.0, 1.0, 12)
    actual = solution.friction_work(radii)[:, 0]
    assert actual == pytest.approx(abs(psi) * solution.pressed(radii), rel=20.0 / abs(psi))


def test_the_pressure_adds_up_to_the_momentum():
    """2 pi integral of p r dr dt = 2/3 pi integral of P dt = (8/15) pi (1 + e)."""
    for losses in (None, carom.KelvinVoigt(restitution=0.7), carom.KelvinVoigt(restitution=0.2)):
        solution = carom.solve(0.5, 1.44, losses=losses)
        radii, areas = _quadrature(solution)
        value = float(solution.pressed(radii) @ areas)
        exact = 8.0 / 15.0 * np.pi * (1.0 + solution.restitution)
        assert value == pytest.approx(exact, rel=1e-9, abs=0.0)
