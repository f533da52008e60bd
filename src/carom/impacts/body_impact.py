"""The result of an impact of bodies of any smooth shape, struck anywhere."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import inf, nan
from typing import Any

import numpy as np

from carom.bodies.contact_shape import axes_of
from carom.bodies.rigid_motion import RigidMotion
from carom.dimensionless.lossy.law import Loss
from carom.dimensionless.lossy.springs.off_centre import OffCentreSolution
from carom.dimensionless.states import History, SlipAngle
from carom.impacts.exact import Impact
from carom.impacts.outcome import PAIR, RESULTS
from carom.impacts.peaks import judge_pressure
from carom.impacts.validity import OF_SHAPES, judge
from carom.io.labels import Finding, Validity
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal, refuse

AT_EDGE = "viscous bodies bear most at the edge, which is not known off the centre; see history"
FLAT = "what happens inside is known of round contacts in a plane; history has the forces"
ROUND = 1e-9  # by which both axes of a contact may differ that is round
PARTS = {2: ("", "_across"), 3: ("_x", "_y", "_z")}  # how names of components end
OF_PLANES = ("rebound_angle", "tangential_restitution", "contact_restitution")  # not in space
OF_CONTACT = ("approach_speed", "separation_speed", "semi_axis_x", "semi_axis_y")


@dataclass(frozen=True, eq=False)
class BodyImpact(Impact):
    """The result of `impact` for a `Body`: the rebound, every phase, and the course of it.

    SI units. psi_in, psi_out and normal_restitution are those of the contact points; e may exceed
    1, as friction feeds the normal motion from the tangential one. Speeds and spins are those of
    the centres. In space velocities, psi and spins are arrays along x and y, and z; psi is along
    the axes of the contact. The theory is that of Maw, Barber & Fawcett (1976), with the inverse
    mass at the contact (Stronge 2000, section 3.1).

    Examples
    --------
    >>> size = {"mass": "10 g", "inertia": 8.3e-6, "curvature_radius": "3 mm"}
    >>> rod = carom.Body(**size, contact=(0.03, -0.04), material="steel")
    >>> hit = carom.impact(carom.Pair(rod, carom.HalfSpace("steel"), 0.5), normal_speed=1.0)
    >>> round(hit.normal_restitution, 3), round(hit.spin_out, 2)
    (0.84, 23.62)
    """

    motion: RigidMotion = field(kw_only=True, repr=False)
    axes: Array = field(kw_only=True, repr=False)  # of the contact along x and y, as rows

    @property
    def psi_in(self) -> Any:
        """Dimensionless velocity kappa V/(mu V_n) of the contact points before."""
        return self._psi(self.motion)

    @property
    def psi_out(self) -> Any:
        """The same after, of V_n before."""
        return self._psi(self._after)

    @property
    def contact_velocity(self) -> Any:
        """Velocity of the contact points along the surface before, in m/s."""
        return self._plain(self.motion.at_contact(self.pair)[:2])

    @property
    def contact_velocity_out(self) -> Any:
        """Velocity of the contact points along the surface after, in m/s."""
        return self._plain(self._after.at_contact(self.pair)[:2])

    @property
    def approach_speed(self) -> float:
        """Speed at which the contact points approach, in m/s."""
        return float(self.motion.at_contact(self.pair)[2])

    @property
    def separation_speed(self) -> float:
        """Speed at which the contact points separate, in m/s."""
        return -float(self._after.at_contact(self.pair)[2])

    @property
    def normal_speed_out(self) -> float:
        """Normal speed of the centres after, in m/s; negative if they still approach."""
        return float(self._after.velocity[2])

    @property
    def tangential_speed_out(self) -> Any:
        """Tangential velocity of the first centre relative to the second after, in m/s."""
        return self._plain(self._after.velocity[:2])

    @property
    def spin_out(self) -> Any:
        """Spin of the first body after, in rad/s."""
        return self._spin(self._after.spin)

    @property
    def spin2_out(self) -> Any:
        """Spin of the second body after, in rad/s."""
        return self._spin(self._after.spin2)

    @property
    def rebound_speed(self) -> float:
        """Relative speed of the centres after the impact, in m/s."""
        return float(np.linalg.norm(self._after.velocity))

    @property
    def tangential_impulse(self) -> Any:
        """Impulse of the tangential force on the first body, against x and y, in N s."""
        return self._plain(self._impulse(*self._end)[:2])

    @property
    def semi_axis_x(self) -> float:
        """Largest semi-axis of the contact near x, in m."""
        return self._semi_axis(self.pair._ellipse.along)

    @property
    def semi_axis_y(self) -> float:
        """Largest semi-axis of the contact near y, in m."""
        return self._semi_axis(self.pair._ellipse.across)

    @property
    def dissipated_energy(self) -> float:
        """Energy lost to friction, in J."""
        if self.pair.friction == 0.0:
            return 0.0
        left = sum(self._after.energies(self.pair)) + self.lost_energy + self.shear_lost_energy
        return float(sum(self.motion.energies(self.pair)) - left)

    @property
    def lost_energy(self) -> float:
        """Energy lost in the normal motion, in J."""
        return float(self._energies(self._at_end)["normal_loss"][0])

    @property
    def shear_lost_energy(self) -> float:
        """Energy lost to viscosity in shear, in J."""
        return self.solution.shear_lost * self._shear_unit

    @property
    def validity(self) -> Validity:
        """Whether the assumptions of the theory hold, as numbers with limits and verdicts."""
        return judge(self, OF_SHAPES)

    @property
    def slip_angles(self) -> tuple[SlipAngle, ...]:
        """Angle between slip and x, which is not known and NaN."""
        return (SlipAngle(nan, nan),) * len(self.phases)

    @property
    def _strength(self) -> tuple[Finding, ...]:
        return (judge_pressure(self.pair, self.scales.pressure, yields=False),)

    @property
    def _size_ratio(self) -> float:
        (along, across), _ = axes_of(self.pair.curvatures)
        return max(along * self.semi_axis_x, across * self.semi_axis_y)

    @cached_property
    def _after(self) -> Any:
        return self.motion.after(self.pair, self._impulse(*self._end))

    def _motion(self, h: History) -> RigidMotion:
        """Return the motion at times."""
        across = getattr(h, "psi_across", np.zeros(len(h)))
        return self.motion.after(self.pair, self._impulse((h.psi, across), h.centre_speed))

    @property
    def _end(self) -> tuple[tuple[float, float], float]:
        """Return psi_2 along both axes, and the approach at the end."""
        across = getattr(self.solution, "psi_across_out", 0.0)
        return (self.solution.psi_out, across), -self.solution.restitution

    @property
    def _units(self) -> Array:
        """Velocities along both axes of the contact over psi, and that of approach, in m/s."""
        speed = self.scales.speed
        return np.array([*(self.pair.friction * speed / k for k in self.pair.kappas), speed])

    @property
    def _shear_unit(self) -> float:
        """Unit of energies of the tangential motion, m_t (mu V_n/kappa)^2, in J."""
        whole = with_normal(self.axes) @ self.pair.inverse_mass @ with_normal(self.axes).T
        return float(self._units[0] ** 2 / whole[0, 0])

    def _impulse(self, psi: tuple[Any, Any], approach: Any) -> Array:
        """Return the impulse on the first body until now, against x, y and the normal, in N s."""
        if self.pair.friction == 0.0:
            normal = (1.0 - np.asarray(approach)) * self.scales.speed * self.pair.normal_mass
            return np.asarray(normal[..., np.newaxis] * [0.0, 0.0, 1.0])
        now = np.stack(np.broadcast_arrays(*psi, approach), axis=-1) * self._units
        lost = self.motion.at_contact(self.pair) - now @ with_normal(self.axes)
        return np.asarray(lost @ np.linalg.inv(self.pair.inverse_mass))

    @property
    def _at_end(self) -> History:
        return self.solution.at([self.solution.duration])

    def _energies(self, h: History) -> dict[str, Array]:
        """Return all energies at times: what is missing went into friction."""
        now = self._motion(h)
        normal, tangential, spins = now.energies(self.pair)
        rubs = 0.0 if self.pair.friction == 0.0 else self._shear_unit
        loses = self.losses is not None or self.pair.thickness is not None
        lost = loses * h.normal_lost * self.scales.energy
        energies: dict[str, Any] = {
            "normal_kinetic_energy": normal,
            "tangential_kinetic_energy": tangential,
            "spin_kinetic_energy": spins,
            "normal_elastic_energy": h.normal_stored * self.scales.energy,
            "normal_loss": lost,
            "tangential_elastic_energy": h.stored * rubs,
            "shear_loss": h.shear_lost * rubs,
        }
        whole = sum(self.motion.energies(self.pair))
        friction = (whole - sum(energies.values())) if rubs else 0.0 * normal
        return energies | {"frictional_work": friction}

    def _columns(self, n: int) -> dict[str, Any]:
        h = self.solution.history(n)
        now, none = self._motion(h), np.zeros(n)
        across = (getattr(h, f"{name}_across", none) for name in ("force", "displacement"))
        force = self._along((h.force, next(across)), self.scales.tangential_force)
        lengths = [self.scales.length * self.pair.friction / kappa for kappa in self.pair.kappas]
        moved = self._along((h.displacement, next(across)), *lengths)
        velocity = now.at_contact(self.pair)
        vectors = {
            "displacement": moved,
            "contact_velocity": velocity[:, :2],
            "tangential_speed": now.velocity[:, :2],
            "tangential_force": force,
        }
        vectors |= {"spin": now.spin, "spin2": now.spin2}
        columns: dict[str, Array] = {}
        for name, values in vectors.items():
            columns |= parts(name, self._spin(values) if "spin" in name else self._plain(values))
        return {
            "time": h.time * self.scales.time,
            "penetration": h.penetration * self.scales.length,
            "normal_velocity": -now.velocity[:, 2],
            "approach_velocity": velocity[:, 2],
            "normal_force": h.normal_force * self.scales.force,
            "contact_radius": h.contact_radius * self.scales.radius,
            "stick_radius": h.stick_radius * self.scales.radius,
            **columns,
            **self._energies(h),
        }

    def scalars(self) -> dict[str, float]:
        """Return the numbers of the result by name; of vectors each component."""
        names = [
            n
            for n in ("normal_speed_out", *RESULTS, *OF_CONTACT)
            if self.pair.is_planar or n not in OF_PLANES
        ]
        numbers: dict[str, Array] = {}
        for name in names:
            numbers |= parts(name, getattr(self, name))
        values = {name: float(value) for name, value in numbers.items()}
        return values | {name: getattr(self.pair, name) for name in PAIR}

    def inputs(self) -> dict[str, Any]:
        """Return what the impact was made from, as plain numbers and words."""
        return super().inputs() | {
            "tangential_speed": _listed(self.tangential_speed),
            "spin": _listed(self.spin),
            "spin2": _listed(self.spin2),
        }

    def _phase_columns(self) -> dict[str, list[float]]:
        return {}

    def _refuse_shape(self) -> None:
        shape = self.pair._ellipse
        flat = self.pair.is_planar and abs(shape.along / shape.across - 1.0) <= ROUND
        refuse(not flat and refusal("pair", str(self.pair), FLAT))
        if isinstance(self.solution, OffCentreSolution):
            viscous = self.solution._losses.loss == Loss.VISCOUS
            refuse(viscous and refusal("losses", self.losses, AT_EDGE))

    def _semi_axis(self, share: float) -> float:
        longer = max(self.pair._ellipse.along, self.pair._ellipse.across)
        return self.max_radius * share / longer

    def _along(self, pair: tuple[Array, Array], *units: float) -> Array:
        """Return components along the axes of the contact as those along x and y, with units."""
        return np.asarray((np.stack(pair, axis=-1) * units) @ self.axes)

    def _psi(self, motion: RigidMotion) -> Any:
        along = motion.at_contact(self.pair)[:2] @ self.axes.T
        if self.pair.friction == 0.0:
            return self._plain(np.where(along == 0.0, 0.0, np.copysign(inf, along)))
        return self._plain(along / self._units[:2])

    def _plain(self, vectors: Array) -> Any:
        """Return vectors along x and y, in a plane what is along x."""
        return _bare(vectors[..., 0]) if self.pair.is_planar else vectors

    def _spin(self, vectors: Array) -> Any:
        return _bare(-vectors[..., 1]) if self.pair.is_planar else vectors


def _bare(values: Any) -> Any:
    return values if np.ndim(values) else float(values)


def parts(name: str, value: Any) -> dict[str, Array]:
    """Return the components of a vector, or of a row of them, by name."""
    size = np.shape(value)[-1:]
    if size not in ((2,), (3,)):
        return {name: value}
    return {f"{name}{end}": value[..., i] for i, end in enumerate(PARTS[size[0]])}


def _listed(value: Any) -> Any:
    return np.asarray(value).tolist()


def with_normal(axes: Array) -> Array:
    """Return axes of the contact, as rows, with the normal as the third."""
    whole = np.eye(3)
    whole[:2, :2] = axes
    return whole
