"""A Kelvin-Voigt contact driven along any path, loaded again before it parts, too.

Free of load the surface of a spring at s recovers, w + alpha w' = 0; it is touched where the other
surface comes down to it, and never pulled. With E = exp(-dt/alpha)

    w = max(d - s, w E),  N = (w - w_before E)/(1 - E),
    f = clip((u + dU - u E)/(1 - E), -N, N),  u = u E + f (1 - E),

so that a spring that is let go recovers, and is met again with what is left of u. Implicit, of
first order in the steps; alpha = 0 is an elastic contact. Units as of `march`.
"""

import numpy as np


def drive(times, depth, moved, alpha, springs=400):
    """Return P/P_max, Q and the radius of the contact after each step of a path."""
    width = np.sqrt(np.max(depth)) / springs
    squares, w, u, rows = ((np.arange(springs) + 0.5) * width) ** 2, 0.0, 0.0, []
    for dt, d, du in zip(np.diff(times), depth[1:], np.diff(moved), strict=True):
        left = np.exp(-dt / alpha) if alpha else 0.0
        most = (np.maximum(d - squares, w * left) - w * left) / (1.0 - left)
        w = np.maximum(d - squares, w * left)
        bears = np.clip((u * (1.0 - left) + du) / (1.0 - left), -most, most)
        u = u * left + bears * (1.0 - left)
        rows.append((1.5 * width * most.sum(), width * bears.sum(), width * (most > 0.0).sum()))
    return np.array(rows).T
