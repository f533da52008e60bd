"""Impacts of bodies of any smooth shape, struck anywhere: off their centre, in an ellipse."""

from collections.abc import Mapping
from math import isfinite
from typing import Any

import numpy as np

from carom.bodies.checks import checked_scales
from carom.bodies.contact_shape import axes_of
from carom.bodies.kinematics import by_angle, components, slope
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair, Scales
from carom.bodies.rigid_motion import RigidMotion
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.lossy.springs.motion import Inertia
from carom.dimensionless.lossy.springs.off_centre import OffCentreSolution, solve_off_centre
from carom.dimensionless.solution import Solution
from carom.impacts.body_impact import ROUND, BodyImpact, with_normal
from carom.impacts.exact import loss_numbers, solution_of
from carom.quantities.arrays import Array, numbers
from carom.quantities.prefixes import text
from carom.quantities.refusals import Faults, refusal, refuse
from carom.quantities.units import finite, positive

ROUND_ONLY = "how an ellipse yields is not known; take KelvinVoigt, or leave losses out"
IN_PLANE = "must be one number, as the bodies move in a plane; for space give an inertia of 3 x 3"
IN_SPACE = "must be {} numbers, along x, y{}, all finite, as the bodies move in space"


def solve_bodies(pair: Pair, speeds: Mapping[str, Any], losses: LossLaw | None) -> BodyImpact:
    """Return an impact of bodies of any shape; see `carom.impact`."""
    motion, axes = read_motion(pair, speeds), axes_of(pair.curvatures)[1]
    *sliding, approach = motion.at_contact(pair)
    leaves = f"the contact points part at {text(-approach, 'm/s')}; turn the velocity or the spin"
    refuse(not approach > 0.0 and refusal("normal_speed", speeds["normal_speed"], leaves))
    scales = checked_scales(pair, float(approach), *map(float, sliding))
    solution = _solution(pair, scales, axes @ sliding, axes, losses)
    moves: tuple[Any, Any, Any] = motion.velocity[:2], motion.spin, motion.spin2
    if pair.is_planar:
        moves = float(motion.velocity[0]), -float(motion.spin[1]), -float(motion.spin2[1])
    return BodyImpact(
        pair,
        -float(motion.velocity[2]),
        moves[0],
        moves[1],
        moves[2],
        solution,
        losses,
        scales=scales,
        motion=motion,
        axes=axes,
    )


def read_motion(pair: Pair, speeds: Mapping[str, Any]) -> RigidMotion:
    """Return the motion before, or raise InputError with all that is wrong."""
    size = 1 if pair.is_planar else 3
    with Faults() as faults:
        with faults.catching():
            names = ("speed", "angle", "normal_speed", "tangential_speed")
            along = np.zeros(2)
            if by_angle({name: speeds[name] for name in names}):
                angle = 0.0 if speeds["angle"] is None else slope(speeds["angle"])
                normal, along[0] = components(positive("speed", speeds["speed"]), angle)
            else:
                normal = finite("normal_speed", speeds["normal_speed"])
                value = speeds["tangential_speed"]
                along = _vector("tangential_speed", value, min(size, 2))
        spins = []
        for name in ("spin", "spin2"):
            with faults.catching():
                spins.append(_vector(name, speeds[name], size))
    turned = [np.array([0.0, -spin[0], 0.0]) if size == 1 else spin for spin in spins]
    fixed = len(pair.moving) == 1 and bool(np.any(turned[1]))
    refuse(
        fixed and refusal("spin2", speeds["spin2"], "the second body does not move; leave it out")
    )
    return RigidMotion(np.array([along[0], along[-1] if size > 1 else 0.0, -normal]), *turned)


def approach_of(pair: Pair, speeds: Mapping[str, Any]) -> float:
    """Return the speed at which contact points approach, or raise InputError."""
    names = ("speed", "angle", "normal_speed", "tangential_speed", "spin", "spin2")
    return float(read_motion(pair, {n: speeds.get(n) for n in names}).at_contact(pair)[2])


def _vector(name: str, value: Any, size: int) -> Array:
    """Return so many finite numbers; none, or one that is zero, are zeros."""
    if value is None:
        return np.zeros(size)
    if size == 1:
        refuse(isinstance(value, list | tuple | np.ndarray) and refusal(name, value, IN_PLANE))
        return np.array([finite(name, value)])
    allowed = IN_SPACE.format(("two", "three")[size - 2], " and z" * (size - 2))
    values = numbers(name, value, allowed)
    if values.ndim == 0 and values == 0.0:
        return np.zeros(size)
    bad = values.shape != (size,) or not np.all(np.isfinite(values))
    refuse(bad and refusal(name, value, allowed))
    return values


def _solution(
    pair: Pair, scales: Scales, sliding: Array, axes: Array, losses: LossLaw | None
) -> Solution | LossySolution | OffCentreSolution:
    """Return the solution: the exact one where bodies are struck through their centres."""
    inertia = inertia_of(pair, axes)
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


def inertia_of(pair: Pair, axes: Array) -> Inertia:
    """Return the inverse mass at the contact in the units of an impact with friction."""
    whole = with_normal(axes)
    b = whole @ pair.inverse_mass @ whole.T / (whole @ pair.inverse_mass @ whole.T)[2, 2]
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
