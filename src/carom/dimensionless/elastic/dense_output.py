"""The state of an impact, and the memory of its contact, between the recorded steps."""

import numpy as np

from carom.dimensionless.elastic import motion as at, record as change
from carom.dimensionless.elastic.integration import evaluate, value_and_slope
from carom.dimensionless.elastic.memory import MADE, OUTER, SLIP_SIGN
from carom.dimensionless.elastic.phases import GROSS, RETRACED
from carom.dimensionless.elastic.record import CLOCK, MODE, SIGN, STEP, STRETCH, Record, Steps
from carom.dimensionless.fields.profile import Annulus, Memory
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(16)
MAX_BISECTIONS = 80

# What is sampled: penetration, speed, psi, displacement U, force Q, energy stored and dissipated in
# units of the ledger, radius of the stick zone, radius of the contact.
AT_D, AT_V, AT_PSI, AT_U, AT_Q, AT_STORED, AT_DISSIPATED, AT_STICK, AT_CONTACT = range(9)
SAMPLED = 9


@entry_point()
def tabulate(changes: Matrix, steps: Steps, change_times: Vector) -> None:
    """Write the times of all steps and changes, and displacement and frictional work at steps."""
    times, moved = steps.times, steps.moved
    for i in range(times.size):
        b, v = steps.series[i, 0, at.B], steps.series[i, 0, at.V]
        times[i] = hertz.time(b * b, v) if i > 0 else 0.0
        if i > 0:
            u, w = progress(steps, i - 1, steps.nodes[i - 1, STEP], b, v)
            moved[i, 0] = moved[i - 1, 0] + u
            moved[i, 1] = moved[i - 1, 1] + w
            if steps.give > 0.0:
                times[i] = times[i - 1] + elapsed(steps, i - 1, steps.nodes[i - 1, STEP])
    for i in range(changes.shape[0]):
        node = int(changes[i, change.AT_NODE])
        if steps.give == 0.0:
            change_times[i] = hertz.time(changes[i, change.AT_B] ** 2, changes[i, change.AT_V])
        elif node < times.size:
            change_times[i] = times[node]
        else:
            change_times[i] = times[node - 1] + elapsed(
                steps, node - 1, steps.nodes[node - 1, STEP]
            )


@kernel
def elapsed(steps: Steps, i: int, h: float) -> float:
    """Return the time from the start of a step to h."""
    total = 0.0
    for k in range(ABSCISSAS.size):
        x = 0.5 * h * (1.0 + ABSCISSAS[k])
        total += h * WEIGHTS[k] * evaluate(steps.series[i][:, at.B], x) * pace(steps, i, x)
    return total


@kernel
def reached(steps: Steps, i: int, time: float) -> float:
    """Return how far into a step a time since its start is."""
    low, high = 0.0, steps.nodes[i, STEP]
    x = high
    for _ in range(MAX_BISECTIONS):
        difference = elapsed(steps, i, x) - time
        if difference < 0.0:
            low = x
        else:
            high = x
        rate = 2.0 * evaluate(steps.series[i][:, at.B], x) * pace(steps, i, x)
        following = x - difference / rate if rate > 0.0 else low
        if not (low <= following <= high):
            following = 0.5 * (low + high)
        if abs(following - x) <= 1e-16 * x:
            return float(following)
        x = following
    return float(x)


@kernel
def pace(steps: Steps, i: int, h: float) -> float:
    """Return how fast the clock of the contact runs at a place of a step."""
    by_front = steps.nodes[i, CLOCK] == at.FRONT
    return evaluate(steps.series[i][:, at.SLOWER], h) if by_front else 1.0


@kernel
def progress(steps: Steps, i: int, h: float, b: float, v: float) -> tuple[float, float]:
    """Return displacement and frictional work from the start of a step to h, where b and v are."""
    node, series = steps.nodes[i], steps.series[i]
    if node[MODE] == GROSS:
        return gross_progress(steps, i, b, v)
    u, w = 0.0, 0.0
    for k in range(ABSCISSAS.size):
        x = 0.5 * h * (1.0 + ABSCISSAS[k])
        radius, psi = evaluate(series[:, at.B], x), evaluate(series[:, at.PSI], x)
        weight = h * WEIGHTS[k] * radius * pace(steps, i, x)
        u += weight * psi
        if node[MODE] != at.STICK:
            front = evaluate(series[:, at.A], x)
            limit = (radius - front) ** 2 * (2.0 * radius + front) / 3.0
            w += weight * limit * (node[SIGN] * psi - evaluate(series[:, at.V], x))
    return u, w


@kernel
def gross_progress(steps: Steps, i: int, b: float, v: float) -> tuple[float, float]:
    """Return displacement and frictional work from the start of gross slip to b and v."""
    chi, sign, start = steps.chi, steps.nodes[i, SIGN], steps.series[i, 0]
    b0, v0, psi0 = start[at.B], start[at.V], start[at.PSI]
    duration = hertz.time(b * b, v) - hertz.time(b0 * b0, v0)
    u = (psi0 - 2.0 * chi * sign * v0) * duration + 2.0 * chi * sign * (b * b - b0 * b0)
    drop = v0 - v
    if abs(v0 + v) > 1.5:  # near the touch speeds are alike to rounding, radii are not
        drop = (b**5 - b0**5) / (v0 + v)
    excess = sign * psi0 - v0
    return u, 8.0 / 15.0 * drop * (excess - 0.5 * (2.0 * chi - 1.0) * drop)


@kernel
def position(steps: Steps, i: int, column: int, target: float, falling: bool) -> float:
    """Return how far into a step a monotone variable, falling or rising, reaches the target."""
    return position_between(steps, i, column, target, falling, 0.0, steps.nodes[i, STEP])


@kernel
def position_between(
    steps: Steps, i: int, column: int, target: float, falling: bool, low: float, high: float
) -> float:
    """Return where, between two places of a step, a monotone variable reaches the target."""
    x = high
    for _ in range(MAX_BISECTIONS):
        value, steepness = value_and_slope(steps.series[i][:, column], x)
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
def sample(steps: Steps, wanted: Vector, out: Matrix) -> None:
    """Write one row of `out` for each wanted time."""
    for row in range(wanted.size):
        t = wanted[row]
        i = np.searchsorted(steps.times, t, side="right") - 1
        if steps.give > 0.0:
            h = reached(steps, i, t - steps.times[i])
            b, v = evaluate(steps.series[i][:, at.B], h), evaluate(steps.series[i][:, at.V], h)
            write_sample(steps, i, h, max(b, 0.0) ** 2, v, out[row])
            continue
        mirrored = steps.nodes[i, MODE] == RETRACED
        if mirrored:
            t = hertz.DURATION - t
            i = np.searchsorted(steps.times, t, side="right") - 1
        d, v = hertz.penetration_and_speed(t)
        write_sample(steps, i, place(steps, i, np.sqrt(d), v), d, v, out[row])
        if mirrored:
            out[row, AT_V] = -v
            out[row, AT_PSI] = -out[row, AT_PSI]


@kernel
def place(steps: Steps, i: int, b: float, v: float) -> float:
    """Return how far into a step the contact has the radius b and the speed v."""
    if steps.nodes[i, MODE] == GROSS:
        return 0.0
    if abs(v) < 0.7:
        return position(steps, i, at.V, v, True)
    return position(steps, i, at.B, b, v < 0.0)


@kernel
def write_sample(steps: Steps, i: int, h: float, d: float, v: float, out: Array) -> None:
    """Write what there is to tell at a place of a step, of penetration d and speed v."""
    node, series, chi = steps.nodes[i], steps.series[i], steps.chi
    psi_1 = steps.series[0, 0, at.PSI]
    b = np.sqrt(d)
    if node[MODE] == GROSS:
        psi = series[0, at.PSI] - 2.0 * chi * node[SIGN] * (series[0, at.V] - v)
        q = node[SIGN] * (2.0 / 3.0) * d * b
        stick = 0.0
    else:
        psi, q = evaluate(series[:, at.PSI], h), evaluate(series[:, at.Q], h)
        stick = b if node[MODE] == at.STICK else evaluate(series[:, at.A], h)
    u, w = progress(steps, i, h, b, v)
    out[AT_D], out[AT_V], out[AT_PSI], out[AT_Q] = d, v, psi, q
    out[AT_U], out[AT_DISSIPATED] = steps.moved[i, 0] + u, 3.75 * chi * (steps.moved[i, 1] + w)
    if node[MODE] == GROSS or node[MODE] == at.SLIDE:
        out[AT_STORED] = chi * d * d * b  # (15/8) chi integral of (d - s)^2
    else:
        out[AT_STORED] = 0.5 * (psi_1 - psi) * (psi_1 + psi) - out[AT_DISSIPATED]
    out[AT_STICK], out[AT_CONTACT] = min(stick, b), b


@entry_point()
def loading_states(steps: Steps, radii: Vector, out: Matrix) -> None:
    """Write g and U when stick laid new contact at radii, or next to them at its rim."""
    for row in range(radii.size):
        radius, nearest, best = radii[row], 0, np.inf
        for i in range(steps.times.size):
            if steps.nodes[i, MODE] == at.STICK:
                outer = evaluate(steps.series[i, :, at.B], steps.nodes[i, STEP])
                away = max(steps.series[i, 0, at.B] - radius, radius - outer, 0.0)
                if away < best:
                    nearest, best = i, away
        series, h = steps.series[nearest], position(steps, nearest, at.B, radius, False)
        psi, psi_slope = value_and_slope(series[:, at.PSI], h)
        v, v_slope = value_and_slope(series[:, at.V], h)
        u, _w = progress(steps, nearest, h, radius, v)
        # at the turning point both vanish
        out[row, 0] = psi / v if v > 1e-9 else psi_slope / v_slope
        out[row, 1] = steps.moved[nearest, 0] + u


def memory_at(record: Record, steps: Steps, now: dict[str, float], scale: float) -> Memory:
    """Return the memory at the instant that `now` describes; `scale` is as in `Solution`."""
    d, edge, front = now["penetration"], now["contact_radius"], now["stick_radius"]
    step = int(np.searchsorted(steps.times, now["time"], side="right")) - 1
    node, mirror = steps.nodes[step], -1 if scale < 0.0 else 1
    stretch = int(node[STRETCH])
    annuli, inner = [], 0.0

    def inside(annulus: Annulus, x: Array) -> tuple[Array, Array]:
        if annulus.sign:
            sign = annulus.sign * abs(scale)
            q = now["displacement"] + sign * (annulus.limit - x * x)
            return q, np.full(x.shape, sign)
        laid = np.empty((x.size, 2))
        loading_states(steps, x, laid)
        return now["displacement"] - scale * laid[:, 1], scale * laid[:, 0]

    for row in record.stacks[stretch, : record.depths[stretch]]:
        outer, sign = min(float(row[OUTER]), front), mirror * int(row[SLIP_SIGN])
        if outer > inner:
            annuli.append(Annulus(inner, outer, sign, _limit(steps, row)))
            inner = outer
    if edge > inner:
        sign = int(node[SIGN])
        limit = d - sign * now["displacement"] / scale
        sticks = node[MODE] in (at.STICK, RETRACED)
        annuli.append(Annulus(inner, edge, *((0, np.nan) if sticks else (mirror * sign, limit))))
    return Memory(now["time"], d, now["displacement"], tuple(annuli), inside)


def _limit(steps: Steps, row: Array) -> float:
    """Return l = d - sigma U when slip made the annulus."""
    made = int(row[MADE])
    if row[SLIP_SIGN] == 0.0 or made >= len(steps.series):
        return np.nan
    return float(steps.series[made, 0, at.B] ** 2 - row[SLIP_SIGN] * steps.moved[made, 0])
