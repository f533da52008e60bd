"""An impact by a contact law as it is meant: its forces as rates, in steps of adaptive size.

In the clock tau of dt = 2 sqrt(d) dtau the radius b = sqrt(d), the speed v = b', psi and the forces
of a spring are smooth from touch to parting, but for the instants at which the contact turns,
begins or ceases to slide, or turns back: these are found by bisection. Steps by Dormand & Prince
(1980).
"""

from typing import NamedTuple

import numpy as np

from carom.dem import coefficients as forces
from carom.dem.coefficients import ELASTIC_PULL, SPRING, Coefficients, Normal, Shear
from carom.dimensionless.numerics.arrays import Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.quantities.arrays import Array

B, V, PSI, T, UPPER, LOWER = range(6)  # the state
SIZE = 6
WORK = (9, SIZE)  # scratch: seven derivatives, the next state, the state
TOUCH = 3e-5  # contact radius at which an impact begins and ends
TOLERANCE = 1e-10
MOST_STEPS = 300_000
SHORTEST, LONGEST = 1e-10, 0.5  # steps
PATIENCE, DWELL = 100, 1e-4  # after so many changes a law chatters: steps go over them
NEAR = 1e-6  # of the limit, from where Walton & Braun's law, stiff there, is taken to slide
HALVINGS = 48
NOTHING, TURNS, PARTS, SLIDES, STICKS, REVERSES, CONTINUES, PULLS = range(8)

NODES = np.array(
    [
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
ERROR = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])


class Mode(NamedTuple):
    """What is constant in a step: sign of `slip`, branch, loading, and the largest penetration."""

    slip: int
    branch: int
    loading: bool
    peak: float


@kernel
def limit_rate(law: Coefficients, loading: bool, b: float, v: float, f: float) -> float:
    """Return df/dtau."""
    pull = -2.0 * b * ELASTIC_PULL * f
    if law.normal == Normal.HERTZ.value:
        rate = 3.0 * b * b * v
    else:
        rate = 2.0 * SPRING * b * v * (1.0 if loading else law.unloading)
    if law.normal_damping > 0.0:
        power = law.damping_power
        rate += law.normal_damping * b**power * (power * v * v / b + pull)
    return float(rate)


@kernel
def spring_rate(law: Coefficients, mode: Mode, y: Array, f: float) -> float:
    """Return dt/dtau of the elastic tangential force of a contact that sticks."""
    elastic = 2.0 * y[B] * forces.shear_stiffness(law, y[B]) * y[PSI]
    if law.shear == Shear.SPRING.value:
        return float(elastic + forces.kept(law, mode.loading) * y[T] * y[V] / y[B])
    rate = limit_rate(law, mode.loading, y[B], y[V], f)
    theta = forces.softening(law.shear, mode.branch, y[T], f, y[UPPER], y[LOWER])
    return forces.force_change(law.shear, mode.branch, theta, elastic, rate)


@kernel
def damping_force(law: Coefficients, y: Array) -> float:
    """Return the tangential damping of a contact that sticks."""
    return float(law.shear_damping * y[B] ** law.damping_power * y[PSI])


@kernel
def rates(law: Coefficients, mode: Mode, y: Array, out: Array) -> None:
    """Write dy/dtau."""
    b, v, slip, loading = y[B], y[V], mode.slip, mode.loading
    f = forces.normal_force(law, mode.peak, loading, b, v)
    out[B] = v
    out[V] = -2.0 * b * ELASTIC_PULL * f
    whole = slip * abs(f) if slip != 0 else y[T] + damping_force(law, y)
    out[PSI] = -4.0 * b * ELASTIC_PULL * law.chi * whole
    out[T] = 0.0 if slip != 0 else spring_rate(law, mode, y, f)
    if law.shear == Shear.MINDLIN_DERESIEWICZ.value:
        out[UPPER] = limit_rate(law, loading, b, v, f)
        out[LOWER] = -out[UPPER]
    elif law.shear == Shear.WALTON_BRAUN.value:
        growth = limit_rate(law, loading, b, v, f) / max(f, 1e-300)
        out[UPPER], out[LOWER] = growth * y[UPPER], growth * y[LOWER]
    else:
        out[UPPER] = out[LOWER] = 0.0


@kernel
def bring_to_limit(law: Coefficients, mode: Mode, y: Array) -> None:
    """Set the elastic force of a sliding contact."""
    limit = mode.slip * abs(forces.normal_force(law, mode.peak, mode.loading, y[B], y[V]))
    y[T] = limit - damping_force(law, y) if law.limits_damping else limit


@kernel
def step(law: Coefficients, mode: Mode, h: float, y: Array, work: Array) -> None:
    """Write the state after a step to work[7], the derivatives on the way to work[:7]."""
    end = work[7]
    rates(law, mode, y, work[0])
    for stage in range(6):
        for i in range(SIZE):
            total = 0.0
            for earlier in range(stage + 1):
                total += NODES[stage, earlier] * work[earlier, i]
            end[i] = y[i] + h * total
        end[B] = max(end[B], 0.1 * TOUCH)
        rates(law, mode, end, work[stage + 1])
    if mode.slip != 0:
        bring_to_limit(law, mode, end)


@kernel
def error_of(law: Coefficients, h: float, y: Array, work: Array) -> float:
    """Return the error of the last step in units of what is tolerated."""
    largest = 0.0
    for i in range(SIZE):
        error = 0.0
        for stage in range(7):
            error += ERROR[stage] * work[stage, i]
        scale = y[B] * y[B] if i >= T else 1.0 + abs(y[i])
        largest = max(largest, abs(h * error) / scale)
    return largest / TOLERANCE


@kernel
def event(law: Coefficients, mode: Mode, pushing: bool, y: Array) -> int:
    """Return what has happened by this state, if anything."""
    b, v, psi, branch, loading = y[B], y[V], y[PSI], mode.branch, mode.loading
    f = forces.normal_force(law, mode.peak, loading, b, v)
    if loading and v <= 0.0:
        return TURNS
    if not loading and (b <= TOUCH or (f <= 0.0 and (law.unloading != 1.0 or not law.pulls))):
        return PARTS
    incremental = law.shear != Shear.SPRING.value
    if incremental and (psi > 0.0 if branch == forces.BACK else psi < 0.0):
        return REVERSES
    if mode.slip == 0:
        whole = y[T] + damping_force(law, y) if law.limits_damping else y[T]
        ahead = -whole if branch == forces.BACK else whole
        stiff = law.shear == Shear.WALTON_BRAUN.value and ahead > (1.0 - NEAR) * f
        if stiff or abs(whole) > abs(f) * (1.0 + 1e-13):
            return SLIDES
        again = law.shear == Shear.MINDLIN_DERESIEWICZ.value and branch == forces.AGAIN
        if again and y[T] > y[UPPER]:
            return CONTINUES
    elif leaves_limit(law, mode, y, f):
        return STICKS
    return PULLS if pushing and f < 0.0 else NOTHING


@kernel
def leaves_limit(law: Coefficients, mode: Mode, y: Array, f: float) -> bool:
    """Return whether the force of a sliding contact would fall below its limit if it stuck."""
    slip, loading = mode.slip, mode.loading
    if law.shear == Shear.WALTON_BRAUN.value and (slip < 0) == (mode.branch == forces.BACK):
        elastic = 2.0 * y[B] * forces.shear_stiffness(law, y[B]) * abs(y[PSI])
        return bool(limit_rate(law, loading, y[B], y[V], f) > 2.0 * np.cbrt(NEAR) * elastic)
    rate = slip * spring_rate(law, mode, y, f)
    if law.limits_damping and law.shear_damping > 0.0:
        b, v, power = y[B], y[V], law.damping_power
        slowing = -4.0 * b * ELASTIC_PULL * law.chi * slip * abs(f)
        rate += slip * law.shear_damping * b**power * (power * v * y[PSI] / b + slowing)
    change = limit_rate(law, loading, y[B], y[V], f) * (1.0 if f >= 0.0 else -1.0)
    return bool(rate < change - 1e-12)


@kernel
def until_event(
    law: Coefficients, mode: Mode, chatters: bool, h: float, y: Array, work: Array
) -> int:
    """Return what ends a step, the state then in work[7]; a law that chatters goes to its end."""
    pushing = forces.normal_force(law, mode.peak, mode.loading, y[B], y[V]) > 0.0
    what = event(law, mode, pushing, work[7])
    if what == NOTHING or chatters:
        return what
    before, after = 0.0, h
    for _ in range(HALVINGS):
        middle = 0.5 * (before + after)
        if middle <= before or middle >= after or after - before < 1e-15:
            break
        step(law, mode, middle, y, work)
        first = event(law, mode, pushing, work[7])
        if first == NOTHING:
            before = middle
        else:
            after, what = middle, first
    step(law, mode, after, y, work)
    return what


@kernel
def outgoing(law: Coefficients, psi: float, work: Array, y: Array) -> float:
    """Return psi_2 of an impact, psi >= 0; NaN if the bodies do not part."""
    y[:] = 0.0
    y[B], y[V], y[PSI] = TOUCH, 1.0, psi
    slip, branch, loading, peak = 0, forces.FIRST, True, 0.0
    h, changes = TOUCH, 0
    for _ in range(MOST_STEPS):
        mode = Mode(slip, branch, loading, peak)
        step(law, mode, h, y, work)
        error = error_of(law, h, y, work)
        if error > 1.0 and h > SHORTEST:  # a cube root that vanishes is stepped over
            h = max(SHORTEST, h * max(0.2, 0.9 * error**-0.2))
            continue
        chatters = changes > PATIENCE and h <= DWELL
        what = until_event(law, mode, chatters, h, y, work)
        for k in range(SIZE):
            y[k] = work[7, k]
        h = min(LONGEST, max(SHORTEST, h * min(5.0, 0.9 * max(error, 1e-10) ** -0.2)))
        if what != NOTHING:
            changes += 1
            h = min(h, DWELL) if changes > PATIENCE else h
        if what == PARTS:
            return float(y[PSI])
        if what == TURNS:
            loading, peak = False, y[B] * y[B]
        elif what == SLIDES:
            ahead = y[T] + damping_force(law, y) if law.limits_damping else y[T]
            slip = 1 if ahead > 0.0 else -1
            bring_to_limit(law, Mode(slip, branch, loading, peak), y)
        elif what == STICKS:
            slip = 0
        elif what == CONTINUES:
            branch = forces.FIRST
        elif what == REVERSES and branch == forces.BACK:
            y[LOWER], branch, slip = y[T], forces.AGAIN, 0
        elif what == REVERSES:
            y[UPPER], branch, slip = y[T], forces.BACK, 0
    return np.nan


@entry_point()
def rebounds(law: Coefficients, psi: Vector, work: Matrix, out: Vector) -> None:
    """Write psi_2 of each impact, NaN where psi is not finite or the bodies do not part."""
    y = work[8]
    for i in range(psi.size):
        if np.isfinite(psi[i]):
            out[i] = np.copysign(1.0, psi[i]) * outgoing(law, abs(psi[i]), work, y)
        else:
            out[i] = np.nan
