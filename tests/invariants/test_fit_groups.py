"""A column `group`: repeated trials of one setting, which share its error, against known truth."""

import numpy as np
import pandas as pd
import pytest
from scipy.stats import binom
from tests.checks import refused

import carom

DEGREES, TIMES = np.array([10.0, 20.0, 30.0, 40.0, 55.0, 70.0]), 10
FLOOR = carom.HalfSpace(material="steel")
PAIR = carom.Pair(carom.Sphere(radius="2.5 mm", material="steel"), FLOOR, friction=0.14)
TRUTH = {"friction": 0.14, "kappa": PAIR.kappa, "restitution": 0.95}
HALF = np.radians(0.5)
NAMES = ("normal_restitution", "tangential_restitution", "rebound_angle")


def repeated(seed, bad=False, times=TIMES):
    """Ten drops at each angle, which is off by half a degree; 3 % and 0.5 degrees of scatter."""
    random, losses = np.random.default_rng([52, seed]), carom.KelvinVoigt(restitution=0.95)
    angles = np.radians(DEGREES) + HALF * random.normal(size=DEGREES.size)
    hits = [carom.impact(PAIR, speed=3.9, angle=angle, losses=losses) for angle in angles]
    table = {"speed": np.full(DEGREES.size * times, 3.9)}
    table["angle"] = np.repeat(np.radians(DEGREES), times)
    table["angle_error"] = np.full(DEGREES.size * times, HALF)
    for name in NAMES:
        values = np.repeat([getattr(hit, name) for hit in hits], times)
        sigma = HALF if "angle" in name else 0.03 * np.abs(values)
        table[name] = values + sigma * random.normal(size=values.size)
    if bad:
        table["tangential_restitution"][random.integers(values.size)] *= 1.35
    table["group"] = np.repeat([f"{each:g} degrees" for each in DEGREES], times).tolist()
    return table


@pytest.mark.slow
def test_intervals_hold_where_trials_share_an_angle():
    """At most as many misses as chance has once in 100 for 8 %; studies/fit_repeats.csv has 5 %."""
    fits = [carom.fit(repeated(seed, bad=seed % 2 == 1), pair=PAIR) for seed in range(40)]
    for name, value in TRUTH.items():
        missed = sum(not fit[name].low <= value <= fit[name].high for fit in fits)
        assert missed <= binom.ppf(0.99, len(fits), 0.08), name


def test_least_squares_are_those_of_means_with_pooled_errors():
    """Made by pandas: errors from the scatter within groups over the root of their sizes."""
    table = repeated(1)
    groups = pd.DataFrame(table).groupby("group", sort=False)
    means = {name: groups[name].mean().to_numpy() for name in ("speed", "angle", *NAMES)}
    for name in NAMES:
        pooled = np.sqrt(groups[name].var().mean())
        means[f"{name}_error"] = np.full(DEGREES.size, pooled / np.sqrt(TIMES))
    means["angle_error"] = np.full(DEGREES.size, HALF)
    actual, wanted = (carom.fit(each, pair=PAIR, robust=False) for each in (table, means))
    for name in TRUTH:
        assert actual[name].value == pytest.approx(wanted[name].value, rel=1e-6)
        longer = (actual[name].high - actual[name].low) / (wanted[name].high - wanted[name].low)
        assert 1.0 < longer < 1.05  # Student's t with 54 degrees of freedom or more: 1.02


def test_a_bad_value_is_named_and_hardly_moves_the_mean():
    """35 % off in one of ten moves the plain mean by 3 to 4 of its errors, the robust one by 1."""
    table = repeated(2)
    plain = carom.fit(table, pair=PAIR)._best.model.problem
    table["tangential_restitution"] = table["tangential_restitution"].copy()
    table["tangential_restitution"][23] *= 1.35
    fits = [carom.fit(table, pair=PAIR, robust=robust) for robust in (True, False)]
    assert any("outliers within groups: row 24" in note for note in fits[0].notes)
    moved = [
        (fit._best.model.problem.measured - plain.measured)[2, 1] / plain.errors[2, 1]
        for fit in fits
    ]
    assert abs(moved[0]) < 1.0
    assert moved[1] > 3.0


def test_groups_may_be_numbers_and_rows_may_have_none():
    table = repeated(3)
    table["group"] = np.repeat(np.arange(6.0), TIMES).tolist()
    table["group"][5] = "-"
    problem = carom.fit(table, pair=PAIR)._best.model.problem
    assert problem.rows.rows.tolist() == ["0", "row 6", "1", "2", "3", "4", "5"]
    assert problem.trials == 60
    np.testing.assert_allclose(problem.before["angle"][[0, 1]], np.radians(10.0))
    larger = problem.errors[1] / problem.errors[0]
    np.testing.assert_allclose(larger, 3.0, rtol=1e-9)  # of one trial, and of nine


def test_what_is_assumed_is_said():
    table = repeated(4)
    assert any(
        "group: speed taken as exact, as there is no speed_error" in note
        for note in carom.fit(table, pair=PAIR).notes
    )
    del table["angle_error"]
    fit = carom.fit(table, pair=PAIR)
    assert any("between the groups, as there is no speed_error and" in note for note in fit.notes)
    assert fit._best.estimated.all()


def test_groups_of_one_row_change_nothing():
    table = repeated(5)
    table["group"] = np.arange(60).tolist()
    fits = [carom.fit(each, pair=PAIR) for each in (table, {**table, "group": ["-"] * 60})]
    assert all("nothing is repeated" in " ".join(fit.notes) for fit in fits)
    assert fits[0]._best.model.problem.count == 180


def test_what_is_no_group_is_refused():
    table = repeated(6)
    series = {**table, "group": ["a", "b"] * 30}
    words = r"2 faults: \(1\) group: in a angle goes from 10 to 70 deg .* rows of a group repeat"
    refused(words, carom.fit, series, pair=PAIR)
    drops = {"h0": ["1 m", "1 m"], "h1": ["0.8 m", "0.81 m"], "h2": ["0.64 m", "0.65 m"]}
    words = "group: bounces of a drop are no repeats of one setting"
    refused(words, carom.fit, {**drops, "group": ["a", "a"]}, pair=PAIR)
    refused("did you mean 'group'", carom.fit, {**table, "Gruppe": ["a"] * 60}, pair=PAIR)
