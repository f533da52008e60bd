"""Stresses below a half-space: point forces of the textbook, summed, and Hamilton's equations."""

import numpy as np


def boussinesq(x, y, z, poisson):
    """Return 2 pi times the stress due to a unit force into the body (Johnson 1985, 3.2)."""
    r, distance = np.hypot(x, y), np.sqrt(x * x + y * y + z * z)
    soft = (1.0 - 2.0 * poisson) * (1.0 - z / distance) / r**2
    radial = soft - 3.0 * z * r**2 / distance**5
    hoop = (1.0 - 2.0 * poisson) * z / distance**3 - soft
    shear = -3.0 * z**2 / distance**5
    c, s = x / r, y / r
    inplane = [radial * c * c + hoop * s * s, radial * s * s + hoop * c * c]
    return np.array([*inplane, z * shear, (radial - hoop) * c * s, x * shear, y * shear])


def cerruti(x, y, z, poisson):
    """Return 2 pi times the stress due to a unit force along x (Johnson 1985, 3.6)."""
    distance = np.sqrt(x * x + y * y + z * z)
    t = 1.0 / (distance + z)
    more = t * t / distance**2 * (1.0 / distance + 2.0 * t)
    xx = x * (1.0 / distance**3 - 3.0 * t * t / distance + x * x * more)
    yy = x * (1.0 / distance**3 - t * t / distance + y * y * more)
    xy = y * (x * x * more - t * t / distance)
    pulled = np.array([x * x, y * y, 0 * x + z * z, x * y, x * z, y * z]) * (-3.0 * x / distance**5)
    return pulled + (1.0 - 2.0 * poisson) * np.array([xx, yy, 0 * x, xy, 0 * x, 0 * x])


def summed(kernel, at, poisson, weight, radius=1.0):
    """Integrate weight(r) sqrt(radius^2 - r^2) times a point force's stress over a disc."""
    nodes, weights = np.polynomial.legendre.leggauss(80)
    t = np.pi / 4 * (1.0 + nodes)
    r, angle = np.meshgrid(radius * np.sin(t), 2.0 * np.pi * (np.arange(160) + 0.5) / 160)
    area = np.pi / 4 * weights * r * radius**2 * np.cos(t) ** 2 * 2.0 * np.pi / 160
    values = kernel(at[0] - r * np.cos(angle), at[1] - r * np.sin(angle), at[2], poisson)
    return (values * area * weight(r)).sum(axis=(1, 2)) / (2.0 * np.pi)


def hamilton(at, nu):
    """Return the stress below a pressure sqrt(1 - r^2) by Hamilton's (1983) explicit equations."""
    x, y, z = at.T
    r2 = x * x + y * y
    a = r2 + z * z - 1.0
    s = np.sqrt(a * a + 4.0 * z * z)
    m = np.where(a > 0.0, np.sqrt(0.5 * (s + np.abs(a))), 0.0)
    n = np.where(a > 0.0, z / np.where(a > 0.0, m, 1.0), np.sqrt(0.5 * (s + np.abs(a))))
    m = np.where(a > 0.0, m, z / n)
    g, h = m * m - n * n + z * m - n, 2.0 * m * n + m + z * n
    turned = (1 - nu) * n * z * z - (1 - 2 * nu) / 3 * (n * s + 2 * a * n + 1) - nu * m * z
    mean = (1 + nu) * z * np.arctan(1.0 / m)

    def normal(u, v):
        rest = -n * (u * u + 2 * nu * v * v) - m * u * u * z / s
        return mean + ((v * v - u * u) / r2 * turned + rest) / r2

    soft = -n * r2 + 2 / 3 * n * (s + 2 * a) - z * (z * n + m) + 2 / 3
    xy = x * y / r2**2 * ((1 - 2 * nu) * soft + z * (-m * r2 / s - z * n + m))
    shear = -z * (n / s - z * h / (g * g + h * h))
    return np.stack([normal(x, y), normal(y, x), -n + z * m / s, xy, x * shear, y * shear], axis=-1)
