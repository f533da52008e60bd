"""Results as points psi_2(psi_1, chi), the exact answer to each, and the errors."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.curves import regime_map
from carom.dimensionless.elastic import solved
from carom.dimensionless.phases import Status
from carom.quantities import InputError
from carom.readings import Array, Results, named

LARGEST = 1e9  # of |psi|: there rounding is as large as errors that matter


class Group(NamedTuple):
    """Errors in psi_2 of some points: how many they are, largest, root mean square and mean."""

    name: str
    points: int
    max_error: float
    rms_error: float
    mean_error: float


@dataclass(frozen=True, eq=False)
class Points:
    """Rebounds of a user and the exact ones; `energy_change` is that after less that before.

    It is in J, or in units of m_t (mu V_1/kappa)^2/2 where all is dimensionless: psi_2^2 - psi_1^2.
    """

    psi_in: Array
    psi_out: Array
    chi: Array
    exact: Array
    sequence: NDArray[np.int64]
    sequence_names: tuple[str, ...]
    energy_change: Array
    rows: NDArray[np.int64]
    word: str

    @cached_property
    def error(self) -> Array:
        """psi_2 less the exact one."""
        return self.psi_out - self.exact

    @property
    def worst(self) -> int:
        """The index of the largest error."""
        return int(np.argmax(np.abs(self.error)))

    def named(self, where: NDArray[np.bool_]) -> str:
        """Return the rows where something is so."""
        return named(self.word, self.rows[where], self.rows.size)

    def one(self, index: int) -> str:
        """Return what one row is called."""
        return named(self.word, self.rows[index : index + 1])

    def group(self, name: str, where: NDArray[np.bool_]) -> Group:
        """Return the errors of some of the points."""
        error = self.error[where]
        rms = float(np.sqrt(np.mean(error**2)))
        return Group(name, error.size, float(np.abs(error).max()), rms, float(error.mean()))

    @property
    def groups(self) -> tuple[Group, ...]:
        """The errors by the sequence of phases of the exact impact, by rising |psi_1|."""
        places = range(len(self.sequence_names))
        members = {place: self.sequence == place for place in places}
        order = sorted(places, key=lambda place: np.abs(self.psi_in[members[place]]).min())
        return tuple(self.group(self.sequence_names[i], members[i]) for i in order)


def compared(
    psi_in: Array, psi_out: Array, chi: Array, energy_change: Array, results: Results
) -> Points:
    """Return results beside the exact rebounds of Maw, Barber & Fawcett (1976).

    Raises InputError for a row of which the exact rebound is not known.
    """
    large = np.maximum(np.abs(psi_in), np.abs(psi_out)) > LARGEST
    if large.any():
        where = results.named(large)
        raise InputError(f"results: |psi| is above {LARGEST:g} in {where}; check the units")
    exact, status, codes = solved(np.array(psi_in), np.array(chi))
    if (status != Status.SOLVED).any():
        bad = status != Status.SOLVED
        reason = Status(int(status[bad][0])).message
        raise InputError(f"results: no exact answer for {results.named(bad)}; {reason}")
    sequence, names = _sequences(psi_in, chi, codes)
    rows, word = results.rows, results.word
    return Points(psi_in, psi_out, chi, exact, sequence, names, energy_change, rows, word)


def _sequences(
    psi: Array, chi: Array, codes: NDArray[np.int64]
) -> tuple[NDArray[np.int64], tuple[str, ...]]:
    """Return the place of each point's sequence of phases in a tuple of their names.

    Signs are those of an impact with positive psi_1. One impact is solved for each code.
    """
    _, first, inverse = np.unique(codes, return_index=True, return_inverse=True)
    found = [_name(abs(float(psi[i])), float(chi[i])) for i in first]
    names = tuple(dict.fromkeys(found))
    places = np.array([names.index(name) for name in found], dtype=np.int64)
    return places[inverse], names


def _name(psi: float, chi: float) -> str:
    found = regime_map([psi], [chi])
    return str(found["sequence_name"].values[0])
