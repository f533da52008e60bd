"""An oblique impact whose direction turns, by springs at even places in short even steps.

w' = -(5/4) B (P, Q), w = (v, psi, psi across); springs in the middle of cells of the contact's
radius, u' = psi, cut radially to |u| <= d - s. Of first order in the angle that turns in a step.

Springs of Kelvin & Voigt bear D - s, D = d + alpha d', from their touch at d = s until that is
zero, and f = u + alpha u', |f| <= D - s, in shear; u' is that at the end of a step, so that elastic
ones have alpha = 0. The edge of a contact that grows bears alpha d', and f = alpha psi, cut to it:
this fills up the last cell. One approach: a contact that grows again is not foreseen.
"""

import numpy as np


def cut(trial, limit, ratio):
    """Return springs beyond the limit slipped back along what they bear, in 120 bisections."""
    if ratio == 1.0:
        return trial * np.minimum(1.0, limit / np.maximum(np.hypot(*trial), 1e-300))
    low, high = np.zeros_like(limit), np.full_like(limit, 1e12)
    for _ in range(120):
        slip = np.sqrt(np.maximum(low, 1e-15) * high)
        size = np.hypot(trial[0] / (1.0 + slip), trial[1] / (1.0 + ratio * slip))
        low, high = np.where(size > limit, slip, low), np.where(size > limit, high, slip)
    beyond = np.hypot(*trial) > limit
    slip = np.where(beyond, high, 0.0)
    return np.array([trial[0] / (1.0 + slip), trial[1] / (1.0 + ratio * slip)])


def marched(psi, rates, springs, across=0.0, ratio=1.0, reach=1.44, alpha=0.0):
    """Return v, psi, psi across after the impact; `rates` is B, shape (3, 3)."""
    cell, step = reach**0.5 / springs, 4.0 / (8 * springs)
    s = (cell * (np.arange(springs) + 0.5)) ** 2
    w, depth, u, forces = np.array([1.0, psi, across]), 0.0, np.zeros((2, springs)), np.zeros(3)
    bears = 0.0  # D
    while bears >= 0.0:
        w -= 0.625 * step * rates @ forces
        before, depth = depth, depth + step * w[0]
        bears = depth + alpha * w[0]
        edge = max(min(depth, bears), 0.0)
        touched = s < edge
        share = np.clip((depth - s) / max(depth - before, 1e-300), 0.0, 1.0)
        share[s < before] = 1.0
        time = step * share[touched]
        held, pull = u[:, touched], w[1:, np.newaxis]
        f = cut(held + (alpha + time) * pull, bears - s[touched], ratio)
        u[:, touched] += time / (alpha + time) * (f - held)
        u[:, ~touched] = 0.0
        outer = cut(alpha * pull, np.array([bears - edge]), ratio)[:, 0]
        rest = edge**0.5 - cell * touched.sum()
        forces[0] = 1.5 * edge**0.5 * (bears - edge / 3.0)
        forces[1:] = cell * f.sum(axis=1) + rest * outer
        w -= 0.625 * step * rates @ forces
    return w


def extrapolated(psi, rates, springs=500, across=0.0, ratio=1.0, alpha=0.0):
    """Return the same by Richardson's extrapolation, as of first order.

    With alpha the force begins as the root of the time, so that an error of order 3/2 is left.
    """
    counts = 2 * springs, springs
    fine, coarse = (marched(psi, rates, n, across, ratio, alpha=alpha) for n in counts)
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
