"""Marched impacts: what they come to, extrapolated from two numbers of springs."""

import numpy as np

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import FAR, Loss, keep_energy, why_not
from carom.dimensionless.lossy.springs import thornton
from carom.dimensionless.lossy.springs.march import (
    ELASTIC_CLOCK,
    MOST_SPRINGS,
    PER_SPRING,
    Arrays,
    march,
    new_work,
)
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.numerics.arrays import Codes, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

TRIAL = 40  # springs with which the clock of the loading is found
LEAST_ERROR = 1e-6  # of psi_2, in max(1, psi_1)
FEW, MANY = MOST_SPRINGS // 2, MOST_SPRINGS


@kernel
def step_for(psi: float, inertia: Inertia, solid: Solid, count: int, work: Arrays) -> float:
    """Return the step of the clock with which the contact is cut into so many springs."""
    trial = ELASTIC_CLOCK / (PER_SPRING * TRIAL)
    _, clock = march(psi, inertia, solid, trial, work, work.coarse)
    return float(clock / (PER_SPRING * count))


@entry_point()
def run(
    psi: float, inertia: Inertia, solid: Solid, work: Arrays, numbers: Vector
) -> tuple[int, float]:
    """Run an impact of any psi_1; return its status, and an estimate of the error of psi_2.

    Beyond FAR psi_1 - psi_2 is the same. Numbers are Richardson's (1911), of two numbers of
    springs, and the error is what he adds, but not below LEAST_ERROR, as that may be by chance.
    """
    status, error = why_not(psi, inertia.chi), 0.0
    if status == Status.SOLVED.value:
        speed = min(abs(psi), FAR)
        if psi < 0.0:
            inertia = Inertia(inertia.chi, -inertia.eps, -inertia.zeta)
        h = step_for(speed, inertia, solid, FEW, work)
        coarse, _ = march(speed, inertia, solid, h, work, work.coarse)
        fine, _ = march(speed, inertia, solid, h * FEW / MANY, work, numbers)
        if coarse == 0 or fine == 0:
            status = Status.UNRESOLVED.value
        for j in range(numbers.size):
            more = (numbers[j] - work.coarse[j]) / ((MANY / FEW) ** 2 - 1.0)
            if j == layout.PSI_OUT:
                error = max(abs(more), LEAST_ERROR * max(speed, 1.0))
            numbers[j] += more
            if not np.isfinite(numbers[j]):
                status = Status.UNRESOLVED.value
        if inertia.eps == 0.0 and inertia.zeta == 0.0:
            if solid.loss == Loss.PLASTIC.value:
                thornton.come_to(solid.parameter, numbers)
            keep_energy(speed, numbers)
        numbers[layout.PSI_OUT] += abs(psi) - speed
        numbers[layout.PSI_OUT] *= np.copysign(1.0, psi)
    if status != Status.SOLVED.value:
        numbers[:], error = np.nan, np.nan
    return status, error


@entry_point()
def trace(
    psi: float, inertia: Inertia, solid: Solid, count: int, trial: Arrays, work: Arrays
) -> int:
    """Fill in a row for each step over so many springs; return the number of steps."""
    h = step_for(psi, inertia, solid, count, trial)
    return march(psi, inertia, solid, h, work, work.coarse)[0]


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
        solid = Solid(loss, parameter[i], extra[i] if loss == Loss.RELAXING.value else 0.0)
        status[i], _ = run(psi[i], Inertia(chi[i], 0.0, 0.0), solid, work, numbers[i])


def march_rebound(psi: float, inertia: Inertia, solid: Solid) -> tuple[float, float]:
    """Return psi_2 by the march, and an estimate of its error; NaN if it is not solved.

    >>> from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia
    >>> from carom.dimensionless.lossy.springs.rebounds import march_rebound
    >>> psi_2, error = march_rebound(0.3, Inertia(chi=4.0), ELASTIC)
    >>> round(psi_2, 6), error < 1e-5
    (-0.3, True)
    """
    numbers = np.empty(layout.NUMBERS)
    _, error = run(psi, inertia, solid, new_work(), numbers)
    return float(numbers[layout.PSI_OUT]), error


def marched(psi: float, inertia: Inertia, solid: Solid, springs: int) -> Vector:
    """Return what an impact comes to over so many springs, not extrapolated."""
    work = new_work(most=springs)
    steps = trace(psi, inertia, solid, springs, work, work)
    return work.coarse if steps else np.full(layout.NUMBERS, np.nan)
