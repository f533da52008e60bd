"""Results as velocities and spins in SI units: psi before and after, and the change of energy."""

from math import pi
from typing import Any, NamedTuple

import numpy as np

from carom.approach import components
from carom.bodies import Sphere
from carom.histories import Tangential, inertia
from carom.pairs import Pair
from carom.quantities import InputError
from carom.readings import Results
from carom.results import Finding
from carom.verify.scoring.audits import energy_audit, friction_audit, restitution_audit
from carom.verify.scoring.momentum import momentum_audit
from carom.verify.scoring.points import Points, compared

BEFORE = ("normal_speed", "tangential_speed", "speed", "angle", "spin", "spin2")
AFTER = ("normal_speed_out", "tangential_speed_out", "spin_out", "spin2_out")


class Motion(NamedTuple):
    """Motion of many impacts before or after, arrays along rows; the normal speed is positive."""

    normal_speed: Any
    tangential: Tangential

    def psi(self, pair: Pair, normal_speed: Any) -> Any:
        """Return kappa V_x/(mu V_1)."""
        return pair.psi(self.tangential.contact_velocity(pair), normal_speed)

    def energy(self, pair: Pair) -> Any:
        """Return the kinetic energy in the frame of the centre of mass, in J."""
        centres = self.normal_speed**2 + self.tangential.tangential_speed**2
        return 0.5 * pair.normal_mass * centres + self.tangential.spin_energy(pair)


def score_velocities(
    results: Results, pair: Pair, limit: float
) -> tuple[Points, tuple[Finding, ...], tuple[str, ...]]:
    """Return the points that velocities make, what is found of them, and notes.

    Raises InputError for columns that are missing, rows that are no impact, or wrong units.
    """
    _refuse_second_spin(results, pair)
    before = _before(results)
    after, notes = _after(results, pair, before)
    normal = before.normal_speed
    momentum = momentum_audit(results, pair, before.tangential, after.tangential, normal, limit)
    points = compared(
        before.psi(pair, normal),
        after.psi(pair, normal),
        np.full(len(results), pair.chi),
        after.energy(pair) - before.energy(pair),
        results,
    )
    unit: Any = 0.5 * pair.tangential_mass * pair.scales(normal).tangential_speed ** 2
    restitution = after.normal_speed / normal
    findings = (
        energy_audit(points, unit, "J", limit),
        momentum,
        friction_audit(points, restitution, limit),
        restitution_audit(points, restitution, limit),
    )
    return points, findings, notes


def _before(results: Results) -> Motion:
    normal, tangential = _speeds(results)
    nothing = np.zeros(len(results))
    spins = [results.get(name, nothing) for name in ("spin", "spin2")]
    return Motion(normal, Tangential(tangential, *spins))


def _speeds(results: Results) -> tuple[Any, Any]:
    """Return normal and tangential speed before, from either way of giving them."""
    if not {"speed", "angle"} & set(results.columns):
        results.require("normal_speed", "tangential_speed")
        normal = results["normal_speed"]
        results.refuse("normal_speed", normal <= 0.0, "must be positive: the bodies must approach")
        return normal, results["tangential_speed"]
    results.require("speed", "angle")
    if {"normal_speed", "tangential_speed"} & set(results.columns):
        raise InputError("speed: give speed and angle, or normal_speed and tangential_speed")
    speed, angle = results["speed"], results["angle"]
    allowed = "must be below pi/2, 90 deg; the head of a column in degrees is 'angle [deg]'"
    results.refuse("angle", np.abs(angle) >= 0.5 * pi, allowed)
    results.refuse("speed", speed <= 0.0, "must be positive: the bodies must approach")
    return components(speed, angle)


def _after(results: Results, pair: Pair, before: Motion) -> tuple[Motion, tuple[str, ...]]:
    results.require("tangential_speed_out", "spin_out")
    notes = []
    normal = results.get("normal_speed_out", before.normal_speed)
    if "normal_speed_out" in results.columns:
        receding = "must be positive: the bodies must recede after the impact"
        results.refuse("normal_speed_out", normal <= 0.0, receding)
    else:
        notes.append("normal_speed_out is not given: taken as normal_speed, e = 1")
    spin = results["spin_out"]
    spin2 = results.get("spin2_out", 0.0 * spin)
    if isinstance(pair.second, Sphere) and "spin2_out" not in results.columns:
        impulse = (before.tangential.spin - spin) * inertia(pair.first) / pair.first.radius
        spin2 = before.tangential.after(pair, impulse).spin2
        notes.append("spin2_out is not given: taken from the impulse that changed the first spin")
    return Motion(normal, Tangential(results["tangential_speed_out"], spin, spin2)), tuple(notes)


def _refuse_second_spin(results: Results, pair: Pair) -> None:
    if isinstance(pair.second, Sphere):
        return
    for name in ("spin2", "spin2_out"):
        if name in results.columns:
            only = "only a second sphere can spin; leave the column out"
            results.refuse(name, results[name] != 0.0, only)
