"""The motion of the bodies through an impact, with the contact between them, and its ledger."""

from collections.abc import Iterator
from math import gamma, pi, sqrt
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from carom.halfspace.quasistatic import ContactStep, Patch
from carom.halfspace.transforms import Field

DURATION = 0.8 * sqrt(pi) * gamma(0.4) / gamma(0.9)  # of Hertz's impact, 2.9433 d_max/V_1
NORMAL_RATE = 15.0 / 16.0  # d'' = -NORMAL_RATE P
EDGE_REACH = 1.0  # elements by which the edge may move in a step
SLOWEST = 0.05  # of V_1: near the turning point the number of steps decides
SLOW_CHI = 2.0  # beyond it the tangential motion on its springs decides the length of steps

Number = TypeVar("Number", float, Field)
FROM_TOUCH = 2.0 / 3.0  # of its end, a traction that grows from zero as a square root


class BodyMotion(NamedTuple):
    """The bodies at an instant: psi/kappa along x, y in friction V_1, turn in that over a_max."""

    time: float
    approach: float  # velocity, d'
    velocity: Field  # along x, y and about the normal, shape (3,)
    step: ContactStep
    force: float  # P
    drag: Field  # forces and moment over friction, shape (3,)


class NormalSpin(NamedTuple):
    """Spin about the normal, of the first body less that of the second.

    `speed` is omega a_max/(friction V_1); `lightness` is m_n a_max^2/I, 1/I the sum of 1/I_1 and
    1/I_2, the moments of inertia about the normal.
    """

    speed: float = 0.0
    lightness: float = 0.0


NO_SPIN = NormalSpin()


def responses(chi: float, kappa: float, lightness: float) -> Field:
    """Return how forces along x and y and the moment change velocities, V' = -response F."""
    along = 2.0 * NORMAL_RATE * chi / kappa
    return np.array([along, along, NORMAL_RATE * lightness])


def move(
    patch: Patch, psi: Field, chi: float, steps: int, spin: NormalSpin = NO_SPIN
) -> Iterator[BodyMotion]:
    """Yield the impact step by step, from the first touch to the last; psi along x and y.

    Verlet's method, of second order: half of the change of velocities, the path, the quasi-static
    contact at its end, the other half (Hairer, Lubich & Wanner 2003, Acta Numerica 12:399). Steps
    are a fraction of the duration of Hertz's impact, smaller where the edge of the contact moves
    fast, and for large chi in proportion to 1/omega, omega^2 = (15/4) chi. The last one is cut
    where the bodies part.
    """
    kappa, spacing = patch.compliance.materials.kappa, patch.compliance.spacing
    response = responses(chi, kappa, spin.lightness)
    velocity = np.array([*psi / kappa, spin.speed])
    longest = DURATION / steps / max(1.0, sqrt(chi / SLOW_CHI))
    now = BodyMotion(0.0, 1.0, velocity, _apart(patch, np.zeros(3)), 0.0, np.zeros(3))
    yield now
    while True:
        state = now.step.state
        radius = max(sqrt(state.depth), 0.25 * spacing)  # of the edge, a = sqrt d
        edge = EDGE_REACH * spacing * 2.0 * radius / max(abs(now.approach), SLOWEST)
        length = min(longest, edge)
        approach = now.approach - 0.5 * length * NORMAL_RATE * now.force
        velocity = now.velocity - 0.5 * length * response * now.drag
        depth = state.depth + length * approach
        if depth <= 0.0:
            left = state.depth / -approach
            apart = _apart(patch, state.displacement + left * velocity)
            yield BodyMotion(now.time + left, approach, velocity, apart, 0.0, np.zeros(3))
            return
        step = patch.advance(state, depth, state.displacement + length * velocity, length)
        force, drag = patch.grid.force(step.state.pressure), patch.grid.drag(step.state.traction)
        approach = approach - 0.5 * length * NORMAL_RATE * force
        velocity = velocity - 0.5 * length * response * drag
        now = BodyMotion(now.time + length, approach, velocity, step, force, drag)
        yield now


def _apart(patch: Patch, displacement: Field) -> ContactStep:
    """Return the step at whose end the bodies do not touch."""
    state = patch.untouched()._replace(displacement=displacement)
    return ContactStep(state, state.yielded, state.yielded)


class LedgerEntry(NamedTuple, Generic[Number]):
    """One instant of an impact, or all of them; `across` is along y, `spin` about the normal.

    Units are d_max, d_max/V_1, those of psi for the tangential motion, and of Hertz's impact for
    the normal one; of spin those of `BodyMotion`, of its moment those of drag. What is `lost` and
    the angles belong to the step that ends here.
    """

    time: Number
    penetration: Number
    centre_speed: Number  # d', and of the surfaces, as the wall does not give way
    displacement: Number
    psi: Number
    psi_across: Number
    spin: Number
    normal_force: Number
    force: Number
    moment: Number  # against the spin
    contact_radius: Number  # of the circle of the same area
    stick_radius: Number  # of that of the area that sticks
    slip_share: Number  # of the elements that touch
    normal_stored: Number
    stored: Number
    lost: Number  # to friction
    lost_across: Number  # of that, by slip across
    slip_angle: Number  # between slip and x, averaged over the work of friction
    slip_angle_max: Number
    slip_force: Number  # what of the tangential force slipping elements bear, over friction


def entry(patch: Patch, chi: float, before: BodyMotion, now: BodyMotion) -> LedgerEntry[float]:
    """Return what the step from one instant to the next comes to."""
    state, old, grid = now.step.state, before.step.state, patch.grid
    moved, slips = now.step.moved, now.step.slips
    kappa, of_normal = patch.compliance.materials.kappa, 2.0 * NORMAL_RATE
    energy = kappa * chi * of_normal
    mean = np.where(old.pressure > 0.0, 0.5, FROM_TOUCH) * (old.traction + state.traction)
    work = energy * grid.element * mean * moved
    angle, largest = _angles(state.traction[:, slips], moved[:, slips])
    touching = np.count_nonzero(state.pressure > 0.0)
    share = np.count_nonzero(slips) / touching if touching else 1.0
    radius = sqrt(touching * grid.element / pi)
    velocity = kappa * now.velocity
    return LedgerEntry(
        now.time,
        state.depth,
        now.approach,
        kappa * float(state.displacement[0]),
        float(velocity[0]),
        float(velocity[1]),
        float(now.velocity[2]),
        0.75 * now.force,
        0.5 * float(now.drag[0]),
        float(now.drag[2]),
        radius,
        sqrt(1.0 - share) * radius,
        share,
        of_normal * 0.5 * grid.force(state.pressure * (state.depth - grid.apart)),
        energy * 0.5 * grid.element * float(np.sum(state.traction * state.yielded)),
        float(work.sum()),
        float(work[1].sum()),
        angle,
        largest,
        0.75 * grid.element * float(state.traction[0, slips].sum()),
    )


def _angles(pulled: Field, slid: Field) -> tuple[float, float]:
    """Return mean and largest angle of slip from x, along the traction, known better; else zero."""
    if not pulled.size:
        return 0.0, 0.0
    work = np.maximum(np.sum(slid * pulled, axis=0), 0.0)
    angle = np.arctan2(np.abs(pulled[1]), np.abs(pulled[0]))
    mean = float(np.sum(angle * work) / np.sum(work)) if work.any() else 0.0
    return mean, float(angle.max())
