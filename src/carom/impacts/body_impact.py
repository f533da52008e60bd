"""Impacts of bodies of any smooth shape, struck anywhere: off their centre, in an ellipse."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf, isfinite
from typing import Any, ClassVar

import numpy as np

from carom.bodies.checks import checked_scales
from carom.bodies.kinematics import RigidMotion, Tangential
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair, Scales
from carom.bodies.smooth_body import axes_of
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.lossy.springs.motion import Inertia
from carom.dimensionless.lossy.springs.off_centre import OffCentreSolution, solve_off_centre
from carom.dimensionless.solution import Solution
from carom.dimensionless.states import History
from carom.impacts.exact import Impact, loss_numbers, solution_of
from carom.impacts.findings import Assumption
from carom.impacts.outcome import PAIR, RESULTS
from carom.impacts.validity import OF_SHAPES
from carom.quantities.arrays import Array
from carom.quantities.prefixes import text
from carom.quantities.refusals import refusal, refuse

ROUND_ONLY = "how an ellipse yields is not known; take KelvinVoigt, or leave losses out"
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

    _assumptions: ClassVar[tuple[Assumption, ...]] = OF_SHAPES

    @cached_property
    def motion(self) -> RigidMotion:
        """Velocity and spins before, along x, y and z."""
        return RigidMotion.of(self.normal_speed, self.before)

    @cached_property
    def axes(self) -> Array:
        """Axes of the contact along x and y, as rows."""
        return axes_of(self.pair.curvatures)[1]

    @property
    def psi_in(self) -> Any:
        """Dimensionless velocity kappa V/(mu V_n) of the contact points before."""
        return self._psi(self.motion)

    @property
    def psi_out(self) -> Any:
        """The same after, of V_n before."""
        return self._psi(self._left)

    @property
    def contact_velocity(self) -> Any:
        """Velocity of the contact points along the surface before, in m/s."""
        return self._plain(self.motion.at_contact(self.pair)[:2])

    @property
    def contact_velocity_out(self) -> Any:
        """Velocity of the contact points along the surface after, in m/s."""
        return self._plain(self._left.at_contact(self.pair)[:2])

    @property
    def approach_speed(self) -> float:
        """Speed at which the contact points approach, in m/s."""
        return float(self.motion.at_contact(self.pair)[2])

    @property
    def separation_speed(self) -> float:
        """Speed at which the contact points separate, in m/s."""
        return -float(self._left.at_contact(self.pair)[2])

    @property
    def normal_speed_out(self) -> float:
        """Normal speed of the centres after, in m/s; negative if they still approach."""
        return float(self._left.velocity[2])

    @property
    def rebound_speed(self) -> float:
        """Relative speed of the centres after the impact, in m/s."""
        return float(np.linalg.norm(self._left.velocity))

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
        left = sum(self._left.energies(self.pair)) + self.lost_energy + self.shear_lost_energy
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
    def _size_ratio(self) -> float:
        (along, across), _ = axes_of(self.pair.curvatures)
        return max(along * self.semi_axis_x, across * self.semi_axis_y)

    @cached_property
    def _left(self) -> RigidMotion:
        return self.motion.after(self.pair, self._impulse(*self._end))

    @cached_property
    def _after(self) -> Tangential:
        return self._left.along(planar=self.pair.is_planar)

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
        return float(self._units[0] ** 2 / _inverse_mass(self.pair)[0, 0])

    def _impulse(self, psi: tuple[Any, Any], approach: Any) -> Array:
        """Return the impulse on the first body until now, against x, y and the normal, in N s."""
        if self.pair.friction == 0.0:
            normal = (1.0 - np.asarray(approach)) * self.scales.speed * self.pair.normal_mass
            return np.asarray(normal[..., np.newaxis] * [0.0, 0.0, 1.0])
        now = np.stack(np.broadcast_arrays(*psi, approach), axis=-1) * self._units
        lost = self.motion.at_contact(self.pair) - now @ _with_normal(self.axes)
        return np.asarray(lost @ np.linalg.inv(self.pair.inverse_mass))

    @property
    def _at_end(self) -> History:
        return self.solution.at([self.solution.duration])

    def _energies(self, h: History) -> dict[str, Array]:
        """Return all energies at times: what is missing went into friction."""
        now = self._motion(h)
        normal, tangential, spins = now.energies(self.pair)
        rubs = 0.0 if self.pair.friction == 0.0 else self._shear_unit
        loses = self.losses is not None or self.pair.gives_way(self.scales)
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

    def _columns(self, h: Any) -> dict[str, Any]:
        now, none = self._motion(h), np.zeros(len(h))
        across = (getattr(h, f"{name}_across", none) for name in ("force", "displacement"))
        force = self._along((h.force, next(across)), self.scales.tangential_force)
        lengths = [self.scales.length * self.pair.friction / kappa for kappa in self.pair.kappas]
        moved = self._along((h.displacement, next(across)), *lengths)
        along = now.along(planar=self.pair.is_planar)
        velocity = now.at_contact(self.pair)
        columns = {
            "displacement": self._plain(moved),
            "contact_velocity": self._plain(velocity[:, :2]),
            "tangential_speed": along.tangential_speed,
            "tangential_force": self._plain(force),
            "spin": along.spin,
            "spin2": along.spin2,
        }
        return {
            "time": h.time * self.scales.time,
            "penetration": h.penetration * self.scales.length,
            "normal_velocity": -now.velocity[:, 2],
            "approach_velocity": velocity[:, 2],
            "normal_force": h.normal_force * self.scales.force,
            "contact_radius": h.contact_radius * self.scales.radius,
            "stick_radius": h.stick_radius * self.scales.radius,
            **self._components(columns),
            **self._energies(h),
        }

    def scalars(self) -> dict[str, float]:
        """Return the numbers of the result by name; of vectors each component."""
        names = ("normal_speed_out", *RESULTS, *OF_CONTACT)
        there = (n for n in names if self.pair.is_planar or n not in OF_PLANES)
        numbers = self._components({name: getattr(self, name) for name in there})
        values = {name: float(value) for name, value in numbers.items()}
        return values | {name: getattr(self.pair, name) for name in PAIR}

    def inputs(self) -> dict[str, Any]:
        """Return what the impact was made from, as plain numbers and words."""
        moves = self.before._asdict().items()
        return super().inputs() | {name: np.asarray(value).tolist() for name, value in moves}

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
        if not self.pair.is_planar:
            return vectors
        along = vectors[..., 0]
        return along if along.ndim else along.item()

    def _components(self, values: dict[str, Any]) -> dict[str, Any]:
        """Return values by name, of vectors in space each component."""
        if self.pair.is_planar:
            return values
        parts: dict[str, Any] = {}
        for name, value in values.items():
            ends = PARTS[np.shape(value)[-1]] if np.ndim(value) else ("",)
            rows = np.moveaxis(np.atleast_1d(value), -1, 0)
            parts |= {f"{name}{end}": row for end, row in zip(ends, rows, strict=True)}
        return parts


def solve_bodies(
    pair: Pair, normal_speed: float, along: Tangential, losses: LossLaw | None
) -> BodyImpact:
    """Return an impact of bodies of any shape; see `carom.impact`."""
    motion, axes = RigidMotion.of(normal_speed, along), axes_of(pair.curvatures)[1]
    *sliding, approach = motion.at_contact(pair)
    leaves = f"the contact points part at {text(-approach, 'm/s')}; turn the velocity or the spin"
    refuse(not approach > 0.0 and refusal("normal_speed", normal_speed, leaves))
    scales = checked_scales(pair, float(approach), *map(float, sliding))
    solution: Any = _solution(pair, scales, axes @ sliding, losses)
    moves = motion.along(planar=pair.is_planar)
    return BodyImpact(pair, normal_speed, *moves, solution, losses, scales=scales)


def _solution(
    pair: Pair, scales: Scales, sliding: Array, losses: LossLaw | None
) -> Solution | LossySolution | OffCentreSolution:
    """Return the solution: the exact one where bodies are struck through their centres."""
    inertia = inertia_of(pair)
    psi, across = (
        pair.kappas[i] / pair.kappa * pair.psi(float(sliding[i]), scales.speed) for i in range(2)
    )
    elliptic = abs(pair._ellipse.along / pair._ellipse.across - 1.0) > ROUND
    loses = loss_numbers(pair, scales, losses)
    yields = loses.loss in (Loss.PLASTIC, Loss.METAL) and elliptic
    refuse(yields and refusal("losses", losses, ROUND_ONLY))
    if pair.friction == 0.0 or (pair.is_planar and pair.is_central):
        return solution_of(pair, scales, psi if isfinite(psi) else 0.0, losses)
    solution = solve_off_centre(psi, across, inertia, loses)
    if solution.status is not Status.SOLVED:
        numbers_of = f"psi_1 = {psi:.3g}, chi = {inertia.chi:.3g}, eps = {inertia.eps:.3g}"
        why = f"the impact at {numbers_of} is not resolved by springs, as jams at grazing angles"
        raise refusal(
            "losses" if losses else "contact", losses or getattr(pair.first, "contact", None), why
        )
    return solution


def inertia_of(pair: Pair) -> Inertia:
    """Return the inverse mass at the contact in the units of an impact with friction."""
    b = _inverse_mass(pair)
    b = b / b[2, 2]
    mu, (along, across) = pair.friction, pair.kappas
    planar = pair.is_planar
    return Inertia(
        chi=float(0.5 * along * b[0, 0]),
        eps=float(mu * b[0, 2]),
        zeta=float(along * b[0, 2] / mu) if mu else 0.0,
        across=0.0 if planar else float(0.5 * across * b[1, 1]),
        mixed=0.0 if planar else float(0.5 * along * b[0, 1]),
        eps_across=0.0 if planar else float(mu * b[1, 2]),
        zeta_across=0.0 if planar or not mu else float(across * b[1, 2] / mu),
        ratio=across / along,
    )


def _inverse_mass(pair: Pair) -> Array:
    """Return the inverse mass along the axes of the contact and the normal, in 1/kg."""
    whole = _with_normal(axes_of(pair.curvatures)[1])
    return np.asarray(whole @ pair.inverse_mass @ whole.T)


def _with_normal(axes: Array) -> Array:
    """Return axes of the contact, as rows, with the normal as the third."""
    whole = np.eye(3)
    whole[:2, :2] = axes
    return whole
