"""Which phases an impact goes through, as one line of words, and a number for each such line."""

from collections.abc import Iterable
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.integration import Work
from carom.dimensionless.elastic.phases import Status, new_work, run_phases
from carom.dimensionless.elastic.record import AT_B, AT_V, Record, new_record
from carom.dimensionless.lossy.law import ScaleFreeLaw
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.threads import in_blocks
from carom.dimensionless.rebounds import LINEAR_PSI, STEP_TOLERANCE, regime_borders
from carom.dimensionless.solution import phases_of, solve
from carom.quantities.arrays import Array

SIGNS = {0: "", 1: " +", -1: " -"}
BLOCK = 64  # impacts with losses that a thread takes at once


class Sequences:
    """Sequences of phases by number, in the order in which they are met; "" is not resolved."""

    def __init__(self, losses: ScaleFreeLaw | None, restitution: float) -> None:
        self.losses, self.restitution = losses, restitution
        self.numbers: dict[str, int] = {}

    @property
    def names(self) -> list[str]:
        """Sequences in words."""
        return list(self.numbers)

    def of(self, psi: Array, chi: Array) -> NDArray[np.int64]:
        """Return the number of the sequence of each impact, two arrays of one length."""
        slides = np.abs(psi) > regime_borders(chi, self.restitution)[:, 2]
        names = np.where(psi > 0.0, f"gross slip{SIGNS[1]}", f"gross slip{SIGNS[-1]}").tolist()
        solved = np.flatnonzero(~slides).tolist()
        for place, name in zip(solved, self._solved(psi[~slides], chi[~slides]), strict=True):
            names[place] = name
        numbers = [self.numbers.setdefault(name, len(self.numbers)) for name in names]
        return np.array(numbers, dtype=np.int64)

    def _solved(self, psi: Array, chi: Array) -> list[str]:
        if self.losses is None:
            pairs = zip(psi.tolist(), chi.tolist(), strict=True)
            return [self._elastic(one, other) for one, other in pairs]
        names = [""] * psi.size

        def block(part: slice) -> None:
            for place in range(*part.indices(psi.size)):
                names[place] = self._lossy(float(psi[place]), float(chi[place]))

        in_blocks(block, psi.size, BLOCK, 1, None)
        return names

    def _lossy(self, psi: float, chi: float) -> str:
        solution = solve(psi, chi, losses=self.losses)
        if solution.status is not Status.SOLVED:
            return ""
        return in_words((phase.kind, phase.sign) for phase in solution.phases)

    @cached_property
    def _room(self) -> tuple[Work, Record]:
        return new_work(), new_record(False)

    def _elastic(self, psi: float, chi: float) -> str:
        """Return the phases that `solve` tells, without what else it makes."""
        work, record = self._room
        record.counts[:] = 0
        if run_phases(max(abs(psi), LINEAR_PSI) if psi else 0.0, chi, STEP_TOLERANCE, work, record):
            return ""
        changes = record.changes[: record.counts[2]]
        times = np.array([hertz.time(row[AT_B] ** 2, row[AT_V]) for row in changes.tolist()])
        phases = phases_of(changes, times, -1 if np.signbit(psi) else 1)
        return in_words((phase.kind, phase.sign) for phase in phases)


def in_words(phases: Iterable[tuple[str, int]]) -> str:
    """Return a sequence of phases, kinds with the sign of slip, in one line."""
    return ", ".join(f"{kind}{SIGNS[sign]}" for kind, sign in phases)
