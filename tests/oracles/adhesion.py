"""Adhering spheres as independent springs that are marched in time, and Maugis & Dugdale's contact.

The springs lie along a line (the method of dimensionality reduction; Popov & Hess 2015). In units
of Hertz's impact the spring at x is pressed by d - x^2; at the edge it holds until it is stretched
by b_0^(3/2) sqrt(x), the rule of Johnson, Kendall & Roberts for the outermost. In shear a spring
follows the body from where the edge met it, and what it bears is lost as the edge leaves it.
"""

from math import acos, pi, sqrt
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq


class Marched(NamedTuple):
    """psi_2/psi_1, e, the duration, and the share of the energy that springs had when let go."""

    ratio: float
    restitution: float
    duration: float
    released: float


def march(stickiness, chi, springs=1500, steps=4000):
    """March an impact that rebounds, V_s/V_1 = stickiness, with so many steps to a time of 5."""
    b_0 = (stickiness**2 * 16.0 / 3.0 / (3.0 + 2.0 ** (-5.0 / 3.0))) ** 0.2
    width, stiffness, step = 2.0 / springs, 3.75 * chi, 5.0 / steps
    x = (np.arange(springs) + 0.5) * width
    held_to = x**2 - b_0**1.5 * np.sqrt(x)  # the least d

    def edge(d):
        inside = np.flatnonzero(held_to <= d)
        return inside[-1] + 1 if inside.size else 0

    d, v, psi, time, released = 0.0, 1.0, 1.0, 0.0, 0.0
    bent, n, count = np.zeros(springs), edge(0.0), 0
    while n and count < 2 * steps:
        v -= step / 2 * 1.875 * np.sum(d - x[:n] ** 2) * width
        psi -= step / 2 * stiffness * np.sum(bent[:n]) * width
        d += step * v
        bent[:n] += step * psi
        n = edge(d)
        released += stiffness * np.sum(bent[n:] ** 2) * width
        bent[n:] = 0.0
        v -= step / 2 * 1.875 * np.sum(d - x[:n] ** 2) * width
        psi -= step / 2 * stiffness * np.sum(bent[:n]) * width
        time, count = time + step, count + 1
    return Marched(psi, -v, time, released)


def lost_by_maugis(tabor, points=4000):
    """Return the energy of a cycle over that of Johnson, Kendall & Roberts (Maugis 1992).

    Units are Maugis' own; his parameter is 1.157 times Tabor's number. The spheres jump together
    where a gap of the reach of the stress is left, and apart where the approach is least.
    """
    reach = 1.157 * tabor

    def rim(a):
        """Return how much wider than the contact the stress acts, from the work of adhesion."""

        def excess(m):
            root, angle = sqrt(m * m - 1.0), acos(1.0 / m)
            bent = 0.5 * reach * a * a * (root + (m * m - 2.0) * angle)
            return bent + 4.0 / 3.0 * reach**2 * a * (root * angle - m + 1.0) - 1.0

        return brentq(excess, 1.0 + 1e-13, 1e7)

    a = np.concatenate([np.geomspace(1e-4, 0.3, points // 4), np.linspace(0.3, 3.0, points)[1:]])
    m = np.array([rim(each) for each in a])
    root = np.sqrt(m * m - 1.0)
    touching = a**2 - 4.0 / 3.0 * a * reach * root
    force = a**3 - reach * a**2 * (root + m * m * np.arccos(1.0 / m))
    gap = 2.0 / (pi * reach)

    def apart(c):
        return c * c / 2.0 - 8.0 * reach * c / (3.0 * pi) - gap

    last = brentq(lambda c: apart(c) + 4.0 / 3.0 * reach * c, 1e-9, 1e4)  # then they touch
    c = np.linspace(0.0, last, points)
    approach = np.concatenate([apart(c), touching])
    load = np.concatenate([-pi / 2.0 * reach * c**2, force])
    falls = np.flatnonzero(np.diff(approach) < 0.0)
    stable = slice(falls[-1] + 1, None)
    approach, load = approach[stable], load[stable]
    if approach[0] >= -gap:
        return 0.0
    pulled = approach < -gap
    ends = np.append(approach[pulled], -gap)
    forces = np.append(load[pulled], np.interp(-gap, approach, load))
    cycle = -np.trapezoid(forces, ends)
    return cycle / (7.09224 / (pi ** (5.0 / 3.0) * 0.75 ** (2.0 / 3.0)))
