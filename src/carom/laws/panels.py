"""What a table of the exact rebound holds: series of r = psi_2/psi_1 between kinks."""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.batch import solved
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.panels.normal import Loss
from carom.dimensionless.lossy.panels.stages import viscous_loss
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.numerics.chebyshev import Panels, fitted
from carom.dimensionless.rebounds import regime_borders
from carom.io.progress import advancing
from carom.laws.rules import DEGREE
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal

Branches = NDArray[np.int64]

LARGEST_CHI = 100.0  # tables of larger ones would take minutes
RETURNING = 3.0
SMALLEST, LOSSY_SMALLEST = 1e-6, 1e-3  # psi_1: below, r is that of the first panel
TOLERANCE = 4e-10  # of the tail of a series; the error stays below 1e-9
LOSSY_TOLERANCE, ROUGH = 1e-8, 2e-7  # with losses; for chi above 3, where the front of slip returns


def panel_ends(chi: float, restitution: float) -> list[float]:
    """Return psi_1 between which panels lie, of the first and the last and of known kinks."""
    smallest = SMALLEST if restitution == 1.0 else LOSSY_SMALLEST
    return [smallest, *np.unique(regime_borders(chi, restitution)).tolist()]


def panels(chi: float, restitution: float) -> Panels:
    """Return the table of r = psi_2/psi_1 between the regime borders; a bar tells of it."""
    parameter = viscous_loss(restitution)
    with advancing("table of rebounds", None, unit="impacts") as advance:

        def ratio(psi: Array) -> tuple[Array, Branches]:
            chis = np.full(psi.size, chi)
            if restitution == 1.0:
                outgoing, status, sequence = solved(psi, chis)
            else:
                found = lossy_rebounds(psi, chis, Loss.VISCOUS, np.full(psi.size, parameter))
                outgoing, status = found.psi_out, found.status
                sequence = np.zeros(psi.size, dtype=np.int64)  # with losses all kinks are weak
            _refuse_unsolved(chi, status)
            advance(psi.size)
            return outgoing / psi, sequence

        lossy_tolerance = LOSSY_TOLERANCE if chi <= RETURNING else ROUGH
        tolerance = TOLERANCE if restitution == 1.0 else lossy_tolerance
        ends = panel_ends(chi, restitution)
        return fitted(ratio, ends, DEGREE, tolerance, singular=(1.0,))


def _refuse_unsolved(chi: float, status: NDArray[np.int8]) -> None:
    if np.any(status):
        message = Status(int(status[status != 0][0])).message
        raise refusal("chi", chi, f"its rebounds are {message}")
