"""Impacts solved exactly within the theory, and what happens inside their contact."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isfinite, nan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.kinematics import Tangential
from carom.bodies.losses import NormalLaw
from carom.bodies.pairs import Pair
from carom.contacts.contact import Contact, contact_in_impact
from carom.contacts.fields import radial_fields, surface_fields
from carom.contacts.stress import stress_dataset
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.solution import Solution, solve, solve_with
from carom.dimensionless.states import SlipAngle
from carom.impacts.result import Course
from carom.impacts.validity import judge
from carom.io.citations import IMPACT, bibtex
from carom.io.labels import Validity
from carom.quantities.units import InputError, Value, counted, refusal

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True, eq=False)
class Impact(Course):
    """The result of `impact`: the rebound, every phase, and what happens inside the contact.

    SI units. Tangential speeds are those of the first body relative to the second, positive spin
    adds to the tangential speed of the contact point: V_x = v_t + R spin + R_2 spin2. The theory is
    that of Maw, Barber & Fawcett (1976), in the form of Barber (1979).

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> hit = carom.impact(pair, speed=2.0, angle="30 deg", spin="100 rad/s")
    >>> round(hit.contact_velocity, 3), round(hit.contact_velocity_out, 3)  # V_x in m/s
    (1.5, -0.623)
    """

    solution: Solution | LossySolution = field(repr=False)

    @property
    def validity(self) -> Validity:
        """How far the assumptions of the theory hold, as numbers with a verdict."""
        return judge(self.pair, self.normal_speed, self.duration, self.psi_in)

    @property
    def slip_angles(self) -> tuple[SlipAngle, ...]:
        """Angle between slip and traction in each phase, which the theory neglects, in rad.

        NaN where the normal motion loses energy: there it is not known.
        """
        if isinstance(self.solution, LossySolution):
            return (SlipAngle(nan, nan),) * len(self.phases)
        if not isfinite(self.psi_in):
            return (SlipAngle(0.0, 0.0),)
        return self.solution.slip_angles(self.pair.lateral_ratio)

    def contact(self, time: Value) -> Contact:
        """Return the contact at a time: what fields and stresses come from.

        Parameters
        ----------
        time : float or str
            Time since the first touch in s, 0 to `duration`.

        Returns
        -------
        Contact
            `numbers()` are its quantities in SI units; penetration, displacement and stick_radius
            are dimensionless, `scales` gives them units.

        Raises
        ------
        InputError
            If the time is outside the contact, or the normal motion loses energy.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
        >>> hit = carom.impact(pair, speed=2.0, angle="30 deg")
        >>> round(hit.contact(0.5 * hit.duration).penetration, 12)  # of the largest
        1.0
        """
        if isinstance(self.solution, LossySolution):
            raise InputError(
                "normal: fields and stresses are those of elastic impacts; leave normal out"
            )
        drift = 0.0 if isfinite(self.psi_in) else self.contact_velocity
        inputs = {"inputs": self.inputs()}
        return contact_in_impact(
            self.pair, self.normal_speed, drift, self.solution, self._instant(time), inputs
        )

    def fields(
        self,
        time: Value,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
    ) -> xr.Dataset:
        """Return tractions, zones, displacements and slip at the surface at a time.

        Pressure and traction are (1) and (6) of Barber (1979). The displacements, of both surfaces
        together and caused by the tractions, are superposed from those of punches, u_x = u_0 +
        lambda u_2 cos 2 theta, u_y = lambda u_2 sin 2 theta, lambda = nu/(2 - nu) for equal
        materials, which is (29) in gross slip: displacement of the second surface against the
        first. Slip is that of the first body on the second since the points met: U less what the
        surfaces gave way.

        Parameters
        ----------
        time : float or str
            Time since the first touch in s, 0 to `duration`.
        x, y : array_like, shapes (nx,) and (ny,)
            Positions in m of a grid around the centre of the contact, x along V_x; by default 101
            by 101 points over 1.5 radii of the contact.
        points : array_like, shape (n, 2)
            Points (x, y) in m, instead of a grid.

        Returns
        -------
        xarray.Dataset
            Along (y, x), or along `point`: pressure, traction_x, zone (0 outside, 1 stick, 2 slip),
            displacement_x, displacement_y, displacement_z, slip_x, slip_y, slip_velocity_x,
            slip_velocity_y; and as numbers contact_radius, stick_radius, normal_force,
            tangential_force, penetration, displacement, time, friction.

        Raises
        ------
        InputError
            If the time is outside the contact, or positions have another shape or are not finite.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
        >>> hit = carom.impact(pair, speed=2.0, angle="30 deg")
        >>> patch = hit.fields(0.6 * hit.duration)
        >>> sorted({int(zone) for zone in patch.zone.values.flat})  # outside, stick, slip
        [0, 1, 2]
        """
        return surface_fields(self.contact(time), x, y, points=points)

    def stress(
        self,
        time: Value,
        x: ArrayLike | None = None,
        z: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
        body: str = "second",
    ) -> xr.Dataset:
        """Return the stress below the surface of one body at a time, and where it is largest.

        Pressure (1) and traction (6) as slices of the memory, each slice a line of Boussinesq's and
        Cerruti's point forces at imaginary depth, sigma = integral of s Im[N + mu g(s) T] ds
        (Johnson 1985, section 3.2; for g = 1 Hamilton 1983); tension positive.

        Parameters
        ----------
        time : float or str
            Time since the first touch in s, 0 to `duration`.
        x, z : array_like, shapes (nx,) and (nz,)
            Positions in m of a grid in the plane y = 0, x along V_x and z the depth; by default 101
            by 61 points over 2 radii of the contact.
        points : array_like, shape (n, 3)
            Points (x, y, z) in m, instead of a grid.
        body : str
            "first" or "second".

        Returns
        -------
        xarray.Dataset
            Along (z, x), or along `point`: sigma_xx, sigma_yy, sigma_zz, sigma_xy, sigma_xz,
            sigma_yz, principal_1 to principal_3, von_mises, max_shear; of the whole body
            max_von_mises and, on its surface, max_tension, with their places, max_von_mises_x and
            so on.

        Raises
        ------
        InputError
            If the time is outside the contact, positions have another shape, are not finite or lie
            outside the body, or the body is rigid.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.0)
        >>> hit = carom.impact(pair, speed=2.0, angle=0.0)
        >>> below = hit.stress(0.5 * hit.duration, points=[[0.0, 0.0, 0.48 * hit.max_radius]])
        >>> round(float(below.max_shear[0]) / hit.max_pressure, 2)
        0.31
        """
        return stress_dataset(self.contact(time), x=x, z=z, points=points, body=body)

    def radial(self, time: Value, n: int = 401) -> xr.Dataset:
        """Return pressure, traction and the memory g, q along a radius at a time.

        Parameters
        ----------
        time : float or str
            Time since the first touch in s, 0 to `duration`.
        n : int
            How many distances from the centre.

        Returns
        -------
        xarray.Dataset
            Along `distance` in m: pressure, friction_limit, traction_x, memory_g, memory_q,
            memory_limit, zone.

        Raises
        ------
        InputError
            If the time is outside the contact, or n below 2.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
        >>> hit = carom.impact(pair, speed=2.0, angle="30 deg")
        >>> along = hit.radial(0.5 * hit.duration, n=11)
        >>> bool((abs(along.traction_x) <= 1.000001 * along.friction_limit).all())
        True
        """
        return radial_fields(self.contact(time), counted("n", n, 2))

    def cite(self) -> str:
        """Return what to cite for this result, as BibTeX.

        Returns
        -------
        str
            Entries of BibTeX, one after the other.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
        >>> hit = carom.impact(pair, speed=2.0, angle="30 deg")
        >>> [line for line in hit.cite().splitlines() if line.startswith("@")]
        ['@software{carom,', '@article{barber1979,', '@article{maw1976,']
        """
        source = () if self.normal is None else (self.normal.source,)
        return bibtex(*IMPACT, *source)

    def _phase_columns(self) -> dict[str, list[float]]:
        return {} if isinstance(self.solution, LossySolution) else super()._phase_columns()

    def _picture(self, time: float) -> xr.Dataset:
        reach = 1.15 * self.max_radius
        line = np.linspace(-reach, reach, 101)
        return self.fields(time, line, line)


def solve_exactly(
    pair: Pair, normal_speed: float, motion: Tangential, normal: NormalLaw | None
) -> Impact:
    """Return an impact solved within the theory; see `carom.impact`."""
    psi = pair.psi(motion.contact_velocity(pair), normal_speed)
    solution = _solution(pair, normal_speed, psi if isfinite(psi) else 0.0, normal)
    return Impact(pair, normal_speed, *motion, solution, normal)


def _solution(
    pair: Pair, normal_speed: float, psi: float, normal: NormalLaw | None
) -> Solution | LossySolution:
    if normal is None:
        return solve(psi, pair.chi)
    if not hasattr(normal, "loss"):
        allowed = "must be a law of normal loss, e.g. carom.KelvinVoigt(restitution=0.9)"
        raise refusal("normal", normal, allowed)
    loss, parameter = normal.loss(pair, normal_speed)
    if np.ndim(parameter):
        allowed = "an impact takes one number; carom.sweep takes many"
        raise refusal("normal", normal.describe(), allowed)
    found = solve_with(psi, pair.chi, loss, float(parameter))
    if found.status is not Status.SOLVED:
        raise refusal("normal", normal.describe(), f"the impact is {found.status.message}")
    return found
