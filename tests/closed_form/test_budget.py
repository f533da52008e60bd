"""What the uncertainty of a fit comes from, against fits to data shifted value by value."""

import numpy as np
import pytest

import carom
from carom.lab.fitting.report_file import budget

BALL = carom.Sphere(radius="10 mm", material="bearing steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="bearing steel"), friction=0.12)
DEGREES = (6.0, 12.0, 20.0, 30.0, 45.0, 60.0)
ERRORS = {"speed": 0.006, "angle": np.radians(0.3), "normal_restitution": 0.01, "spin_out": 0.3}


@pytest.fixture(scope="module")
def table():
    law = carom.KelvinVoigt(restitution=0.95)
    hits = [carom.impact(PAIR, speed=0.6, angle=f"{a} deg", losses=law) for a in DEGREES]
    after = {
        name: np.array([getattr(hit, name) for hit in hits])
        for name in ("normal_restitution", "spin_out")
    }
    errors = {f"{name}_error": np.full(len(hits), size) for name, size in ERRORS.items()}
    return {"speed": np.full(6, 0.6), "angle": np.radians(DEGREES), **after, **errors}


def coordinates(data):
    found = carom.fit(data, pair=PAIR, robust=False)
    return np.array([*np.log([found.friction.value, found.kappa.value]), found.restitution.value])


@pytest.mark.slow
def test_shares_are_those_of_fits_to_shifted_values(table):
    """Half a standard deviation up and down in each value: the change is that of one, and adds."""
    squares = []
    for name, size in ERRORS.items():
        total = np.zeros(3)
        for row in range(len(DEGREES)):
            shift = 0.5 * size * (np.arange(len(DEGREES)) == row)
            ends = (coordinates({**table, name: table[name] + s * shift}) for s in (1.0, -1.0))
            total += np.square(np.subtract(*ends))
        squares.append(total)
    best = carom.fit(table, pair=PAIR, robust=False)._best
    costs = budget(best)
    assert tuple(costs) == tuple(ERRORS)
    assert best.model.free == ("friction", "kappa", "restitution")
    np.testing.assert_allclose([*costs.values()], squares / np.sum(squares, axis=0), atol=5e-4)
    np.testing.assert_allclose(
        np.sum(squares, axis=0), np.diag(best.information.covariance), rtol=2e-3
    )


def test_shares_of_a_robust_fit_add_up_and_leave_an_outlier_out(table):
    """A wild spin adds nothing: its influence hardly changes with its value."""
    spins = np.where(np.arange(6) == 3, -300.0, table["spin_out"])
    wild, clean = (
        np.array([*budget(carom.fit(data, pair=PAIR)._best).values()])
        for data in ({**table, "spin_out": spins}, table)
    )
    np.testing.assert_allclose(wild.sum(axis=0), 1.0, rtol=1e-12)
    assert np.all(wild > 0.0)
    assert wild[3, 2] == pytest.approx(clean[3, 2], abs=0.02)  # of restitution, not by spins
