"""Impacts on a grid against the exact ones at nu = 0, where slip is parallel to the motion.

The theory takes slip to be so: exact for nu = 0 and like materials, and shares no code with the
grid.
"""

import numpy as np
import pytest

import carom
from carom.halfspace.compliance import Materials
from carom.halfspace.motion import move
from carom.halfspace.quasistatic import Patch
from carom.halfspace.transforms import Mirrors

CASES = [(0.3, 1.4412), (0.97, 1.4412), (1.0, 1.4412), (1.03, 1.4412), (1.5, 1.4412)]
CASES += [(3.5, 1.4412), (0.3, 0.4), (1.0, 2.2), (4.0, 2.2)]
GRIDS = {16: 75, 32: 150, 64: 300}  # elements: steps


def psi_out(psi, chi, elements, steps):
    patch = Patch.across(elements, Materials(1.0), Mirrors(True, True))
    *_, last = move(patch, np.array([psi, 0.0]), chi, steps)
    return float(last.velocity[0])


@pytest.fixture(scope="module")
def errors():
    """psi_2 less the exact one: a row a case, a column a grid."""
    return np.array(
        [
            [psi_out(*case, *grid) - float(carom.rebound(*case)) for grid in GRIDS.items()]
            for case in CASES
        ]
    )


@pytest.mark.slow
def test_agrees_with_the_theory(errors):
    """Within 3e-4 on 32 elements and 150 steps, 1e-4 on 64 and 300: near psi_1 = 1, too."""
    assert np.abs(errors[:, 1]).max() <= 3e-4, errors
    assert np.abs(errors[:, 2]).max() <= 1e-4, errors


@pytest.mark.slow
def test_order(errors):
    """Grid and steps refined together: of second order, as a root mean square over the cases."""
    means = np.sqrt(np.mean(errors**2, axis=0))
    assert means[0] > 2.0 * means[1] > 4.0 * means[2], means
    assert np.log2(means[0] / means[2]) / 2.0 >= 1.7, means


@pytest.mark.slow
def test_order_in_time():
    """On one grid, against 240 steps: between 1 and 2, for few elements come to touch in a step."""
    several = []
    for psi in (0.8, 2.5):
        *actual, fine = (psi_out(psi, 1.4412, 16, steps) for steps in (30, 60, 120, 240))
        several.append(np.abs(np.array(actual) - fine))
    means = np.sqrt(np.mean(np.square(several), axis=0))
    assert means[0] > 2.0 * means[1] > 4.0 * means[2], means
    assert np.log2(means[0] / means[2]) / 2.0 >= 1.2
    assert means[2] <= 1.5e-3


def test_gross_slip_throughout():
    """psi_2 = psi_1 - 4 chi beyond psi_1 = 4 chi - 1: slip bears mu p from the first touch on."""
    for psi in (4.8, 5.5, 9.0):
        assert psi_out(psi, 1.4412, 16, 75) == pytest.approx(psi - 4.0 * 1.4412, abs=3e-4)
    assert psi_out(5.5, 1.4412, 32, 150) == pytest.approx(5.5 - 4.0 * 1.4412, abs=1e-6)
