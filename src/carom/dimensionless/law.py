"""The protocol of a law: psi_2 from psi_1 and chi, and a status of each impact."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.dimensionless.rebounds import answered
from carom.quantities.arrays import Array
from carom.quantities.refusals import flag, known_keywords
from carom.quantities.statuses import WordedStatus
from carom.quantities.units import counted, positive, threads_or_none

Codes = NDArray[np.int8]

SOLID = 4.0 / 7.0  # kappa/chi of solid spheres, and of one on a half-space
FEWEST_STEPS, MOST_STEPS = 4, 10_000_000


class LawStatus(WordedStatus):
    """What became of an impact by a contact law; its `message` says so in words.

    Examples
    --------
    >>> carom.status.LawStatus(2).message
    'chi must be positive and finite'
    """

    SOLVED = 0, "solved"
    PSI_NOT_FINITE = 1, "psi_1 must be a finite number"
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


def kappa_or_solid(kappa: Any, chi: Any) -> Any:
    """Return kappa if there is one, else that of solid spheres with this chi."""
    return SOLID * chi if kappa is None else positive("kappa", kappa)


@dataclass(frozen=True)
class Law(ABC):
    """What gives psi_2 from psi_1 and chi: contact laws, a function, the exact table.

    Each has a `name`, and a `source` that says where it is from.
    """

    name: ClassVar[str]
    source: ClassVar[str]
    _largest_chi: ClassVar[float] = np.inf
    _most_steps: ClassVar[int] = MOST_STEPS  # that are tried for a time step
    _statuses: ClassVar[type[WordedStatus]] = LawStatus  # of impacts

    def _damped(self, restitution: float) -> Self:
        """Return the law with another restitution."""
        return replace(self, restitution=restitution)  # type: ignore[call-arg]

    @abstractmethod
    def _solved(
        self, psi: Array, chi: Array, kappa: Array, steps: int | None, threads: int | None
    ) -> tuple[Array, Codes]:
        """Return psi_2 and the status of impacts, arrays of one length."""

    @known_keywords
    def rebound(
        self,
        psi_1: ArrayLike,
        chi: ArrayLike,
        *,
        kappa: ArrayLike | None = None,
        steps: int | None = None,
        threads: int | None = None,
        return_status: bool = False,
    ) -> Any:
        """Return the tangential velocity of the contact point after the impact, psi_2.

        Parameters
        ----------
        psi_1 : array_like
            Dimensionless tangential velocity before the impact, psi_1 = kappa V_x/(mu V_1).
        chi : array_like
            Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive; broadcast against `psi_1`.
        kappa : array_like, optional
            Stiffness ratio G*/E*, by default that of solid spheres, 4 chi/7. It matters for laws
            with their own k_t/k_n or damping.
        steps : int, optional
            Number of equal time steps in the duration of Hertz's contact, as in DEM codes, from 4
            to ten million; by default steps of adaptive size that reach an error of 1e-8.
        threads : int, optional
            Number of threads, by default all cores. The result does not depend on it.
        return_status : bool
            Whether to return also an array of `carom.status.LawStatus` values, one per impact.

        Returns
        -------
        float or ndarray
            psi_2, in the shape of the broadcast arguments. It is NaN where an argument is out of
            range or masked, where chi is above a million, and where the bodies do not part. One
            RuntimeWarning then says where and why, unless `return_status` is set.

        Raises
        ------
        InputError
            If an argument is not a pure number, the shapes do not fit, or `steps` or `threads` is
            out of range.

        Examples
        --------
        >>> law = carom.dem.LammpsMindlin("mindlin")
        >>> round(law.rebound(0.75, 1.4412), 3), round(carom.rebound(0.75, 1.4412), 3)
        (0.591, 0.014)
        """
        if steps is not None:
            steps = counted("steps", steps, FEWEST_STEPS, MOST_STEPS)
        threads, return_status = threads_or_none(threads), flag("return_status", return_status)

        def solve(psi: Array, chi: Array, kappa: Array | None = None) -> tuple[Array, Codes, str]:
            own = SOLID * chi if kappa is None else kappa
            result, status = self._solved(psi, chi, own, steps, threads)
            lost, reason = np.flatnonzero(status)[:1], ""
            if not return_status and lost.size and status[lost[0]] in OF_FUNCTIONS:
                reason = self._why(*(float(each[lost[0]]) for each in (psi, chi, own)))
            return result, status, reason

        arguments = {"psi_1": psi_1, "chi": chi} | ({} if kappa is None else {"kappa": kappa})
        return answered(arguments, solve, self._statuses, return_status)

    def _why(self, psi: float, chi: float, kappa: float) -> str:
        """Return what the function of a law did wrong in an impact, "" if nothing."""
        return ""
