"""The inside of a contact, at a time of an impact or after a step of a load path."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from carom.impacts.contacts.fields import Contact, radial_fields, stress_dataset, surface_fields
from carom.quantities.refusals import known_keywords
from carom.quantities.units import Value, counted

if TYPE_CHECKING:
    import xarray as xr

MOST_RADII = 100_000


class InContact(ABC):
    """A result with a contact at each time in s, or after each step of a load path."""

    @known_keywords
    def contact(self, at: Value | None = None) -> Contact:
        """Return the contact at an instant, from which fields and stresses are computed.

        Parameters
        ----------
        at : float, str or int
            In an impact the time since the first touch in s, 0 to `duration`; on a load path the
            step, from the end if negative, by default the last.

        Returns
        -------
        Contact
            Its quantities in SI units are in `numbers()`. The attributes `penetration`,
            `displacement` and `stick_radius` are dimensionless, in units of its `scales`.

        Raises
        ------
        InputError
            If the bodies do not touch then, or there is no such step.

        Examples
        --------
        >>> round(hit.contact(0.5 * hit.duration).penetration, 12)  # of the largest
        1.0
        >>> path = carom.load_path(pair, normal_force="10 N", tangential_force=[0.0, 1.0])
        >>> path.contact(at=-1).attributes["phase_kind"]
        'slip'
        """
        return self._contact(at)

    @known_keywords
    def fields(
        self,
        at: Value | None = None,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
    ) -> xr.Dataset:
        """Return tractions, zones, displacements and slip at the surface.

            u_x = u_0 + lambda u_2 cos 2 theta, u_y = lambda u_2 sin 2 theta

        Pressure and traction are (1) and (6) of Barber (1979). The displacements are those of the
        second surface against the first under the tractions, superposed from displacements of
        punches; lambda is nu/(2 - nu) for equal materials, and in gross slip they are (29). Slip is
        the motion of the first body on the second since the points met, which is U less the
        displacement of the surfaces.

        Parameters
        ----------
        at : float, str or int
            The instant, as in `contact`.
        x, y : array_like, shapes (nx,) and (ny,)
            Positions in m of a grid around the centre of the contact, with x along V_x; by default
            101 by 101 points over 1.5 contact radii.
        points : array_like, shape (n, 2)
            Points (x, y) in m, instead of a grid.

        Returns
        -------
        xarray.Dataset
            Along `(y, x)` or `point`: pressure, traction_x, zone (0 outside, 1 stick, 2 slip),
            displacement_x, displacement_y, displacement_z, slip_x, slip_y, and in impacts
            slip_velocity_x and slip_velocity_y. Numbers are contact_radius, stick_radius,
            normal_force, tangential_force, penetration, displacement, friction, and in impacts
            time. With losses there are no displacements, and of viscous bodies pressure and
            traction are infinite at the edge while the load grows.

        Raises
        ------
        InputError
            If the bodies do not touch then, or positions have a wrong shape or are not finite.

        Examples
        --------
        >>> patch = hit.fields(0.6 * hit.duration)
        >>> sorted({int(zone) for zone in patch.zone.values.flat})  # outside, stick, slip
        [0, 1, 2]
        """
        return surface_fields(self.contact(at), x, y, points)

    @known_keywords
    def stress(
        self,
        at: Value | None = None,
        x: ArrayLike | None = None,
        z: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
        body: str = "second",
    ) -> xr.Dataset:
        """Return the stress below the surface of one body, and the places where it is largest.

            sigma = integral of s Im[N + mu g(s) T] ds

        The pressure (1) and traction (6) are divided into slices of the memory, each a line of
        Boussinesq's and Cerruti's point forces N and T at imaginary depth (Johnson 1985, section
        3.2; for g = 1 Hamilton 1983). Tension is positive.

        Parameters
        ----------
        at : float, str or int
            The instant, as in `contact`.
        x, z : array_like, shapes (nx,) and (nz,)
            Positions in m of a grid in the plane y = 0, with x along V_x and z the depth; by
            default 101 by 61 points over 2 contact radii.
        points : array_like, shape (n, 3)
            Points (x, y, z) in m, instead of a grid.
        body : str
            Which body, "first" or "second".

        Returns
        -------
        xarray.Dataset
            Along `(z, x)` or `point`: sigma_xx, sigma_yy, sigma_zz, sigma_xy, sigma_xz, sigma_yz,
            principal_1 to principal_3, von_mises, max_shear in Pa. Numbers are max_von_mises of the
            whole body and max_tension on its surface, with their places max_von_mises_x and so on.
            While viscous bodies are loaded, the stress is infinite at the edge. It is then given
            from a fiftieth of the contact radius downwards, without max_tension.

        Raises
        ------
        InputError
            If the bodies do not touch then, positions have a wrong shape, are not finite or lie
            outside the body, the body is rigid, or the spheres yield.

        Examples
        --------
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.0)
        >>> hit = carom.impact(pair, speed=2.0, angle=0.0)
        >>> below = hit.stress(0.5 * hit.duration, points=[[0.0, 0.0, 0.48 * hit.max_radius]])
        >>> round(float(below.max_shear[0]) / hit.max_pressure, 2)
        0.31
        """
        self._refuse_stress()
        return stress_dataset(self.contact(at), x, z, points, body)

    @known_keywords
    def radial(self, at: Value | None = None, n: int = 401) -> xr.Dataset:
        """Return the pressure, the traction and the memory, g and q, along a radius.

        Parameters
        ----------
        at : float, str or int
            The instant, as in `contact`.
        n : int
            Number of distances from the centre, from 2 to 100,000.

        Returns
        -------
        xarray.Dataset
            Along `distance` in m, n values: pressure, friction_limit and traction_x in Pa,
            memory_g, memory_q and memory_limit in m, and zone.

        Raises
        ------
        InputError
            If the bodies do not touch then, or n is out of range.

        Examples
        --------
        >>> along = hit.radial(0.5 * hit.duration, n=11)
        >>> bool((abs(along.traction_x) <= 1.000001 * along.friction_limit).all())
        True
        """
        return radial_fields(self.contact(at), counted("n", n, 2, MOST_RADII))

    @abstractmethod
    def _contact(self, at: Any) -> Contact:
        """Return the contact at an instant as users give it."""

    def _refuse_stress(self) -> None:  # noqa: B027
        """Raise InputError where the stress below the surface is not known."""
