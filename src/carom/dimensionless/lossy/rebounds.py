"""Rebounds of many impacts with losses at once."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.batch import solved
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.panels import record as layout
from carom.dimensionless.lossy.panels.normal import Loss
from carom.dimensionless.lossy.panels.plans import TOLERANCE
from carom.dimensionless.lossy.panels.record import PSI_OUT, Trace, new_record
from carom.dimensionless.lossy.panels.work import Arrays, new_work
from carom.dimensionless.lossy.viscoelastic import impacts as viscoelastic
from carom.dimensionless.lossy.viscoelastic.impacts import NEVER
from carom.dimensionless.lossy.yielding import impacts as yielding
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array, Codes, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.dimensionless.numerics.threads import in_blocks

NEARLY_ELASTIC, NEARLY_YIELDING = 1e-10, 1e-5
TIE = 1e-6  # about psi_1 = 1
LINEAR, FAR = 1e-3, 1e4  # psi_1 between which impacts are solved
BLOCK, SMALLEST_BLOCK = 64, 2  # impacts that a thread takes at once


def is_elastic(loss: int, parameter: float) -> bool:
    """Tell whether so little is lost, 1 - e below 2e-10, that the impact is the elastic one."""
    if loss == Loss.VISCOUS:
        return 0.0 <= parameter < NEARLY_ELASTIC
    return loss == Loss.NONE or parameter > 1.0 - NEARLY_YIELDING


class LossyRebounds(NamedTuple):
    """What impacts with losses come to, in the units of elastic ones; arrays of one shape."""

    psi_out: Array
    restitution: Array
    duration: Array
    max_penetration: Array
    max_force: Array
    max_radius: Array
    shear_lost: Array
    status: NDArray[np.int8]


@entry_point()
def outgoing(
    psi: float,
    chi: float,
    loss: int,
    parameter: float,
    tolerance: float,
    work: Arrays,
    record: Trace,
    numbers: Vector,
) -> tuple[int, int]:
    """Run an impact of any psi_1; return its status and the number of panels.

    Below LINEAR psi_2/psi_1 is linear in psi_1, beyond FAR the impulse is that of sliding.
    """
    speed, other = abs(psi), 0.0
    if speed < LINEAR:
        run_beside(2.0 * LINEAR, chi, loss, parameter, tolerance, work, record, numbers)
        other = 0.5 * numbers[PSI_OUT] / LINEAR
    near = min(max(speed, LINEAR), FAR) if np.isfinite(psi) else psi
    status, panels = run_beside(near, chi, loss, parameter, tolerance, work, record, numbers)
    if speed < LINEAR:
        ratio = numbers[PSI_OUT] / LINEAR
        numbers[PSI_OUT] = speed * (ratio + (ratio - other) * (1.0 - speed / LINEAR))
        numbers[layout.SHEAR_LOST] *= (speed / LINEAR) ** 2
    elif speed > FAR:
        numbers[PSI_OUT] += speed - FAR
    numbers[PSI_OUT] *= np.copysign(1.0, psi)
    if status != Status.SOLVED.value:
        numbers[:] = np.nan
    return status, panels


@kernel
def run_beside(
    psi: float,
    chi: float,
    loss: int,
    parameter: float,
    tolerance: float,
    work: Arrays,
    record: Trace,
    numbers: Array,
) -> tuple[int, int]:
    """Run an impact, psi_1 > 0, beside the border of stick if it lies on it."""
    if loss == Loss.VISCOUS.value:
        return viscoelastic.run(psi, chi, parameter, tolerance, NEVER, work, numbers, record)
    beside = TIE if chi <= 0.5 and abs(psi - 1.0) < TIE else 0.0  # slip would start too slowly
    status, panels = yielding.run(
        psi + beside, chi, loss, parameter, tolerance, work, numbers, record
    )
    numbers[PSI_OUT] -= beside
    return status, panels


@entry_point()
def fill(
    psi: Vector,
    chi: Vector,
    loss: int,
    parameter: Vector,
    tolerance: float,
    work: Arrays,
    record: Trace,
    numbers: Matrix,
    status: Codes,
) -> None:
    """Write what every impact comes to, and its status."""
    for i in range(psi.size):
        given = psi[i], chi[i], loss, parameter[i], tolerance
        status[i], _ = outgoing(*given, work, record, numbers[i])


def lossy_rebounds(
    psi: Array,
    chi: Array,
    loss: int,
    parameter: Array,
    threads: int | None = None,
    tolerance: float = TOLERANCE,
) -> LossyRebounds:
    """Return what impacts with losses come to, all arguments of one length, in threads.

    NaN where the status is not SOLVED.
    """
    numbers, status = np.ones((psi.size, layout.NUMBERS)), np.zeros(psi.size, dtype=np.int8)
    elastic = np.array([is_elastic(loss, float(value)) for value in parameter], dtype=bool)
    numbers[:, layout.TIME], numbers[:, layout.SHEAR_LOST] = hertz.DURATION, 0.0
    numbers[elastic, PSI_OUT], status[elastic], _ = solved(psi[elastic], chi[elastic], threads)
    numbers[status != Status.SOLVED] = np.nan
    lossy = np.flatnonzero(~elastic)
    psis, chis, parameters = psi[lossy], chi[lossy], parameter[lossy]
    found, codes = np.empty((lossy.size, layout.NUMBERS)), np.empty(lossy.size, dtype=np.int8)

    def block(part: slice) -> None:
        given = psis[part], chis[part], int(loss), parameters[part], tolerance
        fill(*given, new_work(), new_record(False), found[part], codes[part])

    in_blocks(block, lossy.size, BLOCK, SMALLEST_BLOCK, threads)
    numbers[lossy], status[lossy] = found, codes
    return LossyRebounds(
        psi_out=numbers[:, PSI_OUT],
        restitution=numbers[:, layout.RESTITUTION],
        duration=numbers[:, layout.TIME],
        max_penetration=numbers[:, layout.DEEPEST],
        max_force=numbers[:, layout.STRONGEST],
        max_radius=numbers[:, layout.WIDEST],
        shear_lost=numbers[:, layout.SHEAR_LOST],
        status=status,
    )
