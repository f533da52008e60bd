"""Tables over psi_1, chi and e against the solver; how series on patches are found."""

import pickle

import numpy as np
import pytest

import carom
from carom.dimensionless.numerics.chebyshev import evaluate
from carom.dimensionless.numerics.patches import Samples, fitted, sections
from carom.dimensionless.rebound_tables import place_of, psi_at
from carom.dimensionless.rebounds import regime_borders

SEED = 20261121


@pytest.fixture(scope="module")
def law():
    return carom.laws.ReboundLaw((0.95, 1.65))


def test_law_is_the_rebound_to_1e_7(law):
    """Random impacts, and the borders of the regimes to the last bit."""
    rng = np.random.default_rng(SEED)
    chi = rng.uniform(*law.chi, 6500)
    chi[:2] = law.chi
    places = [
        rng.uniform(0.0, 1.05, 3000) * 4.0 * chi[:3000],
        1.0 + 10.0 ** rng.uniform(-9, -1, 1000),
    ]
    borders = [np.ones(500), 2.0 * chi[4500:5000], 4.0 * chi[5000:5500] - 1.0]
    psi = np.concatenate([*places, rng.uniform(0.0, 1e-5, 500), *borders, np.zeros(500)])
    error = np.abs(law(psi, chi) - carom.rebound(psi, chi))
    assert error.max() < 1e-7
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
    again = pickle.loads(pickle.dumps(law))
    assert again(0.7, 1.3) == law(0.7, 1.3)
    assert law.nbytes < 200_000


def test_collisions_take_a_law_over_a_range(law):
    """They are those of the law at the chi of the pair, to 1e-7."""
    pair = carom.Pair(
        carom.Sphere(radius=5e-3, material="steel"), carom.HalfSpace(material="steel"), friction=0.2
    )
    motion = {"velocity1": [[1.0, 0.0, -2.0], [0.2, 0.0, -1.0]], "normal": [0.0, 0.0, -1.0]}
    exact = carom.collide(pair, **motion)
    for actual, wanted in zip(carom.collide(pair, law=law, **motion), exact, strict=True):
        np.testing.assert_allclose(actual, wanted, rtol=1e-6, atol=1e-9)
    refusals = (
        lambda: law(0.5),
        lambda: law.impulse(0.5),
        law.to_dict,
        lambda: carom.laws.ReboundLaw((1.5, 1.6)).rule(pair),
    )
    for refused in refusals:
        with pytest.raises(carom.InputError, match=r"chi[^\n]+$"):
            refused()


@pytest.mark.slow
def test_a_range_of_chi_with_losses():
    """To 1e-6 of `rebound`; what lies outside of the range is solved with the same losses."""
    losses = carom.KelvinVoigt(restitution=0.8)
    law, rng = carom.laws.ReboundLaw((1.3, 1.45), losses=losses), np.random.default_rng(SEED)
    chi, psi = rng.uniform(1.25, 1.5, 400), rng.uniform(-6.0, 6.0, 400)
    np.testing.assert_allclose(law(psi, chi), carom.rebound(psi, chi, losses=losses), atol=1e-6)
    assert law.restitution == 0.8


def test_a_table_is_a_law_like_others():
    """It can be ranked and scored beside contact laws, at its chi and elsewhere."""
    for law, chi in ((carom.laws.ReboundLaw(1.44), 1.44), (carom.laws.ReboundLaw((1.4, 1.5)), 1.6)):
        ranking = carom.verify.rank([carom.dem.HardSphere(0.4), law], chi=chi)
        assert ranking.standings[0].entry.law is law
        assert ranking.standings[0].max_error < 1e-8
        assert carom.verify.score(law, chi=chi).max_error < 1e-8
    damped = carom.verify.rank([carom.laws.ReboundLaw(1.44)], chi=1.44, restitution=0.8)
    assert damped.standings[0].restitution == 0.8
    assert damped.standings[0].max_error < 1e-7


@pytest.mark.parametrize("ends", [(0.4, 1.0), (1.5, 1.5), (1.5, 1.0), (0.0, 1.0), (1.0, "many")])
def test_bad_range_is_refused(ends):
    with pytest.raises(carom.InputError, match="chi"):
        carom.laws.ReboundLaw(ends)


def value(patches, *point):
    """The function at a point: the section there, on its panel."""
    edges, rows = sections(patches, *point[:-1])
    panel = np.searchsorted(edges[1:-1], point[-1], side="right")
    return evaluate(rows[panel], edges[panel], edges[panel + 1], point[-1])


def samples(values, branches=None):
    branches = np.zeros(values.size, dtype=np.int64) if branches is None else branches
    return Samples(values, np.ones(values.size), branches)


def test_panels_find_a_kink_and_a_root():
    """|x - 1/3| + sqrt(x): the branch tells the kink to rounding, grading resolves the root."""

    def bent(x):
        x = x.ravel()
        return samples(np.abs(x - 1.0 / 3.0) + np.sqrt(x), (x > 1.0 / 3.0).astype(np.int64))

    patches = fitted(bent, [(0.0, 1.0)], [10], tolerance=1e-10, singular=0.0)
    assert np.min(np.abs(sections(patches)[0] - 1.0 / 3.0)) < 1e-11
    x = np.random.default_rng(SEED).uniform(1e-6, 1.0, 3000)
    values = np.array([value(patches, each) for each in x])
    assert np.max(np.abs(values - bent(x).values)) < 1e-9


def test_panels_do_not_overlook_a_kink_that_no_branch_tells():
    """A kink between the outer nodes, where the last terms of the series happen to be small."""

    def bent(x):
        return samples(1e-3 * np.maximum(0.0, 0.01 - x.ravel()))

    assert len(fitted(bent, [(0.0, 1.0)], [10], tolerance=1e-9).series) > 4


def surface(y, x):
    return np.exp(x) * np.sin(9.0 * y) + np.sqrt(np.maximum(x - 1.0, 0.0))


def solid(x, y, z):
    return np.cos(x + y * z) + np.abs(y - 0.3)


@pytest.mark.parametrize(
    ("of", "box", "degrees", "kink"),
    [
        (surface, [(-1.0, 1.0), (0.0, 2.0)], (8, 8), (1, [1.0])),
        (solid, [(0.0, 2.0), (0.0, 1.0), (-1.0, 1.0)], (6, 5, 8), (1, [0.3])),
    ],
    ids=["singular at x = 1", "a kink in the middle variable"],
)
def test_patches_follow_a_function_of_some_variables(of, box, degrees, kink):
    def sampled(*point):
        return samples(of(*point).ravel())

    patches = fitted(sampled, box, degrees, 1e-8, cuts=[kink], singular=1.0)
    for point in np.random.default_rng(SEED).uniform(*np.transpose(box), (500, len(box))):
        assert value(patches, *point) == pytest.approx(of(*point), abs=1e-7)


@pytest.mark.parametrize("chi", [0.3, 0.5, 1.44, 4.0])
@pytest.mark.parametrize("e", [1.0, 0.9, 0.3])
def test_places_are_those_of_psi_1(chi, e):
    """0 and the borders of the regimes lie at 0, 1, 2, 3; the way back leads to the same psi_1."""
    place = np.array([0.0, 0.4, 1.0, 1.0 + 1e-9, 1.7, 2.0, 2.3, 3.0])
    psi = psi_at(place, *np.broadcast_arrays(chi, e, place)[:2])
    np.testing.assert_array_equal(psi[[0, 2, 5, 7]], [0.0, *regime_borders(chi, e)])
    if chi > 0.5:
        back = [place_of.py_func(each, chi, e) for each in psi]
        np.testing.assert_allclose(back, place, rtol=0, atol=1e-12)
    assert place_of.py_func(1.01 * psi[-1], chi, e) == 3.0
