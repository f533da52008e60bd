"""An oblique impact whose direction turns, by springs at even places in short even steps.

w' = -(5/4) B (P, Q), w = (v, psi, psi across); springs in the middle of cells of the contact's
radius, u' = psi, cut radially to |u| <= d - s. Of first order in the angle that turns in a step.
"""

import numpy as np


def marched(psi, rates, springs):
    """Return v, psi, psi across after the impact; `rates` is B, shape (3, 3)."""
    cell, step = 1.2 / springs, 4.0 / (8 * springs)
    s = (cell * (np.arange(springs) + 0.5)) ** 2
    w, depth, u, forces = np.array([1.0, psi, 0.0]), 0.0, np.zeros((2, springs)), np.zeros(3)
    while depth >= 0.0:
        w -= 0.625 * step * rates @ forces
        before, depth = depth, depth + step * w[0]
        touched = s < depth
        share = np.clip((depth - s) / max(depth - before, 1e-300), 0.0, 1.0)
        share[s < before] = 1.0
        u = touched * (u + step * w[1:, np.newaxis] * share)
        limit, size = np.maximum(depth - s, 0.0), np.hypot(*u)
        u *= np.minimum(1.0, limit / np.maximum(size, 1e-300))
        forces = np.array([max(depth, 0.0) ** 1.5, *(cell * u.sum(axis=1))])
        w -= 0.625 * step * rates @ forces
    return w


def extrapolated(psi, rates, springs=500):
    """Return the same by Richardson's extrapolation, as of first order."""
    return 2.0 * marched(psi, rates, 2 * springs) - marched(psi, rates, springs)


def rates_of(body):
    """Return B, the matrix of w' = -(5/4) B (P, Q)."""
    return np.array(
        [
            [1.0, 1.5 * body.eps, 1.5 * body.eps_across],
            [body.zeta, 3.0 * body.chi, 3.0 * body.mixed],
            [body.zeta_across, 3.0 * body.mixed, 3.0 * body.across],
        ]
    )


def energy(body, out):
    """Return the kinetic energy of a motion (v, psi, psi across), of m_n V_1^2/2."""
    share = 1.5 * np.hypot(body.eps, body.eps_across) / np.hypot(body.zeta, body.zeta_across)
    return float(out @ np.diag([1.0, share, share]) @ np.linalg.inv(rates_of(body)) @ out)
