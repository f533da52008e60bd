"""The normal impact on a plate by Taylor series of many digits, and slow slip as a linear problem.

Zener (1941), Phys. Rev. 59:669: d'' = -(5/4) (d^(3/2) + (3/2) lambda sqrt(d) d'), in units of
Hertz's impact; with b = sqrt(d) and the clock dt/(2 b), b' = v, v' = -(5/2) b^2 (b^2 + (3/2) lambda
v).
"""

from functools import cache

import mpmath as mp
import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

ORDER, STEP = 30, 0.03


def series(b, v, give):
    """Return the Taylor coefficients of b, v and the time in the clock."""
    rows, bs, vs, times = ORDER, [b], [v], [mp.mpf(0)]
    squares, pushes = [], []
    for k in range(rows):
        squares.append(sum(bs[j] * bs[k - j] for j in range(k + 1)))
        pushes.append(squares[k] + mp.mpf(1.5) * give * vs[k])
        rate = sum(squares[j] * pushes[k - j] for j in range(k + 1))
        bs.append(vs[k] / (k + 1))
        vs.append(-mp.mpf(2.5) * rate / (k + 1))
        times.append(2 * bs[k] / (k + 1))
    return bs, vs, times


def at(coefficients, h):
    """Return a series at h."""
    total = mp.mpf(0)
    for coefficient in reversed(coefficients):
        total = total * h + coefficient
    return total


@cache
def restitution_and_duration(give):
    """Return e and the duration of the contact to some 25 digits."""
    with mp.workdps(40):
        give, b, v, time = mp.mpf(give), mp.mpf(0), mp.mpf(1), mp.mpf(0)
        for _ in range(2000):
            bs, vs, times = series(b, v, give)
            following = at(bs, mp.mpf(STEP))
            h = mp.mpf(STEP)
            if following <= 0:
                h = mp.findroot(lambda x, bs=bs: at(bs, x), (h * b / (b - following)))
            b, v, time = at(bs, h), at(vs, h), time + at(times, h)
            if following <= 0:
                return float(-v), float(time)
        raise AssertionError("the contact does not end")


def slow_rebound(chi, give):
    """Return psi_2/psi_1 for psi_1 -> 0, where slip is confined to the edge.

    psi' = -(15/4) chi Q, Q = integral of U - U(touch of x) over 0 <= x <= b.
    """
    options = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853", "dense_output": True}

    def rates(_, y, lag):
        b, v, psi, moved, force = y
        return (
            v,
            -2.5 * b**2 * (b**2 + 1.5 * give * v),
            -7.5 * chi * b * force,
            2.0 * b * psi,
            2.0 * b * b * psi + v * lag(b, moved),
        )

    turns = lambda _, y: y[1]  # noqa: E731
    parts = lambda _, y: y[0]  # noqa: E731
    turns.terminal = parts.terminal = True
    start = [0.0, 1.0, 1.0, 0.0, 0.0]
    loading = solve_ivp(
        lambda t, y: rates(t, y, lambda *_: 0.0), (0.0, 50.0), start, events=turns, **options
    )
    # U over the angle whose cosine is b over its largest value: smooth at the turning point
    clock = loading.t[-1] * np.linspace(0.0, 1.0, 4001)
    edges, touched = loading.sol(clock)[[0, 3]]
    widest = edges[-1]
    angles = np.arccos(np.minimum(edges / widest, 1.0))
    before = CubicSpline(angles[::-1], touched[::-1])

    def lag(b, moved):
        return moved - before(np.arccos(min(max(b / widest, 0.0), 1.0)))

    unloading = solve_ivp(
        lambda t, y: rates(t, y, lag), (0.0, 500.0), loading.y[:, -1], events=parts, **options
    )
    return float(unloading.y[2, -1])
