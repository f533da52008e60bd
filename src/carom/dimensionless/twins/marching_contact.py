"""A viscoelastic contact driven along any path, loaded again before it parts, too.

The truth for contact laws that are stepped, of Kelvin-Voigt springs with one rule for contact. Free
of load the surface of a spring at s recovers, w + alpha w' = 0; it is touched where the other
surface comes down to it, and never pulled:

    w = max(d - s, w E),  N = (w - w_before E)/(1 - E),  E = exp(-dt/alpha),

N its mean load in a step. In shear likewise: u is what moves with U where it sticks, and

    f = clip((u + dU - u E)/(1 - E), -N, N),  u = u E + f (1 - E),

so that a spring that is let go recovers, and is met again with what is left of u. Implicit, of
first order in the steps; alpha = 0 is an elastic contact. Units as of `marching`.
"""

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.numerics.arrays import Array


def drive(
    times: ArrayLike, depth: ArrayLike, moved: ArrayLike, alpha: float, springs: int = 400
) -> tuple[Array, Array, Array]:
    """Return P/P_max, Q and the radius of the contact after each step of a path.

    P = (3/2) integral of N dx, Q = integral of f dx over the contact.

    Dimensionless; times, penetration d and displacement U of the bodies have one length n, the
    results n - 1. Raises ValueError if times do not grow, or alpha is negative.

    >>> from carom.dimensionless.twins.marching_contact import drive
    >>> load, force, radius = drive([0.0, 1.0, 1.5], [0.0, 1.0, 0.6], [0.0, 0.0, 0.1], alpha=0.3)
    >>> load.round(3)  # while unloading less than (0.6)^(3/2)
    array([1.037, 0.361])
    """
    t, d, moves = (np.asarray(x, dtype=float) for x in (times, depth, moved))
    if np.any(np.diff(t) <= 0.0):
        raise ValueError("times: must grow")
    if not alpha >= 0.0:
        raise ValueError(f"alpha: {alpha:g} is negative")
    width = np.sqrt(max(d.max(), 0.0)) / springs
    squares = ((np.arange(springs) + 0.5) * width) ** 2
    w, u, rows = np.zeros(springs), np.zeros(springs), []
    for i in range(1, t.size):
        left = np.exp(-(t[i] - t[i - 1]) / alpha) if alpha > 0.0 else 0.0
        now = np.maximum(d[i] - squares, w * left)
        most = (now - w * left) / (1.0 - left)
        pull = (u * (1.0 - left) + moves[i] - moves[i - 1]) / (1.0 - left)
        bears = np.clip(pull, -most, most)
        u, w = u * left + bears * (1.0 - left), now
        rows.append((1.5 * width * most.sum(), width * bears.sum(), width * (most > 0.0).sum()))
    load, force, radius = np.array(rows).T
    return load, force, radius
