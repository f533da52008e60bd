"""One marched impact: a yielding sphere, or a standard linear solid."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from carom.dimensionless.elastic.phases import Kind, Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import FAR, LossNumbers
from carom.dimensionless.lossy.solution import LossySolution, outcome, phases_told
from carom.dimensionless.lossy.springs.rebounds import run, trace
from carom.dimensionless.lossy.springs.record import BACK, COLUMNS, FORTH
from carom.dimensionless.lossy.springs.work import MOST_SPRINGS, new_work
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.states import Phase
from carom.quantities.refusals import InputError

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

SHORTEST = 10.0  # steps to the shortest phase that is told


@dataclass(frozen=True, eq=False)
class MarchedSolution(LossySolution):
    """An impact marched over springs, states to 3e-5, energies to 1e-4; see LossySolution.

    psi_out, extrapolated in the number of springs, is closer than the history.
    """

    _rows: Array = field(repr=False)

    def _sampled(self, wanted: Array) -> Array:
        return np.asarray(self._between(np.minimum(wanted, self._rows[-1, layout.AT_TIME])).T)

    @cached_property
    def _between(self) -> "PchipInterpolator":
        from scipy.interpolate import (
            PchipInterpolator,
        )  # a third of a second, for these solids alone

        return PchipInterpolator(self._rows[:, layout.AT_TIME], self._rows[:, : layout.ROWS])

    def _contact_at(self, time: float) -> NoReturn:
        _refuse_fields()

    def _touched(self, radii: Array) -> NoReturn:
        _refuse_fields()

    def _friction_work(self, radii: Array) -> NoReturn:
        _refuse_fields()

    def _pressed(self, radii: Array) -> NoReturn:
        _refuse_fields()

    def _slip_borders(self) -> NoReturn:
        _refuse_fields()


def _refuse_fields() -> NoReturn:
    raise InputError("losses: fields of this solid are not known; use KelvinVoigt, or no losses")


def solve_by_marching(psi: float, chi: float, losses: LossNumbers) -> MarchedSolution:
    """Solve one oblique impact of a yielding sphere or a standard linear solid."""
    work, numbers = new_work(), np.zeros(layout.NUMBERS)
    rows = np.zeros((len(work.motion), COLUMNS))
    law, first = (chi, int(losses.loss), losses.parameter, losses.extra), min(abs(psi), FAR)
    status = run(psi, *law, work, numbers)
    steps = trace(first, *law, MOST_SPRINGS, work, rows) if status == Status.SOLVED else -1
    kept = rows[: steps + 1].copy()
    return MarchedSolution(
        **outcome(psi, chi, losses, status, numbers),
        phases=_phases(kept, -1 if psi < 0.0 else 1),
        _rows=kept,
        _first=first or 1.0,
    )


def _phases(rows: Array, mirror: int) -> tuple[Phase, ...]:
    """Return the phases; the edge, where both limits meet, is a ring that is not told."""
    if not len(rows):
        return ()
    return phases_told(_stretches(rows), mirror, SHORTEST * rows[-1, layout.AT_TIME] / len(rows))


def _stretches(rows: Array) -> Iterator[tuple[float, int, int]]:
    """Give the end, kind and sign of slip of every run of steps that do the same."""
    for (kind, slip), run_of in groupby(rows[1:], _kind):
        yield float(list(run_of)[-1][layout.AT_TIME]), kind, slip


def _kind(row: Array) -> tuple[int, int]:
    forth, back = bool(row[FORTH]), bool(row[BACK])
    kind = Kind.GROSS_SLIP if row[layout.AT_STUCK] == 0.0 else Kind.SLIP
    return int(kind if forth or back else Kind.STICK), forth - back
