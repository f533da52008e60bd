"""The exact contact law, a step at a time: springs on a lattice that remember their slip.

The plain twin of `carom/contact.hpp`, in the units of Hertz's impact: springs at x = k h, s = x^2,
are pressed by d - s and deflected by q, |q| <= d - s (method of dimensionality reduction; Popov &
Hess 2015). What Kelvin & Voigt's springs bear is q + alpha q', within D - s, D = d + alpha d'.
"""

from typing import NamedTuple

import numpy as np

from carom.dem.coefficients import ELASTIC_PULL
from carom.dem.stepping import MOST_DURATIONS
from carom.dimensionless.lossy.springs import springs as of
from carom.dimensionless.numerics.arrays import Matrix, Vector
from carom.dimensionless.numerics.hertz import DURATION
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.quantities.arrays import Array

# What is remembered: the spacing, 0 while apart; s at the edge; of the step before three velocities
# in its middle, the forces at its end, and what dashpots took of velocities in half of it; then
# two deflections of each spring, and how far it is pressed that was let go.
SPACING, EDGE, SPEED, FORCE, DAMPED, FIRST = 0, 1, 2, 5, 8, 11
MARGIN = 1.04  # of the lattice beyond the impact that is expected
COARSER, FINER = 1.0, 0.0625  # of the depth that the lattice holds, where it is made so
MOST_LEVELS = 64
CROWD = 16.0  # times as fast as one pair alone the dashpots of a packing slow its bodies, at most


class Now(NamedTuple):
    """What springs share: `rises` of d, `depth` D, and the parts gone in, and after, the step."""

    d: float
    rises: float
    depth: float
    edge: float
    fade: float
    faded: float


def places(springs: int) -> int:
    """Return how many numbers a contact remembers."""
    return FIRST + 3 * springs


@kernel
def widen(memory: Array, springs: int) -> None:
    """Leave out every other spring."""
    memory[SPACING] *= 2.0
    for line in range(3):
        row = memory[FIRST + line * springs : FIRST + (line + 1) * springs]
        for k in range(springs):
            row[k] = row[2 * k] if 2 * k < springs else 0.0


@kernel
def narrow(memory: Array, springs: int) -> None:
    """Put springs between those of the inner half, linear in s."""
    memory[SPACING] *= 0.5
    for line in range(3):
        row = memory[FIRST + line * springs : FIRST + (line + 1) * springs]
        for k in range(springs - 1, 0, -1):  # what is read is not yet written
            low = k // 2
            if k % 2 == 0:
                row[k] = row[low]
            else:
                part = (low + 0.25) / (2.0 * low + 1.0)
                row[k] = row[low] + part * (row[low + 1] - row[low])


@kernel
def begin(memory: Array, springs: int, before: float) -> None:
    """Let a contact that begins pressed have been so for long."""
    memory[EDGE] = max(before, 0.0)
    for k in range(springs):
        memory[FIRST + 2 * springs + k] = max(before - (k * memory[SPACING]) ** 2, 0.0)


@kernel
def grown_edge(memory: Array, springs: int, d: float, rises: float, fade: float) -> float:
    """Return s where the surfaces meet again, those let go having recovered by this part."""
    h, edge = memory[SPACING], memory[EDGE]
    was = d - rises - edge
    gap = rises + fade * was if was > 0.0 else d - edge
    k = int(np.sqrt(edge) / h)
    for _ in range(springs + 1):
        if gap <= 0.0:
            break
        k += 1
        s = (k * h) ** 2
        pressed = memory[FIRST + 2 * springs + k] if k < springs else 0.0
        beyond = d - s - (1.0 - fade) * pressed
        if beyond < 0.0:
            return float(edge + (s - edge) * gap / (gap - beyond))
        edge, gap = s, beyond
    return float(edge)


@kernel
def length(x: float, y: float, most: float) -> float:
    """Return the part of a vector that is not longer than this."""
    size = np.hypot(x, y)
    return most / size if size > most else 1.0


@kernel
def to_right(q: float, r: float, x: float, y: float) -> float:
    """Return how far (q, r) is right of (x, y), in its lengths; a cut turns by half too little."""
    square = x * x + y * y
    return (q * y - r * x) / square if square > 0.0 else 0.0


@kernel
def fit_lattice(memory: Array, springs: int, d: float, v: float) -> None:
    """Give springs their places at the touch, and others as the contact grows or shrinks."""
    if memory[SPACING] == 0.0:
        memory[SPACING] = np.sqrt(MARGIN * max(abs(v) ** 0.8, d)) / springs
    for level in range(MOST_LEVELS):
        holds = (springs * memory[SPACING]) ** 2
        if level == 0 and v < 0.0 and d < FINER * holds:
            narrow(memory, springs)
        elif d > COARSER * holds:
            widen(memory, springs)
        else:
            break


@kernel
def mean_at_end(half: float, d: float, before: float) -> float:
    """Return the mean of b around the end of the step, `half` of the way on, over b there.

    So much more dashpots bear at first, where b rises like the root of the time; the first step
    counts from the touch. No difference of powers is taken: they may be equal to rounding.
    """
    if half <= 0.0:
        return 1.0
    back = min(half if before > 0.0 else 2.0 * half, d)
    high, low = np.sqrt(d + half), np.sqrt(d - back)
    mean = (high * (high + low) + low * low) / (1.5 * (high + low) * np.sqrt(d))
    return float(mean * (back + half) / (2.0 * half))


@kernel
def crowding(memory: Array, motion: Array, first: int, end: int, given: float) -> float:
    """Return S, how many times as much as a contact's own dashpot all of them slow its bodies.

    It is 1 if the contact alone has changed the velocities, of which it looks at some components;
    `given` is the velocity that a force of one gives in half a step. Rounding is no force.
    """
    by_others, by_own, speed = 0.0, 0.0, 0.0
    for i in range(first, end):
        own = given * memory[FORCE + i]
        by_others += (0.5 * (motion[i] - memory[SPEED + i]) + own) ** 2
        by_own += own * own
        speed += motion[i] ** 2
    share = by_others / (by_others + by_own + 1e-12 * speed + 1e-300)
    return 1.0 + (CROWD - 1.0) * min(4.0 * share, 1.0)


@kernel
def at_end(memory: Array, motion: Array, i: int, crowd: float, damping: float) -> float:
    """Return a velocity at the end of the step, and remember what the next one needs of it.

    Forces go on as in the step before, but for what dashpots take in half a step, g e/2:

        e = v + (v - v_before)/2 - S/2 (g e - g e_before),

    which is of second order for any S, and stable for a large one (Steihaug & Wolfbrandt 1979).
    """
    ahead = motion[i] + 0.5 * (motion[i] - memory[SPEED + i])
    speed = (ahead + crowd * memory[DAMPED + i]) / (1.0 + crowd * damping)
    memory[SPEED + i], memory[DAMPED + i] = motion[i], damping * speed
    return float(speed)


@kernel
def move(memory: Array, springs: int, now: Now, moved: tuple[float, float]) -> None:
    """Let springs follow the bodies, as far as friction allows."""
    h = memory[SPACING]
    for k in range(springs):
        s, pressed = (k * h) ** 2, FIRST + 2 * springs + k
        was = memory[pressed]
        is_ = max(now.d - s, (1.0 - now.fade) * was)
        memory[pressed] = is_ if now.fade < 1.0 else 0.0
        q, r = now.faded * memory[FIRST + k], now.faded * memory[FIRST + springs + k]
        memory[FIRST + k] -= q
        memory[FIRST + springs + k] -= r
        if s >= now.edge:
            continue
        share = min((now.d - s) / now.rises, 1.0) if now.rises > 0.0 else 1.0
        most = max(is_ - was + now.fade * was, 0.0) if now.faded < 1.0 else now.depth - s
        x, y = q + share * moved[0], r + share * moved[1]
        part = length(x, y, most)
        left = min(part, 0.5) * (1.0 - part) * to_right(q, r, x, y) if now.faded == 1.0 else 0.0
        memory[FIRST + k] += part * x - left * y
        memory[FIRST + springs + k] += part * y + left * x


@kernel
def pull(memory: Array, springs: int, now: Now, drag: tuple[float, float]) -> tuple[float, float]:
    """Return the integrals of what springs and dashpots bear, up to the edge.

    Sums over springs; beyond the last q is linear in s: -h^2/12 dq/dx (Euler & Maclaurin).
    """
    if now.edge <= 0.0:
        return 0.0, 0.0
    h, rim, last = memory[SPACING], np.sqrt(now.edge), 0
    while last + 1 < springs and ((last + 1) * h) ** 2 < now.edge:
        last += 1
    end = last * h
    inner = of.share(end, rim)
    bend = h * h * end / (6.0 * (now.edge - (max(last - 1, 0) * h) ** 2))
    rest = (rim - end - inner - bend) * length(drag[0], drag[1], max(now.depth - now.edge, 0.0))
    along, across = rest * drag[0], rest * drag[1]
    for k in range(last + 1):
        q, r = memory[FIRST + k] + drag[0], memory[FIRST + springs + k] + drag[1]
        weight = h if 0 < k < last else 0.5 * h * min(last, 1)
        if k == last:
            weight += inner
        if k == last - 1:
            weight += bend
        part = weight * (length(q, r, now.depth - (k * h) ** 2) if now.fade < 1.0 else 1.0)
        along += part * q
        across += part * r
    return along, across


@entry_point()
def step(
    memory: Vector,
    springs: int,
    d: float,
    motion: Vector,
    dt: float,
    alpha: float,
    shear_alpha: float,
    chi: float,
    load: Vector,
) -> None:
    """Step a contact; write its three forces. `motion` has velocities of the middle of the step.

    `chi` is that of the bodies without others: by it dashpots know how much of their acceleration
    is their own.
    """
    load[:] = 0.0
    if d <= 0.0:
        memory[:] = 0.0
        return

    v, slide, aside = motion[0], motion[1], motion[2]
    before, depth, fade, edge, drag = d - v * dt, d, 1.0, d, (0.0, 0.0)
    given = 0.5 * dt * ELASTIC_PULL  # velocity by a force of one in half a step
    slowed = 1.5 * given * shear_alpha * 2.0 * chi
    rates = (1.5 * given * alpha, slowed, slowed)  # taken by dashpots of a contact of radius one
    if memory[SPACING] == 0.0:
        memory[:] = 0.0
        fit_lattice(memory, springs, d, v)
        begin(memory, springs, before)
        for i in range(3):
            memory[SPEED + i] = motion[i]
            memory[DAMPED + i] = rates[i] * np.sqrt(max(before, 0.0)) * motion[i]
    else:
        fit_lattice(memory, springs, d, v)

    if alpha > 0.0:
        width = np.sqrt(d)
        crowd = crowding(memory, motion, 0, 1, given)
        aside_crowd = crowding(memory, motion, 1, 3, 2.0 * chi * given)
        speed = at_end(memory, motion, 0, crowd, rates[0] * width)
        mean = mean_at_end(0.5 * speed * dt, d, before)
        drag = (
            shear_alpha * mean * at_end(memory, motion, 1, aside_crowd, rates[1] * width),
            shear_alpha * mean * at_end(memory, motion, 2, aside_crowd, rates[2] * width),
        )

        depth += alpha * mean * speed
        fade = -np.expm1(-dt / alpha)
        edge = max(depth, 0.0)
        if depth >= memory[EDGE]:
            edge = min(grown_edge(memory, springs, d, v * dt, fade), depth)
    memory[EDGE] = edge

    now = Now(d, v * dt, depth, edge, fade, fade if shear_alpha > 0.0 else 1.0)
    move(memory, springs, now, (slide * dt, aside * dt))
    along, across = pull(memory, springs, now, drag)
    load[0] = 1.5 * max(np.sqrt(edge) * (depth - edge / 3.0), 0.0)
    load[1], load[2] = 1.5 * along, 1.5 * across
    part = length(load[1], load[2], load[0])  # but for rounding it holds already
    load[1] *= part
    load[2] *= part
    for i in range(3):
        memory[FORCE + i] = load[i]


@entry_point()
def impact(
    psi: float,
    chi: float,
    steps: int,
    alpha: float,
    shear_alpha: float,
    springs: int,
    memory: Vector,
    load: Vector,
    record: Matrix,
) -> tuple[int, float]:
    """Return how many rows of the record are filled and psi_2; -1 if the bodies do not part.

    The same if steps are too long to follow springs and dashpots: k dt (dt/4 + tau) must be below
    the mass. Velocity Verlet, as `stepping.stepped`; memory has the places of `places`, load six:
    forces, and room for the motion.
    """
    dt = DURATION / steps
    memory[:], load[:] = 0.0, 0.0
    d, v, motion = 0.0, 1.0, load[3:]
    late = max(0.25 * dt + alpha, 2.0 * chi * (0.25 * dt + shear_alpha))
    moved = 1.5 * ELASTIC_PULL * dt * late  # by a contact of radius one
    for i in range(MOST_DURATIONS * steps):
        if i < record.shape[0]:
            record[i, 0], record[i, 1], record[i, 2] = i * dt, d, v
            record[i, 3], record[i, 4], record[i, 5] = psi, load[0], load[1]
        v -= 0.5 * dt * ELASTIC_PULL * load[0]
        psi -= dt * ELASTIC_PULL * chi * load[1]
        d += dt * v
        motion[0], motion[1], motion[2] = v, psi, 0.0
        step(memory, springs, d, motion, dt, alpha, shear_alpha, chi, load[:3])
        if v < 0.0 and load[0] <= 0.0:
            return i + 1, psi
        if moved * np.sqrt(memory[EDGE]) > 1.0:
            break
        v -= 0.5 * dt * ELASTIC_PULL * load[0]
        psi -= dt * ELASTIC_PULL * chi * load[1]
    return -1, np.nan
