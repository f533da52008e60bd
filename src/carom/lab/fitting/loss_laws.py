"""Laws of losses: the restitution against speed, by constant, viscous, yielding, or waves."""

from functools import cache
from typing import Any

import numpy as np
from scipy.integrate import cumulative_simpson
from scipy.interpolate import CubicSpline, PchipInterpolator

from carom.bodies.losses import LARGEST_STRAIN, yield_velocity, yielding_modulus
from carom.bodies.pairs import Pair
from carom.dimensionless.lossy.springs import metal as springs
from carom.dimensionless.lossy.viscoelastic.normal import restitution
from carom.dimensionless.lossy.viscoelastic.work import new_work
from carom.lab.fitting import model as laws, plates
from carom.lab.fitting.model import FittedLaw, Parameter, Values, untouched
from carom.lab.fitting.problem import FitProblem
from carom.quantities.arrays import Array

LEAST, MOST = 1e-8, 10.0  # of a loss time, in units of d_max/V_1
LEAST_YIELD = 1e-5  # velocity, in units of the smallest speed
LEAST_STRESS = 0.025  # of that with which nothing yields: V_1/V_y is 1e4
LEVELS = 40  # of parameters where a fit begins
CONSTANT, ON_PLATE = "constant", "ZenerPlate"
DEPTHS = np.unique(  # of a metal, in that of first yield: close where it begins to lose
    [*np.linspace(1.0, 1.9, 10), *np.geomspace(1.9, 3.0, 200), *np.geomspace(3.0, 3e4, 160)]
)


def laws_of_losses(problem: FitProblem) -> tuple[FittedLaw, ...]:
    """Return the laws, with ranges beyond which nothing changes at these speeds."""
    speeds = problem.motion.normal_speed
    times = _times(problem.pair, speeds)
    loss_time = Parameter("loss_time", LEAST * times.min(), MOST * times.max(), None, LEVELS)
    least, most = LEAST_YIELD * speeds.min(), float(speeds.max())
    yielding = Parameter("yield_velocity", least, most, None, LEVELS)
    zener = problem.on_plate and FittedLaw(
        ON_PLATE, (laws.ranged(laws.THICK, problem),), untouched, plates.restitution
    )
    return (
        *([zener] if zener else []),
        FittedLaw(CONSTANT, (laws.ANY_RESTITUTION,), untouched),
        FittedLaw("KelvinVoigt", (loss_time,), untouched, viscous),
        FittedLaw("ElasticPlastic", (yielding,), untouched, plastic),
        FittedLaw("Metal", (_flow_stress(problem),), untouched, metal),
    )


def _flow_stress(problem: FitProblem) -> Parameter:
    """Return the strength of a metal: at the upper end it does not yield, or is none any more."""
    pair, fastest = problem.pair, float(problem.motion.normal_speed.max())
    most = LARGEST_STRAIN * yielding_modulus(pair)
    not_yielding = most * (fastest / yield_velocity(pair, most)) ** 0.4  # V_y goes as Y^(5/2)
    high = float(min(most, not_yielding))
    return Parameter("flow_stress", LEAST_STRESS * high, high, None, LEVELS)


def elastic(law: FittedLaw) -> dict[str, float]:
    """Return the parameter with which a law loses next to nothing."""
    (parameter,) = law.parameters
    is_time = parameter.name == "loss_time"
    return {parameter.name: parameter.low if is_time else parameter.high}


def _times(pair: Pair, normal_speed: Any) -> Array:
    """Return d_max/V_1 at each speed."""
    return np.asarray(pair.scales(normal_speed).time)


def viscous(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return e(alpha), alpha = tau V_1/d_max (Kuwabara & Kono 1987), without tension."""
    alpha = values["loss_time"] / _times(pair, normal_speed)
    return np.asarray(np.exp(-np.exp(_viscous()(np.log(alpha)))))


@cache
def _viscous() -> CubicSpline:
    """Return log(-log e) of log alpha, which is nearly straight at both ends."""
    alphas, work = np.geomspace(1e-7, 90.0, 241), new_work()
    restitutions = np.array([restitution(float(alpha), work) for alpha in alphas])
    return CubicSpline(np.log(alphas), np.log(-np.log(restitutions)))


def plastic(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return e = P_max/d_max^(1/4) of a sphere that yields, 1 below V_y (Thornton 1997, (28)).

    In units of the elastic impact, y = (V_y/V_1)^(2/5) and P_max^2 = (6/5) y - y^6/5.
    """
    y = np.minimum(values["yield_velocity"] / normal_speed, 1.0) ** 0.4
    peak = np.sqrt(1.2 * y - 0.2 * y**6)
    deepest = y**2 + (peak - y**3) / (1.5 * y)
    return np.asarray(peak / deepest**0.25)


def metal(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return e of a metal (Jackson & Green 2005), as `Metal` has it.

    In units of the yield point V_1^2 = (5/2) integral of P dw to the turning point, of which the
    springs give e^2 back: they bear Abel's transform of Hertz's pressure, cut.
    """
    curves = []
    for stress in values["flow_stress"][:, 0]:
        strain = float(stress / yielding_modulus(pair))
        load, edge = _pressed(strain)
        work = 1.0 + 2.5 * cumulative_simpson(load, x=DEPTHS, initial=0.0)
        share = np.minimum(load / edge**3, 1.0)
        cut = 2.0 * np.sin(np.arcsin(share) / 3.0)
        e = np.sqrt(np.minimum(edge**5 * _kept()(cut) / work, 1.0))
        speeds = np.sqrt(work) * yield_velocity(pair, float(stress))
        within = np.log(np.clip(normal_speed, speeds[0], speeds[-1]))
        curves.append(PchipInterpolator(np.log(speeds), e)(within))
    return np.array(curves)


def _pressed(strain: float) -> tuple[Array, Array]:
    """Return load and edge of a metal at DEPTHS, in units of first yield."""
    load, area, _, _ = np.array([springs.pressed(1.0, strain, w) for w in DEPTHS]).T
    return load, np.sqrt(area)


@cache
def _kept() -> CubicSpline:
    """Return the energy in springs that bear Hertz's pressure cut at c/b, over that of Hertz's."""
    cuts = np.linspace(1e-3, 1.0, 200)
    x = np.sin(np.linspace(0.0, 0.5 * np.pi, 4001))
    depth = np.maximum(1.0 - x * x, 1e-300)
    kept = []
    for cut in cuts:
        beyond = np.sqrt(np.maximum(depth - cut * cut, 0.0))
        spread = cut * beyond + depth * np.arcsin(np.minimum(cut / np.sqrt(depth), 1.0))
        kept.append(1.875 * np.trapezoid((2.0 / np.pi * spread) ** 2, x))
    return CubicSpline(cuts, np.array(kept) / kept[-1])
