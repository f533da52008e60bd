"""Point forces of a traction on a circle, summed chord by chord through the point of the field.

Cerruti and Boussinesq (Johnson 1985, sections 3.2 and 3.6), on the surface, force along x or z:
2 pi G u_x = (1 - nu)/rho + nu X^2/rho^3, 2 pi G u_y = nu X Y/rho^3, 2 pi G u_z = (1 - nu)/rho.
In polar coordinates about the field point the distance rho cancels. What is left is the integral of
the traction along each chord through that point, weighted by the direction of the chord.
"""

import math
from itertools import pairwise

import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(48)
TERMS = 80


def spread(low, high):
    """Gauss-Legendre points and weights between two numbers."""
    half = 0.5 * (high - low)
    return low + half * (1.0 + NODES), half * WEIGHTS


class Load:
    """A traction f(r) on a circle: f = int_r^b g s ds/sqrt(s^2 - r^2), or any f given on rings.

    On a ring f is smooth in w = sqrt(outer^2 - r^2), where it is held as a Chebyshev series.
    """

    def __init__(self, f, edges):
        self.edges = np.asarray(edges)
        self.series = []
        for inner, outer in pairwise(edges):
            width = math.sqrt(outer**2 - inner**2)
            nodes = 0.5 * width * (1.0 + np.polynomial.chebyshev.chebpts1(TERMS))
            values = [f(math.sqrt(max(outer**2 - w * w, 0.0))) for w in nodes]
            fit = np.polynomial.Chebyshev.fit(nodes, values, TERMS - 1, domain=[0.0, width])
            self.series.append(fit)

    def along_chords(self, h):
        """Return the integral of f along chords at distances h from the centre, all in one ring."""
        total = np.zeros_like(h)
        for (inner, outer), series in zip(pairwise(self.edges), self.series, strict=True):
            if outer > h[0]:
                reach = np.sqrt(outer**2 - h**2)
                start = np.sqrt(np.maximum(inner**2 - h**2, 0.0)) / reach
                half = 0.5 * (0.5 * math.pi - np.arcsin(start))  # t = reach sin(angle) on a chord
                cos = np.sin(np.outer(half, 1.0 + NODES))
                total += 2.0 * reach * half * ((series(reach[:, None] * cos) * cos) @ WEIGHTS)
        return total

    def integrals(self, x, y):
        """Return iint f/rho, iint f X^2/rho^3 and iint f X Y/rho^3 at (x, y), chord by chord."""
        distance, bearing = math.hypot(x, y), math.atan2(y, x)
        tangents = [math.asin(e / distance) for e in self.edges if e < distance]
        if len(tangents) < len(self.edges):
            tangents.append(0.5 * math.pi)  # within the circle every direction meets it
        total = np.zeros(3)
        for low, high in pairwise(tangents):
            angles, weights = spread(low, high)
            chords = self.along_chords(distance * np.sin(angles))
            for direction in (bearing + angles, bearing - angles):
                cos, sin = np.cos(direction), np.sin(direction)
                total += np.stack([np.ones_like(cos), cos * cos, cos * sin]) @ (weights * chords)
        return total
