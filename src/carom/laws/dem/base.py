"""What all contact laws have in common: a name, a source, the rebound that follows from them."""

from abc import ABC, abstractmethod
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.dimensionless.numerics.threads import available_cores
from carom.dimensionless.rebounds import warn_of_unsolved
from carom.laws.dem.adaptive import WORK, rebounds
from carom.laws.dem.coefficients import Coefficients
from carom.laws.dem.damping import damped_restitution
from carom.laws.dem.status import Codes, LawStatus, status_of
from carom.laws.dem.stepping import HISTORY, PATIENCE, REMEMBERED, stepped, stepped_rebounds
from carom.quantities.arrays import Array, along_the_same, pure_numbers, together
from carom.quantities.refusals import flag, refusal
from carom.quantities.units import counted, finite, not_negative, positive, threads_or_none

SOLID = 4.0 / 7.0  # kappa/chi of solid spheres, and of one on a half-space
FEWEST_STEPS, MOST_STEPS = 4, 10_000_000
BLOCK = 16  # impacts that a thread takes at once
READERS = {  # of the parameters that laws have
    "stiffness_ratio": lambda name, value: None if value is None else positive(name, value),
    "stiffness": positive,
    "restitution": damped_restitution,
    "tangential_damping": not_negative,
}


@dataclass(frozen=True)
class Law(ABC):
    """A law of impact in the place of the exact one."""

    name: ClassVar[str]
    source: ClassVar[str]
    largest_chi: ClassVar[float] = np.inf

    def __post_init__(self) -> None:
        for name, read in READERS.items():
            if name in vars(self):
                object.__setattr__(self, name, read(name, getattr(self, name)))

    @abstractmethod
    def _rebound(self, psi: Array, chi: float, kappa: float, steps: int | None) -> Array:
        """Return psi_2 of impacts with one chi."""

    def rebound(
        self,
        psi: ArrayLike,
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
        psi : array_like
            psi_1 = kappa V_x/(mu V_1) before.
        chi : array_like
            (kappa/2)(m_n/m_t), positive; broadcast against `psi`.
        kappa : array_like, optional
            G*/E*, by default that of solid spheres, 4 chi/7; of use to a law with a k_t/k_n or a
            damping of its own.
        steps : int, optional
            How many equal time steps the elastic impact takes (the duration of Hertz's contact),
            as the codes do it, 4 to ten million; by default as many, of adaptive size, as it takes
            for 1e-8.
        threads : int, optional
            How many threads to use, all cores by default. The result does not depend on it.
        return_status : bool
            Return also an array of `carom.laws.dem.LawStatus` values, one per impact.

        Returns
        -------
        float or ndarray
            psi_2; NaN where an argument is out of range or masked, chi above a million, or the
            bodies do not part, with one RuntimeWarning that says where and why unless
            `return_status` is set.

        Raises
        ------
        InputError
            If an argument is not a pure number at all, the shapes do not fit, or `steps` or
            `threads` is out of range.

        Examples
        --------
        >>> import carom
        >>> law = carom.LammpsMindlin("mindlin")
        >>> round(law.rebound(0.75, 1.4412), 3), round(carom.rebound(0.75, 1.4412), 3)
        (0.591, 0.014)
        """
        if steps is not None:
            steps = counted("steps", steps, FEWEST_STEPS, MOST_STEPS)
        threads, return_status = threads_or_none(threads), flag("return_status", return_status)
        along_the_same(psi=psi, chi=chi, kappa=kappa)
        given = {"psi": pure_numbers("psi", psi), "chi": pure_numbers("chi", chi)}
        given["kappa"] = SOLID * given["chi"] if kappa is None else pure_numbers("kappa", kappa)
        shape = together(given)
        flat = (np.broadcast_to(values, shape).ravel() for values in given.values())
        result, status = self._solved(next(flat), next(flat), next(flat), steps, threads)
        psi_out = result.reshape(shape) if shape else float(result[0])
        if return_status:
            return psi_out, status.reshape(shape) if shape else int(status[0])
        warn_of_unsolved(status.reshape(shape), LawStatus)
        return psi_out

    def _solved(
        self, psi: Array, chi: Array, kappa: Array, steps: int | None, threads: int | None
    ) -> tuple[Array, Codes]:
        """Return psi_2 and the status of impacts, in threads."""
        status = status_of(psi, chi, kappa, self.largest_chi)
        result, good = np.full(psi.size, np.nan), np.flatnonzero(status == LawStatus.SOLVED)

        def solve(part: NDArray[np.intp]) -> None:
            where = good[part]
            bodies = float(chi[where[0]]), float(kappa[where[0]])
            result[where] = self._rebound(psi[where], *bodies, steps)

        parts = _parts(chi[good], kappa[good])
        workers = min(threads or available_cores(), len(parts))
        if workers <= 1:
            list(map(solve, parts))
        else:
            with ThreadPoolExecutor(workers) as pool:
                list(pool.map(solve, parts))
        lost = good[~np.isfinite(result[good])]
        result[lost], status[lost] = np.nan, LawStatus.UNRESOLVED
        return result, status


def _parts(chi: Array, kappa: Array) -> list[NDArray[np.intp]]:
    """Return the places of impacts of the same bodies, some for each thread."""
    bodies, members = np.unique(np.stack([chi, kappa]), axis=1, return_inverse=True)
    order = np.argsort(members, kind="stable")
    groups = np.split(order, np.cumsum(np.bincount(members, minlength=bodies.shape[1]))[:-1])
    return [group[i : i + BLOCK] for group in groups for i in range(0, group.size, BLOCK)]


@dataclass(frozen=True)
class ContactLaw(Law):
    """A law of the forces in a contact, from touch to parting."""

    largest_chi: ClassVar[float] = 1e6  # which an adaptive impact takes a tenth of a second for

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        raise NotImplementedError(f"{self.name} is more than coefficients")

    def _rebound(self, psi: Array, chi: float, kappa: float, steps: int | None) -> Array:
        law = self.coefficients(chi, kappa)
        out = np.empty(psi.size)
        if steps is None:
            rebounds(law, psi, np.empty(WORK), out)
        else:
            nothing = np.empty((0, len(HISTORY)))
            stepped_rebounds(law, psi, steps, np.empty(REMEMBERED), nothing, out)
        return out

    def _recorded(self, psi: float, chi: float, kappa: float, steps: int, record: Array) -> int:
        """Write what happens in equal steps; return their number, -1 if the bodies do not part."""
        law = self.coefficients(chi, kappa)
        return stepped(law, psi, steps, np.empty(REMEMBERED), record)[0]

    def history(
        self, psi: float, chi: float, *, kappa: float | None = None, steps: int = 1000
    ) -> dict[str, Array]:
        """Return what happens in equal time steps, in the units of Hertz's impact.

        Parameters
        ----------
        psi : float
            psi_1 = kappa V_x/(mu V_1) before.
        chi : float
            (kappa/2)(m_n/m_t), positive.
        kappa : float, optional
            G*/E*, by default that of solid spheres, 4 chi/7.
        steps : int
            Equal time steps that the elastic impact takes, as the codes do it, 4 to a million.

        Returns
        -------
        dict
            Arrays by name: time, penetration, normal_velocity, psi, normal_force, tangential_force.

        Raises
        ------
        InputError
            If a value is out of range, or the bodies do not part.

        Examples
        --------
        >>> import carom
        >>> history = carom.LinearSpring().history(0.5, 1.44)
        >>> round(float(history["normal_force"].max()), 3)
        0.8
        """
        counted("steps", steps, FEWEST_STEPS)
        chi, psi = positive("chi", chi), finite("psi", psi, "1")
        own = SOLID * chi if kappa is None else positive("kappa", kappa)
        record = np.empty((PATIENCE * steps + 2, len(HISTORY)))
        count = self._recorded(abs(psi), chi, own, steps, record)
        if count < 0 or not np.all(np.isfinite(record[:count])):
            raise refusal("steps", steps, "the bodies do not part; take more steps")
        columns = {name: record[:count, i].copy() for i, name in enumerate(HISTORY)}
        for name in ("psi", "tangential_force"):
            columns[name] *= np.copysign(1.0, psi)
        return columns
