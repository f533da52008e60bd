"""Hertz's ellipse as others have computed it, to the digits that they print."""

import math

import pytest

from carom.dimensionless.ellipse import contact_ellipse

# eve70a/CONTACT (Kalker, Vollebregt), commit d431cdbd125084c79bd59df83b4ac4c63c570ac9, case 1 of
# examples/tractcurv.ref_out and examples/fastsim.ref_out: A and B of the gap A x^2 + B y^2, force,
# semi-axes; and approach and largest pressure, those of its elements
CONTACT = [
    (0.8e-3, 0.2814e-3, 1.067e5, 6.304, 12.61, 7.651e-2, 640.7),
    (0.8464e-3, 0.2406e-2, 8.2e4, 8.000, 4.000, 9.266e-2, 1223.0),
]
SHEAR, POISSON = 8.2e4, 0.28

# Schaeffler, Technisches Taschenbuch, pages 255 and 256 (from janwenzel/Dynamic-Contact-Simulation-
# for-Locating-Bearing-Track-Rollers, Hertz.py): cos(tau) = (B - A)/(A + B), and the semi-axes over
# (3 P/(4 (A + B) E*))^(1/3)
TABLE = {
    0.1: (1.07, 0.938),
    0.2: (1.15, 0.879),
    0.3: (1.24, 0.824),
    0.4: (1.35, 0.771),
    0.5: (1.48, 0.718),
    0.6: (1.66, 0.664),
    0.7: (1.91, 0.607),
    0.8: (2.30, 0.544),
    0.9: (3.09, 0.461),
    0.95: (4.12, 0.396),
    0.99: (7.76, 0.287),
    0.995: (10.15, 0.251),
    0.9995: (23.95, 0.163),
}


def under_load(gap_x, gap_y, force, modulus):
    """Return the semi-axes and the depth."""
    ellipse = contact_ellipse(2.0 * gap_x, 2.0 * gap_y)
    depth = (0.75 * force / (modulus * math.sqrt(ellipse.radius))) ** (2.0 / 3.0)
    scale = math.sqrt(ellipse.radius * depth)
    return scale * ellipse.along, scale * ellipse.across, depth


@pytest.mark.parametrize("case", CONTACT)
def test_contact(case):
    gap_x, gap_y, force, along, across, approach, pressure = case
    found = under_load(gap_x, gap_y, force, SHEAR / (1.0 - POISSON))
    assert found == pytest.approx((along, across, approach), rel=3e-4)
    assert 1.5 * force / (math.pi * found[0] * found[1]) == pytest.approx(pressure, rel=7e-4)


@pytest.mark.parametrize("cosine", TABLE)
def test_table(cosine):
    found = under_load(0.5 * (1.0 - cosine), 0.5 * (1.0 + cosine), 4.0 / 3.0, 1.0)
    assert found[:2] == pytest.approx(TABLE[cosine], rel=5e-3)
