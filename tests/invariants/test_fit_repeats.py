"""Repeated trials at a few angles: the scatter within groups, and between them."""

import numpy as np
import pandas as pd
import pytest
from scipy.stats import f_oneway

import carom

DEGREES, TIMES = (10.0, 20.0, 30.0, 45.0, 60.0), 8
PAIR = carom.Pair(
    carom.Sphere(radius="5 mm", material="steel"), carom.HalfSpace(material="steel"), friction=0.14
)
RATIOS = {"normal_restitution": 0.01, "tangential_restitution": 0.02}


@pytest.fixture(scope="module")
def exact():
    losses = carom.KelvinVoigt(restitution=0.93)
    hits = [carom.impact(PAIR, speed=2.0, angle=f"{a} deg", losses=losses) for a in DEGREES]
    return {name: np.repeat([getattr(hit, name) for hit in hits], TIMES) for name in RATIOS}


def repeated(exact, seed, between=0.0):
    """A table with noise of each row and, for one column, of each group."""
    random = np.random.default_rng([49, seed])
    table = {"angle": np.repeat(np.radians(DEGREES), TIMES)}
    for name, size in RATIOS.items():
        table[name] = exact[name] + size * random.normal(size=len(exact[name]))
    table["tangential_restitution"] += np.repeat(between * random.normal(size=len(DEGREES)), TIMES)
    order = random.permutation(len(table["angle"]))  # groups need not stand together
    return {name: values[order] for name, values in table.items()}


def about(table, name):
    notes = [each for each in carom.fit(table, pair=PAIR).notes if "repeated trials" in each]
    return next(each for each in notes if each.startswith(name))


@pytest.mark.parametrize("name", RATIOS)
def test_scatter_within_groups_is_that_of_pandas(exact, name):
    table = repeated(exact, 1)
    groups = pd.DataFrame(table).groupby("angle")[name]
    pooled = np.sqrt(((groups.count() - 1) * groups.var()).sum() / (groups.count() - 1).sum())
    note = about(table, name)
    assert f"in {len(DEGREES)} groups of repeated trials" in note
    assert f"with {len(DEGREES) * (TIMES - 1)} degrees of freedom" in note
    told = float(note.split("scatters by ")[1].split(",")[0])
    assert told == pytest.approx(pooled, rel=0.05)  # two digits


@pytest.mark.slow
def test_groups_that_scatter_among_each_other_are_told(exact):
    """Once in 1000 by chance; one-way analysis of what a fit leaves agrees."""
    assert "group to group" not in about(repeated(exact, 2), "tangential_restitution")
    table = repeated(exact, 3, between=0.05)
    assert "from group to group the fit is off" in about(table, "tangential_restitution")
    assert "from group to group" not in about(table, "normal_restitution")
    fit = carom.fit(table, pair=PAIR).to_dataset()
    left = (fit.measured - fit.expected).sel(response="tangential_restitution").values
    assert f_oneway(*(left[table["angle"] == a] for a in np.radians(DEGREES))).pvalue < 1e-3


def test_single_trials_are_no_groups(exact):
    table = {name: values[np.arange(len(DEGREES)) * TIMES] for name, values in exact.items()}
    notes = carom.fit({"angle": np.radians(DEGREES), **table}, pair=PAIR).notes
    assert not any("repeated" in note for note in notes)
