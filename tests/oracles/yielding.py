"""Impacts of yielding spheres by rings of traction, and by springs marched plainly.

Rings obey Coulomb's law at every point of the true contact, under Hertz's pressure cut at that of
yield and, while unloading, Hertz's of the radius R_p (Thornton 1997).
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.special import beta, betainc

from tests.oracles import rings

Array = NDArray[np.float64]


def thornton(y: float, steps: int) -> tuple[Array, Array, Array, Array]:
    """Return time, penetration, edge, load of the sphere that yields at d = y^2, in closed form.

    Hertz's times are incomplete beta functions; P = peak sin(omega t + phase) while it yields.
    """
    whole, share = 0.4 * beta(0.4, 0.5), betainc(0.4, 0.5, y**5)
    b = np.sin(np.arcsin(y) * np.linspace(0.0, 1.0, steps))[:-1]
    loading = whole * betainc(0.4, 0.5, b**5), b**2, b, b**3
    peak, omega = np.sqrt(1.2 * y - 0.2 * y**6), np.sqrt(1.875 * y)
    angle = np.linspace(np.arcsin(y**3 / peak), 0.5 * np.pi, steps)
    load = peak * np.sin(angle)
    d = y**2 + (load - y**3) / (1.5 * y)
    yielding = whole * share + (angle - angle[0]) / omega, d, np.sqrt(d), load
    rho = d[-1] ** 1.5 / peak
    elastic, e = d[-1] / rho, np.sqrt(peak * d[-1] / rho)
    b = np.cos(0.5 * np.pi * np.linspace(0.0, 1.0, 2 * steps))[1:]
    b[-1] = 0.0
    left = whole * (1.0 - betainc(0.4, 0.5, b**5)) * elastic / e
    unloading = (
        yielding[0][-1] + left,
        d[-1] - elastic * (1.0 - b**2),
        np.sqrt(d[-1]) * b,
        peak * b**3,
    )
    columns = zip(loading, yielding, unloading, strict=True)
    time, depth, edge, load = (np.concatenate(parts) for parts in columns)
    return time, depth, edge, load


def load_within(radii: Array, y: float, d: float, b: float, peak: tuple[float, ...]) -> Array:
    """Return the integral of the pressure inside radii: cut at (2/pi) y while loading."""
    square = np.minimum(radii**2, b * b)
    rest = np.sqrt(b * b - square)
    if not peak:
        flat = np.minimum(square, max(d - y * y, 0.0))
        return 2.0 * y * flat + 4.0 / 3.0 * (min(b, y) ** 3 - np.minimum(rest, y) ** 3)
    load, widest = peak
    return np.asarray(4.0 / 3.0 * load / widest**3 * (b**3 - rest**3))


def by_rings(psi: float, chi: float, y: float, count: int) -> float:
    time, depth, edge, load = thornton(y, count)
    turn = int(np.argmax(load))
    radii = np.linspace(0.0, edge[turn], count + 1)
    loads = [
        load_within(radii, y, d, b, (load[turn], edge[turn]) if i > turn else ())
        for i, (d, b) in enumerate(zip(depth, edge, strict=True))
    ]
    solid = rings.standard_linear_solid(0.0, 1.0)
    return rings.march_rings(psi, chi, time, radii, np.array(loads[1:]), solid)


def by_springs(psi: float, chi: float, y: float, count: int) -> float:
    """Even springs, each cut to its limit after each step: first order in both."""
    time, depth, edge, load = thornton(y, count)
    turn = int(np.argmax(load))
    x = (np.arange(count) + 0.5) * edge[turn] / count
    u, force = np.zeros(count), 0.0
    for i, (before, after) in enumerate(pairwise(time), 1):
        dt = after - before
        psi -= 0.5 * dt * 3.75 * chi * force
        inside = int(np.searchsorted(x, edge[i]))
        most = (edge[i] ** 2 - x[:inside] ** 2) * load[turn] / edge[turn] ** 3
        if i <= turn:
            most = borne(depth[i] - x[:inside] ** 2, y)
        u[:inside] = np.clip(u[:inside] + psi * dt, -most, most)
        force = float(u[:inside].sum()) * edge[turn] / count
        psi -= 0.5 * dt * 3.75 * chi * force
    return psi


def borne(w: Array, y: float) -> Array:
    """Return the integral of (2/pi) min(sqrt(w - t^2), y) from -sqrt(w) to sqrt(w)."""
    part = np.minimum(y / np.sqrt(w), 1.0)
    root = np.sqrt(np.maximum(w - y * y, 0.0))
    return np.asarray(2.0 / np.pi * (y * root + w * np.arcsin(part)))


def by_fine_springs(psi: float, chi: float, y: float, count: int) -> float:
    """Return psi_2 of even springs, free of the errors of first and second order."""
    values = [by_springs(psi, chi, y, times * count) for times in (1, 2, 4)]
    first = [2.0 * fine - coarse for coarse, fine in pairwise(values)]
    return (4.0 * first[1] - first[0]) / 3.0
