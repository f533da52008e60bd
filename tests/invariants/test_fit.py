"""`fit`: coverage of its intervals, and what must not matter to it."""

import numpy as np
import pytest
from scipy.stats import binom

import carom
from carom.lab.fitting import fit

MU, SPIN = 0.12, 20.0
BALL = carom.Sphere(radius="2.5 mm", material="steel")
FLOOR = carom.HalfSpace(material="steel")
PAIR = carom.Pair(BALL, FLOOR, friction=MU)
START = carom.Pair(BALL, FLOOR, friction=0.3)
DEGREES = np.array([3.0, 7.0, 11.0, 15.0, 19.0, 23.0, 27.0, 31.0, 40.0, 50.0, 60.0])
NAMES = (
    *("tangential_restitution", "spin_out", "rebound_angle", "contact_restitution"),
    *("tangential_speed_out", "rebound_speed"),
)
SIGMA = {"tangential_restitution": 0.01, "spin_out": 8.0, "rebound_angle": 0.005}
SETS = 24


def exact(spin=0.0, degrees=DEGREES):
    """Return what `impact` gives, without noise."""
    hits = [carom.impact(PAIR, speed=3.9, angle=f"{d} deg", spin=spin) for d in degrees]
    return {name: np.array([getattr(hit, name) for hit in hits]) for name in NAMES}


def noisy(truth, seed, sigma=SIGMA):
    random = np.random.default_rng(seed)
    return {n: truth[n] + random.normal(0.0, s, len(truth[n])) for n, s in sigma.items()}


def fitted(data, **options):
    before = {"angle [deg]": DEGREES, "speed": np.full(DEGREES.size, 3.9)}
    return fit({**before, **data}, pair=START, fixed={"restitution": 1.0}, **options)


@pytest.fixture(scope="module")
def plain():
    return exact()


@pytest.mark.slow
def test_intervals_hold_the_truth_as_often_as_they_say():
    """24 sets, errors from the scatter: misses within what is likely for 95 %, 1 in 2000.

    And the intervals are no wider than the scatter of the values calls for: 1.96 standard
    deviations of them to either side, to a third.
    """
    truth = {"friction": MU, "kappa": PAIR.kappa, "spin_offset": SPIN}
    seen = exact(spin=SPIN)
    results = [fitted(noisy(seen, seed), vary=list(truth)) for seed in range(SETS)]
    most = binom.ppf(1.0 - 5e-4, SETS, 0.05)
    for name, value in truth.items():
        inside = [result[name].low <= value <= result[name].high for result in results]
        assert SETS - sum(inside) <= most, name
        values = np.array([result[name].value for result in results])
        width = np.median([result[name].high - result[name].low for result in results])
        assert 0.7 < width / (2.0 * 1.96 * values.std()) < 1.45, name
        assert abs(values.mean() - value) < 4.0 * values.std() / np.sqrt(SETS), name


@pytest.mark.parametrize("name", NAMES)
def test_every_response_tells_the_same_parameters(plain, name):
    """Without noise any response gives back friction and stiffness, to the error of the curves."""
    result = fitted({name: plain[name]}, robust=False)
    assert result.friction.value == pytest.approx(MU, rel=2e-4)
    assert result.kappa.value == pytest.approx(PAIR.kappa, rel=5e-4)


def test_spin_before_that_is_known_is_no_offset():
    seen = exact(spin=SPIN)
    spins = {"spin [rpm]": np.full(DEGREES.size, SPIN * 30.0 / np.pi)}
    result = fitted({**noisy(seen, 1), **spins}, vary=["friction", "kappa", "spin_offset"])
    assert result.spin_offset.low < 0.0 < result.spin_offset.high
    without = fitted(noisy(seen, 1), vary=["friction", "kappa", "spin_offset"])
    assert without.spin_offset.value == pytest.approx(result.spin_offset.value + SPIN, abs=0.1)


def test_ways_of_saying_the_incidence_are_one(plain):
    """angle, components, contact_angle and psi_in give the same fit."""
    data = noisy(plain, 2, {"contact_restitution": 0.02})
    angle = np.radians(DEGREES)
    ways = (
        {"angle": angle},
        {"normal_speed": 2.0 * np.cos(angle), "tangential_speed": 2.0 * np.sin(angle)},
        {"contact_angle": angle},
        {"psi_in": START.kappa / START.friction * np.tan(angle)},
    )
    values = [fit({**w, **data}, pair=START, fixed={"restitution": 1.0}) for w in ways]
    for other in values[1:]:
        assert other.friction.low == pytest.approx(values[0].friction.low, rel=1e-5)
        assert other.kappa.high == pytest.approx(values[0].kappa.high, rel=1e-5)


def test_order_of_rows_and_units_do_not_matter(plain):
    data = noisy(plain, 3)
    first = fitted(data)
    order = np.random.default_rng(0).permutation(DEGREES.size)
    shuffled = {name: values[order] for name, values in data.items()}
    shuffled["spin_out [rpm]"] = shuffled.pop("spin_out") * 30.0 / np.pi
    before = {"angle [deg]": DEGREES[order], "speed [mm/s]": np.full(DEGREES.size, 3900.0)}
    second = fit({**before, **shuffled}, pair=START, fixed={"restitution": 1.0})
    for name in ("friction", "kappa"):
        assert second[name].value == pytest.approx(first[name].value, rel=1e-6)
        assert second[name].high == pytest.approx(first[name].high, rel=1e-4)


def test_rows_may_hold_different_responses(plain):
    """A gap counts as nothing: two tables below each other are one set of data."""
    data = noisy(plain, 4, {"tangential_restitution": 0.01, "contact_restitution": 0.03})
    both = fitted({**data, **{f"{n}_error": np.full(11, 0.02) for n in data}}, robust=False)
    gap = ["-"] * 11
    stacked = {"angle [deg]": np.tile(DEGREES, 2)}
    for place, name in enumerate(data):
        for column, values in ((name, data[name]), (f"{name}_error", np.full(11, 0.02))):
            own = list(values)
            stacked[column] = own + gap if place == 0 else gap + own
    apart = fit(stacked, pair=START, fixed={"restitution": 1.0}, robust=False)
    assert apart.friction.value == pytest.approx(both.friction.value, rel=1e-6)
    assert apart.kappa.low == pytest.approx(both.kappa.low, rel=1e-5)


def test_one_wild_row_moves_a_robust_fit_little(plain):
    data = noisy(plain, 5, {"contact_restitution": 0.02})
    clean = fitted(data)
    data["contact_restitution"][6] += 1.0
    robust, squares = fitted(data), fitted(data, robust=False)
    width = clean.friction.high - clean.friction.low
    assert abs(robust.friction.value - clean.friction.value) < width
    assert abs(squares.friction.value - clean.friction.value) > 2.0 * abs(
        robust.friction.value - clean.friction.value
    )
    assert any("outliers: row 7" in note for note in robust.notes)


def test_errors_that_are_too_small_are_found_out(plain):
    """Errors told as a fifth of the scatter: enlarged about fivefold, and said so."""
    data = noisy(plain, 6, {"contact_restitution": 0.05})
    entries = {"contact_restitution_error": np.full(11, 0.01)}
    result = fitted({**data, **entries})
    assert any("were enlarged" in note for note in result.notes)
    honest = fitted(data)
    assert result.friction.high - result.friction.low == pytest.approx(
        honest.friction.high - honest.friction.low, rel=0.2
    )


def test_more_confidence_is_a_wider_interval(plain):
    data = noisy(plain, 7, {"contact_restitution": 0.02})
    narrow, wide = fitted(data, confidence=0.68), fitted(data, confidence=0.99)
    assert wide.friction.low < narrow.friction.low < narrow.friction.high < wide.friction.high
