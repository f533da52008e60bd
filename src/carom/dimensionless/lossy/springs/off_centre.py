"""One impact of bodies that are struck off their centre, or touch in an ellipse, marched.

The normal motion then depends on friction; velocity and force may turn. Units are those of
`Solution`, of psi across kappa_y V_y/(mu V_1); friction's share of the energies is known only with
the masses.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import LARGEST_PSI, Loss, LossNumbers, largest_pressure
from carom.dimensionless.lossy.springs import march
from carom.dimensionless.lossy.springs.motion import Inertia
from carom.dimensionless.lossy.springs.solution import phases_by_rows, solid_of
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.states import Phase

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

ENERGY = 2.5  # P d over m_n V_1^2/2, in units of both


class Course(NamedTuple):
    """An impact at times, arrays of shape (n,); pairs are along both axes of the contact."""

    time: Array
    penetration: Array
    speed: Array  # of approach at the contact, of plates of the bodies
    psi: tuple[Array, Array]
    displacement: tuple[Array, Array]
    force: tuple[Array, Array]
    stick_radius: Array
    contact_radius: Array
    normal_force: Array
    stored: Array  # energies: in shear in units of m_t (mu V_1/kappa)^2, others of m_n V_1^2/2
    normal_stored: Array
    normal_work: Array
    shear_lost: Array


@dataclass(frozen=True, eq=False)
class OffCentreSolution:
    """One impact with a full inverse mass; `psi_in` and `psi_out` are along both axes."""

    psi_in: tuple[float, float]
    psi_out: tuple[float, float]
    psi_error: float
    inertia: Inertia
    status: Status
    restitution: float
    duration: float
    max_penetration: float
    max_force: float
    max_radius: float
    max_pressure: float
    shear_lost: float
    phases: tuple[Phase, ...]
    _rows: Array = field(repr=False)
    _give: float = field(repr=False)  # speed of a plate over the force
    _excess: tuple[float, float] = field(repr=False)  # by how much faster all slips than in rows

    def at(self, times: Array) -> Course:
        """Return the impact at times within it."""
        rows = self._between(np.minimum(times, self._rows[-1, layout.AT_TIME])).T
        along, across = self._excess
        radius = np.maximum(rows[layout.AT_B], 0.0)  # rounding at the end
        return Course(
            time=times,
            penetration=rows[layout.AT_D],
            speed=rows[layout.AT_V] + self._give * rows[layout.AT_P],
            psi=(rows[layout.AT_PSI] + along, rows[march.OTHER_PSI] + across),
            displacement=(
                rows[layout.AT_U] + along * times,
                rows[march.OTHER_MOVED] + across * times,
            ),
            force=(rows[layout.AT_Q], rows[march.OTHER_FORCE]),
            stick_radius=np.minimum(rows[layout.AT_STUCK], radius),
            contact_radius=radius,
            normal_force=rows[layout.AT_P],
            stored=1.875 * self.inertia.chi * rows[layout.AT_SQUARE],
            normal_stored=rows[layout.AT_STORED],
            normal_work=rows[-1],
            shear_lost=rows[layout.AT_SHEAR_LOST],
        )

    @cached_property
    def _between(self) -> "PchipInterpolator":
        from scipy.integrate import cumulative_trapezoid
        from scipy.interpolate import PchipInterpolator

        rows = self._rows
        speed = rows[:, layout.AT_V] + self._give * rows[:, layout.AT_P]
        power = ENERGY * rows[:, layout.AT_P] * speed
        work = cumulative_trapezoid(power, rows[:, layout.AT_TIME], initial=0.0)
        return PchipInterpolator(rows[:, layout.AT_TIME], np.column_stack((rows, work)))


def solve_off_centre(
    psi: float, across: float, inertia: Inertia, losses: LossNumbers
) -> OffCentreSolution:
    """Solve one impact; what is not solved has a status, and no rows."""
    solid, numbers, trial = solid_of(losses), np.zeros(march.NUMBERS), march.new_work()
    status, error = march.run(psi, across, inertia, solid, trial, numbers)
    size = float(np.hypot(psi, across))
    scale = LARGEST_PSI / size if size > LARGEST_PSI else 1.0
    marched, steps = (scale * psi, scale * across), -1
    kept = march.new_work(march.LONGEST if status == Status.SOLVED else 0)
    if status == Status.SOLVED:
        steps = march.trace(*marched, inertia, solid, march.MOST_SPRINGS, trial, kept)
    rows = kept.rows[: steps + 1].copy()
    force, radius = numbers[layout.STRONGEST], numbers[layout.WIDEST]
    return OffCentreSolution(
        psi_in=(psi, across),
        psi_out=(float(numbers[layout.PSI_OUT]), float(numbers[march.PSI_ACROSS])),
        psi_error=error,
        inertia=inertia,
        status=Status(status),
        restitution=float(numbers[layout.RESTITUTION]),
        duration=float(numbers[layout.TIME]),
        max_penetration=float(numbers[layout.DEEPEST]),
        max_force=float(force),
        max_radius=float(radius),
        max_pressure=float(largest_pressure(losses.loss, force, radius)),
        shear_lost=float(numbers[layout.SHEAR_LOST]),
        phases=phases_by_rows(rows),
        _rows=rows,
        _give=1.25 * losses.parameter if losses.loss == Loss.PLATE else 0.0,
        _excess=(psi - marched[0], across - marched[1]),
    )
