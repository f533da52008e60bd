"""The laws that are fitted, exact and of rigid spheres: their parameters, and what they predict."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from carom.bodies.kinematics import Rebound, Tangential
from carom.bodies.pairs import Pair
from carom.dimensionless.rebound_tables import STORED_CHI, STORED_E, psi_out, stored
from carom.quantities.arrays import Array

Values = Mapping[str, Array]  # of parameters by name, each of shape (batch, 1)
OutgoingVelocity = Callable[[Pair, Array, Array, Values], Array]
NormalRestitution = Callable[[Pair, Array, Values], Array]
OFFSET = "spin_offset"
ROUNDING = 1e-9


class IncomingMotion(NamedTuple):
    """Motion before the impacts, one a row, in SI units."""

    normal_speed: Array
    tangential_speed: Array
    spin: Array
    spin2: Array


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


def constant(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return the same restitution at every speed."""
    return values["restitution"] + 0.0 * normal_speed


@dataclass(frozen=True)
class FittedLaw:
    """A law of rebound: `contact_velocity_out` is V_x' of V_n, V_x, and what can be varied.

    V_n and V_x have the shape (rows,), V_x' and e have (batch, rows). Besides `parameters` an
    offset of the spin can be varied.
    """

    name: str
    parameters: tuple[Parameter, ...]
    contact_velocity_out: OutgoingVelocity
    restitution: NormalRestitution = constant

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(parameter.name for parameter in self.parameters)

    def predicted(
        self, pair: Pair, motion: IncomingMotion, values: Values, names: Sequence[str]
    ) -> Array:
        """Return the observables of these names, of shape (batch, rows, names)."""
        normal, tangential, spin, spin2 = motion
        turning = spin + values[OFFSET]
        before = Tangential(tangential + 0.0 * turning, turning, spin2)  # type: ignore[arg-type]
        velocity = np.asarray(before.contact_velocity(pair))
        after = self.contact_velocity_out(pair, normal, velocity, values)
        impulse = pair.tangential_mass * (velocity - after)
        restitution = self.restitution(pair, normal, values)
        rebound = Rebound(pair, normal, before, restitution + 0.0 * turning, impulse)
        return np.stack([getattr(rebound, name) for name in names], axis=-1)


def half_ratio(pair: Pair) -> float:
    """Return chi/kappa, (1/2) m_n/m_t."""
    return 0.5 * pair.normal_mass / pair.tangential_mass


def exact(pair: Pair, normal_speed: Array, velocity: Array, values: Values) -> Array:
    """Return V_x' = mu V_n psi_2/kappa, psi_1 = kappa V_x/(mu V_n), chi = (kappa/2)(m_n/m_t)."""
    unit = values["friction"] * normal_speed / values["kappa"]
    chi = half_ratio(pair) * values["kappa"][:, 0]
    return unit * psi_out(stored(), velocity / unit, chi, values["restitution"][:, 0])


def untouched(pair: Pair, normal_speed: Array, velocity: Array, values: Values) -> Array:
    """Return V_x, for normal impacts and where normal responses alone are asked for."""
    return velocity + 0.0 * next(iter(values.values()))


def rigid(pair: Pair, normal_speed: Array, velocity: Array, values: Values) -> Array:
    """Return V_x' of rigid spheres, |J_t| = min(m_t (1 + beta_0) |V_x|, mu J_n).

    Sticking or sliding takes the smaller impulse; beta_0 = 0 without `tangential_restitution`
    (Walton 1993; Foerster et al. 1994).
    """
    stuck = 1.0 + values.get("tangential_restitution", 0.0)
    whole = values["friction"] * (1.0 + values["restitution"]) * normal_speed
    bound = 2.0 * half_ratio(pair) * whole
    return velocity - np.copysign(np.minimum(stuck * np.abs(velocity), bound), velocity)


FRICTION = Parameter("friction", 1e-3, 10.0, None)
KAPPA = Parameter("kappa", 0.1, 4.0, None)
RESTITUTION = Parameter("restitution", *STORED_E)
BETA = Parameter("tangential_restitution", -1.0, 1.0)

ANY_RESTITUTION = RESTITUTION._replace(low=1e-3)  # where the table of psi_2 is not asked

EXACT = FittedLaw("exact", (FRICTION, KAPPA, RESTITUTION), exact)
STRAIGHT = FittedLaw(EXACT.name, (FRICTION, KAPPA, ANY_RESTITUTION), untouched)
RIVALS = (
    FittedLaw("rigid Coulomb", (FRICTION, RESTITUTION), rigid),
    FittedLaw("Walton", (FRICTION, RESTITUTION, BETA), rigid),
)


def ranged(parameter: Parameter, pair: Pair) -> Parameter:
    """Return a parameter with the range it has for a pair: chi of a kappa must be in the table."""
    if parameter.name != "kappa":
        return parameter
    half = half_ratio(pair)
    least, most = (chi / half for chi in STORED_CHI)
    low, high = max(parameter.low, least), min(parameter.high, most)
    return parameter._replace(low=low * (1.0 + ROUNDING), high=high * (1.0 - ROUNDING))
