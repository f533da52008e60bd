"""The oblique impact of elastic bodies by marching in time over springs.

The method of Maw, Barber & Fawcett (1976), Wear 38:101-114, a check on the exact solution that
shares nothing with it: the contact is cut into annuli, time into steps, and in every step each
annulus sticks or slips by its own Coulomb limit. Of the Abel-transformed traction each annulus is
one tangential spring of deflection q(x), so that the annuli do not act on one another:

    d'' = -(5/4) d^(3/2),  U' = psi,  psi' = -(15/4) chi Q,  Q = integral of q dx from 0 to sqrt(d),
    q' = psi, but |q| <= d - x^2.

Units: d and x^2 in d_max, time in d_max/V_1, U and q in mu d_max/kappa, psi in mu V_1/kappa. Steps
and springs are uniform in the angle theta of the contact radius b = sin(theta), 0 <= theta <= pi:
every spring is met and released at the end of a step, and U is smooth up to the turning point.
"""

from collections.abc import Iterable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless import hertz
from carom.dimensionless._jit import kernel

Array = NDArray[np.float64]
Labels = NDArray[np.int8]
Phase = tuple[str, int, float, float]

AT_LIMIT = 1e-12  # a spring nearer than this to Coulomb's limit slips; above rounding of q
KINDS = ("stick", "slip", "gross slip")
RESOLUTION = 10.0  # of time, in units of 1/springs: about five springs met or released


@kernel
def _share(near: float, far: float) -> float:
    """Return the weight at `near` of the integral to `far` of a q linear in x^2."""
    return abs(far - near) * (2.0 * far + near) / (3.0 * (far + near))


@kernel
def _springs(springs: int) -> tuple[Array, Array, Array]:
    """Return places x and weights of the springs, and what a last spring's weight loses.

    The weights integrate a q that is linear in x^2 between the springs, as in slip.
    """
    x = np.sin(np.arange(springs + 1) * (0.5 * np.pi / springs))
    outer = np.empty(springs)
    weights = np.zeros(springs)
    for j in range(springs):
        outer[j] = _share(x[j], x[j + 1])
        weights[j] = outer[j] + (_share(x[j], x[j - 1]) if j > 0 else 0.0)
    return x[:springs].copy(), weights, outer


@kernel
def _normal_motion(steps: int) -> Array:
    """Return time, d, v and dt/dtheta at the ends of the steps, shape (steps + 1, 4).

    v^2 = 1 - b^5 is divided by 1 - b^2, so that the turning point is regular.
    """
    rows = np.empty((steps + 1, 4))
    for i in range(steps + 1):
        b = np.sin(min(i, steps - i) * (np.pi / steps))
        quotient = (1.0 + b * (1.0 + b * (1.0 + b * (1.0 + b)))) / (1.0 + b)
        v = np.cos(i * (np.pi / steps)) * np.sqrt(quotient)
        rows[i] = hertz.time(b * b, v), b * b, v, 2.0 * b / np.sqrt(quotient)
    return rows


@kernel
def _lowest(start: float, slope: float, end: float) -> float:
    """Return the least value, its start apart, of a parabola on [0, 1].

    Slip that stops within a step leaves the springs at the limit of that moment; without it the
    error would depend on where in the step slip stops.
    """
    curvature = end - start - slope
    if slope < 0.0 and -slope < 2.0 * curvature:
        return start - slope * slope / (4.0 * curvature)
    return end


@kernel
def _stretch(q: Array, s: Array, weights: Array, step: float, upper: float, lower: float) -> float:
    """Move the springs by `step` within Coulomb's limits and return their force."""
    force = 0.0
    for j in range(q.size):
        q[j] = max(min(q[j] + step, upper - s[j]), s[j] - lower)
        force += weights[j] * q[j]
    return force


@kernel
def _label(q: Array, s: Array, d: float) -> int:
    """Return 0 in stick, else the sign of slip: times 1 if some springs slip, 2 if all do."""
    last = q.size - 1
    sign = 1 if q[last] > 0.0 else -1
    for slipping in range(q.size):
        j = last - slipping
        if d - s[j] - sign * q[j] > AT_LIMIT:
            return sign if slipping > 0 else 0
    return 2 * sign


@kernel
def _integrate(psi: float, chi: float, springs: int, steps: int, labels: Labels) -> float:
    """Return psi after contact, kick-drift-kick; fill `labels` unless it is empty."""
    x, weights, outer = _springs(springs)
    s = x * x
    normal = _normal_motion(steps)
    per_spring = steps // (2 * springs)
    q = np.zeros(springs)
    u, force = 0.0, 0.0
    for i in range(steps):
        t, d, v, clock = normal[i]
        t_end, d_end, _, clock_end = normal[i + 1]
        kick = np.pi / (2 * steps) * 3.75 * chi
        dt, old = t_end - t, psi
        psi -= kick * clock * force
        step = psi * dt
        to_upper = _lowest(d - u, (v - old) * dt, d_end - u - step)
        to_lower = _lowest(d + u, (v + old) * dt, d_end + u + step)
        u += step
        touching = -(-min(i + 1, steps - i - 1) // per_spring)
        inner = q[:touching]
        force = _stretch(inner, s, weights, step, u + to_upper, to_lower - u)
        if touching > 0:
            last = touching - 1
            force += (_share(x[last], np.sqrt(d_end)) - outer[last]) * q[last]
            if labels.size > 0:
                labels[i + 1] = _label(inner, s, d_end)
        psi -= kick * clock_end * force
    return psi


def _check(psi: float, chi: float, springs: int, steps: int) -> None:
    if not np.isfinite(psi):
        raise ValueError(f"psi: {psi:g} is not finite")
    if not 0.0 < chi < np.inf:
        raise ValueError(f"chi: {chi:g} is not positive and finite")
    if springs < 1:
        raise ValueError(f"springs: {springs} is not positive")
    if steps < 1 or steps % (2 * springs):
        raise ValueError(f"steps: {steps} is not a multiple of 2 springs, {2 * springs}")


def march(psi: float, chi: float, springs: int = 500, steps: int = 2000) -> float:
    """Return psi_2, the tangential velocity after the impact, to second order in both steps.

    psi_2 = psi_1 - (15/4) chi integral of Q dt

    Dimensionless scalars. With four steps a spring the error is about 0.3/springs^2 for chi in
    [1.1, 1.8]; it grows with chi. Raises ValueError if psi is not finite, chi not positive, or
    `steps` not a multiple of 2 `springs`. Maw, Barber & Fawcett (1976), Wear 38:101-114.

    >>> round(march(4.0, 0.5), 9)
    2.0
    """
    _check(psi, chi, springs, steps)
    return float(_integrate(float(psi), float(chi), springs, steps, np.empty(0, np.int8)))


def extrapolated(psi: float, chi: float, springs: int = 4000, steps: int = 16000) -> float:
    """Return psi_2 by Richardson extrapolation over halved, hence even, `springs` and `steps`.

    psi_2 = (4 march(springs, steps) - march(springs/2, steps/2))/3

    Dimensionless scalars. What is left is of second order too, but small and irregular: a front
    that stops between two springs leaves a kink in q there. Raises ValueError as `march` does,
    or if `springs` is odd. Richardson (1911), Phil. Trans. A 210:307-357.

    >>> round(extrapolated(0.3, 4.0), 6)
    -0.3
    """
    if springs % 2:
        raise ValueError(f"springs: {springs} is odd")
    fine = march(psi, chi, springs, steps)
    return (4.0 * fine - march(psi, chi, springs // 2, steps // 2)) / 3.0


def resolution(springs: int) -> float:
    """Return the length, in d_max/V_1, of the shortest phase that so many springs tell."""
    return RESOLUTION / springs


def resolved(phases: Iterable[Phase], shortest: float) -> list[Phase]:
    """Leave out phases shorter than `shortest`, their time to the next, and join equal neighbours.

    Times in d_max/V_1.

    >>> resolved([("slip", 1, 0.0, 1.0), ("stick", 0, 1.0, 1.1), ("slip", -1, 1.1, 2.9)], 0.2)
    [('slip', 1, 0.0, 1.0), ('slip', -1, 1.0, 2.9)]
    """
    kept: list[Phase] = []
    stop = 0.0
    for kind, sign, start, stop in phases:
        if kept and kept[-1][:2] == (kind, sign):
            kept[-1] = (kind, sign, kept[-1][2], stop)
        elif stop - start >= shortest:
            kept.append((kind, sign, kept[-1][3] if kept else 0.0, stop))
    if kept:
        kept[-1] = (*kept[-1][:3], stop)
    return kept


def march_phases(psi: float, chi: float, springs: int = 500, steps: int = 2000) -> list[Phase]:
    """Return the phases in order of time as (kind, sign of slip, start, end).

    kind is "stick" (sign 0), "slip" (in a ring) or "gross slip"; times in d_max/V_1. A ring is
    seen once a spring slips in it, and phases shorter than `resolution(springs)` are left out.
    Stick that seems to begin while unloading is a ring not yet seen, and goes to the next phase:
    at the receding edge Coulomb's two limits fall together, and one of them must be met. Raises
    ValueError as `march` does. Maw, Barber & Fawcett (1976), Wear 38:101-114.

    >>> [(kind, sign) for kind, sign, start, end in march_phases(0.5, 1.44)]
    [('stick', 0), ('slip', -1), ('gross slip', -1)]
    """
    _check(psi, chi, springs, steps)
    labels = np.zeros(steps + 1, np.int8)
    _integrate(float(psi), float(chi), springs, steps, labels)
    times = _normal_motion(steps)[:, 0]
    changes = np.flatnonzero(np.diff(labels[1:steps])) + 1
    bounds = [0.0, *(0.5 * (times[changes] + times[changes + 1])).tolist(), hertz.DURATION]
    firsts = [1, *(changes + 1).tolist()]
    runs = [
        (KINDS[abs(labels[first])], int(np.sign(labels[first])), start, end)
        for first, (start, end) in zip(firsts, pairwise(bounds), strict=True)
        if labels[first] or 2 * first <= steps
    ]
    return resolved(runs, resolution(springs))
