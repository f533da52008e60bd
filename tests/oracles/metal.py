"""Impacts of metal spheres that yield: an ODE, rings of traction, and springs marched plainly.

Formulas are those of Jackson & Green (2005), in their units: w = omega/omega_c, loads in P_c, areas
in A_c. Units of the oblique impact are those of the elastic one, in which b_c = y = sqrt(d_c).
"""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from tests.oracles import rings

Array = NDArray[np.float64]
C = 1.6
ACCURACY = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14, "dense_output": True}
NODES, WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(80))
NODES = NODES + 0.5


def jackson_green(w: Array, strain: float) -> tuple[Array, Array, Array]:
    """Return load and area as the source has them from w = 1.9 on, and H_G/S_y."""
    area = w * (w / 1.9) ** (0.14 * np.exp(23.0 * strain))
    ratio = 0.5 * np.pi * C * strain * np.sqrt(area)
    hardness = 2.84 - 0.92 * (1.0 - np.cos(np.pi * np.minimum(ratio, 1.0)))
    load = np.exp(-0.25 * w ** (5 / 12)) * w**1.5
    load = load + 4.0 * hardness / C * (1.0 - np.exp(-(w ** (5 / 9)) / 25.0)) * w
    return load, area, hardness


def loading(y: float, strain: float, d: Array) -> tuple[Array, Array]:
    """Return load and squared edge: Hertz's until both curves meet, and until 1.9."""
    w = np.asarray(d, dtype=np.float64) / y**2
    load, area, _ = jackson_green(np.maximum(w, 1e-300), strain)
    load = np.where(w < 1.0, w**1.5, np.minimum(load, w**1.5))
    return y**3 * load, y**2 * np.where(w < 1.9, w, area)


def capped(w: Array, c: float) -> tuple[Array, Array]:
    """Return the transform of (2/pi) min(sqrt(w - t^2), c), and its slope in w."""
    part = np.minimum(c / np.sqrt(np.maximum(w, 1e-300)), 1.0)
    slope = 2.0 / np.pi * np.arcsin(part)
    return 2.0 / np.pi * c * np.sqrt(np.maximum(w - c * c, 0.0)) + w * slope, slope


class Impact(NamedTuple):
    """The normal motion: time, edge, and how far the bodies have parted since the turning point."""

    time: Array
    edge: Array
    parted: Array
    levels: Array  # radius of an elastic contact of the largest pressure, while loading
    turn: int
    restitution: float  # by the energy of the springs at the turning point
    speed: float  # at the end, by the motion
    work: float  # of the load until the turning point, of m_n V_1^2/2


def level(load: float, b: float) -> float:
    """Return c of (3/2) c b^2 - c^3/2 = P, as a root."""
    roots = np.roots([-0.5, 0.0, 1.5 * b * b, -min(load, b**3)])
    real = np.sort(roots[np.abs(roots.imag) < 1e-6 * b].real)
    return float(min(real[real > 0.0][0], b))


def impact(y: float, strain: float, steps: int) -> Impact:
    """Integrate v' = -(5/4) P, on the clock dt/(2 sqrt(d)) while loading, then in time."""

    def rates(_: float, s: Array) -> Array:
        load, _ = loading(y, strain, s[0] ** 2)
        return np.array([s[1], -2.5 * s[0] * float(load), 2.0 * s[0]])

    down = solve_ivp(rates, (0.0, 50.0), [0.0, 1.0, 0.0], events=rings.loaded, **ACCURACY)
    root, _, time = down.sol(np.linspace(0.0, down.t[-1], steps))
    loads, squares = loading(y, strain, root**2)
    edge = np.sqrt(squares)
    widest, depth = float(edge[-1]), float(root[-1] ** 2)
    top = level(float(loads[-1]), widest)

    def load_left(parted: float) -> float:
        where = 0.5 * np.pi * NODES
        line = capped(widest**2 * np.cos(where) ** 2, top)[0] - parted
        jacobian = widest * np.cos(where) * 0.5 * np.pi
        return float(1.5 * np.sum(np.maximum(line, 0.0) * jacobian * WEIGHTS))

    deepest = float(capped(np.array(widest**2), top)[0])

    def recede(_: float, s: Array) -> Array:
        return np.array([s[1], 1.25 * load_left(s[0])])

    def gone(_: float, s: Array) -> float:
        return deepest - float(s[0])

    gone.terminal = True  # type: ignore[attr-defined]
    up = solve_ivp(recede, (0.0, 50.0), [0.0, 0.0], events=gone, **ACCURACY)
    back = widest * np.cos(np.linspace(0.0, 0.5 * np.pi, steps))[1:]
    back[-1] = 0.0
    parted = capped(widest**2 - back**2, top)[0]
    fine = np.linspace(0.0, up.t[-1], 40 * steps)
    later = np.interp(parted, up.sol(fine)[0], fine)
    ends = np.linspace(0.0, depth, 20001)
    work = 2.5 * np.trapezoid(loading(y, strain, ends)[0], ends)
    angles = 0.5 * np.pi * NODES
    line = capped(widest**2 * np.cos(angles) ** 2, top)[0]
    stored = 1.875 * np.sum(line**2 * widest * np.cos(angles) * 0.5 * np.pi * WEIGHTS)
    return Impact(
        time=np.concatenate([time, time[-1] + later]),
        edge=np.concatenate([edge, back]),
        parted=np.concatenate([np.zeros(steps), parted]),
        levels=np.array([level(*pair) for pair in zip(loads[1:], edge[1:], strict=True)]),
        turn=steps - 1,
        restitution=float(np.sqrt(stored)),
        speed=float(up.y[1, -1]),
        work=float(work),
    )


def bears(found: Impact, i: int) -> Callable[[Array], tuple[Array, Array]]:
    """Return what springs bear at an instant, as a function of x^2, and its slope in -x^2."""
    c, square = (found.levels[min(i, found.turn) - 1], found.edge[min(i, found.turn)] ** 2)

    def line(s: Array) -> tuple[Array, Array]:
        load, slope = capped(np.maximum(square - s, 0.0), c)
        return load - found.parted[i], slope

    return line


def load_within(radii: Array, found: Impact, i: int) -> Array:
    """Return the integral of the pressure inside radii: of flat punches as wide as each spring."""
    line, b = bears(found, i), found.edge[i]
    x = b * np.sin(0.5 * np.pi * NODES)
    jacobian = b * np.cos(0.5 * np.pi * NODES) * 0.5 * np.pi * WEIGHTS
    whole = 2.0 * np.sum(line(x**2)[0] * jacobian)
    inside = np.minimum(radii, b)[:, None]
    reach = np.sqrt(b * b - inside**2)
    u = reach * np.sin(0.5 * np.pi * NODES)
    steps = reach * np.cos(0.5 * np.pi * NODES) * 0.5 * np.pi * WEIGHTS
    return np.asarray(whole - 4.0 * np.sum(line(inside**2 + u**2)[1] * u**2 * steps, axis=1))


def by_rings(psi: float, chi: float, y: float, strain: float, count: int) -> float:
    """Return psi_2 of rings, to first order."""
    found = impact(y, strain, count)
    radii = np.linspace(0.0, found.edge.max(), count + 1)
    loads = [load_within(radii, found, i) for i in range(1, found.time.size)]
    solid = rings.standard_linear_solid(0.0, 1.0)
    return rings.march_rings(psi, chi, found.time, radii, np.array(loads), solid)


def by_springs(psi: float, chi: float, y: float, strain: float, count: int) -> float:
    """Even springs, each cut to its limit after each step: first order in both."""
    found = impact(y, strain, count)
    x = (np.arange(count) + 0.5) * found.edge.max() / count
    u, force = np.zeros(count), 0.0
    for i, (before, after) in enumerate(pairwise(found.time), 1):
        dt = after - before
        psi -= 0.5 * dt * 3.75 * chi * force
        inside = int(np.searchsorted(x, found.edge[i]))
        most = np.maximum(bears(found, i)(x[:inside] ** 2)[0], 0.0)
        u[:inside] = np.clip(u[:inside] + psi * dt, -most, most)
        u[inside:] = 0.0
        force = float(u[:inside].sum()) * found.edge.max() / count
        psi -= 0.5 * dt * 3.75 * chi * force
    return psi


def by_fine_springs(psi: float, chi: float, y: float, strain: float, count: int) -> float:
    """Return psi_2 of even springs, free of the errors of first and second order."""
    values = [by_springs(psi, chi, y, strain, times * count) for times in (1, 2, 4)]
    first = [2.0 * fine - coarse for coarse, fine in pairwise(values)]
    return (4.0 * first[1] - first[0]) / 3.0
