"""Rebounds of many impacts with losses at once."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.batch import solved
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import FAR, Loss, LossNumbers, keep_energy, largest_pressure
from carom.dimensionless.lossy.layout import PSI_OUT
from carom.dimensionless.lossy.panels.work import Arrays, new_work
from carom.dimensionless.lossy.springs import rebounds as springs
from carom.dimensionless.lossy.springs.march import new_work as new_springs
from carom.dimensionless.lossy.viscoelastic import impacts as viscoelastic
from carom.dimensionless.lossy.viscoelastic.impacts import NEVER, TOLERANCE
from carom.dimensionless.lossy.viscoelastic.record import Trace, new_record
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array, Codes, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point
from carom.dimensionless.numerics.threads import in_blocks

NEARLY_ELASTIC, NEARLY_YIELDING = 1e-10, 1e-5
LINEAR = 1e-3  # psi_1 of viscoelastic impacts that is solved at least
BLOCK, SMALLEST_BLOCK = 64, 2  # impacts that a thread takes at once


def is_elastic(loss: int, parameter: Array, extra: Array) -> NDArray[np.bool_]:
    """Tell where so little is lost, 1 - e below 2e-10, that the impact is the elastic one."""
    if loss == Loss.PLASTIC:
        return np.asarray(parameter > 1.0 - NEARLY_YIELDING)
    alpha = parameter * extra if loss == Loss.RELAXING else parameter
    return np.asarray((alpha >= 0.0) & (alpha < NEARLY_ELASTIC))


class LossyRebounds(NamedTuple):
    """What impacts with losses come to, in the units of elastic ones; arrays of one shape."""

    psi_out: Array
    restitution: Array
    duration: Array
    max_penetration: Array
    max_force: Array
    max_radius: Array
    max_pressure: Array
    shear_lost: Array
    status: NDArray[np.int8]


@entry_point()
def outgoing(
    psi: float,
    chi: float,
    alpha: float,
    tolerance: float,
    work: Arrays,
    record: Trace,
    numbers: Vector,
) -> tuple[int, int]:
    """Run a viscoelastic impact of any psi_1; return its status and the number of panels.

    Below LINEAR psi_2/psi_1 is linear in psi_1, and friction's share of the loss the same; beyond
    FAR psi_1 - psi_2 is the same.
    """
    speed, bent, other = abs(psi), False, 0.0
    given = chi, alpha, tolerance, NEVER, work, numbers, record
    if speed < LINEAR:
        twice, _ = viscoelastic.run(2.0 * LINEAR, *given)
        bent, other = twice == Status.SOLVED.value, 0.5 * numbers[PSI_OUT] / LINEAR
    near = min(max(speed, LINEAR), FAR) if np.isfinite(psi) else psi
    status, panels = viscoelastic.run(near, *given)
    keep_energy(near, numbers)
    if speed < LINEAR:
        ratio = numbers[PSI_OUT] / LINEAR
        more = (ratio - other) * (1.0 - speed / LINEAR) if bent else 0.0
        lost, solved_lost = 1.0 - (ratio + more) ** 2, 1.0 - ratio**2
        numbers[PSI_OUT] = speed * (ratio + more)
        share = lost / solved_lost if solved_lost > 0.0 else 1.0
        numbers[layout.SHEAR_LOST] *= share * (speed / LINEAR) ** 2
    elif speed > FAR:
        numbers[PSI_OUT] += speed - FAR
    numbers[PSI_OUT] *= np.copysign(1.0, psi)
    if status != Status.SOLVED.value:
        numbers[:] = np.nan
    return status, panels


@entry_point()
def fill(
    psi: Vector,
    chi: Vector,
    alpha: Vector,
    tolerance: float,
    work: Arrays,
    record: Trace,
    numbers: Matrix,
    status: Codes,
) -> None:
    """Write what every viscoelastic impact comes to, and its status."""
    for i in range(psi.size):
        given = psi[i], chi[i], alpha[i], tolerance
        status[i], _ = outgoing(*given, work, record, numbers[i])


def lossy_rebounds(
    psi: Array,
    chi: Array,
    losses: LossNumbers,
    threads: int | None = None,
    tolerance: float = TOLERANCE,
) -> LossyRebounds:
    """Return what impacts with losses come to, psi and chi of one length, in threads.

    NaN where the status is not SOLVED.
    """
    numbers, status = np.ones((psi.size, layout.NUMBERS)), np.zeros(psi.size, dtype=np.int8)
    parameter, extra = (np.broadcast_to(x, psi.shape) for x in losses[1:])
    elastic = is_elastic(losses.loss, parameter, extra)
    numbers[:, layout.TIME], numbers[:, layout.SHEAR_LOST] = hertz.DURATION, 0.0
    numbers[elastic, PSI_OUT], status[elastic], _ = solved(psi[elastic], chi[elastic], threads)
    numbers[status != Status.SOLVED] = np.nan
    lossy = np.flatnonzero(~elastic)
    psis, chis, parameters, extras = (x[lossy] for x in (psi, chi, parameter, extra))
    found, codes = np.empty((lossy.size, layout.NUMBERS)), np.empty(lossy.size, dtype=np.int8)

    def block(part: slice) -> None:
        given, out = (psis[part], chis[part]), (found[part], codes[part])
        if losses.loss == Loss.VISCOUS:
            fill(*given, parameters[part], tolerance, new_work(), new_record(False), *out)
            return
        law = int(losses.loss), parameters[part], extras[part]
        springs.fill(psis[part], chis[part], *law, new_springs(), *out)

    in_blocks(block, lossy.size, BLOCK, SMALLEST_BLOCK, threads)
    numbers[lossy], status[lossy] = found, codes
    force, radius = numbers[:, layout.STRONGEST], numbers[:, layout.WIDEST]
    pressure = np.where(elastic, 1.0, largest_pressure(losses.loss, force, radius))
    return LossyRebounds(
        psi_out=numbers[:, PSI_OUT],
        restitution=numbers[:, layout.RESTITUTION],
        duration=numbers[:, layout.TIME],
        max_penetration=numbers[:, layout.DEEPEST],
        max_force=force,
        max_radius=radius,
        max_pressure=np.where(status == Status.SOLVED, pressure, np.nan),
        shear_lost=numbers[:, layout.SHEAR_LOST],
        status=status,
    )
