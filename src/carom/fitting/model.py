"""The laws that are fitted, exact and of rigid spheres, and a law with some parameters free."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.kinematics import Rebound, Tangential
from carom.bodies.pairs import Pair
from carom.dimensionless.rebound_tables import STORED_CHI, STORED_E, psi_out, stored
from carom.dimensionless.rebounds import regimes
from carom.fitting.least_squares import BoxBounds, Residuals
from carom.fitting.problem import FitProblem, IncomingMotion, RobustLoss, Weights
from carom.quantities.arrays import Array

Values = Mapping[str, Array]  # of parameters by name, each of shape (batch, 1)
OutgoingVelocity = Callable[[Pair, Array, Array, Values], Array]
NormalRestitution = Callable[[Pair, Array, Values], Array]
OFFSET = "spin_offset"
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
        rebound = Rebound(pair, normal, *before, restitution + 0.0 * turning, impulse)
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


@dataclass(frozen=True, eq=False)
class Model:
    """A law, what was measured, and which of its parameters are free; the others are held."""

    law: FittedLaw
    problem: FitProblem
    free: tuple[str, ...]
    held: Mapping[str, float]

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """The free parameters, in the order of the coordinates."""
        own = (ranged(parameter, self.problem.pair) for parameter in self.law.parameters)
        by_name = {parameter.name: parameter for parameter in own}
        return tuple(by_name.get(name) or offset_parameter(self.problem) for name in self.free)

    @cached_property
    def bounds(self) -> BoxBounds:
        """The range of the coordinates."""
        ends = [(p.coordinate(p.low), p.coordinate(p.high)) for p in self.parameters]
        return BoxBounds(*np.array(ends).reshape(-1, 2).T)

    def values(self, at: Array) -> Values:
        """Return the values of all parameters at coordinates, each of shape (batch, 1)."""
        batch = len(at)
        held = {name: np.full((batch, 1), value) for name, value in self.held.items()}
        columns = (p.value(at[:, i : i + 1]) for i, p in enumerate(self.parameters))
        return held | dict(zip(self.free, columns, strict=True))

    def values_at(self, point: Array) -> dict[str, float]:
        """Return the values of all parameters at coordinates of shape (parameters,)."""
        return {name: float(v[0, 0]) for name, v in self.values(point[np.newaxis]).items()}

    def coordinates(self, values: Mapping[str, float]) -> Array:
        """Return the coordinates of values, of shape (parameters,)."""
        return np.array([p.coordinate(values[p.name]) for p in self.parameters])

    def expected(self, at: Array, motion: IncomingMotion | None = None) -> Array:
        """Return the responses at coordinates, of shape (batch, rows, responses).

        They are those to the motion that was measured, or to another one.
        """
        problem = self.problem
        before = problem.motion if motion is None else motion
        return self.law.predicted(problem.pair, before, self.values(at), problem.responses)

    def weights(self, point: Array, sigma: Array, scale: Array) -> Weights:
        """Return the weights at coordinates of shape (parameters,).

        Covariance of the responses of a row: S (diag(sigma^2) + sum_x d_x d_x^T) S, with d_x half
        the difference of the responses when a column x of the motion before goes one standard
        deviation up and down (effective variance; Orear 1982), and S the factors by which given
        errors are too small. `sigma` has the shape (rows, responses), `scale` (responses,).
        """
        present, at = self.problem.present, point[np.newaxis]
        variance = np.where(present, sigma, 1.0) ** 2
        covariance = variance[:, :, np.newaxis] * np.eye(len(scale))
        for up, down in self.problem.shaken:
            difference = self.expected(at, up)[0] - self.expected(at, down)[0]
            reach = np.where(present, 0.5 * difference, 0.0)
            covariance += reach[:, :, np.newaxis] * reach[:, np.newaxis, :]
        return Weights(np.linalg.inv(np.linalg.cholesky(covariance)) / scale)

    def residuals(self, weights: Weights, loss: RobustLoss) -> Residuals:
        """Return the function whose sum of squares is to be least."""

        def of(at: Array) -> Array:
            roots = loss.root(weights.whitened(self.problem, self.expected(at)))
            return roots.reshape(len(at), self.problem.measured.size)

        return of

    def regimes(self, point: Array) -> NDArray[np.int8]:
        """Return the place in `carom.impacts.curves.REGIMES` of each row, by the exact law."""
        problem, values = self.problem, self.values_at(point)
        velocity = problem.contact_velocity + problem.pair.first.radius * values[OFFSET]
        psi = values["kappa"] * velocity / (values["friction"] * problem.motion.normal_speed)
        return regimes(psi, half_ratio(problem.pair) * values["kappa"], values["restitution"])

    def holding(self, name: str, value: float) -> "Model":
        """Return the model with one of the free parameters held."""
        free = tuple(each for each in self.free if each != name)
        return replace(self, free=free, held={**self.held, name: value})

    def freeing(self, names: Collection[str]) -> "Model":
        """Return the model with some of the parameters that are held free."""
        held = {name: value for name, value in self.held.items() if name not in names}
        return replace(self, free=(*self.free, *names), held=held)


def offset_parameter(problem: FitProblem) -> Parameter:
    """Return the offset of the spin, which is varied in units of a tenth of the rolling spin."""
    scale = 0.1 * float(np.median(problem.motion.normal_speed)) / problem.pair.first.radius
    return Parameter(OFFSET, -100.0 * scale, 100.0 * scale, scale)
