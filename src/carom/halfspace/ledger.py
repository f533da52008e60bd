"""What a step of an impact comes to: forces, zones, energies, and which way the slip goes."""

from math import pi, sqrt
from typing import NamedTuple

import numpy as np

from carom.halfspace.influence import Field
from carom.halfspace.motion import BodyMotion
from carom.halfspace.quasistatic import Patch

FROM_TOUCH = 2.0 / 3.0  # of its end, a traction that grows from zero as a square root


class LedgerEntry(NamedTuple):
    """One instant of an impact, or all of them; `across` is along y, `turn` about the normal.

    Units as in `Compliance` and `BodyMotion`; energies of the normal motion in E* a_max d_max^2, of
    the tangential motion in friction^2 times that. What is `lost` and the angles belong to the step
    that ends here.
    """

    time: float
    depth: float
    approach: float
    displacement: float
    velocity: float
    velocity_across: float
    turn_velocity: float
    force: float
    drag: float
    moment: float
    contact_radius: float  # of the circle of the same area
    slip_share: float  # of the elements that touch
    normal_stored: float
    tangential_stored: float
    lost: float  # to friction
    lost_across: float  # of that, by slip across
    slip_angle: float  # between slip and x, averaged over the work of friction
    slip_angle_max: float
    slip_drag: float  # what of the drag is that of slipping elements

    @property
    def stick_radius(self) -> float:
        """Radius of the circle of the area that sticks."""
        share: float = (1.0 - self.slip_share) ** 0.5
        return share * self.contact_radius

    @property
    def normal_force(self) -> float:
        """Normal force in the largest of Hertz's impact."""
        return 0.75 * self.force

    @property
    def tangential_force(self) -> float:
        """Tangential force in (3/2) friction times that."""
        return 0.5 * self.drag


def entry(patch: Patch, before: BodyMotion, now: BodyMotion) -> LedgerEntry:
    """Return what the step from one instant to the next comes to."""
    state, old, grid = now.step.state, before.step.state, patch.grid
    moved, slips = now.step.moved, now.step.slips
    mean = np.where(old.pressure > 0.0, 0.5, FROM_TOUCH) * (old.traction + state.traction)
    work = grid.element * mean * moved
    angle, largest = _angles(state.traction[:, slips], moved[:, slips])
    touching = np.count_nonzero(state.pressure > 0.0)
    return LedgerEntry(
        now.time,
        state.depth,
        now.approach,
        float(state.displacement[0]),
        float(now.velocity[0]),
        float(now.velocity[1]),
        float(now.velocity[2]),
        now.force,
        float(now.drag[0]),
        float(now.drag[2]),
        sqrt(touching * grid.element / pi),
        np.count_nonzero(slips) / touching if touching else 1.0,
        0.5 * grid.force(state.pressure * (state.depth - grid.apart)),
        0.5 * grid.element * float(np.sum(state.traction * state.yielded)),
        float(work.sum()),
        float(work[1].sum()),
        angle,
        largest,
        grid.element * float(state.traction[0, slips].sum()),
    )


def _angles(pulled: Field, slid: Field) -> tuple[float, float]:
    """Return mean and largest angle against x of what slips; zero where nothing does.

    Slip is along the traction, whose direction is known better where slip is little.
    """
    if not pulled.size:
        return 0.0, 0.0
    work = np.maximum(np.sum(slid * pulled, axis=0), 0.0)
    angle = np.arctan2(np.abs(pulled[1]), np.abs(pulled[0]))
    mean = float(np.sum(angle * work) / np.sum(work)) if work.any() else 0.0
    return mean, float(angle.max())
