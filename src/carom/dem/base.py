"""Contact laws of DEM codes: their parameters, and the rebound that follows from the forces."""

import re
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from inspect import cleandoc
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dem.adaptive import WORK, rebounds
from carom.dem.coefficients import Coefficients
from carom.dem.damping import damped_restitution
from carom.dem.stepping import HISTORY, MOST_DURATIONS, REMEMBERED, stepped
from carom.dimensionless.law import FEWEST_STEPS, Codes, Law, LawStatus, kappa_or_solid, status_of
from carom.dimensionless.numerics.threads import available_cores
from carom.quantities.arrays import Array
from carom.quantities.refusals import known_keywords, refusal
from carom.quantities.units import counted, finite, not_negative, positive

IMPACTS_AT_ONCE = 16  # that a thread takes


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
class CodeLaw(Law):
    """A law of a DEM code.

    In its docstring a line with names of `PARAMETERS` alone stands for what is said there.
    """

    def __init_subclass__(cls) -> None:
        text, count = NAMES_ALONE.subn(described, cleandoc(cls.__doc__ or ""))
        if count:
            cls.__doc__ = text.replace("Examples\n---", f"{RAISES}\n\nExamples\n---", 1) + "\n"

    def __post_init__(self) -> None:
        for name, parameter in PARAMETERS.items():
            if name in vars(self):
                object.__setattr__(self, name, parameter.read(name, getattr(self, name)))


@dataclass(frozen=True)
class ContactLaw(CodeLaw):
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
