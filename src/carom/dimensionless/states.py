"""The phases of a solved impact, and its states at given times."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.elastic.phases import Kind, Status
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.numerics.arrays import Array
from carom.quantities.arrays import pure_numbers, refuse_where
from carom.quantities.prefixes import Printed
from carom.quantities.refusals import known_keywords, refusal, refuse
from carom.quantities.units import counted

KIND_NAMES = {Kind.STICK: "stick", Kind.SLIP: "slip", Kind.GROSS_SLIP: "gross slip"}


class Phase(NamedTuple):
    """A phase: kind, sign of slip (0 in stick), start and end in d_max/V_1 or s, cause of end."""

    kind: str
    sign: int
    start: float
    end: float
    cause: str


class SlipAngle(NamedTuple):
    """Angle between slip and traction in a phase, in rad: largest, and mean by frictional work."""

    largest: float
    mean: float


@dataclass(frozen=True, eq=False)
class History:
    """An impact at some times, in the units of `Solution`.

    `speed` is that of the surfaces, `centre_speed` that of the bodies' centres, which differs if a
    plate gives way. `psi` and `force` are tangential; energies are `stored` elastically,
    `dissipated` by friction, `shear_lost` to viscosity, and `normal_stored` and `normal_lost` of
    the normal motion.
    """

    time: Array
    penetration: Array
    speed: Array
    centre_speed: Array
    psi: Array
    displacement: Array
    force: Array
    stick_radius: Array
    contact_radius: Array
    stored: Array
    dissipated: Array
    shear_lost: Array
    normal_force: Array
    normal_stored: Array
    normal_lost: Array

    def __len__(self) -> int:
        return len(self.time)


class ContactState(NamedTuple):
    """A contact at an instant: radius, `rim` (pressure's density at the edge), profile, slip.

    `slid` and `slipping` give the radial functions w_0, w_2 of slip and its rate at radii, (n, 2).
    """

    radius: float
    rim: float
    profile: Profile
    slid: Callable[[Array], Array]
    slipping: Callable[[Array], Array]


class Trajectory(Printed, ABC):
    """A solved impact and its state at any time."""

    psi_in: float
    chi: float
    psi_out: float
    duration: float
    max_radius: float
    status: Status
    phases: tuple[Phase, ...]

    def __str__(self) -> str:
        rows = [
            f"  {p.kind:10s} {' +-'[p.sign]} {p.start:8.4f} to {p.end:.4f} d_max/V_1: {p.cause}"
            for p in self.phases
        ]
        head = f"psi_1 = {self.psi_in:g}, chi = {self.chi:g}: psi_2 = {self.psi_out:.6g}"
        return "\n".join([f"{head} ({self.status.message})", *rows])

    @abstractmethod
    def at(self, time: ArrayLike) -> History:
        """Return the state at the given times, one row for each.

        The instant at which the phase changes belongs to the later phase.

        Parameters
        ----------
        time : array_like
            Time in units of d_max/V_1, from 0 to `duration`.

        Returns
        -------
        History
            Arrays of shape (n,) in the units of `Solution`: `time`, `penetration`, `speed`, `psi`,
            `displacement`, `force`, `stick_radius` (what stick zones add up to), `contact_radius`,
            `stored`, `dissipated`, `shear_lost`, `normal_force`, `normal_stored`, `normal_lost`.

        Raises
        ------
        InputError
            If a time is outside the contact, or the impact is not solved.

        Examples
        --------
        >>> carom.solve(0.5, 1.44).at([0.0, 1.0]).psi.round(4)
        array([ 0.5   , -0.0419])
        """

    @abstractmethod
    def _contact_at(self, time: float) -> ContactState:
        """Return the contact at a time within the impact."""

    def contact_at(self, time: float) -> ContactState:
        """Return radius, tractions and slip at a time in d_max/V_1, or raise InputError."""
        return self._contact_at(self._time_within(time))

    @abstractmethod
    def _touched(self, radii: Array) -> Array:
        """Return when the edge of the contact first passed radii that it reaches."""

    def touched(self, radii: ArrayLike) -> Array:
        """Return times in d_max/V_1 at which the edge first passed radii; InputError if never."""
        places = places_of(radii)
        allowed = f"the largest radius of the contact is {self.max_radius:.6g}"
        refuse_where("radii", places, places > self.max_radius, allowed)
        return self._touched(places)

    @abstractmethod
    def _friction_work(self, radii: Array) -> Array:
        """Return the radial functions of the work of friction per area of the whole impact."""

    @abstractmethod
    def _pressed(self, radii: Array) -> Array:
        """Return the integral of the pressure over the time of the impact."""

    @abstractmethod
    def _slip_borders(self) -> Array:
        """Return rising radii, from 0 to `max_radius`, between which the work is smooth."""

    def friction_work(self, radii: ArrayLike) -> Array:
        """Return the work of friction per area at given radii, over the whole impact, (n, 2).

        It is the integral over time of the traction times the rate of slip along x,
        W_0 - lambda W_2 cos 2 theta, in mu^2 p_0 d_max/kappa; zero where the bodies never touch.
        Raises InputError if a radius is negative, or the impact is not solved.
        """
        self._check_solved()
        return self._friction_work(places_of(radii))

    def pressed(self, radii: ArrayLike) -> Array:
        """Return the integral of the pressure over the time of the impact at given radii.

        Without friction the bodies slide at a constant speed, and wear is proportional to this
        integral, in p_0 d_max/V_1, times the speed. Raises InputError as `friction_work`.
        """
        self._check_solved()
        return self._pressed(places_of(radii))

    @known_keywords
    def phase_at(self, at: float) -> Phase:
        """Return the phase at a given time; an instant of change belongs to the later phase.

        Parameters
        ----------
        at : float
            Time in units of d_max/V_1, from 0 to `duration`.

        Returns
        -------
        Phase
            Its kind, its sign of slip, its start and end in d_max/V_1, and the cause of its end.

        Raises
        ------
        InputError
            If the time is outside the contact, or the impact is not solved.

        Examples
        --------
        >>> carom.solve(0.5, 1.44).phase_at(1.0).kind
        'stick'
        """
        instant = self._time_within(at)
        started = [phase for phase in self.phases if phase.start <= instant]
        return started[-1]

    @known_keywords
    def traction(self, at: float, radii: ArrayLike) -> Array:
        """Return the tangential traction at given radii and a given time (Barber 1979, (6)).

        Parameters
        ----------
        at : float
            Time in units of d_max/V_1, from 0 to `duration`.
        radii : array_like
            Distances from the centre in units of sqrt(R* d_max).

        Returns
        -------
        numpy.ndarray, shape (n,)
            The ratio f/(mu p_0), where p_0 is the largest pressure of the elastic impact. It is
            zero outside the contact, and infinite at the edge while viscous bodies are loaded.

        Raises
        ------
        InputError
            If the time is outside the contact, or the impact is not solved.

        Examples
        --------
        >>> gross = carom.solve(9.0, 1.44)  # the traction is mu times the pressure
        >>> gross.traction(0.5 * gross.duration, [0.0, 0.6]).round(6)
        array([1. , 0.8])
        """
        places = places_of(radii)
        out = np.empty(places.size)
        surface.tractions(self.contact_at(self._time_within(at)).profile, places, out)
        return out

    def history(self, n: int = 200) -> History:
        """Return the impact at evenly spaced times from the first touch to the last.

        Parameters
        ----------
        n : int
            Number of times, from 2 to a million.

        Returns
        -------
        History
            Arrays of shape (n,), as `at` returns them.

        Raises
        ------
        InputError
            If n is out of range, or the impact is not solved.

        Examples
        --------
        >>> carom.solve(0.5, 1.44).history(3).penetration.round(9)
        array([0., 1., 0.])
        """
        count = counted("n", n, 2)
        self._check_solved()
        return self.at(np.linspace(0.0, self.duration, count))

    def _check_solved(self) -> None:
        words = f"{self.psi_in:g} at chi = {self.chi:g} {self.status.message}"
        refuse(self.status is not Status.SOLVED and f"psi_1: {words}")

    def _times_within(self, times: ArrayLike, name: str = "time") -> Array:
        """Return times as a line of numbers, or raise InputError for one outside the contact."""
        self._check_solved()
        wanted = pure_numbers(name, times).ravel()
        outside = ~((wanted >= 0.0) & (wanted <= self.duration))
        allowed = f"the contact lasts from 0 to {self.duration:.6g}"
        refuse_where(name, wanted, outside, allowed)
        return wanted

    def _time_within(self, at: float) -> float:
        """Return one time, or raise InputError."""
        wanted = self._times_within(at, "at")
        refuse(wanted.size != 1 and refusal("at", at, "give one time"))
        return float(wanted[0])


def now_at(history: History) -> dict[str, float]:
    """Return the only row of a history as numbers."""
    return {item.name: float(getattr(history, item.name)[0]) for item in fields(history)}


def places_of(radii: ArrayLike) -> Array:
    """Return distances from the centre as a line of numbers, or raise InputError."""
    places = pure_numbers("radii", radii).ravel()
    bad = ~((places >= 0.0) & (places < np.inf))
    refuse_where("radii", places, bad, "must be zero or positive and finite")
    return places
