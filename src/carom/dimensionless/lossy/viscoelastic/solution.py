"""One viscoelastic impact: its panels, and what they tell of fields."""

from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import Any

import numpy as np

from carom.dimensionless.elastic.phases import Kind
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import LARGEST_PSI, LossNumbers
from carom.dimensionless.lossy.solution import LossySolution, outcome, phases_of
from carom.dimensionless.lossy.viscoelastic import friction_work
from carom.dimensionless.lossy.viscoelastic.impacts import SMALLEST_PSI, TOLERANCE, Solid, outgoing
from carom.dimensionless.lossy.viscoelastic.instant import Instant, Replay, replay
from carom.dimensionless.lossy.viscoelastic.record import Trace, new_record
from carom.dimensionless.lossy.viscoelastic.work import NODES, TO_SERIES, new_work, place
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.chebyshev import extrema, from_extrema
from carom.dimensionless.states import ContactState

LAG_DEGREE = 6  # of lags over a panel, in which they are smooth
SHORTEST_PHASE = 1e-6  # in units of d_max/V_1: structure is not told any finer


@dataclass(frozen=True, eq=False)
class ViscoelasticSolution(LossySolution):
    """An impact of Kelvin-Voigt solids, solved on panels of time; made by `solve` with losses.

    Units are those of `carom.results.Solution`, of the elastic impact at the same speed.

    Examples
    --------
    >>> s = carom.solve(1.5, 1.44, losses=carom.KelvinVoigt(restitution=0.9))
    >>> round(s.psi_out, 6), round(s.restitution, 10)
    (-0.366922, 0.9)
    """

    _record: Trace = field(repr=False)

    def _contact_at(self, time: float) -> ContactState:
        number, x = self._places_in_time(np.array([time]))[0]
        instant = Instant(self._replay(number), x)
        rates, lags = cache(instant.rates), cache(instant.lags)  # which tractions do without

        def slipping(radii: Array) -> Array:
            rate, change = rates()
            shapes = [surface.slip_shape(instant.stuck, radius) for radius in radii]
            within = (radii <= instant.radius)[:, np.newaxis]
            rates_there = rate * np.array(shapes).reshape(-1, 2) + surface.displaced(change, radii)
            rates_there[:, 0] += self._excess
            return self._scale * within * rates_there

        def slid(radii: Array) -> Array:
            within = radii <= instant.radius
            r, slip = radii[within], np.zeros((radii.size, 2))
            slip[within] = surface.displaced(lags(), r) - self._lag_at_touch(r)
            if self._excess:
                slip[within, 0] += self._excess * (instant.time - self._touched(r))
            return self._scale * slip

        profile = _scaled(instant.forces(), self._scale)
        return ContactState(instant.radius, instant.shift, profile, slid, slipping)

    def _recorded_work(self, radii: Array) -> Array:
        return friction_work.work(self._record, self._replay, self._losses.parameter, radii)

    def _pressed(self, radii: Array) -> Array:
        return friction_work.pressed(self._record, self._losses.parameter, radii)

    def _slip_borders(self) -> Array:
        return friction_work.borders(self._record)

    def _replay(self, number: int) -> Replay:
        return replay(self._first, self.chi, self._losses.parameter, number)

    def _touched(self, radii: Array) -> Array:
        return np.array([self._read(*at, layout.AT_TIME) for at in self._touches(radii)])

    def _touches(self, radii: Array) -> list[tuple[int, float]]:
        """Return the panels and places at which the edge first passed radii."""
        edges = self._record.rows[:, layout.AT_B]
        return self._places(layout.AT_B, radii, np.flatnonzero(edges[:, -1] > edges[:, 0]))

    def _read(self, number: int, x: float, row: int) -> float:
        return float(np.polynomial.chebyshev.chebval(x, TO_SERIES @ self._record.rows[number, row]))

    @cached_property
    def _lags_laid(self) -> dict[int, Array]:
        """How far springs lagged behind at the edge as it passed, as series on panels (2, n)."""
        edges = self._record.rows[:, layout.AT_B]
        series = {}
        for number in np.flatnonzero(edges[:, -1] > edges[:, 0]).tolist():
            replay, places = self._replay(number), extrema(LAG_DEGREE)
            instants = [Instant(replay, float(x)) for x in places]
            lags = [surface.displaced(at.lags(), np.array([at.radius]))[0] for at in instants]
            series[number] = from_extrema(LAG_DEGREE) @ np.array(lags)
        return series

    def _lag_at_touch(self, radii: Array) -> Array:
        """Return the radial functions of how far the surface lagged behind when it was touched."""
        rows = [
            np.polynomial.chebyshev.chebval(x, self._lags_laid[number])
            for number, x in self._touches(radii)
        ]
        return np.array(rows).reshape(-1, 2)

    @cached_property
    def _series(self) -> Array:
        """The record as Chebyshev series, shape (panels, rows, NODES)."""
        return np.asarray(self._record.rows @ TO_SERIES.T)

    def _places(self, row: int, levels: Array, among: Any) -> list[tuple[int, float]]:
        """Return the panels, among some, and places in them at which a row has these values."""
        starts = self._record.rows[among, row, 0]
        panels = np.clip(np.searchsorted(starts, levels, side="right") - 1, 0, among.size - 1)
        at = zip(among[panels].tolist(), levels.tolist(), strict=True)
        return [(n, place(self._series, n, row, level, -1.0, 1.0)) for n, level in at]

    def _places_in_time(self, times: Array) -> list[tuple[int, float]]:
        return self._places(layout.AT_TIME, times, np.arange(len(self._record.rows)))

    def _sampled(self, wanted: Array) -> Array:
        places = self._places_in_time(wanted)
        sampled = np.empty((self._series.shape[1], wanted.size))
        for column, (n, x) in enumerate(places):
            sampled[:, column] = np.polynomial.chebyshev.chebval(x, self._series[n].T)
        return sampled


def _scaled(profile: Profile, scale: float) -> Profile:
    return Profile(profile.edges, scale * profile.q, scale * profile.g, scale * profile.rim)


def solve_viscoelastic(psi: float, chi: float, losses: LossNumbers) -> ViscoelasticSolution:
    """Solve one oblique impact of viscoelastic bodies."""
    record, numbers = new_record(True), np.zeros(layout.NUMBERS)
    solid = Solid(chi, losses.parameter, TOLERANCE)
    status, panels = outgoing(psi, solid, new_work(), record, numbers)
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
        phases=phases_of(stretches, -1 if psi < 0.0 else 1, SHORTEST_PHASE),
        _record=kept,
        _first=min(max(abs(psi), SMALLEST_PSI), LARGEST_PSI),
    )
