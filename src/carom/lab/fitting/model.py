"""The laws that are fitted, exact and of rigid spheres, and a law with some parameters free."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.kinematics import Rebound, Tangential
from carom.bodies.pairs import Pair
from carom.dimensionless.rebound_tables import STORED_CHI, STORED_E, psi_out, stored
from carom.dimensionless.rebounds import regime_borders
from carom.lab.fitting import plates
from carom.lab.fitting.least_squares import BoxBounds
from carom.lab.fitting.plates import DURATION, THICKNESS
from carom.lab.fitting.problem import FitProblem, IncomingMotion, Weights, shared_readings
from carom.quantities.arrays import Array

Values = Mapping[str, Array]  # by name: of parameters (batch, 1), of restitutions (batch, rows)
OutgoingVelocity = Callable[[Pair, Array, Array, Values], Array]
OfNormalSpeed = Callable[[Pair, Array, Values], Array]
OFFSET = "spin_offset"
ROUNDING = 1e-9


class Parameter(NamedTuple):
    """A parameter with its range; what is varied is its logarithm, or it in units of a scale.

    A fit begins with a scan of so many `levels` of it.
    """

    name: str
    low: float
    high: float
    scale: float | None = 1.0  # None: logarithmic
    levels: int = 1

    def coordinate(self, value: Any) -> Any:
        """Return what is varied in place of a value, or of an array of them."""
        return np.log(value) if self.scale is None else value / self.scale

    def value(self, coordinate: Array) -> Array:
        """Return the values of coordinates."""
        return np.exp(coordinate) if self.scale is None else coordinate * self.scale


class Thickness(Parameter):
    """A thickness h, of which -(scale/h)^2 is varied: e is nearly linear in it."""

    def coordinate(self, value: Any) -> Any:
        """Return what is varied in place of a value, or of an array of them."""
        return -(((self.scale or 1.0) / value) ** 2)

    def value(self, coordinate: Array) -> Array:
        """Return the values of coordinates."""
        return np.asarray((self.scale or 1.0) / np.sqrt(-coordinate))


def constant(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return the same restitution at every speed."""
    return values["restitution"] + 0.0 * normal_speed


@dataclass(frozen=True)
class FittedLaw:
    """A law of rebound: `contact_velocity_out` is V_x' of V_n, V_x, and what can be varied.

    V_n and V_x have the shape (rows,), V_x' and e have (batch, rows). Besides `parameters` an
    offset of the spin can be varied. On a plate e depends on V_n.
    """

    name: str
    parameters: tuple[Parameter, ...]
    contact_velocity_out: OutgoingVelocity
    restitution: OfNormalSpeed = constant

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(parameter.name for parameter in self.parameters)

    def predicted(
        self, pair: Pair, motion: IncomingMotion, values: Values, names: Sequence[str]
    ) -> Array:
        """Return the observables of these names, of shape (batch, rows, names)."""
        normal, tangential, spin, spin2, _ = motion
        values = of_rows(motion, values)
        turning = spin + values[OFFSET]
        before = Tangential(tangential + 0.0 * turning, turning, spin2)  # type: ignore[arg-type]
        velocity = np.asarray(before.contact_velocity(pair))
        e = self.restitution(pair, normal, values)
        after = self.contact_velocity_out(pair, normal, velocity, {**values, "restitution": e})
        impulse = pair.tangential_mass * (velocity - after)
        rebound = Rebound(pair, normal, *before, e + 0.0 * turning, impulse)
        observed = (
            plates.duration(pair, normal, values) + 0.0 * turning
            if name == DURATION
            else getattr(rebound, name)
            for name in names
        )
        return np.stack(list(observed), axis=-1)


def of_rows(motion: IncomingMotion, values: Values) -> Values:
    """Return the values with the thickness of each row, if that is in the table."""
    return values if motion.thickness is None else {**values, THICKNESS: motion.thickness[None]}


def half_ratio(pair: Pair) -> float:
    """Return chi/kappa, (1/2) m_n/m_t."""
    return 0.5 * pair.normal_mass / pair.tangential_mass


def exact(pair: Pair, normal_speed: Array, velocity: Array, values: Values) -> Array:
    """Return V_x' = mu V_n psi_2/kappa, psi_1 = kappa V_x/(mu V_n), chi = (kappa/2)(m_n/m_t)."""
    unit = values["friction"] * normal_speed / values["kappa"]
    chi = half_ratio(pair) * values["kappa"][:, 0]
    return unit * psi_out(stored(), velocity / unit, chi, values["restitution"][:, 0])


def exact_on_plate(pair: Pair, normal_speed: Array, velocity: Array, values: Values) -> Array:
    """Return the same on a plate, by the solver: e, and psi_2 for its sake, depend on V_n."""
    unit = values["friction"] * normal_speed / values["kappa"]
    chi, gives = half_ratio(pair) * values["kappa"], plates.give(pair, normal_speed, values)
    rows = np.broadcast_arrays(velocity / unit, chi, gives, values["restitution"])
    return unit * plates.rebounds(*rows)


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


FRICTION = Parameter("friction", 1e-3, 10.0, None, 25)
KAPPA = Parameter("kappa", 0.1, 4.0, None, 12)
RESTITUTION = Parameter("restitution", *STORED_E)
THICK = Thickness(THICKNESS, 0.0, np.inf)  # its range depends on the speeds
BETA = Parameter("tangential_restitution", -1.0, 1.0, levels=9)

ANY_RESTITUTION = RESTITUTION._replace(low=1e-3)  # where the table of psi_2 is not asked

EXACT = FittedLaw("exact", (FRICTION, KAPPA, RESTITUTION), exact)
STRAIGHT = FittedLaw(EXACT.name, (FRICTION, KAPPA, ANY_RESTITUTION), untouched)
RIVALS = (
    FittedLaw("rigid Coulomb", (FRICTION, RESTITUTION), rigid),
    FittedLaw("Walton", (FRICTION, RESTITUTION, BETA), rigid),
)


def suited(law: FittedLaw, problem: FitProblem) -> FittedLaw:
    """Return the law for the bodies: on a plate the thickness gives the restitution."""
    if not problem.on_plate:
        return law
    thickness = () if THICKNESS in problem.before else (THICK,)
    others = (each for each in law.parameters if each.name != RESTITUTION.name)
    out = exact_on_plate if law.contact_velocity_out is exact else law.contact_velocity_out
    return FittedLaw(law.name, (*others, *thickness), out, plates.restitution)


def ranged(parameter: Parameter, problem: FitProblem) -> Parameter:
    """Return a parameter with the range it has for a problem.

    chi of a kappa must be in the table; a plate must be one that the theory can solve.
    """
    pair = problem.pair
    if parameter.name == THICKNESS:
        low, high, scale = plates.thickness_range(pair, problem.motion.normal_speed)
        return parameter._replace(low=low, high=high, scale=scale)
    if parameter.name != "kappa":
        return parameter
    half = half_ratio(pair)
    least, most = (chi / half for chi in STORED_CHI)
    low, high = least * (1.0 + ROUNDING), most * (1.0 - ROUNDING)
    return parameter._replace(low=max(parameter.low, low), high=min(parameter.high, high))


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
        own = (ranged(parameter, self.problem) for parameter in self.law.parameters)
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
        problem, before = self.problem, self.problem.motion if motion is None else motion
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
        factors = np.linalg.inv(np.linalg.cholesky(covariance)) / scale
        bounces = self.problem.bounces
        if bounces is None or len(scale) > 1:
            return Weights(factors)
        gains = self.expected(at)[0, :, 0] / self.problem.motion.normal_speed
        rows, larger = shared_readings(self.problem, bounces, gains, float(scale[0]))
        across = np.zeros_like(rows)
        for drop in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(bounces.places) > 1) + 1):
            own = slice(drop[0], drop[-1] + 1)
            across[own, own] = np.linalg.inv(np.linalg.cholesky(rows[own, own]))
        return Weights(factors / larger[:, np.newaxis, np.newaxis], across)

    def regimes(self, point: Array) -> NDArray[np.int8]:
        """Return the place in `carom.impacts.curves.REGIMES` of each row, by the exact law."""
        problem, values = self.problem, self.values_at(point)
        velocity = problem.contact_velocity + problem.pair.first.radius * values[OFFSET]
        psi = values["kappa"] * velocity / (values["friction"] * problem.motion.normal_speed)
        passed = self.borders(point, problem.motion) <= np.abs(psi)[:, np.newaxis]
        return np.asarray(passed.sum(axis=1).astype(np.int8))

    def borders(self, point: Array, motion: IncomingMotion) -> Array:
        """Return the |psi_1| at which the regime changes, of shape (rows, 3)."""
        pair, values = self.problem.pair, self.values(point[np.newaxis])
        arguments = pair, motion.normal_speed, of_rows(motion, values)
        e = self.law.restitution(*arguments)[0]
        turning = plates.turning(*arguments)[0] if self.problem.on_plate else 0.0
        return regime_borders(half_ratio(pair) * float(values["kappa"][0, 0]), e, turning)

    def holding(self, name: str, value: float) -> "Model":
        """Return the model with one of the free parameters held."""
        free = tuple(each for each in self.free if each != name)
        return replace(self, free=free, held={**self.held, name: value})

    def freeing(self, names: Collection[str]) -> "Model":
        """Return the model with some of the parameters that are held free."""
        held = {name: value for name, value in self.held.items() if name not in names}
        return replace(self, free=(*self.free, *names), held=held)


def plain(name: str) -> str:
    """Return the name of a parameter without the number of its set, which a joint fit adds."""
    return name.rstrip("_0123456789")


def offset_parameter(problem: FitProblem) -> Parameter:
    """Return the offset of the spin, which is varied in units of a tenth of the rolling spin."""
    scale = 0.1 * float(np.median(problem.motion.normal_speed)) / problem.pair.first.radius
    return Parameter(OFFSET, -100.0 * scale, 100.0 * scale, scale)
