"""What a solved impact is told in: phases, and states at some times."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields
from operator import index
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.elastic.phases import Kind
from carom.dimensionless.numerics.arrays import Array

KIND_NAMES = {Kind.STICK: "stick", Kind.SLIP: "slip", Kind.GROSS_SLIP: "gross slip"}


class Phase(NamedTuple):
    """A phase of an impact: its kind, sign of slip (0 in stick), times, and what ended it.

    Times are in d_max/V_1 in a `Solution`, in s in an `Impact`.
    """

    kind: str
    sign: int
    start: float
    end: float
    cause: str


class SlipAngle(NamedTuple):
    """Angle between slip and traction in a phase, in rad: largest, and mean by frictional work."""

    largest: float
    mean: float


@dataclass(frozen=True, eq=False)
class History:
    """An impact at some times, in the dimensionless units of `Solution`."""

    time: Array
    penetration: Array
    speed: Array
    psi: Array
    displacement: Array
    force: Array
    stick_radius: Array
    contact_radius: Array
    stored: Array
    dissipated: Array
    normal_force: Array
    normal_stored: Array
    normal_lost: Array

    def __len__(self) -> int:
        return len(self.time)


class Trajectory(ABC):
    """A solved impact: what its state at any time gives."""

    duration: float

    @abstractmethod
    def at(self, time: ArrayLike) -> History:
        """Return the state at the given times, one row for each."""

    def history(self, n: int = 200) -> History:
        """Return the impact at evenly spaced times from the first touch to the last.

        Parameters
        ----------
        n : int
            How many times, 2 at least.

        Returns
        -------
        History
            Arrays of shape (n,), as of `at`.

        Raises
        ------
        ValueError
            If there are fewer, or the impact is not solved.

        Examples
        --------
        >>> import carom
        >>> carom.solve(0.5, 1.44).history(3).penetration.round(9)
        array([0., 1., 0.])
        """
        if index(n) < 2:
            raise ValueError(f"n: {n} cannot be used; must be a whole number of at least 2")
        return self.at(np.linspace(0.0, self.duration, n))


def times_within(duration: float, time: ArrayLike) -> Array:
    """Return times of a contact as a line of numbers, or raise ValueError for one outside it."""
    wanted = np.asarray(time, dtype=np.float64).ravel()
    within = (wanted >= 0.0) & (wanted <= duration)
    if not np.all(within):
        outside = wanted[~within][0]
        raise ValueError(f"time: {outside:g} is outside the contact, 0 to {duration:.6g}")
    return wanted


def now_at(history: History) -> dict[str, float]:
    """Return the only row of a history as numbers."""
    return {item.name: float(getattr(history, item.name)[0]) for item in fields(history)}
