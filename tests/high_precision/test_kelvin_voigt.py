"""The marching method's normal impact of Kelvin & Voigt springs against power series, 40 digits."""

from pathlib import Path

import mpmath as mp
import pytest
from scipy.special import beta
from tests.oracles.kelvin_voigt import impact
from tests.oracles.march import motion

from carom.dimensionless.numerics import hertz

LINES = (Path(__file__).parent / "kelvin_voigt.csv").read_text().splitlines()
TABLE = [line.split(",") for line in LINES[1:]]  # alpha, restitution, duration, largest b^2, time


@pytest.mark.parametrize("row", TABLE, ids=lambda row: row[0])
def test_rows_of_the_marching_method(row):
    """Equal steps of the clock, any number of them, end where the table does, to 1e-11."""
    alpha, *truth = map(float, row)
    for steps in (100, 1000):
        _, time, edge, limit, _, speed = motion(alpha, steps)
        peak = steps // 2
        values = -speed[-1], time[-1], edge[peak] ** 2, time[peak]
        assert values == pytest.approx(truth, rel=1e-11)
        assert edge[peak] == max(edge)
        assert edge[-1] == limit[-1] == 0.0


@pytest.mark.parametrize("row", TABLE[2::6], ids=lambda row: row[0])
def test_table_does_not_depend_on_the_strides_of_the_series(row):
    with mp.workdps(40):
        for value, text in zip(impact(mp.mpf(row[0]), mp.mpf("0.1")), row[1:], strict=True):
            assert abs(value / mp.mpf(text) - 1) < mp.mpf("1e-28")


def test_small_losses():
    """1 - e = (3/2) B(3/5, 3/2) alpha, the duration and depth are Hertz's, to the next order."""
    alpha, restitution, duration, depth, half = (mp.mpf(text) for text in TABLE[0])
    assert abs((1 - restitution) / alpha - 1.5 * beta(0.6, 1.5)) < 5 * alpha
    assert abs(duration - hertz.DURATION) < 2 * alpha
    assert abs(depth - 1) < 2 * alpha
    assert abs(half - hertz.HALF) < 2 * alpha
