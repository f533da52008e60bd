"""What became of an impact by a contact law: a status, and its words."""

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array
from carom.quantities.statuses import WordedStatus

Codes = NDArray[np.int8]


class LawStatus(WordedStatus):
    """What became of an impact by a contact law; its `message` says so in words.

    Examples
    --------
    >>> from carom.dem.status import LawStatus
    >>> LawStatus(2).message
    'chi must be positive and finite'
    """

    SOLVED = 0, "solved"
    PSI_NOT_FINITE = 1, "psi must be a finite number"
    CHI_NOT_POSITIVE = 2, "chi must be positive and finite"
    KAPPA_NOT_POSITIVE = 3, "kappa must be positive and finite"
    CHI_TOO_LARGE = 4, "not solved: chi is too large"
    UNRESOLVED = 5, "not solved: the bodies do not part, or steps are too few"
    RAISED = 6, "not solved: the function of the law raised an exception"
    NOT_A_NUMBER = 7, "not solved: the function of the law did not return a finite number"


OF_FUNCTIONS = (LawStatus.RAISED, LawStatus.NOT_A_NUMBER)


def status_of(psi: Array, chi: Array, kappa: Array, largest_chi: float) -> Codes:
    """Return what is known of impacts before they are solved; of two faults the first."""
    status = np.zeros(psi.size, dtype=np.int8)
    status[chi > largest_chi] = LawStatus.CHI_TOO_LARGE
    for values, fault in ((kappa, LawStatus.KAPPA_NOT_POSITIVE), (chi, LawStatus.CHI_NOT_POSITIVE)):
        status[~((values > 0.0) & (values < np.inf))] = fault
    status[~np.isfinite(psi)] = LawStatus.PSI_NOT_FINITE
    return status
