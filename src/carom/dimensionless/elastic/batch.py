"""Many elastic impacts: psi_2, status and sequence of phases, in threads."""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.integration import Work
from carom.dimensionless.elastic.motion import PSI
from carom.dimensionless.elastic.phases import Status, new_work, run_phases
from carom.dimensionless.elastic.record import KIND, KIND_SIGN, Record, new_record
from carom.dimensionless.numerics.arrays import Array, Codes, Counts, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.dimensionless.numerics.threads import in_blocks

STEP_TOLERANCE = 1e-10  # of one Taylor step; keeps psi_2 to a tenth of what `rebound` promises
LINEAR_PSI = 1e-6  # below, psi_2 is taken proportional to psi_1: rounding would cost more
BLOCK, SMALLEST_BLOCK = 256, 8  # impacts that a thread takes at once


@kernel
def outgoing(psi_1: float, chi: float, work: Work, record: Record) -> tuple[float, int]:
    """Return psi_2 of one impact, of either sign, and its status."""
    speed = abs(psi_1)
    scale = 1.0
    if 0.0 < speed < LINEAR_PSI:
        scale = speed / LINEAR_PSI
        speed = LINEAR_PSI
    status = run_phases(speed, chi, STEP_TOLERANCE, work, record)
    if status != Status.SOLVED:
        return np.nan, status
    result = scale * work.series[0, PSI] if speed > 0.0 else 0.0
    return -result if np.signbit(psi_1) else result, status


@kernel
def code_of_phases(record: Record) -> int:
    """Return a number that tells one sequence of phases and stretches of memory from another."""
    code = 1 + int(record.counts[1])
    for row in range(record.counts[2]):
        digit = 3 * int(record.changes[row, KIND]) + int(record.changes[row, KIND_SIGN]) + 1
        code = (code * 16 + digit) % 2147483629  # a prime: sequences of any length stay apart
    return code


@entry_point()
def fill(
    psi_1: Vector,
    chi: Vector,
    work: Work,
    record: Record,
    psi_2: Vector,
    status: Codes,
    sequence: Counts,
) -> None:
    """Write psi_2, the status and the sequence of phases of every impact."""
    for i in range(psi_1.size):
        record.counts[:] = 0
        psi_2[i], status[i] = outgoing(psi_1[i], chi[i], work, record)
        sequence[i] = code_of_phases(record)


def solved(
    psi_1: Array, chi: Array, threads: int | None = None
) -> tuple[Array, NDArray[np.int8], NDArray[np.int64]]:
    """Return psi_2, `Status` and a number for the sequence of phases of impacts, in threads."""
    psi_2, status = np.empty(psi_1.size), np.empty(psi_1.size, dtype=np.int8)
    sequence = np.empty(psi_1.size, dtype=np.int64)

    def block(part: slice) -> None:
        results = psi_2[part], status[part], sequence[part]
        fill(psi_1[part], chi[part], new_work(), new_record(False), *results)

    in_blocks(block, psi_1.size, BLOCK, SMALLEST_BLOCK, threads)
    return psi_2, status, sequence
