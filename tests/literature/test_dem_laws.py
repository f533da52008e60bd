"""How far the laws of the codes lie from the exact theory, as measured with the codes themselves.

Largest |psi_2 - exact| over 15 incidences at chi = 1.4412 (solid steel spheres).
"""

import numpy as np
import pytest

import carom

CHI = 1.4412
PSI = np.array([0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0])
MEASURED = [
    (carom.dem.LinearSpring(), 0.1756),
    (carom.dem.LinearSpring(2 / 7), 1.3851),
    (carom.dem.LammpsMindlin("mindlin"), 0.5763),
    (carom.dem.LammpsMindlin("mindlin/force"), 0.4677),
    (carom.dem.LammpsMindlin("mindlin_rescale"), 0.4272),
    (carom.dem.LammpsMindlin("mindlin_rescale/force"), 0.42995),
]


@pytest.mark.parametrize(("law", "largest"), MEASURED, ids=[str(law) for law, _ in MEASURED])
def test_distance_from_the_exact_theory(law, largest):
    difference = law.rebound(PSI, CHI) - carom.rebound(PSI, CHI)
    assert np.max(np.abs(difference)) == pytest.approx(largest, abs=1e-4)


def test_the_law_that_knows_micro_slip_is_nearest():
    """Of the laws beside Hertz's force Thornton's alone softens as slip spreads from the edge."""
    exact = carom.rebound(PSI, CHI)
    errors = [
        np.max(np.abs(law.rebound(PSI, CHI) - exact))
        for law in (carom.dem.ThorntonLaw(), *(law for law, _ in MEASURED[2:]))
    ]
    assert errors[0] < 0.5 * min(errors[1:])
