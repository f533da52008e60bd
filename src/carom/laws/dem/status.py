"""What became of an impact by a contact law: a status, and its words."""

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array

Codes = NDArray[np.int8]


class LawStatus(IntEnum):
    """What became of an impact by a contact law; its `message` says so in words.

    Examples
    --------
    >>> from carom.laws.dem import LawStatus
    >>> LawStatus(2).message
    'chi must be positive and finite'
    """

    SOLVED = 0
    PSI_NOT_FINITE = 1
    CHI_NOT_POSITIVE = 2
    KAPPA_NOT_POSITIVE = 3
    CHI_TOO_LARGE = 4
    UNRESOLVED = 5

    @property
    def message(self) -> str:
        """The status in words."""
        return MESSAGES[self]


MESSAGES = {
    LawStatus.SOLVED: "solved",
    LawStatus.PSI_NOT_FINITE: "psi must be a finite number",
    LawStatus.CHI_NOT_POSITIVE: "chi must be positive and finite",
    LawStatus.KAPPA_NOT_POSITIVE: "kappa must be positive and finite",
    LawStatus.CHI_TOO_LARGE: "not solved: chi is too large",
    LawStatus.UNRESOLVED: "not solved: the bodies do not part, or steps are too few",
}


def status_of(psi: Array, chi: Array, kappa: Array, largest_chi: float) -> Codes:
    """Return what is known of impacts before they are solved; of two faults the first."""
    status = np.zeros(psi.size, dtype=np.int8)
    status[chi > largest_chi] = LawStatus.CHI_TOO_LARGE
    for values, fault in ((kappa, LawStatus.KAPPA_NOT_POSITIVE), (chi, LawStatus.CHI_NOT_POSITIVE)):
        status[~((values > 0.0) & (values < np.inf))] = fault
    status[~np.isfinite(psi)] = LawStatus.PSI_NOT_FINITE
    return status
