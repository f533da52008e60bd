"""An impact marched over springs, step by step: kick, stretch, kick.

    v' = -(5/4) (P + (3/2) eps . Q),  psi' = -(5/4) (3 chi Q + zeta P),  U' = psi,
    Q = integral of f dx over 0 <= x <= b,

vectors of two components where the inertia has a direction across, f that of springs in shear,
whose Coulomb limit is what they bear in compression. The solid says what that is and what load it
makes (solids). Springs are laid at the edge as it grows, every second step. Of second order in the
number of springs; what comes of two numbers of springs is extrapolated.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import LARGEST_PSI, Loss, keep_energy, why_not
from carom.dimensionless.lossy.springs import motion as at, solids, springs as of, thornton
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.numerics.arrays import Array, Codes, Cube, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

MOST_SPRINGS = 500
SPARE_SPRINGS = 40
PER_SPRING = 2  # steps of the loading to a spring
LONGEST = 20 * PER_SPRING * MOST_SPRINGS
ELASTIC_CLOCK = 1.26  # of the loading of elastic bodies
STANDING = 1e-7  # speed at which the bodies turn; a step that ends faster is followed by another
ENDLESS = 1e300  # relaxation time of an elastic solid

# What an impact comes to besides the numbers of the layout: psi_2 across.
PSI_ACROSS = layout.NUMBERS
NUMBERS = layout.NUMBERS + 1

# Of a row that is kept, besides those of the layout: whether springs slip, either way.
FORTH, BACK = layout.ROWS, layout.ROWS + 1
OTHER_PSI, OTHER_MOVED, OTHER_FORCE = range(layout.ROWS + 2, layout.ROWS + 5)  # across
ROWS = layout.ROWS + 5
LIMIT_TOLERANCE = 1e-9  # of the limit: a spring nearer to it slips
# Of a frame, for each spring: what it bears in compression and in shear, and how far it is behind.
PRESSED, PULLED, LAGGING = range(3)
FRAMES = 3

TRIAL_SPRINGS = 40  # with which the clock of the loading is found
LEAST_ERROR = 1e-6  # of psi_2, in max(1, psi_1)
LARGEST_ERROR = 1e-3  # of bodies off their centre, in the same or in max(1, e)
FEW, MANY = MOST_SPRINGS // 2, MOST_SPRINGS


class Arrays(NamedTuple):
    """Arrays that an impact needs, made once and used for many."""

    motion: Matrix  # (3, MOTION): before a step, after it, and where the bodies turned
    springs: Matrix  # (COLUMNS, springs + 2)
    state: Vector  # (STATE,)
    coarse: Vector  # what the impact comes to with half the springs
    rows: Matrix  # (steps + 1, ROWS), or none
    frames: Cube  # (steps + 1, FRAMES, springs), or none


def new_work(steps: int = 0, springs: int = 0, most: int = MOST_SPRINGS) -> Arrays:
    """Return the arrays of an impact: with rows for so many steps, frames of so many springs."""
    return Arrays(
        motion=np.zeros((3, at.MOTION)),
        springs=np.zeros((of.SPRING_COLUMNS, most + SPARE_SPRINGS + 2)),
        state=np.zeros(at.STATE),
        coarse=np.zeros(NUMBERS),
        rows=np.zeros((steps + 1 if steps else 0, ROWS)),
        frames=np.zeros((steps + 1 if springs else 0, FRAMES, springs)),
    )


@kernel
def march(
    psi_1: float,
    across: float,
    inertia: Inertia,
    solid: Solid,
    h: float,
    work: Arrays,
    numbers: Array,
) -> tuple[int, float]:
    """March an impact; return its steps, none if it does not end, and the clock of the loading."""
    now, new, turned = work.motion[0], work.motion[1], work.motion[2]
    springs, state = work.springs, work.state
    begin(psi_1, across, work)
    laid, touching, since, widest, strongest, clock = 0, 0, 0, 0.0, 0.0, 0.0
    for i in range(LONGEST):
        again = now[at.SPEED] > 0.0 and turned[at.EDGE] > 0.0
        if again and solid.loss != Loss.PLATE.value:
            return 0, clock  # what springs that yielded or relaxed then bear is not said
        grows = now[at.SPEED] > 0.0 and now[at.EDGE] >= widest
        if grows and since % PER_SPRING == 0:
            if laid >= springs.shape[1] - 1:
                return 0, clock
            of.lay(springs, laid, now[at.EDGE])
            springs[of.NEXT, laid] = at.viscosity(solid) * now[at.SPEED]
            laid += 1
        since += grows
        part = at.drift(inertia, h, now, state, new)
        clock += part * h if grows else 0.0
        met = touching
        touching = solids.press(solid, now, new, turned, springs, laid)
        if touching == solids.UNKNOWN:
            return 0, clock
        if touching == 0:
            end(now, new, springs)
        let_go(springs, touching, met, inertia, solid.extra, state)
        kick_and_stretch(solid, inertia, now, new, springs, touching, state)
        widest, strongest = max(widest, new[at.EDGE]), max(strongest, new[at.LOAD])
        if work.rows.shape[0] > 0:
            keep(solid, inertia.ratio, new, springs, touching, state, work.rows[i + 1])
        if work.frames.shape[0] > 0:
            keep_springs(solid.extra, springs, touching, state, work.frames[i + 1])
        if touching == 0:
            note(new, turned, state, numbers)
            numbers[layout.STRONGEST] = strongest
            return i + 1, clock
        if now[at.SPEED] > 0.0 and new[at.SPEED] <= STANDING:
            new[at.SPEED] = min(new[at.SPEED], 0.0)
            if new[at.EDGE] >= widest:
                of.lay(springs, laid, new[at.EDGE])
                at.copy(new, turned)
            solids.turn(solid, new, springs, touching, state, inertia.ratio)
        at.copy(new, now)
    return 0, clock


@kernel
def begin(psi_1: float, across: float, work: Arrays) -> None:
    """Put the bodies to their first touch."""
    work.motion[:], work.springs[:], work.state[:] = 0.0, 0.0, 0.0
    work.motion[0, at.SPEED], work.motion[0, at.PACE] = 1.0, 1.0
    work.state[at.PSI], work.state[at.PSI_ACROSS] = psi_1, across
    if work.rows.shape[0] > 0:
        work.rows[0] = 0.0
        work.rows[0, layout.AT_V], work.rows[0, layout.AT_PSI] = 1.0, psi_1
        work.rows[0, OTHER_PSI] = across


@kernel
def end(now: Array, new: Array, springs: Array) -> None:
    """Cut the last step where the spring at the centre lets go; its load is next to nothing."""
    part = springs[of.LIMIT, 0] / (springs[of.LIMIT, 0] - springs[of.NEXT, 0])
    for row in (at.TIME, at.DEPTH):
        new[row] = now[row] + part * (new[row] - now[row])
    new[at.EDGE], new[at.LOAD], new[at.DRAG] = 0.0, 0.0, 0.0


@kernel
def let_go(
    springs: Array, touching: int, met: int, inertia: Inertia, extra: float, state: Array
) -> None:
    """Free springs whose contact ends; what both branches hold against each other is lost."""
    for j in range(touching, met):
        if extra > 0.0:
            held = springs[of.WEIGHT, j] * of.square(springs, j, extra, inertia.ratio)
            state[at.LOST] += 1.875 * inertia.chi * held
        else:
            springs[of.U, j], springs[of.U_ACROSS, j], springs[of.NEXT, j] = 0.0, 0.0, 0.0


@kernel
def kick_and_stretch(
    solid: Solid,
    inertia: Inertia,
    now: Array,
    new: Array,
    springs: Array,
    touching: int,
    state: Array,
) -> None:
    """Move velocities and springs on by a step."""
    g, dt = solid.extra, new[at.TIME] - now[at.TIME]
    theta = solid.parameter if g > 0.0 else ENDLESS
    slowed = at.slowing(inertia, now[at.LOAD], state)
    braked, braked_across = at.braking(inertia, now[at.LOAD], state)
    half = state[at.PSI] - 0.5 * dt * braked
    half_across = state[at.PSI_ACROSS] - 0.5 * dt * braked_across
    step = of.step_of(g, theta, dt, state[at.PSI], half, -braked)
    if inertia.across > 0.0 or at.viscosity(solid) > 0.0:
        across = of.step_of(g, theta, dt, state[at.PSI_ACROSS], half_across, -braked_across)
        force, aside, square = of.stretch_both(
            springs, touching, new[at.EDGE], step, across, inertia.ratio
        )
        state[at.FORCE], state[at.FORCE_ACROSS] = force, aside
        square += pull_edge(solid, inertia.ratio, step, across, new, springs, touching, state)
    else:
        state[at.FORCE], square = of.stretch(springs, touching, new[at.EDGE], step)
    losing = square * g / theta
    state[at.LOST] += 1.875 * inertia.chi * dt * (state[at.LOSING] + losing)
    state[at.LOSING] = losing
    at.settle(inertia, now, new, slowed, state)
    braked, braked_across = at.braking(inertia, new[at.LOAD], state)
    state[at.PSI] = half - 0.5 * dt * braked
    state[at.PSI_ACROSS] = half_across - 0.5 * dt * braked_across
    state[at.MOVED] += half * dt
    state[at.MOVED_ACROSS] += half_across * dt


@kernel
def pull_edge(
    solid: Solid,
    ratio: float,
    step: of.Step,
    across: of.Step,
    new: Array,
    springs: Array,
    touching: int,
    state: Array,
) -> float:
    """Add what the edge of viscous bodies bears while it grows; return its m^2, weighed."""
    viscosity = at.viscosity(solid)
    if viscosity == 0.0 or new[at.SPEED] <= 0.0:
        return 0.0
    pull, aside = viscosity * (step.psi + step.gained), viscosity * (across.psi + across.gained)
    pull, aside = of.slid(pull, aside, viscosity * new[at.SPEED], ratio)
    weight = of.share(new[at.EDGE], springs[of.X, touching - 1])
    state[at.FORCE] += weight * pull
    state[at.FORCE_ACROSS] += weight * aside
    return float(weight * (pull**2 + aside**2 / ratio) / solid.extra**2)


@kernel
def keep(
    solid: Solid, ratio: float, now: Array, springs: Array, touching: int, state: Array, row: Array
) -> None:
    """Keep a row after a step: motion, energies, how wide the zones are that stick, who slips."""
    row[:] = 0.0
    row[layout.AT_TIME], row[layout.AT_D] = now[at.TIME], now[at.DEPTH]
    row[layout.AT_V], row[layout.AT_B], row[layout.AT_P] = now[at.SPEED], now[at.EDGE], now[at.LOAD]
    row[layout.AT_PSI], row[layout.AT_U] = state[at.PSI], state[at.MOVED]
    row[layout.AT_Q], row[layout.AT_SHEAR_LOST] = state[at.FORCE], state[at.LOST]
    row[OTHER_PSI], row[OTHER_MOVED] = state[at.PSI_ACROSS], state[at.MOVED_ACROSS]
    row[OTHER_FORCE] = state[at.FORCE_ACROSS]
    row[layout.AT_STORED] = solids.stored(solid, now, springs, touching)
    row[layout.AT_LOST] = 1.0 - now[at.SPEED] ** 2 - row[layout.AT_STORED]
    for j in range(touching):
        weight, most = of.weight_of(springs, j, touching, now[at.EDGE]), springs[of.NEXT, j]
        row[layout.AT_SQUARE] += weight * of.square(springs, j, solid.extra, ratio)
        force, aside = of.pulled(springs, j, solid.extra)
        if most - np.hypot(force, aside) > LIMIT_TOLERANCE * most:
            outer = springs[of.X, j + 1] if springs[of.OUTER, j] > 0.0 else now[at.EDGE]
            row[layout.AT_STUCK] += min(outer, now[at.EDGE]) - springs[of.X, j]
        else:
            row[FORTH if force > 0.0 else BACK] = 1.0


@kernel
def keep_springs(extra: float, springs: Array, touching: int, state: Array, frame: Array) -> None:
    """Keep what springs bear, and by how much they are behind the bodies."""
    frame[:] = 0.0
    for j in range(touching):
        frame[PRESSED, j] = springs[of.NEXT, j]
        frame[PULLED, j], _ = of.pulled(springs, j, extra)
        frame[LAGGING, j] = state[at.MOVED] - springs[of.U, j]


@kernel
def note(now: Array, turned: Array, state: Array, numbers: Array) -> None:
    """Note what the impact came to."""
    e = -now[at.SPEED]
    numbers[layout.PSI_OUT], numbers[layout.RESTITUTION] = state[at.PSI], e
    numbers[layout.TIME], numbers[layout.PENETRATION] = now[at.TIME], now[at.DEPTH]
    numbers[layout.LOST], numbers[layout.SHEAR_LOST] = 1.0 - e * e, state[at.LOST]
    numbers[layout.DEEPEST], numbers[layout.WIDEST] = turned[at.DEPTH], turned[at.EDGE]
    numbers[PSI_ACROSS] = state[at.PSI_ACROSS]


@kernel
def step_for(
    psi_1: float, across: float, inertia: Inertia, solid: Solid, count: int, work: Arrays
) -> float:
    """Return the step of the clock with which the contact is cut into so many springs."""
    trial = ELASTIC_CLOCK / (PER_SPRING * TRIAL_SPRINGS)
    _, clock = march(psi_1, across, inertia, solid, trial, work, work.coarse)
    return float(clock / (PER_SPRING * count))


@kernel
def share_of(size: float, inertia: Inertia) -> float:
    """Return which part of psi is marched: off the centre all, as slip may turn at any."""
    return LARGEST_PSI / size if size > LARGEST_PSI and at.is_central(inertia) else 1.0


@entry_point()
def run(
    psi_1: float, across: float, inertia: Inertia, solid: Solid, work: Arrays, numbers: Vector
) -> tuple[int, float]:
    """Run an impact of any psi_1, and that across; return its status, and the error of psi_2.

    Numbers are Richardson's (1911), of two numbers of springs, and the error is what he adds, but
    not below LEAST_ERROR, as that may be by chance. Jams at grazing angles may not be resolved.
    """
    size = np.hypot(psi_1, across)
    status, error = why_not(size, inertia.chi), 0.0
    if status == Status.SOLVED.value:
        scale = np.copysign(share_of(size, inertia), psi_1)
        along, aside, speed = scale * psi_1, scale * across, abs(scale) * size
        if psi_1 < 0.0:
            inertia = at.turned(inertia)
        h = step_for(along, aside, inertia, solid, FEW, work)
        coarse, _ = march(along, aside, inertia, solid, h, work, work.coarse)
        fine, _ = march(along, aside, inertia, solid, h * FEW / MANY, work, numbers)
        if coarse == 0 or fine == 0:
            status = Status.UNRESOLVED.value
        for j in range(numbers.size):
            more = (numbers[j] - work.coarse[j]) / ((MANY / FEW) ** 2 - 1.0)
            if j in (layout.PSI_OUT, PSI_ACROSS):
                error = max(error, abs(more), LEAST_ERROR * max(speed, 1.0))
            numbers[j] += more
            if not np.isfinite(numbers[j]):
                status = Status.UNRESOLVED.value
        e, before = numbers[layout.RESTITUTION], work.coarse[layout.RESTITUTION]
        wrong = abs(e - before) > 4.0 * LARGEST_ERROR * max(abs(e), 1.0)
        wrong = wrong or error > LARGEST_ERROR * max(speed, 1.0)
        if wrong and not at.is_central(inertia):
            status = Status.UNRESOLVED.value
        if at.is_central(inertia) and solid.loss == Loss.PLASTIC.value:
            thornton.come_to(solid.parameter, numbers)
        if at.is_central(inertia) and inertia.across == 0.0:
            keep_energy(speed, numbers)
        sign = np.copysign(1.0, psi_1)
        numbers[layout.PSI_OUT] = sign * numbers[layout.PSI_OUT] + (psi_1 - sign * along)
        numbers[PSI_ACROSS] = sign * numbers[PSI_ACROSS] + (across - sign * aside)
    if status != Status.SOLVED.value:
        numbers[:], error = np.nan, np.nan
    return status, error


@entry_point()
def trace(
    psi_1: float,
    across: float,
    inertia: Inertia,
    solid: Solid,
    count: int,
    trial: Arrays,
    work: Arrays,
) -> int:
    """Fill in a row for each step over so many springs; return the number of steps."""
    h = step_for(psi_1, across, inertia, solid, count, trial)
    return march(psi_1, across, inertia, solid, h, work, work.coarse)[0]


@entry_point()
def fill(
    psi_1: Vector,
    chi: Vector,
    loss: int,
    parameter: Vector,
    extra: Vector,
    work: Arrays,
    numbers: Matrix,
    status: Codes,
) -> None:
    """Write what every impact comes to, and its status."""
    for i in range(psi_1.size):
        inertia = Inertia(chi[i], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        solid = at.made_of(loss, parameter[i], extra[i])
        status[i], _ = run(psi_1[i], 0.0, inertia, solid, work, numbers[i])


def march_rebound(psi_1: float, inertia: Inertia, solid: Solid) -> tuple[float, float]:
    """Return psi_2 by the march, and an estimate of its error; NaN if it is not solved."""
    numbers = np.empty(NUMBERS)
    _, error = run(psi_1, 0.0, inertia, solid, new_work(), numbers)
    return float(numbers[layout.PSI_OUT]), error


def marched(
    psi_1: float, inertia: Inertia, solid: Solid, springs: int, across: float = 0.0
) -> Vector:
    """Return what an impact comes to over so many springs, not extrapolated."""
    work = new_work(most=springs)
    steps = trace(psi_1, across, inertia, solid, springs, work, work)
    return work.coarse if steps else np.full(NUMBERS, np.nan)
