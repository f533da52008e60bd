"""The base of all contact laws, with a name, a source and the rebound that follows from them."""

import re
from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from inspect import cleandoc
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.dem.adaptive import WORK, rebounds
from carom.dem.coefficients import Coefficients
from carom.dem.damping import damped_restitution
from carom.dem.stepping import HISTORY, MOST_DURATIONS, REMEMBERED, stepped
from carom.dimensionless.numerics.threads import available_cores
from carom.dimensionless.rebounds import answered
from carom.quantities.arrays import Array
from carom.quantities.refusals import flag, known_keywords, refusal
from carom.quantities.statuses import WordedStatus
from carom.quantities.units import counted, finite, not_negative, positive, threads_or_none

Codes = NDArray[np.int8]

SOLID = 4.0 / 7.0  # kappa/chi of solid spheres, and of one on a half-space
FEWEST_STEPS, MOST_STEPS = 4, 10_000_000
IMPACTS_AT_ONCE = 16  # that a thread takes


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


class Parameter(NamedTuple):
    """A parameter that laws share: what reads it, and what docstrings say of it."""

    read: Callable[[str, Any], float | None]
    meaning: str


PARAMETERS = {
    "stiffness_ratio": Parameter(
        lambda name, value: None if value is None else positive(name, value),
        "float, optional\n    k_t/k_n, positive; by default kappa = G*/E* (Mindlin 1949).",
    ),
    "stiffness": Parameter(
        positive, "float\n    k_t in units of Mindlin's stiffness 2 G* a, positive."
    ),
    "restitution": Parameter(
        damped_restitution,
        "float\n    Normal coefficient of restitution e, above 0 and at most 1 (no damping).",
    ),
    "tangential_damping": Parameter(
        not_negative,
        "float\n    Tangential damping in units of the normal one, `x_gamma` of LAMMPS.",
    ),
}
NAMES_ALONE = re.compile("(?m)^(?:{0})(?:, (?:{0}))*$".format("|".join(PARAMETERS)))
RAISES = "Raises\n------\nInputError\n    If a parameter is out of range."


def described(names: re.Match[str]) -> str:
    """Return the entries of a docstring for parameters that laws share."""
    return "\n".join(f"{name} : {PARAMETERS[name].meaning}" for name in names[0].split(", "))


@dataclass(frozen=True)
class Law(ABC):
    """What gives psi_2 from psi_1 and chi: contact laws, a function, the exact table.

    Each has a `name`, and a `source` that says where it is from. In docstrings of laws a line with
    names of `PARAMETERS` alone stands for what is said there.
    """

    name: ClassVar[str]
    source: ClassVar[str]
    _largest_chi: ClassVar[float] = np.inf
    _most_steps: ClassVar[int] = MOST_STEPS  # that are tried for a time step
    _statuses: ClassVar[type[WordedStatus]] = LawStatus  # of impacts

    def __init_subclass__(cls) -> None:
        text, count = NAMES_ALONE.subn(described, cleandoc(cls.__doc__ or ""))
        if count:
            cls.__doc__ = text.replace("Examples\n---", f"{RAISES}\n\nExamples\n---", 1) + "\n"

    def __post_init__(self) -> None:
        for name, parameter in PARAMETERS.items():
            if name in vars(self):
                object.__setattr__(self, name, parameter.read(name, getattr(self, name)))

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


@dataclass(frozen=True)
class ContactLaw(Law):
    """A law of the forces in a contact, from the first touch to separation."""

    _largest_chi: ClassVar[float] = 1e6  # which an adaptive impact takes a tenth of a second for
    _symmetric: ClassVar[bool] = True  # in the sign of psi: it is solved for |psi|
    _default_steps: ClassVar[int | None] = None  # None: of adaptive size

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        raise NotImplementedError(f"{self.name} is more than coefficients")

    def _solved(
        self, psi: Array, chi: Array, kappa: Array, steps: int | None, threads: int | None
    ) -> tuple[Array, Codes]:
        status = status_of(psi, chi, kappa, self._largest_chi)
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

    def _rebound(self, psi: Array, chi: float, kappa: float, steps: int | None) -> Array:
        """Return psi_2 of impacts with one chi."""
        steps = steps or self._default_steps
        if steps is None:
            out = np.empty(psi.size)
            rebounds(self._coefficients(chi, kappa), psi, np.empty(WORK), out)
            return out
        sign, nothing = np.copysign(1.0, psi), np.empty((0, len(HISTORY)))
        each = (self._stepped(size, chi, kappa, steps, nothing)[1] for size in np.abs(psi).tolist())
        return np.asarray(sign * np.array(list(each)))

    def _stepped(
        self, psi: float, chi: float, kappa: float, steps: int, record: Array
    ) -> tuple[int, float]:
        """Return how many rows of the record are filled and psi_2; -1 if the bodies do not part."""
        return stepped(self._coefficients(chi, kappa), psi, steps, np.empty(REMEMBERED), record)

    def _recorded(self, psi: float, chi: float, kappa: float, steps: int, record: Array) -> int:
        return self._stepped(psi, chi, kappa, steps, record)[0]

    @known_keywords
    def history(
        self, psi_1: float, chi: float, *, kappa: float | None = None, steps: int = 1000
    ) -> dict[str, Array]:
        """Return the history of an impact in equal time steps, in the units of Hertz's impact.

        Parameters
        ----------
        psi_1, chi, kappa : float
            As in `rebound`.
        steps : int
            Number of equal time steps in the duration of Hertz's contact, from 4 to a million.

        Returns
        -------
        dict
            Arrays named `time`, `penetration`, `normal_velocity`, `psi`, `normal_force` and
            `tangential_force`.

        Raises
        ------
        InputError
            If a value is out of range, or the bodies do not part.

        Examples
        --------
        >>> history = carom.dem.LinearSpring().history(0.5, 1.44)
        >>> round(float(history["normal_force"].max()), 3)
        0.8
        """
        counted("steps", steps, FEWEST_STEPS)
        chi, psi_1 = positive("chi", chi), finite("psi_1", psi_1, "1")
        kappa = kappa_or_solid(kappa, chi)
        record = np.empty((MOST_DURATIONS * steps + 2, len(HISTORY)))
        sign = float(np.copysign(1.0, psi_1)) if self._symmetric else 1.0
        count = self._recorded(sign * psi_1, chi, kappa, steps, record)
        if count < 0 or not np.all(np.isfinite(record[:count])):
            raise refusal("steps", steps, "the bodies do not part; take more steps")
        columns = {name: record[:count, i].copy() for i, name in enumerate(HISTORY)}
        for name in ("psi", "tangential_force"):
            columns[name] *= sign
        return columns


def _parts(chi: Array, kappa: Array) -> list[NDArray[np.intp]]:
    """Return the places of impacts of the same bodies, some for each thread."""
    bodies, members = np.unique(np.stack([chi, kappa]), axis=1, return_inverse=True)
    members = members.ravel()  # NumPy 2.0 gives it two dimensions
    order = np.argsort(members, kind="stable")
    groups = np.split(order, np.cumsum(np.bincount(members, minlength=bodies.shape[1]))[:-1])
    return [
        group[i : i + IMPACTS_AT_ONCE]
        for group in groups
        for i in range(0, group.size, IMPACTS_AT_ONCE)
    ]
