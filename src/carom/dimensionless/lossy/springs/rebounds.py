"""Marched impacts: what they come to, extrapolated from two numbers of springs."""

import numpy as np

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import Loss, why_not
from carom.dimensionless.lossy.springs.march import Law, march
from carom.dimensionless.lossy.springs.work import Arrays
from carom.dimensionless.numerics.arrays import Codes, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

YIELDING, RELAXING = 200, 800  # springs, for 1e-5 and 1e-6


@kernel
def springs_of(loss: int) -> int:
    """Return how many springs the contact is cut into."""
    return YIELDING if loss == Loss.PLASTIC.value else RELAXING


@entry_point()
def run(
    psi: float,
    chi: float,
    loss: int,
    parameter: float,
    extra: float,
    work: Arrays,
    rows: Matrix,
    numbers: Vector,
) -> tuple[int, int]:
    """Run an impact of any psi_1; return its status and the number of steps.

    Numbers are Richardson's (1911) of all springs and half of them, rows those of all.
    """
    steps, status = 0, why_not(psi, chi)
    if status == Status.SOLVED.value:
        law, count = Law(loss, parameter, extra), springs_of(loss)
        half = march(abs(psi), chi, law, count // 2, work, rows[:0], work.coarse)
        steps = march(abs(psi), chi, law, count, work, rows, numbers)
        numbers[:] += (numbers - work.coarse) / 3.0
        numbers[layout.PSI_OUT] *= np.copysign(1.0, psi)
        if half == 0 or steps == 0 or not np.all(np.isfinite(numbers)):
            status = Status.UNRESOLVED.value
    if status != Status.SOLVED.value:
        numbers[:] = np.nan
    return status, steps


@entry_point()
def fill(
    psi: Vector,
    chi: Vector,
    loss: int,
    parameter: Vector,
    extra: Vector,
    work: Arrays,
    rows: Matrix,
    numbers: Matrix,
    status: Codes,
) -> None:
    """Write what every impact comes to, and its status."""
    for i in range(psi.size):
        given = psi[i], chi[i], loss, parameter[i], extra[i]
        status[i], _ = run(*given, work, rows, numbers[i])
