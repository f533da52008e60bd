"""A viscoelastic contact on any path: impacts, elastic load paths, recovery, energy."""

import numpy as np
import pytest
from tests.oracles.contact import drive

from carom.dimensionless.load_paths import paths
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.solution import solve_lossy


def wandering(seed, n):
    """Return times, penetration and displacement of a path that unloads, parts and loads again."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0.0, 6.0, n)
    waves = [rng.uniform(0.1, 0.5) * np.sin(rng.uniform(0.5, 4.0) * t + p) for p in range(3)]
    depth = 0.3 + np.sum(waves, axis=0)
    depth -= depth[0]
    moved = np.sum([rng.normal() * np.sin(rng.uniform(1.0, 5.0) * t) for _ in range(3)], axis=0)
    return t, depth, 0.4 * moved


@pytest.mark.first_case
@pytest.mark.parametrize("impact", [(0.4, 1.44, 0.1), (1.5, 1.44, 0.2), (4.0, 2.0, 0.4)])
def test_driven_as_an_impact_moves_it_gives_its_forces(impact):
    """To first order in the steps, in the mean: the load sets in like the root of time."""
    psi, chi, alpha = impact
    h = solve_lossy(psi, chi, LossNumbers(Loss.VISCOUS, alpha)).history(4001)
    errors = []
    for stride in (4, 2, 1):
        path = h.time[::stride], h.penetration[::stride], h.displacement[::stride]
        load, force, radius = drive(*path, alpha, springs=1600)
        errors.append(
            np.mean(np.abs(load - h.normal_force[::stride][1:]))
            + np.mean(np.abs(force - h.force[::stride][1:]))
        )
        assert radius[:-2] == pytest.approx(h.contact_radius[::stride][1:-2], abs=0.03)
    assert errors[2] < 1e-3
    assert errors[0] / errors[2] > 2.5


@pytest.mark.parametrize("seed", range(6))
def test_elastic_paths_are_those_of_the_exact_memory(seed):
    """alpha = 0, loaded again and again, apart in between or not."""
    t, depth, moved = wandering(seed, 1501)
    load, force, _ = drive(t, depth, moved, 0.0, springs=1500)
    assert load == pytest.approx(np.maximum(depth, 0.0)[1:] ** 1.5, abs=2e-4)
    held = np.maximum(depth, 0.0)
    exact = paths.follow_path(held, moved, np.zeros(t.size, dtype=bool)).results
    assert force == pytest.approx(exact[1:, paths.TRACTION], abs=5e-3)
    assert np.mean(np.abs(force - exact[1:, paths.TRACTION])) < 5e-4


def test_a_surface_that_recovers_is_met_where_it_is():
    """Pressed to 1 and let go at once, w(0) = exp(-t/alpha): no load before d is as much."""
    alpha, t = 0.5, np.linspace(0.0, 2.0, 2001)
    depth = np.where(t < 0.1, 10.0 * t, np.where(t < 0.3, -1.0, t - 1.0))
    load, _, _ = drive(t, depth, 0.0 * t, alpha)
    left = np.exp(-(t - 0.1) / alpha)  # from just before it is let go
    met = t[1:][(t[1:] > 0.3) & (load > 0.0)][0]
    assert met == pytest.approx(t[(t > 0.3) & (depth > left)][0], abs=0.01)
    assert met > 1.1  # an elastic surface would be met at 1


@pytest.mark.parametrize("alpha", [0.0, 0.05, 0.5])
@pytest.mark.parametrize("seed", range(4))
def test_no_cycle_gains_energy(alpha, seed):
    """Work of both forces from apart, at rest, to apart and recovered: never negative."""
    t, depth, moved = wandering(seed, 2001)
    t, end = np.append(t, t[-1] + 40.0), [-1.0]
    depth, moved = np.append(depth, end), np.append(moved, moved[-1])
    load, force, _ = drive(t, depth, moved, alpha)
    assert np.sum(load * np.diff(depth)) > -2e-3 * np.sum(load * np.abs(np.diff(depth)))
    assert np.sum(force * np.diff(moved)) > 0.0
    if alpha > 0.0:
        assert np.sum(load * np.diff(depth)) > 0.0
