"""Unlike materials with hardly any friction: radial slip under load makes friction a dashpot.

The surfaces slip radially by what Hertz's pressure moves them, as a charge attracts (Gauss):
(K/mu)(4/(3 r)) [a^3 - (a^2 - r^2)^1.5], K = beta/pi; per depth, a^2 = d, at w = (K/mu)(2/r)
[a - sqrt(a^2 - r^2)]. With a tangential drift c per depth the traction is mu p along
(c - w cos, -w sin), whatever came before, once beta/mu is large. Hence F, far below mu P where w
exceeds c.
"""

import numpy as np
import pytest

from carom.halfspace.compliance import Materials
from carom.halfspace.quasistatic import Patch

RATIO = 1e5  # beta/friction
DEPTH, LAST = 0.9, 1e-3  # and the depth of the last step, in which few elements come to touch


def pull(drift):
    """Return F/(mu P) for a drift per depth, in units of 2 K/mu."""
    nodes, weights = np.polynomial.legendre.leggauss(80)
    s, angle = 0.5 * (nodes + 1.0), (np.arange(400) + 0.5) * np.pi / 400  # s^2 = 1 - r^2/a^2
    w = ((1.0 - s) / np.sqrt(1.0 - s**2))[:, None]
    x, y = drift - w * np.cos(angle), w * np.sin(angle)
    return float(np.sum(0.5 * weights * 3.0 * s**2 * (x / np.hypot(x, y)).mean(axis=1)))


@pytest.mark.first_case
@pytest.mark.parametrize(("beta", "drift"), [(1e-2, 0.1), (-1e-2, 0.3), (1e-2, 0.6), (-1e-2, 2.0)])
def test_force_under_radial_slip(beta, drift):
    friction = abs(beta) / RATIO
    patch = Patch.across(16, Materials(0.8, beta, friction))
    shift = drift * 2.0 * RATIO / np.pi
    state = patch.untouched()
    for depth in (*np.linspace(0.0, DEPTH, 8)[1:], DEPTH + LAST):
        moved, length = np.array([shift * depth, 0.0, 0.0]), depth - state.depth
        state = patch.advance(state, depth, moved, length).state
    value = state.traction.sum(axis=(1, 2)) / state.pressure.sum()
    assert value[0] == pytest.approx(pull(drift), rel=0.006)
    assert abs(value[1]) <= 1e-6


def test_little_drift_meets_a_dashpot():
    """F = mu P times the drift over a speed: a third of the drift gives about a third of F."""
    assert pull(0.01) / pull(0.03) == pytest.approx(1.0 / 3.0, rel=0.02)
    assert pull(100.0) == pytest.approx(1.0, abs=1e-4)
