"""Collisions with a plate that gives way: each is solved, as its speed decides how far it does."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.pairs import Pair
from carom.collisions.records import CollisionStatus
from carom.dimensionless.elastic import motion as at
from carom.dimensionless.elastic.integration import Work
from carom.dimensionless.elastic.phases import LARGEST_GIVE, Status, run_phases
from carom.dimensionless.elastic.record import Record
from carom.dimensionless.numerics.arrays import Vector
from carom.dimensionless.numerics.kernels import kernel
from carom.dimensionless.rebounds import LINEAR_PSI, NEARLY_ELASTIC, STEP_TOLERANCE


class PlateRule(NamedTuple):
    """What a collision with a plate needs: lambda = give V_n^(1/5), psi = scale V_t/V_n.

    Above `fastest` it gives way like a foil, or is thinner than the penetration of a thick wall.
    """

    chi: float
    scale: float
    give: float
    fastest: float


def plate_rule(pair: Pair) -> PlateRule:
    """Return what collisions of a pair with a plate need, in SI units."""
    assert pair.thickness is not None
    give, depth = pair.plate_give(1.0), pair.scales(1.0).length
    fastest = min((LARGEST_GIVE / give) ** 5, (pair.thickness / depth) ** 1.25)
    scale = pair.kappa / pair.friction if pair.friction > 0.0 else 0.0
    return PlateRule(pair.chi, scale, give, fastest)


@kernel
def rebounds(
    plate: PlateRule,
    work: Work,
    record: Record,
    slope: Vector,
    closing: Vector,
    fraction: Vector,
    status: NDArray[np.int8],
) -> None:
    """Write 1 + beta at each slope psi_1, and (1 + e) V_n in the place of V_n.

    From psi_1 = 4 chi + 1 on the contact slides throughout, and psi_1 - psi_2 stays the same. Where
    psi_1 is 0, without friction or sliding, such an impact gives e.
    """
    sliding = 4.0 * plate.chi + 1.0
    for i in range(status.size):
        if status[i] != CollisionStatus.COLLIDED.value:
            continue
        if closing[i] > plate.fastest:
            status[i] = CollisionStatus.PLATE_TOO_THIN.value
            continue
        moves = slope[i] > 0.0
        psi_1 = max(slope[i], LINEAR_PSI) if moves else sliding
        psi = min(psi_1, sliding)
        give = min(plate.give * closing[i] ** 0.2, LARGEST_GIVE)
        give = give if give >= NEARLY_ELASTIC else 0.0
        record.counts[:] = 0
        ended = run_phases(psi, plate.chi, give, STEP_TOLERANCE, work, record)
        if ended != Status.SOLVED.value:
            status[i] = CollisionStatus.NOT_SOLVED.value
            continue
        lost = (psi - work.series[0, at.PSI]) / psi_1
        fraction[i] = min(2.0, max(0.0, lost)) if moves else 0.0
        closing[i] *= 1.0 - work.series[0, at.V]
