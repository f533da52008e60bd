"""The table over psi_1 and chi against the solver; how series on panels and patches are found."""

import pickle

import numpy as np
import pytest

import carom
from carom.dimensionless.numerics.chebyshev import evaluate, fitted
from carom.dimensionless.numerics.chebyshev_2d import fitted_patches, value_at

SEED = 20261121


@pytest.fixture(scope="module")
def law():
    return carom.laws.MixtureLaw(0.95, 1.65)


def test_law_is_the_rebound_to_1e_7(law):
    """Random impacts, and the borders of the regimes to the last bit."""
    rng = np.random.default_rng(SEED)
    chi = rng.uniform(law.low, law.high, 6500)
    chi[:2] = law.low, law.high
    places = [
        rng.uniform(0.0, 1.05, 3000) * 4.0 * chi[:3000],
        1.0 + 10.0 ** rng.uniform(-9, -1, 1000),
    ]
    borders = [np.ones(500), 2.0 * chi[4500:5000], 4.0 * chi[5000:5500] - 1.0]
    psi = np.concatenate([*places, rng.uniform(0.0, 1e-5, 500), *borders, np.zeros(500)])
    assert np.abs(law(psi, chi) - carom.rebound(psi, chi)).max() < 1e-7
    assert np.array_equal(law(-psi, chi), -law(psi, chi))
    assert np.all(np.abs(law(psi, chi)) <= np.abs(psi)), "no impact gains energy"


def test_law_agrees_with_the_law_of_one_chi(law):
    psi = np.linspace(-8.0, 8.0, 1001)
    np.testing.assert_allclose(law(psi, 1.44), carom.laws.ReboundLaw(1.44)(psi), rtol=0, atol=1e-7)


def test_what_lies_outside_the_table_is_solved(law):
    """chi beyond the range costs time, not accuracy; what cannot be solved is NaN, and said so."""
    np.testing.assert_array_equal(law([0.5, 1.5], 3.0), carom.rebound([0.5, 1.5], 3.0))
    with pytest.warns(RuntimeWarning, match="chi must be positive"):
        assert np.isnan(law(0.5, -1.0))


def test_shapes_broadcast_and_the_law_can_be_stored(law):
    assert law(np.ones((4, 1)), np.full(3, 1.2)).shape == (4, 3)
    assert law(0.5, 1.2).shape == ()
    assert pickle.loads(pickle.dumps(law))(0.7, 1.3) == law(0.7, 1.3)
    assert law.nbytes < 200_000


@pytest.mark.parametrize("ends", [(0.4, 1.0), (1.5, 1.5), (1.5, 1.0), (0.0, 1.0), (1.0, "many")])
def test_bad_range_is_refused(ends):
    with pytest.raises(carom.InputError, match="chi"):
        carom.laws.MixtureLaw(*ends)


def test_panels_find_a_kink_and_a_root():
    """|x - 1/3| + sqrt(x): the branch tells the kink to rounding, grading resolves the root."""

    def bent(x):
        return np.abs(x - 1.0 / 3.0) + np.sqrt(x), (x > 1.0 / 3.0).astype(np.int64)

    panels = fitted(bent, [0.0, 1.0], degree=10, tolerance=1e-10, singular=[0.0])
    assert np.min(np.abs(panels.edges - 1.0 / 3.0)) < 1e-11
    x = np.random.default_rng(SEED).uniform(1e-6, 1.0, 3000)
    place = np.searchsorted(panels.edges, x, side="right") - 1
    ends = panels.edges[place], panels.edges[place + 1]
    found = [
        evaluate(panels.coefficients[i], a, b, each)
        for i, a, b, each in zip(place, *ends, x, strict=True)
    ]
    assert np.max(x * np.abs(found - bent(x)[0])) < 1e-9


def test_panels_do_not_overlook_a_kink_that_no_branch_tells():
    """A kink between the outer nodes, where the last terms of the series happen to be small."""

    def bent(x):
        return 1e-3 * np.maximum(0.0, 0.01 - x), np.zeros(x.size, dtype=np.int64)

    assert len(fitted(bent, [0.0, 1.0], degree=10, tolerance=1e-9).edges) > 5


def test_patches_follow_a_function_of_two_variables():
    """exp(x) sin(9 y) + sqrt(x - 1): smooth in y, singular at x = 1."""

    def surface(x, y):
        return np.exp(x) * np.sin(9.0 * y) + np.sqrt(np.maximum(x - 1.0, 0.0))

    patches = fitted_patches(surface, (0.0, 2.0, -1.0, 1.0), (1.0,), 1e-8, singular=1.0)
    rng = np.random.default_rng(SEED)
    for x, y in zip(rng.uniform(0.0, 2.0, 500), rng.uniform(-1.0, 1.0, 500), strict=True):
        assert value_at(patches, x, y) == pytest.approx(surface(x, y), abs=1e-7)
