"""Integrals of point forces over a square element: 30 digits within, Gauss's rule outside."""

import mpmath
import numpy as np
from mpmath import mp

KERNELS = {
    "xx": lambda x, y: x**2 / mpmath.hypot(x, y) ** 3,
    "yy": lambda x, y: y**2 / mpmath.hypot(x, y) ** 3,
    "xy": lambda x, y: x * y / mpmath.hypot(x, y) ** 3,
    "x": lambda x, y: x / mpmath.hypot(x, y) ** 2,
    "y": lambda x, y: y / mpmath.hypot(x, y) ** 2,
}


def integral_around(kernel, point):
    """Return the integral in polar coordinates around a point of the element.

    The kernels are even or odd of degree -1, so that r kernel is a function of direction alone.
    """
    x, y = map(mp.mpf, point)
    walls = [(mp.mpf("0.5") - x, 0), (mp.mpf("0.5") - y, 1), (mp.mpf("0.5") + x, 2)]
    walls.append((mp.mpf("0.5") + y, 3))
    total = mp.mpf(0)
    for distance, quarter in walls:
        before, after = walls[quarter - 1][0], walls[(quarter + 1) % 4][0]
        middle = quarter * mp.pi / 2
        ends = [
            middle - mpmath.atan2(before, distance),
            middle,
            middle + mpmath.atan2(after, distance),
        ]

        def to_the_wall(angle, distance=distance, middle=middle):
            # the force lies in direction (cos, sin), seen from it the point in the opposite one
            return (
                kernel(-mpmath.cos(angle), -mpmath.sin(angle))
                * distance
                / mpmath.cos(angle - middle)
            )

        total += mpmath.quad(to_the_wall, ends)
    return total


def integral_over(name, point):
    """Return the integral over an element that the point is outside of, by Gauss's rule."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    places = np.concatenate([0.25 * nodes - 0.25, 0.25 * nodes + 0.25])
    weights = 0.25 * np.concatenate([weights, weights])
    x, y = point[0] - places[:, None], point[1] - places
    r = np.hypot(x, y)
    kernels = {"xx": x**2 / r**3, "yy": y**2 / r**3, "xy": x * y / r**3}
    kernels |= {"x": x / r**2, "y": y / r**2}
    return float(weights @ kernels[name] @ weights)


def least_energy(dense, inputs, bound):
    """Return the traction of least energy by Nesterov's accelerated gradients (1983)."""
    values = np.linalg.eigvalsh(dense)
    ratio = np.sqrt(values[0] / values[-1])
    speed = (1.0 - ratio) / (1.0 + ratio)
    here = ahead = np.zeros(inputs.size)
    for _ in range(1500):
        trial = ahead + (inputs.ravel() - dense @ ahead) / values[-1]
        size = np.hypot(*trial.reshape(2, -1))
        cut = np.minimum(1.0, bound.ravel() / np.maximum(size, 1e-300))
        new = trial * np.tile(cut, 2)
        here, ahead = new, new + speed * (new - here)
    return here.reshape(inputs.shape)
