"""What a table of the exact rebound holds: series of r = psi_2/psi_1 between kinks."""

from functools import partial

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.numerics.chebyshev import NARROWEST, Panels, fitted
from carom.dimensionless.rebounds import lossy_rebounds, regime_borders, solved
from carom.io.progress import advancing
from carom.laws.rules import DEGREE
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal

Branches = NDArray[np.int64]

LARGEST_CHI = 100.0  # tables of larger ones would take minutes
RETURNING = 3.0
NARROW = 1e-7  # with losses, relative: no kink is strong enough to be felt within
SMALLEST, LOSSY_SMALLEST = 1e-6, 1e-3  # psi_1: below, r is that of the first panel
TOLERANCE = 4e-10  # of the tail of a series; the error stays below 1e-9
LOSSY_TOLERANCE, ROUGH = 1e-8, 2e-7  # with losses; for chi above 3, where the front of slip returns


def panel_ends(chi: float, restitution: float) -> list[float]:
    """Return psi_1 between which panels lie, of the first and the last and of known kinks."""
    smallest = SMALLEST if restitution == 1.0 else LOSSY_SMALLEST
    return [smallest, *np.unique(regime_borders(chi, restitution)).tolist()]


def panels(chi: float, restitution: float) -> Panels:
    """Return the table of r = psi_2/psi_1 between the regime borders; a bar tells of it."""
    rebounds, tolerance, narrowest = _elastic, TOLERANCE, NARROWEST
    if restitution < 1.0:
        rebounds, narrowest = partial(_lossy, viscous_loss(restitution)), NARROW
        tolerance = LOSSY_TOLERANCE if chi <= RETURNING else ROUGH
    with advancing("tabulating the rebounds", None, unit="impacts") as advance:

        def ratio(psi: Array) -> tuple[Array, Branches]:
            outgoing, status, sequence = rebounds(psi, np.full(psi.size, chi))
            _refuse_unsolved(chi, status)
            advance(psi.size)
            return outgoing / psi, sequence

        ends = panel_ends(chi, restitution)
        return fitted(ratio, ends, DEGREE, tolerance, (1.0,), narrowest)


def _elastic(psi: Array, chi: Array) -> tuple[Array, NDArray[np.int8], Branches]:
    return solved(psi, chi)


def _lossy(alpha: float, psi: Array, chi: Array) -> tuple[Array, NDArray[np.int8], Branches]:
    """Return psi_2, status and one branch for all: with losses kinks are weak."""
    found = lossy_rebounds(psi, chi, LossNumbers(Loss.VISCOUS, alpha))
    return found.psi_out, found.status, np.zeros(psi.size, dtype=np.int64)


def _refuse_unsolved(chi: float, status: NDArray[np.int8]) -> None:
    if np.any(status):
        message = Status(int(status[status != 0][0])).message
        raise refusal("chi", chi, f"its rebounds are {message}")
