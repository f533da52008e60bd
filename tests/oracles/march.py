"""The oblique impact of elastic or Kelvin-Voigt spheres by marching in time over springs.

Maw, Barber & Fawcett (1976), Wear 38:101-114. The normal motion is SciPy's in the clock dt/(2 b);
springs stand where the edge is after every second step of the loading. At s = x^2, u = 0 at touch,

    alpha u' = f - u,  f = clip(u + alpha psi, -(D - s), D - s),
    U' = psi,  psi' = -(15/4) chi integral of f dx over 0 <= x <= b.

In a step a spring sticks, slips, exactly, or stops: what moves it least. Units as of `Solution`.
"""

import numpy as np
from scipy.integrate import solve_ivp


def rates(_, y, alpha, late):
    b, v, _ = y
    if late:
        return v - 1.25 * alpha * b**3, -2.5 * b**4, 2.0 * b
    return v, -2.5 * b**2 * (b**2 + 1.5 * alpha * v), 2.0 * b


def ends(_, y, alpha, late):
    return y[0 if late else 1]


ends.terminal, ends.direction = True, -1.0
CLOSELY = {"rtol": 1e-13, "atol": 1e-15, "method": "DOP853", "dense_output": True, "events": ends}


def motion(alpha, steps):
    """Return clock, time, edge, limit D at the centre, d and v, half of the steps loading."""
    y, clock, parts = np.array([0.0, 1.0, 0.0]), 0.0, []
    for late in (False, True):
        run = solve_ivp(rates, (0.0, 100.0), y, args=(alpha, late), **CLOSELY)
        grid = np.linspace(0.0, run.t[-1], steps // 2 + 1)[late:]
        parts.append(np.vstack((clock + grid, run.sol(grid))))
        y, clock = run.y[:, -1], clock + run.t[-1]
    (clock, b, v, time), late = np.hstack(parts), np.arange(steps + 1) > steps // 2
    b[-1], v[steps // 2] = 0.0, 0.0
    return clock, time, b, b**2 + alpha * np.maximum(v, 0.0), b**2 - late * alpha * v, v


def share(near, far):
    """Return the weight at `near` of the integral to `far` of what is linear in x^2."""
    return np.abs(far - near) * (2.0 * far + near) / (3.0 * (far + near))


def least(start, slope, end):
    """Return the least value of a parabola on [0, 1] if that is negative."""
    bend = end - start - slope
    inside = (slope < 0.0) & (-slope < 2.0 * bend)
    lowest = start - slope**2 / (4.0 * np.where(inside, bend, 1.0))
    return np.minimum(np.where(inside, lowest, end), 0.0)


def march(psi, chi, alpha=0.0, springs=500, history=None):
    """Return psi_2, of second order; fill in time, psi, U, Q, integral of u^2, both losses."""
    clock, time, b, limit, depth, v = motion(alpha, 4 * springs)
    x = b[: 2 * springs + 1 : 2]
    x, outer, s = x[:-1], share(x[:-1], x[1:]), x[:-1] ** 2
    weights = outer + np.append(0.0, share(x[1:], x[:-1]))
    u, moved, force, lost = np.zeros(springs), 0.0, 0.0, np.zeros(2)
    for i in range(4 * springs):
        dt, kick = time[i + 1] - time[i], 1.875 * chi * (clock[i + 1] - clock[i])
        n, edge, first = int(np.searchsorted(x, b[i + 1])), b[i + 1], psi
        half = psi - kick * 2.0 * b[i] * force
        du, left, fades = half * dt, np.exp(-dt / alpha) if alpha else 0.0, alpha > 4.0 * dt
        w, w_end, old = depth[i] - s[:n], depth[i + 1] - s[:n], u[:n].copy()
        rest = ((old - w) / alpha, (old + w) / alpha) if fades else (0.0, 0.0)
        stops = w_end + (old - w) * left - du - old, w_end - (old + w) * left + du + old
        follows = float(fades or not alpha)  # a parabola does, what happens within the step
        slopes = follows * dt * (v[i] - rest[0] - psi), follows * dt * (v[i] + rest[1] + psi)
        forth = least(0.0 if alpha else w - old, slopes[0], stops[0])
        back = least(0.0 if alpha else w + old, slopes[1], stops[1])
        u[:n] += du + forth - back
        weight, rim = weights[:n].copy(), 0.0
        if n:
            weight[-1] += share(x[n - 1], edge) - outer[n - 1]
            rim = share(edge, x[n - 1]) if edge else 0.0
        most, at_rim = limit[i + 1] - s[:n], max(limit[i + 1] - edge**2, 0.0)
        moved, psi = moved + du, half
        for _ in range(12 if alpha else 1):
            force = weight @ np.clip(u[:n] + alpha * psi, -most, most)
            force += rim * np.clip(alpha * psi, -at_rim, at_rim)
            psi = half - kick * 2.0 * edge * force
        if history is not None:  # the dashpots of springs that are let go take what is left
            for q, drag, bound in ((old, first, limit[i] - s[:n]), (u[:n], psi, most)):
                pull = np.clip(q + alpha * drag, -bound, bound)
                slip, rate = (alpha * drag - pull + q) * pull, (pull - q) ** 2
                lost += 0.5 * dt / alpha * np.array((weight @ slip, weight @ rate))
            lost[1] += 0.5 * weights[n:] @ u[n:] ** 2
            u[n:] = 0.0
            history[i + 1] = time[i + 1], psi, moved, force, weight @ u[:n] ** 2, *lost
    return psi


def extrapolated(psi, chi, alpha=0.0, springs=1000):
    """Return psi_2 by Richardson's extrapolation."""
    return (4.0 * march(psi, chi, alpha, springs) - march(psi, chi, alpha, springs // 2)) / 3.0
