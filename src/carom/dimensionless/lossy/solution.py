"""One impact with losses in plain numbers: its phases, and its state at any time."""

from abc import abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.elastic.phases import Kind, Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import LossNumbers, named
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.states import KIND_NAMES, History, Phase, Trajectory
from carom.quantities.statuses import Cause, cause_between


@dataclass(frozen=True, eq=False)
class LossySolution(Trajectory):
    """One oblique impact with losses, solved; made by `solve`.

    Units are those of `Solution`, of the elastic impact at the same speed. Kinetic energy of the
    normal motion, `normal_stored` and `normal_lost` of its history add up to 1. `status` is SOLVED
    or says why not, `phases` are in order, `shear_lost` is the energy lost to viscosity in shear.
    """

    psi_in: float
    chi: float
    psi_out: float
    status: Status
    phases: tuple[Phase, ...]
    restitution: float
    duration: float
    max_penetration: float
    max_force: float
    max_radius: float
    max_pressure: float
    shear_lost: float
    _losses: LossNumbers = field(repr=False)
    _first: float = field(repr=False)  # psi_1 of the record

    @property
    def _scale(self) -> float:
        """What the record is scaled by: its psi_1 is the smallest that is solved."""
        return float(np.copysign(min(abs(self.psi_in) / self._first, 1.0), self.psi_in))

    @property
    def _excess(self) -> float:
        """How much faster than in the record all slips: its psi_1 is the largest that is solved."""
        return max(abs(self.psi_in) - self._first, 0.0)

    @abstractmethod
    def _sampled(self, wanted: Array) -> Array:
        """Return all rows of the record at these times, shape (rows, times)."""

    @abstractmethod
    def _recorded_work(self, radii: Array) -> Array:
        """Return the work of friction per area of the record."""

    def _friction_work(self, radii: Array) -> Array:
        work = self._recorded_work(radii)
        if self._excess:
            work[:, 0] += self._excess * self._pressed(radii)
        return self._scale**2 * work

    def at(self, time: ArrayLike) -> History:
        wanted = self._times_within(time)
        rows, scale, excess = self._sampled(wanted), self._scale, self._excess
        first, psi = self._first, rows[layout.AT_PSI]
        radius = np.maximum(rows[layout.AT_B], 0.0)  # rounding at the end of the contact
        stored, shear = 1.875 * self.chi * rows[layout.AT_SQUARE], rows[layout.AT_SHEAR_LOST]
        kinetic_lost = 0.5 * (first - psi) * (first + psi + 2.0 * excess)
        return History(
            time=wanted,
            penetration=rows[layout.AT_D],
            speed=rows[layout.AT_V],
            centre_speed=rows[layout.AT_V],
            psi=scale * (psi + excess),
            displacement=scale * (rows[layout.AT_U] + excess * wanted),
            force=scale * rows[layout.AT_Q],
            stick_radius=np.minimum(rows[layout.AT_STUCK], radius),
            contact_radius=radius,
            stored=scale**2 * stored,
            dissipated=scale**2 * (kinetic_lost - stored - shear),
            shear_lost=scale**2 * shear,
            normal_force=rows[layout.AT_P],
            normal_stored=rows[layout.AT_STORED],
            normal_lost=rows[layout.AT_LOST],
        )


def outcome(
    psi: float, chi: float, losses: LossNumbers, status: int, numbers: Array
) -> dict[str, Any]:
    """Return what a solution tells as numbers."""
    values = named(numbers, losses.loss, Status(status))._asdict()
    columns = {name: float(value) for name, value in values.items() if name != "status"}
    return {"psi_in": psi, "chi": chi, "_losses": losses, **columns, "status": Status(status)}


def phases_of(
    stretches: Iterable[tuple[float, int, int]], mirror: int, shortest: float
) -> tuple[Phase, ...]:
    """Return the phases of stretches of time, (end, kind, sign); short ones join the one before."""
    phases: list[Phase] = []
    for end, kind, slip in stretches:
        start = phases[-1].end if phases else 0.0
        name, sign = KIND_NAMES[Kind(kind)], mirror * slip
        same = phases and (phases[-1].kind, phases[-1].sign) == (name, sign)
        if phases and (same or end - start <= shortest):
            phases[-1] = phases[-1]._replace(end=end)
            continue
        if phases:
            cause = cause_between(phases[-1].kind, name).message
            phases[-1] = phases[-1]._replace(cause=cause)
        phases.append(Phase(name, sign, start, end, Cause.SEPARATION.message))
    return tuple(phases)
