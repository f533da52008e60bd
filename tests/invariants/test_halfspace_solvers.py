"""The solvers of both contact problems against other algorithms on dense matrices."""

import numpy as np
import pytest
from scipy.optimize import nnls
from tests.oracles.influence import least_energy

from carom.halfspace.compliance import Compliance, Materials
from carom.halfspace.traction import solve_pressure, solve_traction

SIZE = 8
TIGHT = 1e-9


def matrix(operator, parts):
    """Return the operator as a matrix."""
    units = np.eye(parts * SIZE**2).reshape(-1, parts, SIZE, SIZE)
    return np.array([operator(load if parts > 1 else load[0]).ravel() for load in units]).T


def bumps(seed, *shape):
    """Return a smooth random field and some noise."""
    random = np.random.default_rng(seed)
    waves = np.cos(np.outer(random.normal(size=6), np.arange(SIZE)) + random.uniform(0, 6, (6, 1)))
    fields = np.einsum("...k,ki,kj->...ij", random.normal(size=(*shape, 6)), waves, waves)
    return fields + 0.1 * random.normal(size=(*shape, SIZE, SIZE))


@pytest.mark.parametrize("seed", range(5))
def test_pressure_of_rough_bodies(seed):
    """min p.N p/2 - overlap.p over p >= 0 by the active sets of Lawson & Hanson (1974)."""
    compliance = Compliance(SIZE, 0.3, Materials(1.0))
    overlap = bumps(seed)
    overlap -= np.median(overlap)
    root = np.linalg.cholesky(matrix(compliance.normal, 1))
    exact, _ = nnls(root.T, np.linalg.solve(root, overlap.ravel()))
    start = np.zeros((SIZE, SIZE))
    load = solve_pressure(compliance, overlap, start, TIGHT).load
    assert 5 <= np.count_nonzero(exact) <= 60
    assert np.abs(load.ravel() - exact).max() <= 1e-7 * exact.max()
    assert np.array_equal(load.ravel() > 0.0, exact > 0.0)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("kappa", [1.0, 0.7])
def test_traction_of_any_history(seed, kappa):
    compliance = Compliance(SIZE, 0.3, Materials(kappa))
    values, bound = 0.5 * bumps(seed, 2), np.maximum(bumps(seed + 100), 0.0)
    exact = least_energy(matrix(compliance.tangential, 2), values, bound)
    load = solve_traction(compliance, values, bound, np.zeros_like(values), TIGHT).load
    assert np.abs(load - exact).max() <= 1e-7 * bound.max()
    slips = np.hypot(*exact) >= bound * (1.0 - 1e-9)
    assert 3 <= np.count_nonzero(slips & (bound > 0.0)) <= np.count_nonzero(bound) - 3


@pytest.mark.parametrize("seed", range(3))
def test_coulombs_law_at_every_element(seed):
    """|q| <= p; where it is less nothing moves, elsewhere slip is along q and never against it."""
    compliance = Compliance(SIZE, 0.3, Materials(0.75))
    values, bound = 0.5 * bumps(seed, 2), np.maximum(bumps(seed + 100), 0.0)
    traction, dragged = solve_traction(compliance, values, bound, np.zeros_like(values), TIGHT)
    size, slip = np.hypot(*traction), values - dragged
    noise = 10.0 * TIGHT * bound.max() * compliance.tangential_diagonal
    assert np.all(size <= bound * (1.0 + 1e-12))
    touches, slips = bound > 0.0, np.hypot(*slip) > noise
    assert np.all(size[touches & slips] >= bound[touches & slips] * (1.0 - 1e-8))
    along, across = np.sum(traction * slip, 0), traction[0] * slip[1] - traction[1] * slip[0]
    assert np.all(along[touches & slips] > 0.0)
    assert np.all(np.abs(across[touches]) <= noise * size[touches])
    assert np.count_nonzero(touches & slips) >= 3
    assert np.count_nonzero(touches & ~slips) >= 3


def test_start_does_not_matter():
    """The energy has one minimum: from any start the same traction."""
    compliance = Compliance(SIZE, 0.3, Materials(0.75))
    source, bound = bumps(1, 2), np.maximum(bumps(51), 0.0)
    values = [
        solve_traction(compliance, source, bound, start, TIGHT).load
        for start in (np.zeros_like(source), bumps(8, 2), -source)
    ]
    assert np.abs(values[1] - values[0]).max() <= 1e-7 * bound.max()
    assert np.abs(values[2] - values[0]).max() <= 1e-7 * bound.max()


def test_nothing_touches():
    compliance = Compliance(SIZE, 0.3, Materials(1.0))
    everywhere = np.ones((SIZE, SIZE))
    assert not solve_pressure(compliance, -everywhere, everywhere).load.any()
