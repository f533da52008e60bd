"""Rebounds of many impacts at once."""

from __future__ import annotations

import warnings
from enum import IntEnum
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.dimensionless.elastic.batch import solved
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import ScaleFreeLaw, scale_free
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.numerics.arrays import Array
from carom.quantities.arrays import along_the_same, pure_numbers, together
from carom.quantities.keywords import known_keywords
from carom.quantities.refusals import flag
from carom.quantities.units import threads_or_none

THROUGHOUT = 3  # place of the regime of gross slip throughout


@overload
def rebound(
    psi: ArrayLike,
    chi: ArrayLike,
    *,
    threads: int | None = ...,
    return_status: Literal[False] = ...,
    losses: ScaleFreeLaw | None = ...,
) -> Any: ...


@overload
def rebound(
    psi: ArrayLike,
    chi: ArrayLike,
    *,
    threads: int | None = ...,
    return_status: Literal[True],
    losses: ScaleFreeLaw | None = ...,
) -> tuple[Any, Any]: ...


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
    along_the_same(psi=psi, chi=chi)
    given = {"psi": pure_numbers("psi", psi), "chi": pure_numbers("chi", chi)}
    shape = together(given)
    flat_psi, flat_chi = (np.array(np.broadcast_to(x, shape)).ravel() for x in given.values())
    if losses is None:
        psi_out, status, _ = solved(flat_psi, flat_chi, threads)
    else:
        found = lossy_rebounds(flat_psi, flat_chi, scale_free(losses), threads)
        psi_out, status = found.psi_out, found.status
    result = psi_out.reshape(shape) if shape else float(psi_out[0])
    if return_status:
        return result, status.reshape(shape) if shape else int(status[0])
    warn_of_unsolved(status.reshape(shape))
    return result


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


def warn_of_unsolved(
    status: NDArray[np.int8], kind: type[IntEnum] = Status, reason: str = ""
) -> None:
    """Warn once of impacts that were not solved, with their number and the reason of the first.

    A status of zero means solved; other members of `kind` have a `message`, which is the reason
    unless one is given.
    """
    unsolved = np.argwhere(status)
    if len(unsolved):
        first = tuple(int(i) for i in unsolved[0]) if status.ndim else ()
        reason = reason or kind(int(status[first])).message  # type: ignore[attr-defined]
        where = f"first at index {first}: {reason}" if first else reason
        warnings.warn(
            f"{len(unsolved)} of {status.size} impacts give NaN ({where}); "
            "return_status=True tells each",
            RuntimeWarning,
            stacklevel=3,
        )
