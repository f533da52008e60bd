"""How far facing points have slid on each other since they met, and in which direction."""

import numpy as np

from carom.dimensionless.elastic.dense_output import gross_progress, position
from carom.dimensionless.elastic.integration import evaluate
from carom.dimensionless.elastic.motion import FRONT, PSI, SLOWER, STICK, A, B, Series, V
from carom.dimensionless.elastic.phases import GROSS, RETRACED
from carom.dimensionless.elastic.record import CLOCK, MODE, SIGN, STEP
from carom.dimensionless.fields.surface import slip_shape
from carom.dimensionless.numerics.arrays import Array, Cube, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(10)
AROUND, WEIGHTS_AROUND = np.polynomial.legendre.leggauss(32)
# Slip starts at a point like a root of time: panels grow from there by this factor.
GROWTH = 0.3
LEVELS = 12


@kernel
def slid_in_gross_slip(
    node: Array, series: Series, chi: float, r: float, b: float, v: float
) -> float:
    """Return the slip of a point from the start of gross slip, or from its touch, to b and v."""
    start, sign = series[0, B], node[SIGN]
    u, _w = gross_progress(node, series, chi, b, v)
    slid = u - sign * (b * b - start * start)
    if r > start:
        touched, _w = gross_progress(node, series, chi, r, np.sqrt(1.0 - r**5))
        slid -= touched - sign * (r * r - start * start)
    return float(slid)


@kernel
def touch(node: Array, series: Series, r: float) -> float:
    """Return how far into a step the edge of the growing contact reaches r."""
    if r < 0.8:
        return float(position(node, series, B, r, False))
    speed = np.sqrt(max(1.0 - r**5, 0.0))  # monotone where the step goes beyond the turning point
    return float(position(node, series, V, speed, True))


@kernel
def slid_in_ring(node: Array, series: Series, r: float, h_end: float) -> tuple[float, float]:
    """Return the radial functions of the slip of a point from the start of a step to h_end."""
    h0 = 0.0
    if series[0, A] > r:
        if evaluate(series[:, A], h_end) >= r:
            return 0.0, 0.0
        h0 = position(node, series, A, r, True)
    if series[0, B] < r and series[0, V] > 0.0:
        h0 = max(h0, touch(node, series, r))
    mean, lateral = 0.0, 0.0
    high = h_end
    for level in range(LEVELS):
        low = h0 + (high - h0) * GROWTH if level < LEVELS - 1 else h0
        for k in range(ABSCISSAS.size):
            h = low + 0.5 * (high - low) * (1.0 + ABSCISSAS[k])
            rate = evaluate(series[:, SLOWER], h) if node[CLOCK] == FRONT else 1.0
            excess = evaluate(series[:, PSI], h) - node[SIGN] * evaluate(series[:, V], h)
            w = (high - low) * WEIGHTS[k] * rate * evaluate(series[:, B], h) * excess
            one, two = slip_shape(evaluate(series[:, A], h), r)
            mean += w * one
            lateral += w * two
        high = low
    return mean, lateral


@entry_point()
def slid(
    nodes: Matrix,
    series: Cube,
    chi: float,
    last: int,
    b: float,
    v: float,
    radii: Vector,
    out: Matrix,
) -> None:
    """Write the radial functions of the slip up to step `last`, where b and v are, for each radius.

    Only points that are in contact then, r <= b, have a slip; the others get zero.
    """
    h_last = 0.0
    if nodes[last, MODE] != GROSS and nodes[last, MODE] != RETRACED:
        by_speed = abs(v) < 0.7
        h_last = position(
            nodes[last], series[last], V if by_speed else B, v if by_speed else b, by_speed or v < 0
        )
    for row in range(radii.size):
        r = radii[row]
        out[row, 0], out[row, 1] = 0.0, 0.0
        if r > b:
            continue
        for i in range(last + 1):
            mode = nodes[i, MODE]
            if mode in (STICK, RETRACED):
                continue
            b_end = series[i + 1, 0, B] if i < last else b
            v_end = series[i + 1, 0, V] if i < last else v
            if v_end > 0.0 and b_end < r:
                continue  # not yet touched
            if mode == GROSS:
                out[row, 0] += slid_in_gross_slip(nodes[i], series[i], chi, r, b_end, v_end)
            else:
                h_end = nodes[i, STEP] if i < last else h_last
                mean, lateral = slid_in_ring(nodes[i], series[i], r, h_end)
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
