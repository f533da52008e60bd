"""Closed forms of spheres and punches that stick or slip; the tests that use them derive them."""

from math import asin, atanh, cosh, log, pi, sqrt

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk


def stiffening(beta):
    """Return the force under a flat punch that sticks over that without friction.

    artanh(beta)/beta, for a rigid punch (1 - nu) ln(3 - 4 nu)/(1 - 2 nu) (Mossakovski 1963, J.
    Appl. Math. Mech. 27:630).
    """
    return atanh(beta) / beta


def depth_of_sphere(beta):
    """Return d/a^2 of a paraboloid that sticks from first touch; 1 without friction.

    It is laid as punches of growing radius. Outside one, u_z = 2 A times the integral of
    cos(theta ln((1 + t)/(1 - t)))/sqrt(r^2 - t^2), tanh pi theta = beta, A = cosh(pi theta)/pi;
    at the edge all of them add to d - a^2/2.
    """
    theta = atanh(beta) / pi

    def reached(t):
        wave = np.cos(theta * log((1.0 + t) / (1.0 - t)))
        return wave * (asin(t) - t * sqrt(1.0 - t * t)) / t**3

    outside, _ = quad(reached, 1e-3, 1.0, limit=400)
    return 0.5 / (1.0 - 2.0 * cosh(pi * theta) / pi * (outside + 2e-3 / 3.0))


def stick_radius(ratio):
    """Return c/a where tractions do not change the pressure: beta and friction in a small ratio.

    (a/2c) ln((a + c)/(a - c)) = (friction/beta) K(sqrt(1 - c^2/a^2)): there phi of what sticks
    meets phi of q = friction p outside; the same for profiles of any power (Spence 1975, J.
    Elasticity 5:297).
    """

    def missing(c):
        return ratio * log((1.0 + c) / (1.0 - c)) / (2.0 * c) - ellipk(1.0 - c * c)

    return brentq(missing, 1e-9, 1.0 - 1e-13)


def turn_of(c):
    return 2.0 / pi * (ellipk(1.0 - c * c) - ellipe(1.0 - c * c))


def moment_of(c):
    return 16.0 / (3.0 * pi) * quad(lambda s: s * s * ellipe(1.0 - s * s), c, 1.0)[0]


def moment(turn):
    """Return M for a turn from rest."""
    return moment_of(brentq(lambda c: turn_of(c) - turn, 1e-9, 1.0)) if turn else 0.0


def traction_of(r, c):
    """Return q at a radius, as the discs add up; the root of s^2 - r^2 is what is integrated."""

    def discs(root):
        return ellipe(1.0 - r * r - root * root) / (r * r + root * root)

    return 4.0 / pi**2 * r * quad(discs, sqrt(max(c * c - r * r, 0.0)), sqrt(1.0 - r * r))[0]
