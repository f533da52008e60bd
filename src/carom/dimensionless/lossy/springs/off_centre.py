"""One impact of bodies that are struck off their centre, or touch in an ellipse, marched.

The normal motion then depends on friction, and velocity and force may turn. Units are those of
`Solution`; psi across is kappa_y V_y/(mu V_1).
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.solution import outcome
from carom.dimensionless.lossy.springs import march
from carom.dimensionless.lossy.springs.motion import Inertia
from carom.dimensionless.lossy.springs.solution import (
    Frames,
    MarchedSolution,
    phases_by_rows,
    solid_of,
)
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.states import History

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

ENERGY = 2.5  # P d over m_n V_1^2/2, in units of both


@dataclass(frozen=True, eq=False)
class HistoryInSpace(History):
    """A history with what is across; what friction takes is not known without the masses."""

    psi_across: Array
    displacement_across: Array
    force_across: Array


@dataclass(frozen=True, eq=False)
class OffCentreSolution(MarchedSolution):
    """An impact with a full inverse mass; psi_in and psi_out are along x. See MarchedSolution."""

    psi_across_in: float
    psi_across_out: float
    _inertia: Inertia = field(repr=False)
    _marched: tuple[float, float] = field(repr=False)  # psi of the rows, along and across

    @property
    def _scale(self) -> float:
        return 1.0

    @property
    def _excess(self) -> float:
        return self.psi_in - self._marched[0]

    def at(self, time: ArrayLike) -> HistoryInSpace:
        wanted = self._times_within(time)
        rows, along = self._sampled(wanted), self._excess
        across, stored = self.psi_across_in - self._marched[1], rows[layout.AT_STORED]
        radius = np.maximum(rows[layout.AT_B], 0.0)  # rounding at the end of the contact
        return HistoryInSpace(
            time=wanted,
            penetration=rows[layout.AT_D],
            speed=rows[layout.AT_V],
            centre_speed=rows[layout.AT_V] + self._give * rows[layout.AT_P],
            psi=rows[layout.AT_PSI] + along,
            displacement=rows[layout.AT_U] + along * wanted,
            force=rows[layout.AT_Q],
            stick_radius=np.minimum(rows[layout.AT_STUCK], radius),
            contact_radius=radius,
            stored=1.875 * self.chi * rows[layout.AT_SQUARE],
            dissipated=np.full(wanted.size, np.nan),
            shear_lost=rows[layout.AT_SHEAR_LOST],
            normal_force=rows[layout.AT_P],
            normal_stored=stored,
            normal_lost=rows[-1] - stored,
            psi_across=rows[march.OTHER_PSI] + across,
            displacement_across=rows[march.OTHER_MOVED] + across * wanted,
            force_across=rows[march.OTHER_FORCE],
        )

    @property
    def _give(self) -> float:
        """Speed of a plate that is struck over the force."""
        return 1.25 * self._losses.parameter if self._losses.loss == Loss.PLATE else 0.0

    @cached_property
    def _between(self) -> "PchipInterpolator":
        """Rows, and the work of the normal force as the last."""
        from scipy.integrate import cumulative_trapezoid
        from scipy.interpolate import PchipInterpolator  # a third of a second, for these alone

        time, force = self._rows[:, layout.AT_TIME], self._rows[:, layout.AT_P]
        power = ENERGY * force * (self._rows[:, layout.AT_V] + self._give * force)
        work = cumulative_trapezoid(power, time, initial=0.0)
        return PchipInterpolator(time, np.column_stack((self._rows, work)))

    @cached_property
    def _frames(self) -> Frames:
        return Frames(*self._marched, self._inertia, solid_of(self._losses))


def solve_off_centre(
    psi: float, across: float, inertia: Inertia, losses: LossNumbers
) -> OffCentreSolution:
    """Solve one impact; what is not solved has a status, and no rows."""
    trial, kept, numbers = march.new_work(), march.new_work(march.LONGEST), np.zeros(march.NUMBERS)
    law, scale = (inertia, solid_of(losses)), march.share_of(float(np.hypot(psi, across)), inertia)
    first = scale * psi, scale * across
    status, error = march.run(psi, across, *law, trial, numbers)
    solved = status == Status.SOLVED
    steps = march.trace(*first, *law, march.MOST_SPRINGS, trial, kept) if solved else -1
    rows = kept.rows[: steps + 1].copy()
    return OffCentreSolution(
        **outcome(psi, inertia.chi, losses, status, numbers),
        phases=phases_by_rows(rows),
        psi_error=error,
        _rows=rows,
        _first=first[0] or 1.0,
        psi_across_in=across,
        psi_across_out=float(numbers[march.PSI_ACROSS]),
        _inertia=inertia,
        _marched=first,
    )
