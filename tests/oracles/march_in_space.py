"""An oblique impact whose direction turns, by springs at even places in short even steps.

w' = -(5/4) B (P, Q), w = (v, psi, psi across); springs in the middle of cells of the contact's
radius, u' = psi, cut radially to |u| <= d - s. Of first order in the angle that turns in a step.
"""

import numpy as np


def cut(trial, limit, ratio):
    """Return springs beyond the limit slipped back along what they bear, in 60 bisections."""
    low, high = np.zeros_like(limit), np.full_like(limit, 1e12)
    for _ in range(120):
        slip = np.sqrt(np.maximum(low, 1e-15) * high)
        size = np.hypot(trial[0] / (1.0 + slip), trial[1] / (1.0 + ratio * slip))
        low, high = np.where(size > limit, slip, low), np.where(size > limit, high, slip)
    beyond = np.hypot(*trial) > limit
    slip = np.where(beyond, high, 0.0)
    return np.array([trial[0] / (1.0 + slip), trial[1] / (1.0 + ratio * slip)])


def marched(psi, rates, springs, across=0.0, ratio=1.0, reach=1.44):
    """Return v, psi, psi across after the impact; `rates` is B, shape (3, 3)."""
    cell, step = reach**0.5 / springs, 4.0 / (8 * springs)
    s = (cell * (np.arange(springs) + 0.5)) ** 2
    w, depth, u, forces = np.array([1.0, psi, across]), 0.0, np.zeros((2, springs)), np.zeros(3)
    while depth >= 0.0:
        w -= 0.625 * step * rates @ forces
        before, depth = depth, depth + step * w[0]
        touched = s < depth
        share = np.clip((depth - s) / max(depth - before, 1e-300), 0.0, 1.0)
        share[s < before] = 1.0
        u = touched * (u + step * w[1:, np.newaxis] * share)
        limit, size = np.maximum(depth - s, 0.0), np.hypot(*u)
        if ratio == 1.0:
            u *= np.minimum(1.0, limit / np.maximum(size, 1e-300))
        else:
            u[:, touched] = cut(u[:, touched], limit[touched], ratio)
        forces = np.array([max(depth, 0.0) ** 1.5, *(cell * u.sum(axis=1))])
        w -= 0.625 * step * rates @ forces
    return w


def extrapolated(psi, rates, springs=500, across=0.0, ratio=1.0):
    """Return the same by Richardson's extrapolation, as of first order."""
    fine, coarse = (marched(psi, rates, n, across, ratio) for n in (2 * springs, springs))
    return 2.0 * fine - coarse


def rates_of(body):
    """Return B, the matrix of w' = -(5/4) B (P, Q)."""
    return np.array(
        [
            [1.0, 1.5 * body.eps, 1.5 * body.eps_across],
            [body.zeta, 3.0 * body.chi, 3.0 * body.mixed],
            [body.zeta_across, 3.0 * body.ratio * body.mixed, 3.0 * body.across],
        ]
    )


def energy(body, out):
    """Return the kinetic energy of a motion (v, psi, psi across), of m_n V_1^2/2."""
    share = (
        1.5 * body.eps / body.zeta
        if body.zeta
        else 1.5 * body.eps_across * body.ratio / body.zeta_across
    )
    return float(
        out @ np.diag([1.0, share, share / body.ratio]) @ np.linalg.inv(rates_of(body)) @ out
    )
