"""Impacts of standard linear solids by rings of traction, under a normal motion of their own.

Neither springs in shear nor the normal motion of the package: here on even springs and times.
"""

import numpy as np
from numpy.typing import NDArray

from tests.oracles import rings

Array = NDArray[np.float64]
WIDEST, SPRINGS = 1.1, 2000


def normal_motion(g: float, theta: float, dt: float) -> tuple[Array, Array, Array, float]:
    """Return times, the edges of even springs, what they bear then, and e."""
    width = WIDEST / SPRINGS
    squares = ((np.arange(SPRINGS) + 0.5) * width) ** 2
    k, apart = np.zeros(SPRINGS), np.zeros(SPRINGS, dtype=bool)
    left, d, v, load, time = np.exp(-dt / theta), 0.0, 1.0, 0.0, [0.0]
    borne = [np.zeros(SPRINGS)]
    while v > 0.0 or load > 0.0:
        v -= 0.625 * load * dt
        grown = np.maximum(d + v * dt - squares, 0.0) - np.maximum(d - squares, 0.0)
        d += v * dt
        k = k * left + grown * (1.0 - left) * theta / dt
        force = np.where(apart, 0.0, np.maximum(d - squares, 0.0) + g * k)
        if v < 0.0:
            apart |= force <= 0.0
        borne.append(np.maximum(force, 0.0))
        load = 1.5 * width * float(borne[-1].sum())
        v -= 0.625 * load * dt
        time.append(time[-1] + dt)
    return np.array(time), (np.arange(SPRINGS) + 1.0) * width, np.array(borne), -v


def by_rings(psi: float, chi: float, g: float, theta: float, count: int) -> tuple[float, float]:
    """Return psi_2 and e; a pressure is made of flat punches, of which each ends where a spring."""
    time, edges, borne, e = normal_motion(g, theta, 0.64 / count)
    widest = edges[np.flatnonzero(borne.max(axis=0)).max()]
    radii = np.linspace(0.0, widest, count + 1)
    root = np.sqrt(np.maximum(edges[:, None] ** 2 - radii[None, :] ** 2, 0.0))
    punches = -np.diff(borne[1:], axis=1, append=0.0)
    loads = 2.0 * punches @ (edges[:, None] - root)
    solid = rings.standard_linear_solid(g, theta)
    return rings.march_rings(psi, chi, time, radii, loads, solid), e
