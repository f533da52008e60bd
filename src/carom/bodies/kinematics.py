"""The approach of two bodies, their motion after two impulses, and the observables of it."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import zip_longest
from math import nan, pi
from typing import Any, NamedTuple

import numpy as np

from carom.bodies.pairs import Pair
from carom.bodies.shapes import Sphere
from carom.quantities.arrays import Array, arctan2, cos, hypot, quotient, sin, where
from carom.quantities.refusals import Faults, refusal, refuse
from carom.quantities.units import APPROACH, Value, finite, positive

READERS: dict[str, Callable[[str, Any], float]] = {
    "speed": positive,
    "angle": lambda _, value: slope(value),
    "normal_speed": positive,
    "tangential_speed": finite,
    "spin": finite,
    "spin2": finite,
}


def approach(
    speed: Value | None,
    angle: Value | None,
    normal_speed: Value | None,
    tangential_speed: Value | None,
    readers: Mapping[str, Callable[[str, Any], Any]] = READERS,
) -> tuple[float, Any]:
    """Return normal and tangential speed from either way of giving them, in m/s."""
    motion = {"speed": speed, "angle": angle}
    motion |= {"normal_speed": normal_speed, "tangential_speed": tangential_speed}
    there = {name: value for name, value in motion.items() if value is not None}
    with Faults() as faults:
        angular = faults.trying(by_angle, motion)
        read = {name: faults.trying(readers[name], name, value) for name, value in there.items()}
    if angular:
        return components(read["speed"], read.get("angle", 0.0))
    return read["normal_speed"], read.get("tangential_speed", 0.0)


def by_angle(motion: Mapping[str, Any]) -> bool:
    """Tell whether speed and angle are given, or both velocities; InputError for both or none."""
    there = {name for name, value in motion.items() if value is not None}
    angular, either = "speed" in there, "give speed and angle, or normal_speed"
    missing = not there & {"speed", "normal_speed"} and f"speed: missing; {either}"
    mixed = there & {"normal_speed", "tangential_speed"} if angular else "angle" in there
    name = "speed" if angular else "angle"
    refuse(missing or (mixed and f"{name}: {either} and tangential_speed"))
    return angular


def components(speed: float, angle: float) -> tuple[float, float]:
    """Return normal and tangential speed, numbers or arrays of them, in m/s."""
    return speed * cos(angle), speed * sin(angle)


def slope(angle: Value) -> float:
    """Return an angle of incidence in rad, or raise InputError if it does not approach."""
    result = finite("angle", angle)
    if abs(result) < pi / 2:
        return result
    bare = not isinstance(angle, str) or not any(c.isalpha() or c == "°" for c in angle)
    hint = f"; a bare angle is in radians, below pi/2; write '{angle} deg'" if bare else ""
    raise refusal("angle", angle, f"must be below 90 deg{APPROACH}{hint}")


class Tangential(NamedTuple):
    """Speed of the first centre relative to the second, and the spins: numbers, or arrays."""

    tangential_speed: float
    spin: float
    spin2: float

    def after(self, pair: Pair, impulse: Any) -> "Tangential":
        """Return the motion after an impulse on the contact point of the first body, against +x."""
        spins = (
            spin - impulse * body.radius / inertia(body) if body else spin + 0.0 * impulse
            for body, spin in zip_longest(pair.moving, self[1:])
        )
        return Tangential(self.tangential_speed - impulse / pair.normal_mass, *spins)

    def contact_velocity(self, pair: Pair) -> float:
        """Return the velocity of the contact point, V_x = v_t + R omega + R_2 omega_2, in m/s."""
        return self.tangential_speed + sum(self.carried(pair))

    def carried(self, pair: Pair) -> list[float]:
        """Return the parts of that velocity that are due to spins, R omega and R_2 omega_2."""
        return [body.radius * spin for body, spin in zip(pair.moving, self[1:], strict=False)]

    def spin_energy(self, pair: Pair) -> float:
        """Return the kinetic energy of the spins, (1/2) sum I omega^2, in J."""
        moving = zip(pair.moving, self[1:], strict=False)
        return sum(0.5 * inertia(body) * spin**2 for body, spin in moving)


class RigidMotion(NamedTuple):
    """Velocity of the first centre relative to the second, spins of both, along x, y, z.

    z points from the second body to the first, spins are right-handed. Arrays (3,), or (n, 3).
    """

    velocity: Array
    spin: Array
    spin2: Array

    @classmethod
    def of(cls, normal_speed: float, along: Tangential) -> "RigidMotion":
        """Return a motion from vectors along the surface, or numbers in a plane."""
        x, y = np.append(along.tangential_speed, 0.0)[:2]
        given = (np.ravel(spin) for spin in along[1:])
        spins = (each if each.size > 1 else np.array([0.0, -each[0], 0.0]) for each in given)
        return cls(np.array([x, y, -normal_speed]), *spins)

    def along(self, *, planar: bool) -> Tangential:
        """Return what is along the surface, and the spins: vectors, or numbers in a plane."""
        parts: tuple[Any, ...] = self.velocity[..., :2], self.spin, self.spin2
        if planar:
            parts = self.velocity[..., 0], -self.spin[..., 1], -self.spin2[..., 1]
            parts = tuple(each if each.ndim else each.item() for each in parts)
        return Tangential(*parts)

    def at_contact(self, pair: Pair) -> Array:
        """Return the velocity of the contact points along x, y and the normal, approaching."""
        first, second = pair.bodies
        turned = np.cross(self.spin, first.place) - np.cross(self.spin2, second.place)
        return (self.velocity + turned) * [1.0, 1.0, -1.0]

    def after(self, pair: Pair, impulse: Array) -> "RigidMotion":
        """Return the motion after an impulse on the first body, against x, y and the normal."""
        first, second = pair.bodies
        pushed = impulse * [-1.0, -1.0, 1.0]
        return RigidMotion(
            self.velocity + pushed * sum(1.0 / body.mass for body in pair.moving),
            self.spin + np.cross(first.place, pushed) @ first.turning,
            self.spin2 - np.cross(second.place, pushed) @ second.turning,
        )

    def energies(self, pair: Pair) -> tuple[Array, Array, Array]:
        """Return kinetic energies: along the normal, across it, of the spins, in J.

        Those of the centres are in the frame of the centre of mass.
        """
        half = 0.5 / sum(1.0 / body.mass for body in pair.moving)
        spins = zip((self.spin, self.spin2), pair.bodies, strict=True)
        turning = np.sum([np.sum(spin * (spin @ body.tensor), axis=-1) for spin, body in spins], 0)
        squares = self.velocity**2
        return half * squares[..., 2], half * (squares[..., 0] + squares[..., 1]), 0.5 * turning


def inertia(body: Sphere) -> float:
    """Return the moment of inertia about the centre, M K^2, in kg m^2."""
    return body.mass * body.gyration_ratio * body.radius**2


def normal_inertia(pair: Pair) -> float:
    """Return the effective inertia of spin about the normal, 1/sum(1/I_i), in kg m^2."""
    return 1.0 / sum(1.0 / inertia(body) for body in pair.moving)


@dataclass(frozen=True, eq=False)
class Kinematics(ABC):
    """Two rigid bodies before and after two impulses, in SI units, numbers or arrays of one shape.

    Tangential speeds are those of the first body relative to the second. Positive spin adds to the
    tangential speed of the contact point: V_x = v_t + R omega + R_2 omega_2.
    """

    pair: Pair
    normal_speed: float
    tangential_speed: float
    spin: float
    spin2: float

    @property
    def before(self) -> Tangential:
        """Tangential speed of the centre and spins before."""
        return Tangential(self.tangential_speed, self.spin, self.spin2)

    @property
    @abstractmethod
    def tangential_impulse(self) -> float:
        """Impulse of the tangential force on the first body, against +x, in N s."""

    @property
    @abstractmethod
    def normal_restitution(self) -> float:
        """Normal velocity after over before, which is 1 for elastic bodies."""

    @property
    @abstractmethod
    def contact_velocity_out(self) -> float:
        """Tangential velocity of the contact point after the impact, in m/s."""

    @cached_property
    def contact_velocity(self) -> float:
        """Tangential velocity of the contact point before the impact, V_x in m/s."""
        return self.before.contact_velocity(self.pair)

    @cached_property
    def psi_in(self) -> float:
        """Dimensionless velocity psi_1 = kappa V_x/(mu V_1); infinite without friction."""
        return self.pair.psi(self.contact_velocity, self.normal_speed)

    @cached_property
    def _after(self) -> Tangential:
        """Tangential speed of the centre and spins after."""
        return self.before.after(self.pair, self.tangential_impulse)

    @property
    def normal_speed_out(self) -> float:
        """Normal speed of the centres after the impact, in m/s."""
        return self.normal_restitution * self.normal_speed

    @property
    def tangential_speed_out(self) -> float:
        """Tangential speed of the first centre relative to the second after the impact, in m/s."""
        return self._after.tangential_speed

    @property
    def spin_out(self) -> float:
        """Spin of the first body after the impact, in rad/s."""
        return self._after.spin

    @property
    def spin2_out(self) -> float:
        """Spin of the second body after the impact, in rad/s; zero for a half-space or cup."""
        return self._after.spin2

    @property
    def rebound_speed(self) -> float:
        """Relative speed of the centres after the impact, in m/s."""
        return hypot(self.normal_speed_out, self.tangential_speed_out)

    @property
    def rebound_angle(self) -> float:
        """Angle of rebound of the centre from the normal, in rad; negative if it turns back."""
        return arctan2(self.tangential_speed_out, self.normal_speed_out)

    @property
    def tangential_restitution(self) -> float:
        """Tangential velocity of the centres after over before, v_t'/v_t; NaN if v_t is zero."""
        return _ratio(self.tangential_speed_out, self.tangential_speed)

    @property
    def contact_restitution(self) -> float:
        """Velocity of the contact point after over before, V_x'/V_x; NaN if V_x is zero."""
        return _ratio(self.contact_velocity_out, self.contact_velocity)


@dataclass(frozen=True)
class Rebound(Kinematics):
    """An impact of which the motion before, e and the tangential impulse against +x are known."""

    normal_speed: Any
    tangential_speed: Any
    spin: Any
    spin2: Any
    restitution: Any
    impulse: Any

    @property
    def tangential_impulse(self) -> Any:
        """Impulse of the tangential force on the first body, against +x, in N s."""
        return self.impulse

    @property
    def normal_restitution(self) -> Any:
        """Coefficient of restitution e, the normal velocity after over before."""
        return self.restitution

    @property
    def contact_velocity_out(self) -> Any:
        """Tangential velocity of the contact point after, V_x' in m/s."""
        return self.contact_velocity - self.impulse / self.pair.tangential_mass

    @property
    def speed(self) -> Any:
        """Speed of approach of the centres, in m/s."""
        return hypot(self.normal_speed, self.tangential_speed)

    @property
    def angle(self) -> Any:
        """Angle of incidence of the centre from the normal, tan = v_t/V_1."""
        return arctan2(self.tangential_speed, self.normal_speed)

    @property
    def contact_angle(self) -> Any:
        """Angle of incidence of the contact point from the normal, tan = V_x/V_1."""
        return arctan2(self.contact_velocity, self.normal_speed)

    @property
    def contact_rebound_angle(self) -> Any:
        """Angle of rebound of the contact point from the normal, tan = V_x'/(e V_1)."""
        return arctan2(self.contact_velocity_out, self.normal_speed_out)

    @property
    def contact_beta(self) -> Any:
        """-V_x'/V_x of the contact point, beta of Foerster et al. (1994), Walton's beta."""
        return -self.contact_restitution

    @property
    def normal_impulse(self) -> Any:
        """J_n = m_n (1 + e) V_1, in N s."""
        return self.pair.normal_mass * (1.0 + self.restitution) * self.normal_speed

    @property
    def impulse_ratio(self) -> Any:
        """J_t/J_n: the coefficient of friction where the impact slides throughout."""
        return self.impulse / self.normal_impulse

    @property
    def psi_out(self) -> Any:
        """kappa V_x'/(mu V_1)."""
        return self.pair.psi(self.contact_velocity_out, self.normal_speed)


def _ratio(after: float, before: float) -> float:
    return where(before == 0.0, nan, quotient(after, before))
