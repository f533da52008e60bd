"""What is fitted: the exact rebound, and the rival laws of rigid spheres."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from carom.bodies.kinematics import Rebound, Tangential
from carom.bodies.pairs import Pair
from carom.fitting.interpolation import LEAST_CHI, LEAST_E, MOST_CHI, psi_out
from carom.quantities.arrays import Array

Values = Mapping[str, Array]  # of parameters by name, each of shape (batch, 1)
ROUNDING = 1e-9


class Parameter(NamedTuple):
    """A parameter with its range; what is varied is its logarithm, or it in units of a scale."""

    name: str
    low: float
    high: float
    scale: float | None = 1.0  # None: logarithmic

    def coordinate(self, value: float) -> float:
        """Return what is varied in place of a value."""
        return float(np.log(value)) if self.scale is None else value / self.scale

    def value(self, coordinate: Array) -> Array:
        """Return the values of coordinates."""
        return np.exp(coordinate) if self.scale is None else coordinate * self.scale


FRICTION = Parameter("friction", 1e-3, 10.0, None)
KAPPA = Parameter("kappa", 0.1, 4.0, None)
RESTITUTION = Parameter("restitution", LEAST_E, 1.0)
BETA = Parameter("tangential_restitution", -1.0, 1.0)


class Law(Protocol):
    """A law of rebound whose parameters can be fitted."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be varied, besides an offset of the spin."""

    def contact_velocity_out(
        self, pair: Pair, normal_speed: Array, contact_velocity: Array, values: Values
    ) -> Array:
        """Return V_x' of shape (batch, rows)."""


@dataclass(frozen=True)
class Exact:
    """V_x' = mu V_n psi_2/kappa, psi_1 = kappa V_x/(mu V_n), chi = (kappa/2)(m_n/m_t)."""

    name: str = "exact"
    parameters: tuple[Parameter, ...] = (FRICTION, KAPPA, RESTITUTION)

    def contact_velocity_out(
        self, pair: Pair, normal_speed: Array, contact_velocity: Array, values: Values
    ) -> Array:
        """Return V_x' of shape (batch, rows)."""
        unit = values["friction"] * normal_speed / values["kappa"]
        chi = half_ratio(pair) * values["kappa"][:, 0]
        return unit * psi_out(contact_velocity / unit, chi, values["restitution"][:, 0])


@dataclass(frozen=True)
class RigidCoulomb:
    """|J_t| = min(m_t |V_x|, mu J_n): a rigid sphere slides, or its contact point comes to rest."""

    name: str = "rigid Coulomb"
    parameters: tuple[Parameter, ...] = (FRICTION, RESTITUTION)

    def contact_velocity_out(
        self, pair: Pair, normal_speed: Array, contact_velocity: Array, values: Values
    ) -> Array:
        """Return V_x' of shape (batch, rows)."""
        return _limited(pair, normal_speed, contact_velocity, values, 1.0)


@dataclass(frozen=True)
class Walton:
    """|J_t| = min(m_t (1 + beta_0) |V_x|, mu J_n) (Walton 1993; Foerster et al. 1994)."""

    name: str = "Walton"
    parameters: tuple[Parameter, ...] = (FRICTION, RESTITUTION, BETA)

    def contact_velocity_out(
        self, pair: Pair, normal_speed: Array, contact_velocity: Array, values: Values
    ) -> Array:
        """Return V_x' of shape (batch, rows)."""
        reversed_part = 1.0 + values["tangential_restitution"]
        return _limited(pair, normal_speed, contact_velocity, values, reversed_part)


EXACT = Exact()
RIVALS: tuple[Law, ...] = (RigidCoulomb(), Walton())


def ranged(parameter: Parameter, pair: Pair) -> Parameter:
    """Return a parameter with the range it has for a pair: chi of a kappa must be in the table."""
    if parameter.name != "kappa":
        return parameter
    half = half_ratio(pair)
    low, high = max(parameter.low, LEAST_CHI / half), min(parameter.high, MOST_CHI / half)
    return parameter._replace(low=low * (1.0 + ROUNDING), high=high * (1.0 - ROUNDING))


def half_ratio(pair: Pair) -> float:
    """Return chi/kappa, (1/2) m_n/m_t."""
    return 0.5 * pair.normal_mass / pair.tangential_mass


def _limited(
    pair: Pair, normal_speed: Array, velocity: Array, values: Values, stuck: Array | float
) -> Array:
    """Return V_x less what the smaller of the impulses of sticking and sliding takes."""
    whole = values["friction"] * (1.0 + values["restitution"]) * normal_speed
    bound = 2.0 * half_ratio(pair) * whole
    return velocity - np.copysign(np.minimum(stuck * np.abs(velocity), bound), velocity)


class Motion(NamedTuple):
    """Motion before the impacts, one a row, in SI units."""

    normal_speed: Array
    tangential_speed: Array
    spin: Array
    spin2: Array


def rebounds(law: Law, pair: Pair, motion: Motion, values: Values) -> Rebound:
    """Return the rebounds from a motion, of shape (batch, rows)."""
    normal, tangential, spin, spin2 = motion
    turning = spin + values["spin_offset"]
    before = Tangential(tangential + 0.0 * turning, turning, spin2)  # type: ignore[arg-type]
    velocity = np.asarray(before.contact_velocity(pair))
    after = law.contact_velocity_out(pair, normal, velocity, values)
    impulse = pair.tangential_mass * (velocity - after)
    return Rebound(pair, normal, before, values["restitution"] + 0.0 * turning, impulse)


def predicted(law: Law, pair: Pair, motion: Motion, values: Values, names: Sequence[str]) -> Array:
    """Return the observables of these names, of shape (batch, rows, names)."""
    rebound = rebounds(law, pair, motion, values)
    return np.stack([getattr(rebound, name) for name in names], axis=-1)
