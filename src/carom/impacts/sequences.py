"""Which phases an impact goes through, as one line of words, and a number for each such line."""

from collections.abc import Callable, Iterable
from functools import lru_cache, partial
from itertools import groupby, pairwise

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.phases import Kind, Status, new_work, run_phases
from carom.dimensionless.elastic.record import AT_B, AT_V, KIND, KIND_SIGN, new_record
from carom.dimensionless.lossy.law import ScaleFreeLaw
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.threads import in_blocks
from carom.dimensionless.rebounds import LINEAR_PSI, STEP_TOLERANCE, regime_borders
from carom.dimensionless.solution import SHORTEST_PHASE, solve
from carom.dimensionless.states import KIND_NAMES
from carom.quantities.arrays import Array

SIGNS = {0: "", 1: " +", -1: " -"}
SHORT_IN_SPEED = 1e-6  # phases that may be too short to matter
AT_ONCE = 64  # impacts that a thread takes


class Sequences:
    """Sequences of phases by number, in the order in which they are met; "" is not resolved."""

    def __init__(self, losses: ScaleFreeLaw | None, restitution: float) -> None:
        self.losses, self.restitution = losses, restitution
        self.numbers: dict[str, int] = {}

    @property
    def names(self) -> list[str]:
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
        names = [""] * psi.size

        def block(part: slice) -> None:
            name = _elastic() if self.losses is None else partial(_lossy, self.losses)
            names[part] = map(name, psi[part].tolist(), chi[part].tolist())

        in_blocks(block, psi.size, AT_ONCE, AT_ONCE if self.losses is None else 1, None)
        return names


def _lossy(losses: ScaleFreeLaw, psi: float, chi: float) -> str:
    solution = solve(psi, chi, losses=losses)
    if solution.status is not Status.SOLVED:
        return ""
    return in_words((phase.kind, phase.sign) for phase in solution.phases)


def _elastic() -> Callable[[float, float], str]:
    """Return what names the phases that `solve` tells, without what else that makes."""
    work, record = new_work(), new_record(False)

    def name(psi: float, chi: float) -> str:
        record.counts[:] = 0
        solved_for = max(abs(psi), LINEAR_PSI) if psi else 0.0
        if run_phases(solved_for, chi, 0.0, STEP_TOLERANCE, work, record):
            return ""
        rows = record.changes[: record.counts[2]].tolist()
        mirror = -1 if np.signbit(psi) else 1
        phases = [
            (int(row[KIND]), mirror * int(row[KIND_SIGN]))
            for row, after in pairwise(rows)
            if abs(row[AT_V] - after[AT_V]) >= SHORT_IN_SPEED or lasts(row, after) > SHORTEST_PHASE
        ]
        return _elastic_words(tuple(phase for phase, _ in groupby(phases)))

    return name


@lru_cache(1024)
def _elastic_words(phases: tuple[tuple[int, int], ...]) -> str:
    return in_words((KIND_NAMES[Kind(kind)], sign) for kind, sign in phases)


def lasts(row: list[float], after: list[float]) -> float:
    """Return how long the phase between two changes lasts."""
    start, end = (hertz.time(change[AT_B] ** 2, change[AT_V]) for change in (row, after))
    return end - start


def in_words(phases: Iterable[tuple[str, int]]) -> str:
    """Return a sequence of phases, kinds with the sign of slip, in one line."""
    return ", ".join(f"{kind}{SIGNS[sign]}" for kind, sign in phases)
