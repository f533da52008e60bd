"""The work of slip in one straight step of a load path, in closed form."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.load_paths.memory import RADIUS, RIM, SHIFT, SLOPE, ring_square, shift_at
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

NODES = np.array([-np.sqrt(0.6), 0.0, np.sqrt(0.6)])  # Gauss: exact for degree 5 in the radius
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9.0


class Step(NamedTuple):
    """A straight step: d and U before and after."""

    d0: float
    u0: float
    d1: float
    u1: float


@kernel
def work_in(stack: Array, k: int, low: float, high: float, sign: int, step: Step) -> float:
    """Return the work of slip of this sign from radius low to high in annulus k.

    A spring slips from F(s) = l(t0) until the end t1 of the step or of its contact:
    w(s) = (l0 - l1) * integral of (d - s) dt, quadratic in s where F and t1 are linear.
    """
    before, after = step.d0 - sign * step.u0, step.d1 - sign * step.u1
    fall, deepening = before - after, step.d1 - step.d0
    if high <= low or fall <= 0.0:
        return 0.0
    middle, half, total = 0.5 * (high + low), 0.5 * (high - low), 0.0
    for n in range(NODES.size):
        s = (middle + half * NODES[n]) ** 2
        start = (before - s - sign * shift_at(stack, k, s)) / fall
        end = 1.0
        if s > step.d1 and deepening < 0.0:  # by rounding also where nothing leaves
            end = min(max((s - step.d0) / deepening, 0.0), 1.0)
        start = min(max(start, 0.0), end)
        mean = step.d0 + 0.5 * deepening * (start + end) - s
        total += WEIGHTS[n] * fall * (end - start) * mean
    return half * total


@kernel
def work_within(stack: Array, i: int, s: float, j: int, sign: int, step: Step) -> float:
    """Return the work of slip between the front at s in annulus i and the edge in annulus j."""
    front, rim, total = np.sqrt(s), np.sqrt(min(step.d0, step.d1)), 0.0
    for k in range(max(i, 1), j + 1):
        low, high = max(stack[k - 1, RADIUS], front), min(stack[k, RADIUS], rim)
        total += work_in(stack, k, low, high, sign, step)
    return total


@kernel
def work_leaving(stack: Array, j: int, top: int, step: Step) -> float:
    """Return the work of slip of the springs that leave the contact in a step.

    Which sign slips is that of the deflection with which a spring would leave if it stuck; it is
    linear in s on each annulus.
    """
    if step.d1 == step.d0:
        return 0.0
    edge, total = max(step.d1, 0.0), 0.0
    drift = (step.u1 - step.u0) / (step.d1 - step.d0)
    for k in range(max(j, 1), top + 1):
        inner, g = stack[k - 1, RIM], stack[k, SLOPE]
        low, high = max(inner, edge), stack[k, RIM]
        at_low = step.u1 + drift * (low - step.d1) + stack[k - 1, SHIFT] - g * (low - inner)
        at_high = at_low + (drift - g) * (high - low)
        turn = high
        if at_low * at_high < 0.0:
            turn = low + (high - low) * at_low / (at_low - at_high)
        sign = 1 if at_low > 0.0 or (at_low == 0.0 and at_high > 0.0) else -1
        middle = np.sqrt(turn)
        total += work_in(stack, k, np.sqrt(low), middle, sign, step)
        total += work_in(stack, k, middle, stack[k, RADIUS], -sign, step)
    return total


@kernel
def work_on_new(step: Step) -> float:
    """Return the work of slip on contact that is laid in a step: as above, from touch to end."""
    rise = step.d1 - step.d0
    fall = abs(step.u1 - step.u0) - rise
    return 0.5 * fall / rise * ring_square(np.sqrt(step.d0), np.sqrt(step.d1))
