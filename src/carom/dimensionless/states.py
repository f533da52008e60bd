"""What a solved impact is told in: phases, and states at some times."""

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
from carom.quantities.arrays import pure_numbers
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import counted

KIND_NAMES = {Kind.STICK: "stick", Kind.SLIP: "slip", Kind.GROSS_SLIP: "gross slip"}


class Phase(NamedTuple):
    """A phase of an impact: its kind, sign of slip (0 in stick), times, and what ended it.

    Times are in d_max/V_1 in a `Solution`, in s in an `Impact`.
    """

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
    """An impact at some times, in the dimensionless units of `Solution`."""

    time: Array
    penetration: Array
    speed: Array
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
    """A contact at an instant: radius, density of the pressure at the edge, tractions, slip.

    `slid` and `slipping` give the radial functions w_0, w_2 of slip and its rate at radii, (n, 2).
    """

    radius: float
    rim: float
    profile: Profile
    slid: Callable[[Array], Array]
    slipping: Callable[[Array], Array]


class Trajectory(ABC):
    """A solved impact: what its state at any time gives."""

    psi_in: float
    chi: float
    duration: float
    max_radius: float
    status: Status
    phases: tuple[Phase, ...]

    @abstractmethod
    def at(self, time: ArrayLike) -> History:
        """Return the state at the given times, one row for each."""

    @abstractmethod
    def _contact_at(self, time: float) -> ContactState:
        """Return the contact at a time within the impact."""

    def contact_at(self, time: float) -> ContactState:
        """Return the contact at a time: its radius, tractions and slip.

        Parameters
        ----------
        time : float
            In d_max/V_1, 0 to `duration`.

        Returns
        -------
        ContactState
            `radius` of the edge in sqrt(R* d_max), `rim` the density of the pressure there, a
            `profile` of g and q, and functions `slid`, `slipping` of radii.

        Raises
        ------
        InputError
            If the time is outside the contact, or the bodies are spheres that yield.

        Examples
        --------
        >>> import carom
        >>> round(float(carom.solve(0.5, 1.44).contact_at(1.0).radius), 4)
        0.9304
        """
        return self._contact_at(self._time_within(time))

    @abstractmethod
    def _touched(self, radii: Array) -> Array:
        """Return when the edge of the contact first passed radii that it reaches."""

    def touched(self, radii: ArrayLike) -> Array:
        """Return when the edge of the contact first passed radii that it reaches.

        Parameters
        ----------
        radii : array_like, shape (n,)
            In sqrt(R* d_max), none larger than `max_radius`.

        Returns
        -------
        numpy.ndarray, shape (n,)
            Times in d_max/V_1.

        Raises
        ------
        InputError
            If a radius is negative or the contact does not grow so large.

        Examples
        --------
        >>> import carom
        >>> carom.solve(0.5, 1.44).touched([0.5]).round(4)
        array([0.2511])
        """
        places = places_of(radii)
        if np.any(places > self.max_radius):
            far, most = float(places.max()), self.max_radius
            raise refusal("radii", far, f"the contact grows to a radius of {most:.6g}")
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
        """Return the work of friction per area at given radii, over the whole impact.

        The integral over time of traction times slip rate along x, W_0 - lambda W_2 cos 2 theta.

        Parameters
        ----------
        radii : array_like, shape (n,)
            In sqrt(R* d_max).

        Returns
        -------
        numpy.ndarray, shape (n, 2)
            W_0 and W_2 in units of mu^2 p_max d_max/kappa, zero where the bodies never touch.

        Raises
        ------
        InputError
            If a radius is negative, the impact is not solved, or the bodies are solids whose
            contact is not known.

        Examples
        --------
        >>> import carom
        >>> carom.solve(0.5, 1.44).friction_work([0.0, 0.8])[:, 0].round(6)
        array([0.019084, 0.031222])
        """
        self._check_solved()
        return self._friction_work(places_of(radii))

    def pressed(self, radii: ArrayLike) -> Array:
        """Return the integral of the pressure over the time of the impact at given radii.

        Without friction, bodies slide at a constant speed, and this times it is what wears them.

        Parameters
        ----------
        radii : array_like, shape (n,)
            In sqrt(R* d_max).

        Returns
        -------
        numpy.ndarray, shape (n,)
            In units of p_max d_max/V_1.

        Raises
        ------
        InputError
            If a radius is negative, the impact is not solved, or the bodies are solids whose
            contact is not known.

        Examples
        --------
        >>> import carom
        >>> carom.solve(0.5, 1.44).pressed([0.0, 0.8]).round(4)
        array([2.2196, 0.7413])
        """
        self._check_solved()
        return self._pressed(places_of(radii))

    def phase_at(self, time: float) -> Phase:
        """Return the phase at a time; the instant of a change belongs to the later one.

        Parameters
        ----------
        time : float
            In d_max/V_1, 0 to `duration`.

        Returns
        -------
        Phase
            Its kind, sign of slip, start and end in d_max/V_1, and what ended it.

        Raises
        ------
        InputError
            If the time is outside the contact, or the impact is not solved.

        Examples
        --------
        >>> import carom
        >>> carom.solve(0.5, 1.44).phase_at(1.0).kind
        'stick'
        """
        instant = self._time_within(time)
        started = [phase for phase in self.phases if phase.start <= instant]
        return started[-1]

    def traction(self, time: float, radii: ArrayLike) -> Array:
        """Return the traction at given radii at a time, over mu and the largest pressure.

        In the plane of the contact, along x (Barber 1979, (6)).

        Parameters
        ----------
        time : float
            In d_max/V_1, 0 to `duration`.
        radii : array_like
            In units of sqrt(R* d_max).

        Returns
        -------
        numpy.ndarray, shape (n,)
            f/(mu p_max), p_max the largest pressure of the elastic impact; zero outside the
            contact, and infinite at the edge where viscous bodies are loaded.

        Raises
        ------
        InputError
            If the time is outside the contact, or the impact is not solved.

        Examples
        --------
        >>> import carom
        >>> gross = carom.solve(9.0, 1.44)  # the traction is mu times the pressure
        >>> gross.traction(0.5 * gross.duration, [0.0, 0.6]).round(6)
        array([1. , 0.8])
        """
        places = places_of(radii)
        out = np.empty(places.size)
        surface.tractions(self.contact_at(self._time_within(time)).profile, places, out)
        return out

    def history(self, n: int = 200) -> History:
        """Return the impact at evenly spaced times from the first touch to the last.

        Parameters
        ----------
        n : int
            How many times, from 2 to a million.

        Returns
        -------
        History
            Arrays of shape (n,), as of `at`.

        Raises
        ------
        InputError
            If there are fewer or more, or the impact is not solved.

        Examples
        --------
        >>> import carom
        >>> carom.solve(0.5, 1.44).history(3).penetration.round(9)
        array([0., 1., 0.])
        """
        count = counted("n", n, 2)
        self._check_solved()
        return self.at(np.linspace(0.0, self.duration, count))

    def _check_solved(self) -> None:
        if self.status is not Status.SOLVED:
            raise InputError(f"psi: {self.psi_in:g} at chi = {self.chi:g} {self.status.message}")

    def _times_within(self, time: ArrayLike) -> Array:
        """Return times as a line of numbers, or raise InputError for one outside the contact."""
        self._check_solved()
        wanted = pure_numbers("time", time).ravel()
        within = (wanted >= 0.0) & (wanted <= self.duration)
        if not np.all(within):
            outside = float(wanted[~within][0])
            raise refusal("time", outside, f"it is outside the contact, 0 to {self.duration:.6g}")
        return wanted

    def _time_within(self, time: float) -> float:
        """Return one time, or raise InputError."""
        wanted = self._times_within(time)
        if wanted.size != 1:
            raise refusal("time", time, "give one time")
        return float(wanted[0])


def now_at(history: History) -> dict[str, float]:
    """Return the only row of a history as numbers."""
    return {item.name: float(getattr(history, item.name)[0]) for item in fields(history)}


def places_of(radii: ArrayLike) -> Array:
    """Return distances from the centre as a line of numbers, or raise InputError."""
    places = pure_numbers("radii", radii).ravel()
    bad = ~((places >= 0.0) & (places < np.inf))
    if bad.any():
        raise refusal("radii", float(places[bad][0]), "must be zero or positive and finite")
    return places
