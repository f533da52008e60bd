"""A standard linear solid in compression, constant Poisson's ratio: its normal motion by springs.

A spring at s = x^2 bears N = d - s + g k, k' = d' - k/theta, from its touch at d = s until N = 0;
then it is let go (no tension). While loading, P = b^3 + g K, K' = (b^3)' - K/theta. Steps are even
in a clock, d(clock) = dt/(2 b), in which the edge grows and recedes at a finite rate. Units of the
elastic impact of the relaxed modulus.
"""

import numpy as np

from carom.dimensionless.lossy.springs.stretch import faded
from carom.dimensionless.lossy.springs.work import (
    DEPTH,
    EDGE,
    LIMIT,
    LOAD,
    NEXT,
    PRESSED,
    RATE,
    SPEED,
    TIME,
    WEIGHT,
    S,
    rim,
)
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

FIRST, GROWTH, ROUNDS = 0.3, 1.5, 60  # of the clock, until the loading ends within it
SETTLED = 1e-14
RESOLVED = 2.0  # steps to a relaxation time, below which a rate is that of the whole step


@kernel
def lay_loading(g: float, theta: float, steps: int, motion: Array) -> float:
    """Fill in the loading, whose last step ends where v = 0; return a step of the clock."""
    near, far, v_near = 0.0, FIRST / steps, 1.0
    v_far = _load(g, theta, far, steps, motion)
    for _ in range(ROUNDS):
        if v_far < 0.0:
            break
        near, v_near, far = far, v_far, GROWTH * far
        v_far = _load(g, theta, far, steps, motion)
    h, side = far, 0
    for _ in range(ROUNDS):  # the Illinois method
        h = (near * v_far - far * v_near) / (v_far - v_near)
        v = _load(g, theta, h, steps, motion)
        if abs(v) < SETTLED:
            break
        if v > 0.0:
            near, v_near = h, v
            v_far *= 0.5 if side == 1 else 1.0
            side = 1
        else:
            far, v_far = h, v
            v_near *= 0.5 if side == -1 else 1.0
            side = -1
    motion[steps, SPEED] = 0.0
    return h


@kernel
def _load(g: float, theta: float, h: float, steps: int, motion: Array) -> float:
    """Fill in so many steps of loading; return the speed after them."""
    b, v, time, kept, load = 0.0, 1.0, 0.0, 0.0, 0.0
    motion[0, TIME], motion[0, DEPTH], motion[0, SPEED] = time, 0.0, v
    motion[0, EDGE], motion[0, LOAD] = b, load
    for i in range(steps):
        middle = v - 1.25 * h * b * load
        edge = b + h * middle
        dt = h * (b + edge)
        left, share, growing = faded(dt, theta)
        change = (middle - 1.25 * h * edge * load) * edge - v * b
        kept = kept * left + (edge**3 - b**3) * share + 1.5 * growing * change
        b, time, load = edge, time + dt, edge**3 + g * kept
        v = middle - 1.25 * h * b * load
        motion[i + 1, TIME], motion[i + 1, DEPTH], motion[i + 1, SPEED] = time, b * b, v
        motion[i + 1, EDGE], motion[i + 1, LOAD] = b, load
    return v


@kernel
def press(g: float, theta: float, before: Array, after: Array, springs: Array, count: int) -> None:
    """Fill in what springs bear before and after a step, and its rate before."""
    dt = after[TIME] - before[TIME]
    left, share, growing = faded(dt, theta)
    grown = (after[DEPTH] - before[DEPTH]) * share + growing * (after[SPEED] - before[SPEED])
    for j in range(count):
        springs[RATE, j] = (1.0 + g) * before[SPEED] - g * springs[PRESSED, j] / theta
        springs[PRESSED, j] = springs[PRESSED, j] * left + grown
        springs[LIMIT, j] = springs[NEXT, j]
        springs[NEXT, j] = after[DEPTH] - springs[S, j] + g * springs[PRESSED, j]
    if theta < RESOLVED * dt:
        for j in range(count):
            springs[RATE, j] = (springs[NEXT, j] - springs[LIMIT, j]) / dt


@kernel
def unload(
    g: float, theta: float, h: float, before: Array, after: Array, springs: Array, last: int
) -> int:
    """Fill in the motion after a step of unloading; return how many springs still bear."""
    dt = 2.0 * before[EDGE] * h
    middle = before[SPEED] - 0.625 * dt * before[LOAD]
    after[TIME], after[DEPTH] = before[TIME] + dt, before[DEPTH] + dt * middle
    after[SPEED] = middle - 0.625 * dt * before[LOAD]  # until the load is known
    press(g, theta, before, after, springs, last + 1)
    count = 0
    for j in range(last):
        if springs[NEXT, j] <= 0.0:
            break
        count = j + 1
    if count == 0:
        return 0
    inner, outer = count - 1, count
    part = springs[NEXT, inner] / (springs[NEXT, inner] - springs[NEXT, outer])
    after[EDGE] = np.sqrt(springs[S, inner] + part * (springs[S, outer] - springs[S, inner]))
    after[LOAD] = 1.5 * rim(springs, inner, after[EDGE]) * springs[NEXT, inner]
    for j in range(count):
        after[LOAD] += 1.5 * springs[WEIGHT, j] * springs[NEXT, j]
    after[SPEED] = middle - 0.625 * dt * after[LOAD]
    return count


@kernel
def end(before: Array, after: Array, springs: Array) -> None:
    """Cut the last step where the spring at the centre lets go; its load is next to nothing."""
    part = springs[LIMIT, 0] / (springs[LIMIT, 0] - springs[NEXT, 0])
    after[TIME] = before[TIME] + part * (after[TIME] - before[TIME])
    after[DEPTH] = before[DEPTH] + part * (after[DEPTH] - before[DEPTH])
    after[SPEED], after[EDGE], after[LOAD] = before[SPEED], 0.0, 0.0


@kernel
def stored(g: float, edge: float, springs: Array, count: int) -> float:
    """Return the energy in springs in compression, both branches, of m_n V_1^2/2."""
    total = 0.0
    for j in range(count):
        k = springs[PRESSED, j]
        w = springs[NEXT, j] - g * k
        weight = springs[WEIGHT, j] + (rim(springs, j, edge) if j == count - 1 else 0.0)
        total += weight * (w * w + g * k * k)
    return 1.875 * total
