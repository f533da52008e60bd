"""The contact of two smooth bodies: Hertz's ellipse, and its stiffness along both axes.

The pressure p0 sqrt(1 - x^2/a^2 - y^2/b^2) presses an ellipse of semi-axes a, b in by
d - x^2/(2 R_x) - y^2/(2 R_y), with Carlson's integrals (Johnson 1985, sections 3.3, 4.2)

    d = (p0 a b/E*) R_F(0, a^2, b^2),  1/(2 R_x) = (p0 a b/(3 E*)) R_D(0, b^2, a^2),

and so for y. A traction q0/sqrt(1 - x^2/a^2 - y^2/b^2) along x moves all of it (the chords
through a point hold pi q0/w) by u_x = (q0/(2 G)) times the integral over half a turn of
(1 - nu + nu cos^2)/w, w^2 = cos^2/a^2 + sin^2/b^2, and along x alone. With the share c of cos^2

    c = int cos^2/w / int 1/w = a^2 R_D(0, b^2, a^2)/(3 R_F(0, a^2, b^2)) = a^2/(2 R_x d),

1 - c = b^2/(2 R_y d), and 1/G*_x = sum (1 - nu (1 - c))/(2 G). Pressed deeper, the ellipse gains
the pressure of a flat punch, p0/sqrt(1 - x^2/a^2 - y^2/b^2): dF/dU = kappa_x dP/d(d) with the
constant kappa_x = G*_x/E*.
"""

from math import pi, sqrt
from typing import NamedTuple

STEPS = 30  # each leaves a quarter of the error or less


class Ellipse(NamedTuple):
    """The shape of a contact, which does not depend on the load, and its normal stiffness."""

    radius: float  # R_e, of the sphere of the same stiffness: P = (4/3) E* sqrt(R_e) d^(3/2)
    along: float  # semi-axis along x, over sqrt(R_e d)
    across: float  # semi-axis along y, over sqrt(R_e d)
    share: float  # c; 1/2 of a circle, above that the ellipse is longer along x


def contact_ellipse(curvature_x: float, curvature_y: float) -> Ellipse:
    """Return the contact of bodies whose relative curvatures are 1/R_x and 1/R_y, both positive.

    To 1e-14, at ratios from 1e-38 to 1e38. A line contact, with a curvature of zero, has no depth
    for a load, and must be refused before. (b/a)^2 = (R_y/R_x) (1 - c)/c is iterated.
    """
    from scipy.special import elliprd, elliprf  # an eighth of a second, for these alone

    ratio, share = curvature_x / curvature_y, 0.5
    for _ in range(STEPS):
        squared = ratio * (1.0 - share) / share
        share = float(elliprd(0.0, squared, 1.0) / (3.0 * elliprf(0.0, 1.0, squared)))
    along = float(elliprf(0.0, 1.0, squared)) / (0.5 * pi)
    return Ellipse(2.0 * share / (curvature_x * along**2), along, along * sqrt(squared), share)


def stiffness_ratios(
    share: float, modulus: float, *bodies: tuple[float, float]
) -> tuple[float, float]:
    """Return kappa_x and kappa_y of a share, E*, and nu and G of each body, infinite if rigid."""

    def ratio(other: float) -> float:
        return 1.0 / sum((2.0 - 2.0 * other * nu) / (4.0 * shear) for nu, shear in bodies) / modulus

    return ratio(1.0 - share), ratio(share)
