"""Rebounds of many impacts at once."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.dimensionless.elastic.batch import solved
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import ScaleFreeLaw, scale_free
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.numerics.arrays import Array, Codes
from carom.quantities.arrays import along_the_same, pure_numbers, together
from carom.quantities.keywords import known_keywords
from carom.quantities.refusals import flag
from carom.quantities.statuses import WordedStatus
from carom.quantities.units import threads_or_none

THROUGHOUT = 3  # place of the regime of gross slip throughout


@known_keywords
def rebound(
    psi: ArrayLike,
    chi: ArrayLike,
    *,
    threads: int | None = None,
    return_status: bool = False,
    losses: ScaleFreeLaw | None = None,
) -> Any:
    """Return the tangential velocity of the contact point after an oblique impact.

        psi_2 = psi_2(psi_1, chi)

    The function is the exact solution of Maw, Barber & Fawcett (1976), with the stick phase of
    Barber (1979), (15)-(37), and the slip ring that follows it. Its error is below
    1e-10 max(1, |psi_1|) for 0.05 <= chi <= 10 and ten times that for chi <= 60. With losses it is
    below 1e-8 max(1, |psi_1|).

    Parameters
    ----------
    psi : array_like
        Dimensionless tangential velocity of the contact point before the impact,
        psi_1 = kappa V_x/(mu V_1), of any sign.
    chi : array_like
        Ratio of inertia to stiffness, chi = (kappa/2)(m_n/m_t), positive; broadcast against `psi`.
    threads : int, optional
        Number of threads, by default all cores. The result does not depend on it.
    return_status : bool
        Whether to return also an array of `Status` values, one for each impact.
    losses : KelvinVoigt, optional
        Loss of energy in the normal motion, with a restitution; by default none.

    Returns
    -------
    float or ndarray
        psi_2, in the shape of the broadcast arguments. It is NaN where an argument is out of range
        or masked, and where chi is too large (above some thousands, or above 1000 with losses).
        One RuntimeWarning then says where and why, unless `return_status` is set.

    Raises
    ------
    InputError
        If an argument is not a pure number, the shapes do not fit, `losses` is not a law of losses
        or depends on the speed, or `threads` is below 1.

    Examples
    --------
    >>> import carom
    >>> round(carom.rebound(0.5, 1.44), 10)
    0.0471310838
    >>> carom.rebound([0.5, 1.5, 3.5, 6.0], 1.44).round(6)
    array([ 0.047131, -0.429967, -1.477247,  0.24    ])
    >>> carom.rebound([0.5, 6.0], 1.44, losses=carom.KelvinVoigt(restitution=0.9)).round(6)
    array([0.00384, 0.528  ])
    """
    threads, return_status = threads_or_none(threads), flag("return_status", return_status)

    def solve(psi: Array, chi: Array) -> tuple[Array, Codes, str]:
        if losses is None:
            return *solved(psi, chi, threads)[:2], ""
        lossy = lossy_rebounds(psi, chi, scale_free(losses), threads)
        return lossy.psi_out, lossy.status, ""

    return answered({"psi": psi, "chi": chi}, solve, Status, return_status)


def regime_borders(chi: ArrayLike, restitution: ArrayLike = 1.0) -> Array:
    """Return the |psi_1| at which the regime changes, along a new last axis.

    They are 1; 2 chi, up to which gross slip ends before the largest compression; and
    2 chi (1 + e) - e, from which on gross slip lasts to the end. All are 1 for chi <= 1/2.
    """
    given = np.broadcast_arrays(np.asarray(chi, dtype=np.float64), np.asarray(restitution))
    with np.errstate(over="ignore"):
        twice, e = 2.0 * given[0], given[1]
        borders = np.ones_like(twice), twice, twice * (1.0 + e) - e
    return np.asarray(np.maximum(np.stack(borders, axis=-1), 1.0))


def regimes(psi: Array, chi: float, restitution: float) -> NDArray[np.int8]:
    """Return the place of the regime of each psi_1 in `carom.impacts.curves.REGIMES`."""
    borders = regime_borders(chi, restitution)
    return np.searchsorted(borders, np.abs(psi), side="right").astype(np.int8)


def answered(
    arguments: Mapping[str, Any],
    solve: Callable[..., tuple[Array, Codes, str]],
    kind: type[WordedStatus],
    return_status: bool,
) -> Any:
    """Return psi_2 of impacts whose arguments broadcast, and the status of each if asked for.

    `solve` takes flat arrays and returns psi_2, a status, zero where an impact is solved, and the
    reason of the first that is not, "" if its status of this `kind` says it. Of such impacts there
    is one warning, unless the status is asked for.
    """
    along_the_same(**arguments)
    numbers = {name: pure_numbers(name, values) for name, values in arguments.items()}
    shape = together(numbers)
    flat = (np.array(np.broadcast_to(values, shape)).ravel() for values in numbers.values())
    psi_out, codes, reason = solve(*flat)
    result = psi_out.reshape(shape) if shape else float(psi_out[0])
    status = codes.reshape(shape)
    if return_status:
        return result, status if shape else int(codes[0])
    unsolved = np.argwhere(status)
    if len(unsolved):
        first = tuple(int(i) for i in unsolved[0])
        reason = reason or kind(int(status[first])).message
        where = f"first at index {first}: {reason}" if first else reason
        warnings.warn(
            f"{len(unsolved)} of {status.size} impacts give NaN ({where}); "
            "return_status=True tells each",
            RuntimeWarning,
            stacklevel=3,
        )
    return result
