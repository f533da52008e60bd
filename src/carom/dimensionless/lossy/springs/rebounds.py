"""Marched impacts: what they come to, extrapolated from two numbers of springs."""

import numpy as np

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import FAR, Loss, LossNumbers, keep_energy, why_not
from carom.dimensionless.lossy.springs.march import march
from carom.dimensionless.lossy.springs.work import MOST_SPRINGS, Arrays
from carom.dimensionless.numerics.arrays import Codes, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

YIELDING, RELAXING = (100, 300), (MOST_SPRINGS // 2, MOST_SPRINGS)  # springs, for 3e-5 and 1e-6


@kernel
def law_of(loss: int, parameter: float, extra: float) -> LossNumbers:
    """Return what the impact loses energy to; a yielding sphere is elastic in shear."""
    return LossNumbers(loss, parameter, 0.0 if loss == Loss.PLASTIC.value else extra)


@kernel
def springs_of(loss: int) -> tuple[int, int]:
    """Return how many springs the contact is cut into, first coarsely."""
    return YIELDING if loss == Loss.PLASTIC.value else RELAXING


@entry_point()
def run(
    psi: float, chi: float, loss: int, parameter: float, extra: float, work: Arrays, numbers: Vector
) -> int:
    """Run an impact of any psi_1; return its status. Beyond FAR psi_1 - psi_2 is the same.

    Numbers are Richardson's (1911), of two numbers of springs.
    """
    status = why_not(psi, chi)
    if status == Status.SOLVED.value:
        law, (few, many) = law_of(loss, parameter, extra), springs_of(loss)
        speed = min(abs(psi), FAR)
        coarse = march(speed, chi, law, few, work, work.no_rows, work.coarse)
        fine = march(speed, chi, law, many, work, work.no_rows, numbers)
        if coarse == 0 or fine == 0:
            status = Status.UNRESOLVED.value
        for j in range(numbers.size):
            numbers[j] += (numbers[j] - work.coarse[j]) / ((many / few) ** 2 - 1.0)
            if not np.isfinite(numbers[j]):
                status = Status.UNRESOLVED.value
        keep_energy(speed, numbers)
        numbers[layout.PSI_OUT] += abs(psi) - speed
        numbers[layout.PSI_OUT] *= np.copysign(1.0, psi)
    if status != Status.SOLVED.value:
        numbers[:] = np.nan
    return status


@entry_point()
def trace(
    psi: float,
    chi: float,
    loss: int,
    parameter: float,
    extra: float,
    count: int,
    work: Arrays,
    rows: Matrix,
) -> int:
    """Fill in a row for each step over so many springs; return the number of steps."""
    return march(psi, chi, law_of(loss, parameter, extra), count, work, rows, work.coarse)


@entry_point()
def fill(
    psi: Vector,
    chi: Vector,
    loss: int,
    parameter: Vector,
    extra: Vector,
    work: Arrays,
    numbers: Matrix,
    status: Codes,
) -> None:
    """Write what every impact comes to, and its status."""
    for i in range(psi.size):
        status[i] = run(psi[i], chi[i], loss, parameter[i], extra[i], work, numbers[i])
