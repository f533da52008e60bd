"""The exact rebound as a table over psi_1 and chi, for mixtures whose pairs differ in chi."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.elastic.batch import solved
from carom.dimensionless.numerics.arrays import Vector
from carom.dimensionless.numerics.chebyshev_2d import Patches, fitted_patches, value_at
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.dimensionless.rebounds import warn_of_unsolved
from carom.io.progress import advancing
from carom.quantities.arrays import Array, along_the_same, pure_numbers, together
from carom.quantities.refusals import flag, refusal
from carom.quantities.units import positive

SMALLEST = 1e-6  # psi_1: below, psi_2/psi_1 is constant
LARGEST_CHI = 5.0  # up to which a table takes minutes
TOLERANCE = 3e-8  # of the last terms of a series; errors found are a third of the promised 1e-7


@kernel
def place_of(psi: float, chi: float) -> float:
    """Return psi_1 in a measure in which 0, 1, 2 chi and 4 chi - 1 lie at 0, 1, 2 and 3."""
    return psi if psi <= 1.0 else 1.0 + (psi - 1.0) / (2.0 * chi - 1.0)


@entry_point()
def fill(psi: Vector, chi: Vector, patches: Patches, psi_out: Vector) -> None:
    """Write psi_2; beyond the table NaN."""
    low, high = patches.corners[0, 2], patches.corners[0, 3]
    for i in range(psi.size):
        size = abs(psi[i])
        place = place_of(size, chi[i])
        if not (low <= chi[i] <= high and size < np.inf):
            psi_out[i] = np.nan
        elif place >= 3.0:
            psi_out[i] = psi[i] - np.copysign(4.0 * chi[i], psi[i])
        else:
            loss = value_at(patches, max(place, SMALLEST), chi[i]) / (1.0 + size)
            psi_out[i] = psi[i] * min(1.0, max(-1.0, 1.0 - loss))


class MixtureLaw:
    """The exact rebound over a range of chi, tabulated for NumPy arrays to within 1e-7.

        psi_2 = psi_1 r(|psi_1|, chi)

    The ratio r (Maw, Barber & Fawcett 1976; Barber 1979, section 5) is stored as Chebyshev series
    on rectangles, over chi and a scaled psi_1 in which the regime borders 1, 2 chi, 4 chi - 1 are
    straight. The table takes 0.1 s for chi from 1.2 to 1.5, a second for 0.9 to 1.8, and several
    seconds for chi beyond 2.

    Parameters
    ----------
    low, high : float
        The range of chi, `0.5 <= low < high <= 5`.

    Raises
    ------
    InputError
        If the range is empty, begins below 0.5 or ends above 5.

    Examples
    --------
    >>> import carom
    >>> law = carom.laws.MixtureLaw(1.2, 1.5)
    >>> law([0.5, 1.5, -3.5], [1.25, 1.44, 1.5]).round(6)
    array([-0.079793, -0.429967,  1.471999])
    """

    def __init__(self, low: float, high: float) -> None:
        self.low, self.high = positive("chi", low), positive("chi", high)
        if not 0.5 <= self.low < self.high <= LARGEST_CHI:
            allowed = f"must be a range within 0.5 to {LARGEST_CHI:g}; carom.rebound takes any chi"
            raise refusal("chi", (low, high), allowed)
        whole = (SMALLEST, 3.0, self.low, self.high)
        with advancing("tabulating the rebounds", None, unit="impacts") as advance:

            def loss(place: Array, chi: Array) -> Array:
                advance(place.size)
                return _scaled_loss(place, chi)

            self.patches = fitted_patches(loss, whole, (1.0, 2.0), TOLERANCE, singular=1.0)

    def __call__(self, psi: ArrayLike, chi: ArrayLike, *, return_status: bool = False) -> Any:
        """Return psi_2 of the broadcast arguments; outside the range of chi `rebound` is used.

        With `return_status` a `Status` of each impact is returned, too; otherwise a warning reports
        impacts that are NaN.
        """
        return_status = flag("return_status", return_status)
        along_the_same(psi=psi, chi=chi)
        given = {"psi": pure_numbers("psi", psi), "chi": pure_numbers("chi", chi)}
        shape = together(given)
        flat_psi, flat_chi = (np.broadcast_to(each, shape).flatten() for each in given.values())
        psi_out, status = np.empty(flat_psi.size), np.zeros(flat_psi.size, dtype=np.int8)
        fill(flat_psi, flat_chi, self.patches, psi_out)
        outside = np.flatnonzero(np.isnan(psi_out))
        if outside.size:
            psi_out[outside], status[outside], _ = solved(flat_psi[outside], flat_chi[outside])
        result, each = psi_out.reshape(shape)[()], status.reshape(shape)
        if return_status:
            return result, each[()]
        warn_of_unsolved(each)
        return result

    @property
    def nbytes(self) -> int:
        """Size of the table in bytes."""
        return sum(part.nbytes for part in self.patches)

    def __repr__(self) -> str:
        return f"MixtureLaw({self.low!r}, {self.high!r})"


def _scaled_loss(place: Array, chi: Array) -> Array:
    """Return (1 + psi_1)(1 - psi_2/psi_1) at a place: an error in it is about that in psi_2."""
    psi = np.where(place <= 1.0, place, 1.0 + (2.0 * chi - 1.0) * (place - 1.0))
    return (1.0 + psi) * (1.0 - solved(psi, chi)[0] / psi)
