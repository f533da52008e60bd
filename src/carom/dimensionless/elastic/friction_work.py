"""The work of friction per area of the contact, over a whole impact.

Where the contact slips the traction is mu p, and the slip rate is that of a punch, so that at a
distance r from the centre the work per area is W_0 - lambda W_2 cos 2 theta with

    W_i(r) = integral |psi - sigma v| sqrt(d - r^2) w_i(a, r) dt,   dt = 2 b d(tau),

w_i those of `slip_shape`. The integrand has square roots where the front passes r, where the edge
touches r and where it leaves r; h = low + (high - low) sin^2(phi) removes those at both ends.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.elastic import motion as at
from carom.dimensionless.elastic.dense_output import position
from carom.dimensionless.elastic.integration import evaluate, value_and_slope
from carom.dimensionless.elastic.motion import Series
from carom.dimensionless.elastic.phases import GROSS, RETRACED
from carom.dimensionless.elastic.record import CLOCK, MODE, SIGN, STEP, STRETCH
from carom.dimensionless.elastic.slip import touch
from carom.dimensionless.fields.surface import slip_shape
from carom.dimensionless.numerics.arrays import Array, Cube, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(12)
MANY_ABSCISSAS, MANY_WEIGHTS = np.polynomial.legendre.leggauss(32)
FAST = 0.8  # speed beyond which gross slip is integrated over the radius of the contact
WIDE = float((1.0 - FAST**2) ** 0.2)  # that radius there
# Panels grow by this factor from the narrowest, which is not narrower than the second number.
GROWTH, NARROWEST = 3.0, 1e-3
LEVELS = 8
NEVER = 1e9
ALIKE = 1e-12  # radii nearer to each other are one


class SlipRate(NamedTuple):
    """The rate of gross slip, linear in the normal speed: at a speed, and how it grows with it."""

    start: float
    speed: float
    slope: float


@kernel
def near_touch(rate_at: SlipRate, r: float, side: float, inner: float, outer: float) -> float:
    """Return the work in gross slip between two radii of the contact, far from the turning point.

    u^2 = b^2 - r^2 makes the integrand smooth.
    """
    first, last = np.sqrt(max(inner * inner - r * r, 0.0)), np.sqrt(max(outer * outer - r * r, 0.0))
    total, half = 0.0, 0.5 * (last - first)
    for k in range(MANY_ABSCISSAS.size):
        u = first + half * (1.0 + MANY_ABSCISSAS[k])
        d = r * r + u * u
        speed = np.sqrt(max(1.0 - d * d * np.sqrt(d), 0.0))
        rate = rate_at.start - rate_at.slope * (rate_at.speed - side * speed)
        total += half * MANY_WEIGHTS[k] * 2.0 * u * u / speed * rate
    return float(total)


@kernel
def near_turning(rate_at: SlipRate, r: float, fast: float, slow: float) -> float:
    """Return the work in gross slip between two speeds around the turning point."""
    r5 = r**5
    limit = np.sqrt(max(1.0 - r5, 0.0))  # at which the edge touches r
    fast, slow = min(fast, limit), max(slow, -limit)
    if fast <= slow:
        return 0.0
    first, last = np.arcsin(slow / limit), np.arcsin(fast / limit)
    total, half = 0.0, 0.5 * (last - first)
    for k in range(MANY_ABSCISSAS.size):
        phi = first + half * (1.0 + MANY_ABSCISSAS[k])
        v, cosine = limit * np.sin(phi), np.cos(phi)
        d5 = (limit * cosine) ** 2  # less r^5
        above = max((r5 + d5) ** 0.4 - r * r, 0.0)
        rate = rate_at.start - rate_at.slope * (rate_at.speed - v)
        pace = 0.8 * (r5 + d5) ** -0.6 * limit * cosine
        total += half * MANY_WEIGHTS[k] * np.sqrt(above) * pace * rate
    return float(total)


@kernel
def work_in_gross_slip(
    rate_at: SlipRate, r: float, b0: float, v0: float, b1: float, v1: float
) -> float:
    """Return the work per area of gross slip from one state of the contact to another."""
    total = 0.0
    if v0 > FAST and r < WIDE:
        total += near_touch(rate_at, r, 1.0, b0, WIDE if v1 < FAST else b1)
    if v0 > -FAST and v1 < FAST:
        total += near_turning(rate_at, r, min(v0, FAST), max(v1, -FAST))
    if v1 < -FAST and r < WIDE:
        total += near_touch(rate_at, r, -1.0, b1, WIDE if v0 > -FAST else b0)
    return total


@kernel
def slipping(node: Array, series: Series, r: float) -> tuple[float, float]:
    """Return from where to where in a step points at r are in the slip ring."""
    low, high = 0.0, node[STEP]
    if series[0, at.A] > r:
        if evaluate(series[:, at.A], high) >= r:
            return 0.0, 0.0
        low = position(node, series, at.A, r, True)
    outer, speed = evaluate(series[:, at.B], high), evaluate(series[:, at.V], high)
    if series[0, at.B] < r:
        if series[0, at.V] <= 0.0 or (outer < r and speed > 0.0):
            return 0.0, 0.0
        low = max(low, touch(node, series, r))
    if outer < r and speed < 0.0:
        if r < 0.8:
            high = position(node, series, at.B, r, True)
        else:
            high = position(node, series, at.V, -np.sqrt(max(1.0 - r**5, 0.0)), True)
    return low, high


@kernel
def room(node: Array, series: Series, r: float, h: float, side: float, own: float) -> float:
    """Return how far beyond an end of the slip of r the nearest other root is, in h, roughly.

    On the side of the start the front passes r, or the edge touches r; on that of the end the front
    as it would go on beyond the centre passes -r, or the edge leaves r.
    """
    a, a_rate = value_and_slope(series[:, at.A], h)
    b, v = evaluate(series[:, at.B], h), evaluate(series[:, at.V], h)
    pace = evaluate(series[:, at.SLOWER], h) if node[CLOCK] == at.FRONT else 1.0
    to_front = (r - side * a) / max(-a_rate, 1.0 / NEVER)
    if r < 0.8:
        to_edge = (b - r) / max(side * v * pace, 1.0 / NEVER)
    else:
        limit = np.sqrt(max(1.0 - r**5, 0.0))
        to_edge = abs(limit - side * v) / max(2.5 * b**4 * pace, 1.0 / NEVER)
    nearer, farther = min(to_front, to_edge), max(to_front, to_edge)
    return float(farther if nearer <= own else nearer)


@kernel
def work_in_ring(node: Array, series: Series, r: float) -> tuple[float, float]:
    """Return the radial functions of the work per area in a step of a slip ring."""
    low, high = slipping(node, series, r)
    length = high - low
    if length <= 0.0:
        return 0.0, 0.0
    mean, lateral = 0.0, 0.0
    for end in range(2):
        place, side = (low, 1.0) if end == 0 else (high, -1.0)
        beyond = room(node, series, r, place, side, 1e-9 * length)
        outer = min(max(np.sqrt(beyond / length), NARROWEST), 0.25 * np.pi)
        inner = 0.0
        for _ in range(LEVELS):
            half = 0.5 * (outer - inner)
            for k in range(ABSCISSAS.size):
                phi = inner + half * (1.0 + ABSCISSAS[k])
                sine = np.sin(phi)
                h = place + side * length * sine * sine
                one, two = power(node, series, r, h)
                weight = half * WEIGHTS[k] * 2.0 * length * sine * np.cos(phi)
                mean += weight * one
                lateral += weight * two
            if outer >= 0.25 * np.pi:
                break
            inner, outer = outer, min(GROWTH * outer, 0.25 * np.pi)
    return mean, lateral


@kernel
def power(node: Array, series: Series, r: float, h: float) -> tuple[float, float]:
    """Return the radial functions of the work per area and per h, at a place of a step."""
    b = evaluate(series[:, at.B], h)
    rate = evaluate(series[:, at.SLOWER], h) if node[CLOCK] == at.FRONT else 1.0
    excess = node[SIGN] * evaluate(series[:, at.PSI], h) - evaluate(series[:, at.V], h)
    one, two = slip_shape(evaluate(series[:, at.A], h), r)
    unit = 2.0 * b * rate * excess * np.sqrt(max((b - r) * (b + r), 0.0))
    return unit * one, unit * two


@kernel
def work_in_step(nodes: Matrix, series: Cube, chi: float, i: int, r: float) -> tuple[float, float]:
    """Return the radial functions of the work per area in a step, none in stick."""
    if nodes[i, MODE] in (at.STICK, RETRACED):
        return 0.0, 0.0
    if nodes[i, MODE] != GROSS:
        return work_in_ring(nodes[i], series[i], r)
    b, v, sign = series[i, 0, at.B], series[i, 0, at.V], nodes[i, SIGN]
    rate_at = SlipRate(sign * series[i, 0, at.PSI] - v, v, 2.0 * chi - 1.0)
    if i + 1 == nodes.shape[0]:
        return work_in_gross_slip(rate_at, r, b, v, 0.0, -1.0), 0.0
    return work_in_gross_slip(rate_at, r, b, v, series[i + 1, 0, at.B], series[i + 1, 0, at.V]), 0.0


@entry_point()
def work(nodes: Matrix, series: Cube, chi: float, radii: Vector, out: Matrix) -> None:
    """Write the radial functions of the work per area over the whole impact for each radius."""
    for row in range(radii.size):
        mean, lateral = 0.0, 0.0
        for i in range(nodes.shape[0] if radii[row] < 1.0 else 0):
            one, two = work_in_step(nodes, series, chi, i, radii[row])
            mean += one
            lateral += two
        out[row, 0], out[row, 1] = mean, lateral


@entry_point()
def pressed(radii: Vector, out: Vector) -> None:
    """Write the integral of the pressure over the whole impact for each radius."""
    for row in range(radii.size):
        steady = SlipRate(1.0, 0.0, 0.0)
        inside = radii[row] < 1.0
        out[row] = work_in_gross_slip(steady, radii[row], 0.0, 1.0, 0.0, -1.0) if inside else 0.0


def borders(nodes: Array, series: Array) -> Array:
    """Return radii between which the work is smooth: fronts at all steps, edges where rings begin.

    Steps are short where the front is about to stop, beside which the work has a steep flank.
    """
    rings = np.flatnonzero((nodes[:, MODE] == at.LAID) | (nodes[:, MODE] == at.FLAT))
    new = np.flatnonzero(np.diff(nodes[:, STRETCH], prepend=-1.0))
    found = [0.0, 1.0, *series[new, 0, at.B], *series[rings, 0, at.A]]
    for i in np.intersect1d(rings, np.append(new[1:], len(nodes)) - 1):
        found += [evaluate(series[i][:, column], nodes[i, STEP]) for column in (at.A, at.B)]
    radii = np.unique(np.clip(found, 0.0, 1.0))
    return np.asarray(radii[np.append(np.diff(radii) > ALIKE, True)])
