"""Results as velocities and spins in SI units: psi before and after, and the change of energy."""

from math import pi
from typing import Any, NamedTuple

import numpy as np

from carom.bodies.kinematics import Tangential, by_angle, components, inertia
from carom.bodies.observables import FASTEST, SLOWEST
from carom.bodies.pairs import Pair
from carom.bodies.shapes import Sphere
from carom.io.user_table import UserTable
from carom.quantities.refusals import InputError
from carom.quantities.verdicts import Finding
from carom.verify.scoring import points as scored
from carom.verify.scoring.cases import ScoredCase
from carom.verify.scoring.points import FEWEST_POINTS, Scored, within

UNIT_MISTAKES = {  # by the ratio of the impulse in the spins to that in the speeds
    30.0 / pi: "in rpm; head the columns 'spin [rpm]' and 'spin_out [rpm]'",
    180.0 / pi: "in deg/s; head the columns 'spin [deg/s]' and 'spin_out [deg/s]'",
    0.5 / pi: "in turns/s; head the columns 'spin [turn/s]' and 'spin_out [turn/s]'",
    1e-3: "in mm/s; head the columns 'normal_speed [mm/s]' and so on",
    1e-2: "in cm/s; head the columns 'normal_speed [cm/s]' and so on",
    1.0 / 3.6: "in km/h; head the columns 'normal_speed [km/h]' and so on",
}
CAUSES = {
    -1.0: "does spin have the opposite sign? Positive spin adds to the speed of the contact point",
    2.0: "is the radius in the case a diameter?",
    0.5: "is the radius in the case half of the true one?",
    0.8: "is the moment of inertia in the results that of a disc?",
}
SAME_RATIO = 0.02  # relative difference of ratios that are taken for the same
BEFORE = ("normal_speed", "tangential_speed", "speed", "angle", "spin", "spin2")
AFTER = ("normal_speed_out", "tangential_speed_out", "spin_out", "spin2_out")


class Velocities(NamedTuple):
    """Velocities before or after many impacts, arrays along rows; the normal speed is positive."""

    normal_speed: Any
    tangential: Tangential

    def energy(self, pair: Pair) -> Any:
        """Return the kinetic energy in the frame of the centre of mass, in J."""
        centres = self.normal_speed**2 + self.tangential.tangential_speed**2
        return 0.5 * pair.normal_mass * centres + self.tangential.spin_energy(pair)


def score_velocities(results: UserTable, case: ScoredCase, limit: float) -> Scored:
    """Return the points that velocities make, and what is found of them."""
    results.require_rows(FEWEST_POINTS)
    pair, expected = case.pair, case.restitution
    for name in ("spin2", "spin2_out"):
        if name in results.columns and not isinstance(pair.second, Sphere):
            only = "only a second sphere can spin; leave the column out"
            results.refuse(name, results[name] != 0.0, only)
    normal, tangential = _speeds(results)
    nothing = np.zeros(len(results))
    spins: list[Any] = [results.columns.get(name, nothing) for name in ("spin", "spin2")]
    before = Velocities(normal, Tangential(tangential, *spins))
    after, notes = _after(results, pair, before, expected)
    name = "normal_speed" if "normal_speed" in results.columns else "speed"
    results.refuse(name, (normal < SLOWEST) | (normal > FASTEST), "check its unit")
    psi_in, psi_out = (
        np.asarray(pair.psi(each.tangential.contact_velocity(pair), normal))
        for each in (before, after)
    )
    scored.refuse_large(psi_in, psi_out, results)
    speed_unit: Any = pair.scales(normal).tangential_speed
    momentum = momentum_audit(results, pair, before.tangential, after.tangential, speed_unit, limit)
    chi, change = np.full(len(results), pair.chi), after.energy(pair) - before.energy(pair)
    points = scored.compared(psi_in, psi_out, chi, expected, change, results)
    unit: Any = 0.5 * pair.tangential_mass * speed_unit**2
    restitution = after.normal_speed / normal
    audit = (
        scored.energy_audit(points, unit, "J", limit),
        momentum,
        scored.friction_audit(points, restitution, limit),
        scored.restitution_audit(points, restitution, limit),
    )
    return Scored(points, audit, notes, pair._describe())


def _speeds(results: UserTable) -> tuple[Any, Any]:
    """Return normal and tangential speed before, from either way of giving them."""
    angular = bool({"speed", "angle"} & set(results.columns))
    names = ("speed", "angle") if angular else ("normal_speed", "tangential_speed")
    results.require(*names)
    one, other = (results[name] for name in names)
    return components(one, other) if by_angle(results.columns) else (one, other)


def _after(
    results: UserTable, pair: Pair, before: Velocities, expected: float
) -> tuple[Velocities, tuple[str, ...]]:
    results.require("tangential_speed_out", "spin_out")
    notes = []
    normal = results.columns.get("normal_speed_out", expected * before.normal_speed)
    if "normal_speed_out" in results.columns:
        receding = "must be positive: the bodies must recede after the impact"
        results.refuse("normal_speed_out", normal <= 0.0, receding)
    else:
        times = "" if expected == 1.0 else f"{expected:g} "
        taken = f"it was taken as {times}normal_speed, e = {expected:g}"
        notes.append(f"normal_speed_out is not given; {taken}")
    spin = results["spin_out"]
    spin2 = results.columns.get("spin2_out", 0.0 * spin)
    if isinstance(pair.second, Sphere) and "spin2_out" not in results.columns:
        impulse = (before.tangential.spin - spin) * inertia(pair.first) / pair.first.radius
        spin2 = before.tangential.after(pair, impulse).spin2
        notes.append(
            "spin2_out is not given; it was computed from the impulse that changed the first spin"
        )
    tangential = Tangential(results["tangential_speed_out"], spin, spin2)
    return Velocities(normal, tangential), tuple(notes)


def momentum_audit(
    results: UserTable,
    pair: Pair,
    before: Tangential,
    after: Tangential,
    speed_unit: Any,
    limit: float,
) -> Finding:
    """Return whether spins and speeds changed by the same impulse, in units of psi."""
    linear = pair.normal_mass * (before.tangential_speed - after.tangential_speed)
    spins = zip(pair.moving, before[1:], after[1:], strict=False)
    angular = [(was - now) * inertia(body) / body.radius for body, was, now in spins]
    unit = pair.tangential_mass * speed_unit
    off = np.max([np.abs(linear - other) for other in angular], axis=0) / unit
    ratio = _constant_ratio(angular[0], linear, limit * unit)
    _refuse_units(ratio)
    value, verdict = float(off.max()), "speeds and spins change by the same impulse"
    if not value <= limit:
        where = f"{results.named(off > limit)}, most in {results.one(int(np.argmax(off)))}"
        verdict = f"speeds and spins change by different impulses in {where}{_cause(ratio)}"
    return within("angular momentum", value, limit, verdict)


def _constant_ratio(angular: Any, linear: Any, small: Any) -> float:
    """Return the ratio of two impulses if it is the same in all rows, else 1."""
    size = float(linear @ linear)
    if size == 0.0:
        return 1.0
    ratio = float(angular @ linear) / size
    if ratio == 0.0:
        return 1.0
    spread = np.abs(angular - ratio * linear)
    allowed = np.maximum(SAME_RATIO * np.abs(ratio * linear), np.maximum(abs(ratio), 1.0) * small)
    return ratio if np.all(spread <= allowed) else 1.0


def _refuse_units(ratio: float) -> None:
    for factor, words in UNIT_MISTAKES.items():
        if abs(abs(ratio) / factor - 1.0) < SAME_RATIO:
            wrong = "spins" if "spin" in words else "speeds"
            raise InputError(
                f"{wrong}: in every row the spins change {abs(ratio):.4g} times as much as the "
                f"speeds imply; the {wrong} seem to be {words}"
            )


def _cause(ratio: float) -> str:
    """Return what may be wrong if the impulses differ by the same factor in all rows."""
    if abs(ratio - 1.0) < SAME_RATIO:
        return ""
    causes = (words for factor, words in CAUSES.items() if abs(ratio / factor - 1.0) < SAME_RATIO)
    return f", by the same factor {ratio:.4g}; {next(causes, 'check units and sizes')}"
