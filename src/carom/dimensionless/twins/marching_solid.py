"""The oblique impact of Kelvin-Voigt solids by marching in time over springs.

As in `marching`, but each annulus is a spring with a dashpot in shear, too, of the retardation time
alpha that rules compression. At s = x^2, with u = 0 at the touch:

    alpha u' = f - u,  f = clip(u + alpha psi, -(D - s), D - s),
    psi' = -(15/4) chi integral of f dx over 0 <= x <= b.

In a step a spring sticks, u grows as U does, or it slips, u = sigma (d - s) + y, y ~ exp(-t/alpha),
exactly; what it does is the least of both, and of slip that stops within the step. Units as there.
"""

import numpy as np

from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel
from carom.dimensionless.twins.marching_motion import kelvin_voigt
from carom.dimensionless.twins.marching_springs import places, share, weigh

AT, TIME, PACE, EDGE, LIMIT = range(5)  # columns of a normal motion
DEPTH, SPEED = 6, 7
COLUMNS = 7  # of a history: time, psi, U, Q, the integral of u^2, friction, what dashpots lose
MAX_ROUNDS, SETTLED = 40, 1e-15
RESOLVED = 4.0  # steps to a retardation time, for a parabola to follow what happens in one


def march(psi: float, chi: float, alpha: float, springs: int = 500, steps: int = 2000) -> float:
    """Return psi_2 of Kelvin-Voigt solids, to second order in both steps.

    psi_2 = psi_1 - (15/4) chi integral of Q dt

    Dimensionless scalars; `steps` is a multiple of 2 `springs`.

    >>> from carom.dimensionless.twins.marching_solid import march
    >>> round(march(9.0, 1.0, 0.2), 9)  # slides throughout
    5.575234871
    """
    motion = kelvin_voigt(float(alpha), steps)
    given = float(psi), float(chi), float(alpha), motion, steps // (2 * springs)
    return float(integrate(*given, np.empty((0, COLUMNS))))


def march_history(psi: float, chi: float, alpha: float, springs: int, steps: int) -> Array:
    """Return time, psi, U, Q, integral of u^2, friction and dashpots' loss after each step.

    psi^2/2 + (15/4) chi [integral of u^2/2 + both losses] is constant. First row: the touch.

    >>> from carom.dimensionless.twins.marching_solid import march_history
    >>> rows = march_history(9.0, 1.0, 0.2, 100, 400)
    >>> rows.shape
    (401, 7)
    """
    motion = kelvin_voigt(float(alpha), steps)
    history = np.zeros((len(motion), COLUMNS))
    history[0, 1] = psi
    integrate(float(psi), float(chi), float(alpha), motion, steps // (2 * springs), history)
    return history


def extrapolated(psi: float, chi: float, alpha: float, springs: int = 2000) -> float:
    """Return psi_2 by Richardson extrapolation, with four steps to an even number of springs.

    psi_2 = (4 march(springs) - march(springs/2))/3

    >>> from carom.dimensionless.twins.marching_solid import extrapolated
    >>> round(extrapolated(1.5, 1.44, 0.0576035799), 6)  # e = 0.9
    -0.366922
    """
    fine = march(psi, chi, alpha, springs, 4 * springs)
    return (4.0 * fine - march(psi, chi, alpha, springs // 2, 2 * springs)) / 3.0


@kernel
def _least(slope: float, end: float) -> float:
    """Return the least value on [0, 1] of a parabola that begins at 0."""
    curvature = end - slope
    if slope < 0.0 and -slope < 2.0 * curvature:
        return float(-slope * slope / (4.0 * curvature))
    return min(0.0, end)


@kernel
def _moved(
    u: float, s: float, psi: float, du: float, before: Array, after: Array, alpha: float
) -> float:
    """Return u after a step in which U grows by du; psi is that of its start."""
    dt = after[TIME] - before[TIME]
    decay = np.exp(-dt / alpha)
    w, w_end, v = before[DEPTH] - s, after[DEPTH] - s, before[SPEED]
    forth = w_end + (u - w) * decay - du - u  # slip +, less stick
    back = w_end - (u + w) * decay + du + u  # slip -, less stick, mirrored
    if alpha < RESOLVED * dt:
        return float(u + du + min(0.0, forth) - min(0.0, back))
    slope_forth, slope_back = v - (u - w) / alpha - psi, v + (u + w) / alpha + psi
    return float(u + du + _least(slope_forth * dt, forth) - _least(slope_back * dt, back))


@kernel
def _force(u: Array, s: Array, weights: Array, limit: float, pull: float) -> float:
    """Return the integral of f over the springs."""
    total = 0.0
    for j in range(u.size):
        most = limit - s[j]
        total += weights[j] * max(min(u[j] + pull, most), -most)
    return total


@kernel
def _lost(
    old: float, new: float, s: float, drag: tuple[float, float], before: Array, after: Array
) -> tuple[float, float]:
    """Return what slip and its dashpot take from a spring in a step, by the trapezoidal rule.

    `drag` is alpha psi before and after the step.
    """
    most, most_end = before[LIMIT] - s, after[LIMIT] - s
    force = max(min(old + drag[0], most), -most)
    force_end = max(min(new + drag[1], most_end), -most_end)
    rate, rate_end = force - old, force_end - new  # alpha u'
    slip = 0.5 * ((drag[0] - rate) * force + (drag[1] - rate_end) * force_end)
    return slip, 0.5 * (rate * rate + rate_end * rate_end)


@kernel
def integrate(
    psi: float, chi: float, alpha: float, motion: Array, stride: int, history: Array
) -> float:
    """Return psi after contact, kick-drift-kick, with alpha psi in the force of the last kick."""
    x = places(motion, stride)
    s = x * x
    weights, outer = weigh(x)
    u = np.zeros(outer.size)
    force = 0.0
    for i in range(motion.shape[0] - 1):
        before, after = motion[i], motion[i + 1]
        kick, first = 0.5 * (after[AT] - before[AT]) * 3.75 * chi, psi
        half = psi - kick * before[PACE] * force
        du = half * (after[TIME] - before[TIME])
        edge, limit = after[EDGE], after[LIMIT]
        touching = np.searchsorted(x[: u.size], edge)
        inner, last = u[:touching], max(touching - 1, 0)
        old = u.copy() if history.shape[0] > 0 else u
        for j in range(touching):
            inner[j] = _moved(inner[j], s[j], first, du, before, after, alpha)
        whole = weights[last]
        weights[last] += share(x[last], edge) - outer[last]
        rim = share(edge, x[last]) if edge > 0.0 else 0.0  # where u = 0, but not f
        most = max(limit - edge * edge, 0.0)
        psi = half
        for _ in range(MAX_ROUNDS):
            pull, last_psi = alpha * psi, psi
            force = _force(inner, s, weights, limit, pull) + rim * max(min(pull, most), -most)
            psi = half - kick * after[PACE] * force
            if abs(psi - last_psi) <= SETTLED * (1.0 + abs(half)):
                break
        if history.shape[0] > 0:
            row, dt = history[i + 1], after[TIME] - before[TIME]
            row[0], row[1], row[2], row[3] = after[TIME], psi, history[i, 2] + du, force
            row[5], row[6] = history[i, 5], history[i, 6]
            drag = alpha * first, alpha * psi
            for j in range(touching):
                slip, dashpot = _lost(old[j], inner[j], s[j], drag, before, after)
                row[4] += weights[j] * inner[j] * inner[j]
                row[5] += weights[j] * slip * dt / alpha
                row[6] += weights[j] * dashpot * dt / alpha
            for j in range(touching, u.size):  # let go: the dashpot takes what is left
                row[6] += 0.5 * weights[j] * u[j] * u[j]
                u[j] = 0.0
        weights[last] = whole
    return psi
