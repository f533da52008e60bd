"""One impact with losses in plain numbers: its phases, and its state at any time."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.elastic.phases import Kind, Status
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.lossy.panels import record as layout
from carom.dimensionless.lossy.panels.collocation import NODES, TO_SERIES, place
from carom.dimensionless.lossy.panels.normal import Loss
from carom.dimensionless.lossy.panels.plans import TOLERANCE
from carom.dimensionless.lossy.panels.record import Trace, new_record
from carom.dimensionless.lossy.panels.work import new_work
from carom.dimensionless.lossy.rebounds import outgoing
from carom.dimensionless.lossy.viscoelastic.instant import Instant, Replay
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.chebyshev import extrema, from_extrema
from carom.dimensionless.states import KIND_NAMES, ContactState, History, Phase, Trajectory
from carom.quantities.refusals import InputError, refusal

LAG_DEGREE = 6  # of lags over a panel, in which they are smooth
SHORTEST = 1e-6  # of a phase, in units of d_max/V_1: structure is not told any finer
CAUSES = {
    ("stick", "slip"): "friction limit reached",
    ("stick", "gross slip"): "friction limit reached",
    ("slip", "stick"): "slip stops",
    ("slip", "slip"): "slip reverses",
    ("slip", "gross slip"): "stick zone vanishes",
    ("gross slip", "stick"): "slip stops",
    ("gross slip", "slip"): "slip reverses",
    ("gross slip", "gross slip"): "slip reverses",
}


@dataclass(frozen=True, eq=False)
class LossySolution(Trajectory):
    """One oblique impact with losses, solved; made by `solve`.

    Units are those of `Solution`, of the elastic impact at the same speed. Kinetic energy of the
    normal motion, `normal_stored` and `normal_lost` add up to 1.

    Examples
    --------
    >>> import carom
    >>> s = carom.solve(1.5, 1.44, losses=carom.KelvinVoigt(restitution=0.9))
    >>> round(s.psi_out, 6), round(s.restitution, 10)
    (-0.366922, 0.9)
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
    shear_lost: float
    loss: tuple[int, float] = field(repr=False)  # which it is, and its parameter
    _record: Trace = field(repr=False)
    _scale: float = field(repr=False)

    def at(self, time: ArrayLike) -> History:
        """Return the state at the given times, 0 <= time <= duration, one row for each.

        `stick_radius` is what the stick zones add up to, wherever they lie. Raises InputError for
        a time outside the contact, or if the impact is not solved.
        """
        wanted = self._times_within(time)
        rows, scale = self._sampled(wanted), self._scale
        first, psi = self._record.rows[0, layout.AT_PSI, 0], rows[layout.AT_PSI]
        stored, shear = 1.875 * self.chi * rows[layout.AT_SQUARE], rows[layout.AT_SHEAR_LOST]
        return History(
            time=wanted,
            penetration=rows[layout.AT_D],
            speed=rows[layout.AT_V],
            psi=scale * psi,
            displacement=scale * rows[layout.AT_U],
            force=scale * rows[layout.AT_Q],
            stick_radius=np.minimum(rows[layout.AT_STUCK], rows[layout.AT_B]),
            contact_radius=rows[layout.AT_B],
            stored=scale**2 * stored,
            dissipated=scale**2 * (0.5 * (first - psi) * (first + psi) - stored - shear),
            shear_lost=scale**2 * shear,
            normal_force=rows[layout.AT_P],
            normal_stored=rows[layout.AT_STORED],
            normal_lost=rows[layout.AT_LOST],
        )

    def _contact_at(self, time: float) -> ContactState:
        number, x = self._places(np.array([time]))[0]
        instant = Instant(self._replay(number), x)
        rate, change = instant.rates()
        lags = instant.lags()

        def slipping(radii: Array) -> Array:
            shapes = [surface.slip_shape(instant.stuck, radius) for radius in radii]
            within = (radii <= instant.radius)[:, np.newaxis]
            found = rate * np.array(shapes).reshape(-1, 2) + _displaced(change, radii)
            return self._scale * within * found

        def slid(radii: Array) -> Array:
            within = radii <= instant.radius
            found = np.zeros((radii.size, 2))
            found[within] = _displaced(lags, radii[within]) - self._lag_at_touch(radii[within])
            return self._scale * found

        profile = _scaled(instant.forces(), self._scale)
        return ContactState(instant.radius, instant.shift, profile, slid, slipping)

    def _replay(self, number: int) -> Replay:
        loss, alpha = self.loss
        if loss != Loss.VISCOUS:
            what = "fields of spheres that yield are not known; take KelvinVoigt, or no losses"
            raise InputError(f"losses: {what}")
        return Replay(float(self._record.rows[0, layout.AT_PSI, 0]), self.chi, alpha, number)

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
            lags = [_displaced(at.lags(), np.array([at.radius]))[0] for at in instants]
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


def _displaced(profile: Profile, radii: Array) -> Array:
    """Return the radial functions w_0, w_2 of what springs with this profile have slipped."""
    out = np.empty((radii.size, 5))
    surface.sample(profile, 0.0, 0.0, 0.0, np.ascontiguousarray(radii), out)
    return np.asarray(out[:, 3:] * np.array([1.0, -1.0]))


def _scaled(profile: Profile, scale: float) -> Profile:
    return Profile(profile.edges, scale * profile.q, scale * profile.g, scale * profile.rim)


def solve_with_losses(psi: float, chi: float, loss: int, parameter: float) -> LossySolution:
    """Solve one oblique impact with losses; InputError for bad numbers."""
    record, numbers = new_record(True), np.zeros(layout.NUMBERS)
    given = psi, chi, int(loss), parameter, TOLERANCE
    code, panels = outgoing(*given, new_work(), record, numbers)
    status = Status(code)
    if status in (Status.PSI_NOT_FINITE, Status.CHI_NOT_POSITIVE):
        name, value = ("psi", psi) if status is Status.PSI_NOT_FINITE else ("chi", chi)
        raise refusal(name, value, f"not allowed: {status.message}")
    kept = Trace(record.rows[:panels].copy(), record.kinds[:panels].copy())
    first = float(kept.rows[0, layout.AT_PSI, 0]) if panels else 1.0
    return LossySolution(
        psi_in=psi,
        chi=chi,
        psi_out=float(numbers[layout.PSI_OUT]),
        status=status,
        phases=_phases(kept, -1 if psi < 0.0 else 1),
        restitution=float(numbers[layout.RESTITUTION]),
        duration=float(numbers[layout.TIME]),
        max_penetration=float(numbers[layout.DEEPEST]),
        max_force=float(numbers[layout.STRONGEST]),
        max_radius=float(numbers[layout.WIDEST]),
        shear_lost=float(numbers[layout.SHEAR_LOST]),
        loss=(int(loss), parameter),
        _record=kept,
        _scale=psi / first,
    )


def _phases(record: Trace, mirror: int) -> tuple[Phase, ...]:
    """Return the phases that the panels make up; what is too short goes to the one before."""
    found: list[Phase] = []
    for rows, (kind, sign) in zip(record.rows, record.kinds.tolist(), strict=True):
        start = found[-1].end if found else 0.0
        end = float(rows[layout.AT_TIME, NODES - 1])
        name, sign = KIND_NAMES[Kind(kind)], mirror * sign
        if found and ((found[-1].kind, found[-1].sign) == (name, sign) or end - start <= SHORTEST):
            found[-1] = found[-1]._replace(end=end)
            continue
        if found:
            found[-1] = found[-1]._replace(cause=CAUSES[found[-1].kind, name])
        found.append(Phase(name, sign, start, end, "separation"))
    return tuple(found)
