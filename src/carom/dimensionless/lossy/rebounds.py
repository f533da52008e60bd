"""Rebounds of many impacts with losses at once."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless._jit import kernel
from carom.dimensionless.blocks import in_blocks
from carom.dimensionless.lossy.impacts import run
from carom.dimensionless.lossy.normal import Loss
from carom.dimensionless.lossy.record import (
    DEEPEST,
    NUMBERS,
    PSI_OUT,
    RESTITUTION,
    STRONGEST,
    TIME,
    WIDEST,
    Array,
    Record,
    new_record,
)
from carom.dimensionless.lossy.work import Work, new_work
from carom.dimensionless.phases import Status

TOLERANCE = 1e-9  # of a panel; keeps psi_2 to 1e-8 max(1, |psi_1|)
TIE = 1e-6  # about psi_1 = 1
LINEAR = 1e-4  # below, psi_2 is taken proportional to psi_1
BLOCK, SMALLEST_BLOCK = 64, 2  # impacts that a thread takes at once


class Rebounds(NamedTuple):
    """What impacts with losses come to, in the units of elastic ones; arrays of one shape."""

    psi_out: Array
    restitution: Array
    duration: Array
    max_penetration: Array
    max_force: Array
    max_radius: Array
    status: NDArray[np.int8]


@kernel
def outgoing(
    psi: float, chi: float, loss: int, parameter: float, work: Work, record: Record, numbers: Array
) -> tuple[int, int]:
    """Run an impact of any psi_1; return its status and the number of panels."""
    speed, scale = abs(psi), np.copysign(1.0, psi)
    if speed < LINEAR:
        speed, scale = LINEAR, psi / LINEAR
    beside = 0.0
    if loss != Loss.VISCOUS.value and chi <= 0.5 and abs(speed - 1.0) < TIE:
        beside = TIE  # at the border of stick, slip would start too slowly to be told
    status, panels = run(speed + beside, chi, loss, parameter, TOLERANCE, work, numbers, record)
    numbers[PSI_OUT] = scale * (numbers[PSI_OUT] - beside)
    if status != Status.SOLVED.value:
        numbers[:] = np.nan
    return status, panels


@kernel
def fill(
    psi: Array,
    chi: Array,
    loss: NDArray[np.int64],
    parameter: Array,
    work: Work,
    record: Record,
    numbers: Array,
    status: NDArray[np.int8],
) -> None:
    """Write what every impact comes to, and its status."""
    for i in range(psi.size):
        status[i], _ = outgoing(psi[i], chi[i], loss[i], parameter[i], work, record, numbers[i])


def lossy_rebounds(
    psi: Array, chi: Array, loss: int, parameter: Array, threads: int | None = None
) -> Rebounds:
    """Return what impacts with losses come to, all arguments of one length, in threads.

    NaN where the status is not SOLVED.
    """
    numbers, status = np.empty((psi.size, NUMBERS)), np.empty(psi.size, dtype=np.int8)
    losses = np.full(psi.size, loss)

    def block(part: slice) -> None:
        given = psi[part], chi[part], losses[part], parameter[part]
        fill(*given, new_work(), new_record(False), numbers[part], status[part])

    in_blocks(block, psi.size, BLOCK, SMALLEST_BLOCK, threads)
    return Rebounds(
        psi_out=numbers[:, PSI_OUT],
        restitution=numbers[:, RESTITUTION],
        duration=numbers[:, TIME],
        max_penetration=numbers[:, DEEPEST],
        max_force=numbers[:, STRONGEST],
        max_radius=numbers[:, WIDEST],
        status=status,
    )
