"""One marched impact: a yielding sphere, a standard linear solid, or another without an engine."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from carom.dimensionless.elastic.phases import Kind, Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import FAR, Loss, LossNumbers
from carom.dimensionless.lossy.solution import LossySolution, outcome, phases_told
from carom.dimensionless.lossy.springs.frames import Frames
from carom.dimensionless.lossy.springs.march import BACK, FORTH, LONGEST, MOST_SPRINGS, new_work
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.lossy.springs.rebounds import run, trace
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.states import ContactState, Phase

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

SHORTEST = 10.0  # steps to the shortest phase that is told


@dataclass(frozen=True, eq=False)
class MarchedSolution(LossySolution):
    """An impact marched over springs; see LossySolution.

    States are good to 3e-5, energies and fields to 1e-3 and better. psi_out, extrapolated in the
    number of springs, is closer: `psi_error` estimates its error, by the numbers of two grids.
    """

    psi_error: float
    _rows: Array = field(repr=False)

    def _sampled(self, wanted: Array) -> Array:
        return np.asarray(self._between(np.minimum(wanted, self._rows[-1, layout.AT_TIME])).T)

    @cached_property
    def _between(self) -> "PchipInterpolator":
        from scipy.interpolate import PchipInterpolator  # a third of a second, for these alone

        return PchipInterpolator(self._rows[:, layout.AT_TIME], self._rows[:, : layout.ROWS])

    @cached_property
    def _frames(self) -> Frames:
        """What springs did, of which fields are made."""
        return Frames(self._first, self.chi, solid_of(self.losses))

    def _contact_at(self, time: float) -> ContactState:
        frames, scale = self._frames, self._scale

        def slid(radii: Array) -> Array:
            slip = frames.slid(time, radii)
            if self._excess:
                inside = radii <= frames.edge(time)
                slip[:, 0] += inside * self._excess * (time - self._touched(radii * inside))
            return scale * slip

        def slipping(radii: Array) -> Array:
            rate = frames.slipping(time, radii)
            rate[:, 0] += self._excess * (radii <= frames.edge(time))
            return scale * rate

        return ContactState(frames.edge(time), 0.0, frames.profile(time, scale), slid, slipping)

    def _touched(self, radii: Array) -> Array:
        widest = int(np.argmax(self._rows[:, layout.AT_B]))
        edges, times = self._rows[: widest + 1, [layout.AT_B, layout.AT_TIME]].T
        return np.asarray(np.interp(radii, edges, times))

    def _friction_work(self, radii: Array) -> Array:
        work = self._frames.work(radii)
        work[:, 0] += self._excess * self._frames.pressed(radii)
        return self._scale**2 * work

    def _pressed(self, radii: Array) -> Array:
        return self._frames.pressed(radii)

    def _slip_borders(self) -> Array:
        return np.array([0.0, self.max_radius])


def solid_of(losses: LossNumbers) -> Solid:
    """Return what the contact is of; a yielding sphere is elastic in shear."""
    extra = losses.extra if losses.loss == Loss.RELAXING else 0.0
    return Solid(int(losses.loss), float(losses.parameter), float(extra))


def solve_by_marching(psi: float, chi: float, losses: LossNumbers) -> MarchedSolution:
    """Solve one oblique impact for which there is no engine but the march."""
    trial, kept, numbers = new_work(), new_work(LONGEST), np.zeros(layout.NUMBERS)
    law, first = (Inertia(chi), solid_of(losses)), min(abs(psi), FAR)
    status, error = run(psi, *law, trial, numbers)
    solved = status == Status.SOLVED
    steps = trace(first, *law, MOST_SPRINGS, trial, kept) if solved else -1
    rows = kept.rows[: steps + 1].copy()
    return MarchedSolution(
        **outcome(psi, chi, losses, status, numbers),
        phases=_phases(rows, -1 if psi < 0.0 else 1),
        psi_error=error,
        _rows=rows,
        _first=first or 1.0,
    )


def _phases(rows: Array, mirror: int) -> tuple[Phase, ...]:
    """Return the phases; the edge, where both limits meet, is a ring that is not told."""
    if not len(rows):
        return ()
    return phases_told(_stretches(rows), mirror, SHORTEST * rows[-1, layout.AT_TIME] / len(rows))


def _stretches(rows: Array) -> Iterator[tuple[float, int, int]]:
    """Give the end, kind and sign of slip of every run of steps that do the same.

    Stick that seems to begin while unloading is a ring too thin for springs: it goes to the next.
    """
    kinds = [_kind(row) for row in rows[1:-1]]
    for i in range(len(kinds) - 2, -1, -1):
        if kinds[i][0] == Kind.STICK and rows[i + 1, layout.AT_V] < 0.0:
            kinds[i] = kinds[i + 1]
    steps = zip([*rows[1:-2, layout.AT_TIME], rows[-1, layout.AT_TIME]], kinds, strict=True)
    for (kind, slip), run_of in groupby(steps, lambda step: step[1]):
        yield float(list(run_of)[-1][0]), kind, slip


def _kind(row: Array) -> tuple[int, int]:
    forth, back = bool(row[FORTH]), bool(row[BACK])
    kind = Kind.GROSS_SLIP if row[layout.AT_STUCK] == 0.0 else Kind.SLIP
    return int(kind if forth or back else Kind.STICK), forth - back
