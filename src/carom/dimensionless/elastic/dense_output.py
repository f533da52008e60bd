"""The state at any time between the recorded steps of an impact."""

import numpy as np

from carom.dimensionless.elastic import motion as at
from carom.dimensionless.elastic.integration import evaluate, value_and_slope
from carom.dimensionless.elastic.motion import Series
from carom.dimensionless.elastic.phases import GROSS, RETRACED
from carom.dimensionless.elastic.record import AT_B, AT_V as CHANGE_V, CLOCK, MODE, SIGN, STEP
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array, Cube, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(16)
MAX_BISECTIONS = 80

# What is sampled: penetration, speed, psi, displacement U, force Q, energy stored and dissipated in
# units of the ledger, radius of the stick zone, radius of the contact.
COLUMNS = 9
AT_D, AT_V, AT_PSI, AT_U, AT_Q, AT_STORED, AT_DISSIPATED, AT_STICK, AT_CONTACT = range(COLUMNS)


@entry_point()
def tabulate(
    nodes: Matrix,
    series: Cube,
    changes: Matrix,
    chi: float,
    times: Vector,
    moved: Matrix,
    change_times: Vector,
) -> None:
    """Write the times of all steps and changes, and displacement and frictional work at steps."""
    for i in range(changes.shape[0]):
        change_times[i] = hertz.time(changes[i, AT_B] ** 2, changes[i, CHANGE_V])
    for i in range(nodes.shape[0]):
        b, v = series[i, 0, at.B], series[i, 0, at.V]
        times[i] = hertz.time(b * b, v) if i > 0 else 0.0
        if i > 0:
            u, w = progress(nodes[i - 1], series[i - 1], chi, nodes[i - 1, STEP], b, v)
            moved[i, 0] = moved[i - 1, 0] + u
            moved[i, 1] = moved[i - 1, 1] + w


@kernel
def progress(
    node: Array, series: Series, chi: float, h: float, b: float, v: float
) -> tuple[float, float]:
    """Return displacement and frictional work from the start of a step to h, where b and v are."""
    if node[MODE] == GROSS:
        return gross_progress(node, series, chi, b, v)
    u, w = 0.0, 0.0
    for i in range(ABSCISSAS.size):
        x = 0.5 * h * (1.0 + ABSCISSAS[i])
        rate = evaluate(series[:, at.SLOWER], x) if node[CLOCK] == at.FRONT else 1.0
        radius, psi = evaluate(series[:, at.B], x), evaluate(series[:, at.PSI], x)
        weight = h * WEIGHTS[i] * radius * rate
        u += weight * psi
        if node[MODE] != at.STICK:
            front = evaluate(series[:, at.A], x)
            limit = (radius - front) ** 2 * (2.0 * radius + front) / 3.0
            w += weight * limit * (node[SIGN] * psi - evaluate(series[:, at.V], x))
    return u, w


@kernel
def gross_progress(
    node: Array, series: Series, chi: float, b: float, v: float
) -> tuple[float, float]:
    """Return displacement and frictional work from the start of gross slip to b and v."""
    b0, v0, psi0, sign = series[0, at.B], series[0, at.V], series[0, at.PSI], node[SIGN]
    duration = hertz.time(b * b, v) - hertz.time(b0 * b0, v0)
    u = (psi0 - 2.0 * chi * sign * v0) * duration + 2.0 * chi * sign * (b * b - b0 * b0)
    drop = v0 - v
    if abs(v0 + v) > 1.5:  # near the touch speeds are alike to rounding, radii are not
        drop = (b**5 - b0**5) / (v0 + v)
    excess = sign * psi0 - v0
    return u, 8.0 / 15.0 * drop * (excess - 0.5 * (2.0 * chi - 1.0) * drop)


@kernel
def position(node: Array, series: Series, row: int, target: float, falling: bool) -> float:
    """Return how far into a step a monotone variable, falling or rising, reaches the target."""
    low, high = 0.0, node[STEP]
    x = high
    for _ in range(MAX_BISECTIONS):
        value, steepness = value_and_slope(series[:, row], x)
        difference = value - target
        if (difference > 0.0) == falling:
            low = x
        else:
            high = x
        following = x - difference / steepness if steepness != 0.0 else low
        if not (low <= following <= high):
            following = 0.5 * (low + high)
        if abs(following - x) <= 1e-16 * x:
            return float(following)
        x = following
    return float(x)


@entry_point()
def sample(
    nodes: Matrix,
    series: Cube,
    chi: float,
    times: Vector,
    moved: Matrix,
    wanted: Vector,
    out: Matrix,
) -> None:
    """Write one row of `out` for each wanted time."""
    psi_in = series[0, 0, at.PSI]
    for row in range(wanted.size):
        t = wanted[row]
        i = np.searchsorted(times, t, side="right") - 1
        mirrored = nodes[i, MODE] == RETRACED
        if mirrored:
            t = hertz.DURATION - t
            i = np.searchsorted(times, t, side="right") - 1
        d, v = hertz.penetration_and_speed(t)
        write_sample(nodes[i], series[i], chi, moved[i], psi_in, d, v, out[row])
        if mirrored:
            out[row, AT_V] = -v
            out[row, AT_PSI] = -out[row, AT_PSI]


@kernel
def write_sample(
    node: Array,
    series: Series,
    chi: float,
    moved: Array,
    psi_in: float,
    d: float,
    v: float,
    out: Array,
) -> None:
    """Write what there is to tell at penetration d and speed v inside a step."""
    b = np.sqrt(d)
    h = 0.0
    if node[MODE] == GROSS:
        psi = series[0, at.PSI] - 2.0 * chi * node[SIGN] * (series[0, at.V] - v)
        q = node[SIGN] * (2.0 / 3.0) * d * b
        stick = 0.0
    else:
        if abs(v) < 0.7:
            h = position(node, series, at.V, v, True)
        else:
            h = position(node, series, at.B, b, v < 0.0)
        psi, q = evaluate(series[:, at.PSI], h), evaluate(series[:, at.Q], h)
        stick = b if node[MODE] == at.STICK else evaluate(series[:, at.A], h)
    u, w = progress(node, series, chi, h, b, v)
    out[AT_D], out[AT_V], out[AT_PSI], out[AT_Q] = d, v, psi, q
    out[AT_U], out[AT_DISSIPATED] = moved[0] + u, 3.75 * chi * (moved[1] + w)
    if node[MODE] == GROSS:
        out[AT_STORED] = chi * d * d * b  # (15/8) chi integral of (d - s)^2
    else:
        out[AT_STORED] = 0.5 * (psi_in - psi) * (psi_in + psi) - out[AT_DISSIPATED]
    out[AT_STICK], out[AT_CONTACT] = min(stick, b), b


@kernel
def loading_state(nodes: Array, series: Array, moved: Array, radius: float) -> tuple[float, float]:
    """Return g and U when stick laid new contact at this radius, or next to it at its rim."""
    nearest, best = 0, np.inf
    for i in range(nodes.shape[0]):
        if nodes[i, MODE] == at.STICK:
            outer = evaluate(series[i, :, at.B], nodes[i, STEP])
            away = max(series[i, 0, at.B] - radius, radius - outer, 0.0)
            if away < best:
                nearest, best = i, away
    node, steps = nodes[nearest], series[nearest]
    h = position(node, steps, at.B, radius, False)
    psi, psi_slope = value_and_slope(steps[:, at.PSI], h)
    v, v_slope = value_and_slope(steps[:, at.V], h)
    u, _w = progress(node, steps, 0.0, h, radius, v)
    g = psi / v if v > 1e-9 else psi_slope / v_slope  # at the turning point both vanish
    return g, moved[nearest, 0] + u


@entry_point()
def loading_states(nodes: Matrix, series: Cube, moved: Matrix, radii: Vector, out: Matrix) -> None:
    """Write g and U for every radius, as `loading_state` gives them."""
    for i in range(radii.size):
        out[i, 0], out[i, 1] = loading_state(nodes, series, moved, radii[i])
