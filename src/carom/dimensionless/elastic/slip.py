"""How far facing points have slid on each other since they met, and the work of friction there.

Where the contact slips the traction is mu p, and the slip rate is that of a punch, so that at a
distance r from the centre the work per area is W_0 - lambda W_2 cos 2 theta with

    W_i(r) = integral |psi - sigma v| sqrt(d - r^2) w_i(a, r) dt,   dt = 2 b d(tau),

w_i those of `slip_shape`. The integrand has square roots where the front passes r, where the edge
touches r and where it leaves r; h = low + (high - low) sin^2(phi) removes those at both ends.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.elastic import dense_output as dense, motion as at
from carom.dimensionless.elastic.dense_output import pace, place
from carom.dimensionless.elastic.integration import evaluate, value_and_slope
from carom.dimensionless.elastic.phases import GROSS, RETRACED
from carom.dimensionless.elastic.record import MODE, SIGN, STEP, STRETCH, Steps
from carom.dimensionless.fields.surface import slip_shape
from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(10)
AROUND, WEIGHTS_AROUND = np.polynomial.legendre.leggauss(32)
RING_ABSCISSAS, RING_WEIGHTS = np.polynomial.legendre.leggauss(12)
# Slip starts at a point like a root of time: panels grow from there by the inverse of this factor.
SHRINKING, PANELS_OF_SLIP = 0.3, 12
FAST = 0.8  # speed beyond which gross slip is integrated over the radius of the contact
WIDE = float((1.0 - FAST**2) ** 0.2)  # that radius there
GROWTH, NARROWEST, PANELS_OF_WORK = 3.0, 1e-3, 8  # of panels beside the roots of the work
FAR_AWAY = 1e9
ALIKE_RADII = 1e-12  # radii nearer to each other are one


@kernel
def slid_in_gross_slip(steps: Steps, i: int, r: float, b: float, v: float) -> float:
    """Return the slip of a point from the start of gross slip, or from its touch, to b and v."""
    start, sign = steps.series[i, 0, at.B], steps.nodes[i, SIGN]
    u, _w = dense.gross_progress(steps, i, b, v)
    slid = u - sign * (b * b - start * start)
    if r > start:
        touched, _w = dense.gross_progress(steps, i, r, np.sqrt(1.0 - r**5))
        slid -= touched - sign * (r * r - start * start)
    return float(slid)


@kernel
def edge_at(steps: Steps, i: int, r: float, recedes: bool) -> float:
    """Return how far into a step the edge of the contact, growing or receding, is at r."""
    if steps.give > 0.0:
        end, turning = steps.nodes[i, STEP], 0.0
        if evaluate(steps.series[i][:, at.V], end) > 0.0:
            turning = end
        elif steps.series[i, 0, at.V] > 0.0:
            turning = dense.position(steps, i, at.V, 0.0, True)
        low, high = (turning, end) if recedes else (0.0, turning)
        return float(dense.position_between(steps, i, at.B, r, recedes, low, high))
    if r < 0.8:
        return float(dense.position(steps, i, at.B, r, recedes))
    speed = np.sqrt(max(1.0 - r**5, 0.0))  # monotone where the step goes beyond the turning point
    return float(dense.position(steps, i, at.V, -speed if recedes else speed, True))


@entry_point()
def touched(steps: Steps, radii: Vector, out: Vector) -> None:
    """Write when the edge of the growing contact touches radii, on a plate."""
    for row in range(radii.size):
        for i in range(steps.times.size):
            outer = evaluate(steps.series[i][:, at.B], steps.nodes[i, STEP])
            turns = evaluate(steps.series[i][:, at.V], steps.nodes[i, STEP]) <= 0.0
            if outer >= radii[row] or turns:
                h = edge_at(steps, i, radii[row], False)
                out[row] = steps.times[i] + dense.elapsed(steps, i, h)
                break


@kernel
def slid_in_ring(steps: Steps, i: int, r: float, h_end: float) -> tuple[float, float]:
    """Return the radial functions of the slip of a point from the start of a step to h_end."""
    series, h0 = steps.series[i], 0.0
    if series[0, at.A] > r:
        if evaluate(series[:, at.A], h_end) >= r:
            return 0.0, 0.0
        h0 = dense.position(steps, i, at.A, r, True)
    if series[0, at.B] < r and series[0, at.V] > 0.0:
        h0 = max(h0, edge_at(steps, i, r, False))
    mean, lateral = 0.0, 0.0
    high = h_end
    for level in range(PANELS_OF_SLIP):
        low = h0 + (high - h0) * SHRINKING if level < PANELS_OF_SLIP - 1 else h0
        for k in range(ABSCISSAS.size):
            h = low + 0.5 * (high - low) * (1.0 + ABSCISSAS[k])
            sign_v = steps.nodes[i, SIGN] * evaluate(series[:, at.V], h)
            excess = evaluate(series[:, at.PSI], h) - sign_v
            rate = pace(steps, i, h)
            w = (high - low) * WEIGHTS[k] * rate * evaluate(series[:, at.B], h) * excess
            one, two = slip_shape(evaluate(series[:, at.A], h), r)
            mean += w * one
            lateral += w * two
        high = low
    return mean, lateral


@entry_point()
def slid(
    steps: Steps, last: int, time: float, b: float, v: float, radii: Vector, out: Matrix
) -> None:
    """Write the radial functions of the slip up to step `last` at radii r <= b, zero at others."""
    series, h_last = steps.series, 0.0
    if steps.give > 0.0:
        h_last = dense.reached(steps, last, time - steps.times[last])
    elif steps.nodes[last, MODE] != RETRACED:
        h_last = place(steps, last, b, v)
    for row in range(radii.size):
        r = radii[row]
        out[row, 0], out[row, 1] = 0.0, 0.0
        if r > b:
            continue
        for i in range(last + 1):
            mode = steps.nodes[i, MODE]
            if mode in (at.STICK, RETRACED):
                continue
            b_end = series[i + 1, 0, at.B] if i < last else b
            v_end = series[i + 1, 0, at.V] if i < last else v
            if v_end > 0.0 and b_end < r:
                continue  # not yet touched
            if mode == GROSS:
                out[row, 0] += slid_in_gross_slip(steps, i, r, b_end, v_end)
            else:
                h_end = steps.nodes[i, STEP] if i < last else h_last
                mean, lateral = slid_in_ring(steps, i, r, h_end)
                out[row, 0] += mean
                out[row, 1] += lateral


def directions(front: Array, lateral_ratio: float) -> tuple[Array, Array]:
    """Return frictional power in a slip ring, and that times the angle of slip from the traction.

    For fronts a/b in [0, 1), per unit of slip rate: integral over the ring of sqrt(1 - r^2) w_x,
    and the same times |atan2(lambda w_2 sin 2 theta, w_0 - lambda w_2 cos 2 theta)|.
    """
    phi, theta = 0.5 * np.pi * AROUND, 0.25 * np.pi * (1.0 + AROUND)
    a = np.atleast_1d(front)[:, np.newaxis]
    r = 0.5 * (1.0 + a) + 0.5 * (1.0 - a) * np.sin(phi)
    w = np.sqrt((r - a) * (r + a))
    mean = (2.0 / np.pi * np.arctan2(w, a))[..., np.newaxis]
    lateral = (2.0 / np.pi * lateral_ratio * a * w / r**2)[..., np.newaxis]
    along, across = mean - lateral * np.cos(2.0 * theta), lateral * np.sin(2.0 * theta)
    area = WEIGHTS_AROUND * np.cos(phi) * (1.0 - a) * r * np.sqrt(1.0 - r**2)
    power = area[..., np.newaxis] * WEIGHTS_AROUND * along
    angle = np.abs(np.arctan2(across, along))
    return power.sum((1, 2)), (power * angle).sum((1, 2))


class SlipRate(NamedTuple):
    """The rate of gross slip, linear in the normal speed: at a speed, and how it grows with it."""

    start: float
    speed: float
    slope: float


@kernel
def near_touch(rate_at: SlipRate, r: float, side: float, inner: float, outer: float) -> float:
    """Return the work in gross slip between two radii; u^2 = b^2 - r^2 makes it smooth."""
    first, last = np.sqrt(max(inner * inner - r * r, 0.0)), np.sqrt(max(outer * outer - r * r, 0.0))
    total, half = 0.0, 0.5 * (last - first)
    for k in range(AROUND.size):
        u = first + half * (1.0 + AROUND[k])
        d = r * r + u * u
        speed = np.sqrt(max(1.0 - d * d * np.sqrt(d), 0.0))
        rate = rate_at.start - rate_at.slope * (rate_at.speed - side * speed)
        total += half * WEIGHTS_AROUND[k] * 2.0 * u * u / speed * rate
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
    for k in range(AROUND.size):
        phi = first + half * (1.0 + AROUND[k])
        v, cosine = limit * np.sin(phi), np.cos(phi)
        d5 = (limit * cosine) ** 2  # less r^5
        above = max((r5 + d5) ** 0.4 - r * r, 0.0)
        rate = rate_at.start - rate_at.slope * (rate_at.speed - v)
        pace = 0.8 * (r5 + d5) ** -0.6 * limit * cosine
        total += half * WEIGHTS_AROUND[k] * np.sqrt(above) * pace * rate
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
def slipping(steps: Steps, i: int, r: float, all_slides: bool) -> tuple[float, float]:
    """Return from where to where in a step points at r are in the slip ring, or in the contact."""
    series, low, high = steps.series[i], 0.0, steps.nodes[i, STEP]
    if series[0, at.A] > r and not all_slides:
        if evaluate(series[:, at.A], high) >= r:
            return 0.0, 0.0
        low = dense.position(steps, i, at.A, r, True)
    outer, speed = evaluate(series[:, at.B], high), evaluate(series[:, at.V], high)
    if series[0, at.B] < r:
        if series[0, at.V] <= 0.0 or (outer < r and speed > 0.0):
            return 0.0, 0.0
        low = max(low, edge_at(steps, i, r, False))
    if outer < r and speed < 0.0:
        high = edge_at(steps, i, r, True)
    return low, high


@kernel
def room(steps: Steps, i: int, r: float, h: float, side: float, own: float) -> float:
    """Return how far beyond an end of the slip of r the nearest other root is, in h, roughly.

    On the side of the start the front passes r, or the edge touches r; on that of the end the front
    as it would go on beyond the centre passes -r, or the edge leaves r.
    """
    series, rate = steps.series[i], pace(steps, i, h)
    a, a_rate = value_and_slope(series[:, at.A], h)
    b, v = evaluate(series[:, at.B], h), evaluate(series[:, at.V], h)
    to_front = (r - side * a) / max(-a_rate, 1.0 / FAR_AWAY)
    if r < 0.8 or steps.give > 0.0:
        to_edge = (b - r) / max(side * v * rate, 1.0 / FAR_AWAY)
    else:
        limit = np.sqrt(max(1.0 - r**5, 0.0))
        to_edge = abs(limit - side * v) / max(2.5 * b**4 * rate, 1.0 / FAR_AWAY)
    nearer, farther = min(to_front, to_edge), max(to_front, to_edge)
    return float(farther if nearer <= own else nearer)


@kernel
def work_in_ring(steps: Steps, i: int, r: float, steady: bool) -> tuple[float, float]:
    """Return the work per area in a step of a slip ring; if slip is steady, that at the rate 1."""
    low, high = slipping(steps, i, r, steady)
    length = high - low
    if length <= 0.0:
        return 0.0, 0.0
    mean, lateral = 0.0, 0.0
    for end in range(2):
        place, side = (low, 1.0) if end == 0 else (high, -1.0)
        beyond = room(steps, i, r, place, side, 1e-9 * length)
        outer = min(max(np.sqrt(beyond / length), NARROWEST), 0.25 * np.pi)
        inner = 0.0
        for _ in range(PANELS_OF_WORK):
            half = 0.5 * (outer - inner)
            for k in range(RING_ABSCISSAS.size):
                phi = inner + half * (1.0 + RING_ABSCISSAS[k])
                sine = np.sin(phi)
                h = place + side * length * sine * sine
                one, two = power(steps, i, r, h, steady)
                weight = half * RING_WEIGHTS[k] * 2.0 * length * sine * np.cos(phi)
                mean += weight * one
                lateral += weight * two
            if outer >= 0.25 * np.pi:
                break
            inner, outer = outer, min(GROWTH * outer, 0.25 * np.pi)
    return mean, lateral


@kernel
def power(steps: Steps, i: int, r: float, h: float, steady: bool) -> tuple[float, float]:
    """Return the radial functions of the work per area and per h, at a place of a step."""
    series, rate = steps.series[i], pace(steps, i, h)
    b = evaluate(series[:, at.B], h)
    excess = steps.nodes[i, SIGN] * evaluate(series[:, at.PSI], h) - evaluate(series[:, at.V], h)
    one, two = slip_shape(evaluate(series[:, at.A], h), r)
    if steady:
        excess, one, two = 1.0, 1.0, 0.0
    unit = 2.0 * b * rate * excess * np.sqrt(max((b - r) * (b + r), 0.0))
    return unit * one, unit * two


@kernel
def work_in_step(steps: Steps, i: int, r: float) -> tuple[float, float]:
    """Return the radial functions of the work per area in a step, none in stick."""
    nodes, series = steps.nodes, steps.series
    if nodes[i, MODE] in (at.STICK, RETRACED):
        return 0.0, 0.0
    if nodes[i, MODE] != GROSS:
        return work_in_ring(steps, i, r, False)
    b, v, sign = series[i, 0, at.B], series[i, 0, at.V], nodes[i, SIGN]
    rate_at = SlipRate(sign * series[i, 0, at.PSI] - v, v, 2.0 * steps.chi - 1.0)
    if i + 1 == nodes.shape[0]:
        return work_in_gross_slip(rate_at, r, b, v, 0.0, -1.0), 0.0
    return work_in_gross_slip(rate_at, r, b, v, series[i + 1, 0, at.B], series[i + 1, 0, at.V]), 0.0


@entry_point()
def work(steps: Steps, radii: Vector, out: Matrix) -> None:
    """Write the radial functions of the work per area over the whole impact for each radius."""
    for row in range(radii.size):
        mean, lateral = 0.0, 0.0
        for i in range(steps.times.size if radii[row] < 1.0 else 0):
            one, two = work_in_step(steps, i, radii[row])
            mean += one
            lateral += two
        out[row, 0], out[row, 1] = mean, lateral


@entry_point()
def pressed(steps: Steps, radii: Vector, out: Vector) -> None:
    """Write the integral of the pressure over the whole impact for each radius."""
    steady = SlipRate(1.0, 0.0, 0.0)
    for row in range(radii.size):
        out[row] = 0.0
        if steps.give == 0.0 and radii[row] < 1.0:
            out[row] = work_in_gross_slip(steady, radii[row], 0.0, 1.0, 0.0, -1.0)
        for i in range(steps.times.size if steps.give > 0.0 else 0):
            out[row] += work_in_ring(steps, i, radii[row], True)[0]


def borders(steps: Steps, widest: float) -> Array:
    """Return radii between which the work is smooth: fronts at all steps, edges of new rings."""
    nodes, series = steps.nodes, steps.series
    rings = np.flatnonzero((nodes[:, MODE] == at.LAID) | (nodes[:, MODE] == at.FLAT))
    new = np.flatnonzero(np.diff(nodes[:, STRETCH], prepend=-1.0))
    radii = [0.0, widest, *series[new, 0, at.B], *series[rings, 0, at.A]]
    for i in np.intersect1d(rings, np.append(new[1:], len(nodes)) - 1):
        radii += [evaluate(series[i][:, column], nodes[i, STEP]) for column in (at.A, at.B)]
    borders = np.unique(np.clip(radii, 0.0, widest))
    return np.asarray(borders[np.append(np.diff(borders) > ALIKE_RADII, True)])
