"""Rebounds of many impacts with losses at once."""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.batch import solved
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import Loss, LossNumbers, LossyRebounds, named
from carom.dimensionless.lossy.springs import march
from carom.dimensionless.lossy.viscoelastic import impacts as viscoelastic, record, work
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.threads import in_blocks

NEARLY_ELASTIC, NEARLY_YIELDING = 1e-10, 1e-5
BLOCK, SMALLEST_BLOCK = 64, 2  # impacts that a thread takes at once


def is_elastic(loss: int, parameter: Array, extra: Array) -> NDArray[np.bool_]:
    """Tell where so little is lost, 1 - e below 2e-10, that the impact is the elastic one."""
    if loss == Loss.PLASTIC:
        return np.asarray(parameter > 1.0 - NEARLY_YIELDING)
    alpha = parameter * extra if loss == Loss.RELAXING else parameter
    return np.asarray((alpha >= 0.0) & (alpha < NEARLY_ELASTIC))


def lossy_rebounds(
    psi: Array,
    chi: Array,
    losses: LossNumbers,
    threads: int | None = None,
    tolerance: float = viscoelastic.TOLERANCE,
) -> LossyRebounds:
    """Return what impacts with losses come to, psi and chi of one length, in threads.

    NaN where the status is not SOLVED.
    """
    parameter, extra = (np.broadcast_to(x, psi.shape) for x in losses[1:])
    elastic = is_elastic(losses.loss, parameter, extra)
    numbers, status = np.ones((psi.size, layout.NUMBERS)), np.zeros(psi.size, dtype=np.int8)
    numbers[:, layout.TIME], numbers[:, layout.SHEAR_LOST] = hertz.DURATION, 0.0
    psi_2, status[elastic], _ = solved(psi[elastic], chi[elastic], threads)
    numbers[elastic, layout.PSI_OUT] = psi_2
    lossy = np.flatnonzero(~elastic)
    columns = tuple(x[lossy] for x in (psi, chi, parameter, extra))
    rows, codes = np.empty((lossy.size, layout.NUMBERS)), np.empty(lossy.size, dtype=np.int8)

    def block(part: slice) -> None:
        psis, chis, parameters, extras = (column[part] for column in columns)
        out = rows[part], codes[part]
        if losses.loss == Loss.VISCOUS:
            arrays = tolerance, work.new_work(), record.new_record(False)
            viscoelastic.fill(psis, chis, parameters, *arrays, *out)
        else:
            law = int(losses.loss), parameters, extras
            march.fill(psis, chis, *law, march.new_work(), *out)

    in_blocks(block, lossy.size, BLOCK, SMALLEST_BLOCK, threads)
    numbers[lossy], status[lossy] = rows, codes
    numbers[status != Status.SOLVED] = np.nan
    return named(numbers, losses.loss, status)
