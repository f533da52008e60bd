"""One viscoelastic impact: its panels, and what they tell of fields."""

from dataclasses import dataclass, field
from functools import cache, cached_property

import numpy as np

from carom.dimensionless.elastic.phases import Kind
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.lossy import friction_work, layout
from carom.dimensionless.lossy.law import FAR, LossNumbers
from carom.dimensionless.lossy.panels.collocation import NODES, TO_SERIES, place
from carom.dimensionless.lossy.panels.work import new_work
from carom.dimensionless.lossy.rebounds import LINEAR, outgoing
from carom.dimensionless.lossy.solution import LossySolution, outcome, phases_told
from carom.dimensionless.lossy.viscoelastic.impacts import TOLERANCE
from carom.dimensionless.lossy.viscoelastic.instant import Instant, Replay, displaced, replay
from carom.dimensionless.lossy.viscoelastic.record import Trace, new_record
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.chebyshev import extrema, from_extrema
from carom.dimensionless.states import ContactState

LAG_DEGREE = 6  # of lags over a panel, in which they are smooth
SHORTEST = 1e-6  # of a phase, in units of d_max/V_1: structure is not told any finer


@dataclass(frozen=True, eq=False)
class ViscoelasticSolution(LossySolution):
    """A viscoelastic impact, solved on panels of time; see LossySolution."""

    _record: Trace = field(repr=False)

    def _contact_at(self, time: float) -> ContactState:
        number, x = self._places(np.array([time]))[0]
        instant = Instant(self._replay(number), x)
        rates, lags = cache(instant.rates), cache(instant.lags)  # which tractions do without

        def slipping(radii: Array) -> Array:
            rate, change = rates()
            shapes = [surface.slip_shape(instant.stuck, radius) for radius in radii]
            within = (radii <= instant.radius)[:, np.newaxis]
            found = rate * np.array(shapes).reshape(-1, 2) + displaced(change, radii)
            found[:, 0] += self._excess
            return self._scale * within * found

        def slid(radii: Array) -> Array:
            within = radii <= instant.radius
            found = np.zeros((radii.size, 2))
            found[within] = displaced(lags(), radii[within]) - self._lag_at_touch(radii[within])
            if self._excess:
                found[within, 0] += self._excess * (instant.time - self._touched(radii[within]))
            return self._scale * found

        profile = _scaled(instant.forces(), self._scale)
        return ContactState(instant.radius, instant.shift, profile, slid, slipping)

    def _friction_work(self, radii: Array) -> Array:
        given = self._record, self._replay, self.losses.parameter
        found = friction_work.work(*given, radii)
        if self._excess:
            found[:, 0] += self._excess * self._pressed(radii)
        return self._scale**2 * found

    def _pressed(self, radii: Array) -> Array:
        return friction_work.pressed(self._record, self.losses.parameter, radii)

    def _slip_borders(self) -> Array:
        return friction_work.borders(self._record)

    def _replay(self, number: int) -> Replay:
        return replay(self._first, self.chi, self.losses.parameter, number)

    def _touched(self, radii: Array) -> Array:
        return np.array([self._read(*at, layout.AT_TIME) for at in self._touches(radii)])

    def _touches(self, radii: Array) -> list[tuple[int, float]]:
        """Return the panels and places at which the edge first passed radii."""
        edges, series = self._record.rows[:, layout.AT_B], self._record.rows @ TO_SERIES.T
        grows = np.flatnonzero(edges[:, -1] > edges[:, 0])
        panels = np.clip(np.searchsorted(edges[grows, 0], radii, side="right") - 1, 0, None)
        numbers = grows[np.minimum(panels, grows.size - 1)]
        return [
            (int(n), place(series, int(n), layout.AT_B, r, -1.0, 1.0))
            for n, r in zip(numbers, radii, strict=True)
        ]

    def _read(self, number: int, x: float, row: int) -> float:
        return float(np.polynomial.chebyshev.chebval(x, TO_SERIES @ self._record.rows[number, row]))

    @cached_property
    def _lags_laid(self) -> dict[int, Array]:
        """How far springs lagged behind at the edge as it passed, as series on panels (2, n)."""
        edges = self._record.rows[:, layout.AT_B]
        found = {}
        for number in np.flatnonzero(edges[:, -1] > edges[:, 0]).tolist():
            replay, places = self._replay(number), extrema(LAG_DEGREE)
            instants = [Instant(replay, float(x)) for x in places]
            lags = [displaced(at.lags(), np.array([at.radius]))[0] for at in instants]
            found[number] = from_extrema(LAG_DEGREE) @ np.array(lags)
        return found

    def _lag_at_touch(self, radii: Array) -> Array:
        """Return the radial functions of how far the surface lagged behind when it was touched."""
        rows = [
            np.polynomial.chebyshev.chebval(x, self._lags_laid[number])
            for number, x in self._touches(radii)
        ]
        return np.array(rows).reshape(-1, 2)

    def _places(self, wanted: Array) -> list[tuple[int, float]]:
        """Return the panels and places in them of times."""
        rows, starts = self._record.rows, self._record.rows[:, layout.AT_TIME, 0]
        panels = np.clip(np.searchsorted(starts, wanted, side="right") - 1, 0, len(rows) - 1)
        series = rows @ TO_SERIES.T
        return [
            (int(n), place(series, int(n), layout.AT_TIME, instant, -1.0, 1.0))
            for n, instant in zip(panels, wanted, strict=True)
        ]

    def _sampled(self, wanted: Array) -> Array:
        """Return all rows of the record at these times, shape (rows, times)."""
        rows = self._record.rows
        found, series = np.empty((rows.shape[1], wanted.size)), rows @ TO_SERIES.T
        for i, (panel, x) in enumerate(self._places(wanted)):
            found[:, i] = np.polynomial.chebyshev.chebval(x, series[panel].T)
        return found


def _scaled(profile: Profile, scale: float) -> Profile:
    return Profile(profile.edges, scale * profile.q, scale * profile.g, scale * profile.rim)


def solve_viscoelastic(psi: float, chi: float, losses: LossNumbers) -> ViscoelasticSolution:
    """Solve one oblique impact of viscoelastic bodies."""
    record, numbers = new_record(True), np.zeros(layout.NUMBERS)
    status, panels = outgoing(psi, chi, losses.parameter, TOLERANCE, new_work(), record, numbers)
    kept = Trace(record.rows[:panels].copy(), record.kinds[:panels].copy())
    if psi == 0.0:  # solved as a limit; nothing moves along, and nothing slips
        kept.kinds[:] = Kind.STICK, 0
        kept.rows[:, layout.AT_STUCK] = kept.rows[:, layout.AT_B]
    stretches = (
        (float(rows[layout.AT_TIME, NODES - 1]), *kind)
        for rows, kind in zip(kept.rows, kept.kinds.tolist(), strict=True)
    )
    return ViscoelasticSolution(
        **outcome(psi, chi, losses, status, numbers),
        phases=phases_told(stretches, -1 if psi < 0.0 else 1, SHORTEST),
        _record=kept,
        _first=min(max(abs(psi), LINEAR), FAR),
    )
