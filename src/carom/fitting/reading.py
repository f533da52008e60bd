"""Measurements read and checked: what contradicts itself, or has another unit, is refused."""

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from carom.bodies.cases import check_case, pair_of
from carom.bodies.kinematics import Tangential
from carom.bodies.pairs import Pair, alike
from carom.datasets.observables import BEFORE, FASTEST, INCIDENCE, OBSERVABLES, SCALED, SLOWEST
from carom.dimensionless.rebound_tables import STORED_CHI
from carom.fitting.heights import HEIGHTS, with_speeds
from carom.fitting.laws import IncomingMotion
from carom.fitting.problem import NOTHING, FitProblem
from carom.io.columns import ERROR, Results, entry, in_units, others, with_errors
from carom.io.tables import Cells, read_table
from carom.quantities.arrays import Array
from carom.quantities.faults import Faults
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, refusal

MOST = 1.5  # restitution that scatter may reach; beyond it is a percentage, or another unit
LARGEST = 1e9  # of what has no unit
RELATIVE = ("tangential_restitution", "contact_restitution", "contact_beta")
START = 0.3  # friction of bodies of which none is known, to begin with


def read_problem(
    data: Any, pair: Pair | None, columns: Mapping[str, str] | None = None
) -> FitProblem:
    """Return what was measured, or raise InputError for all that cannot be used.

    `columns` tells what heads of the data stand for.
    """
    table = read_table(data, columns)
    with Faults() as faults:
        return _problem(table, pair, faults)


def _problem(table: Cells, pair: Pair | None, faults: Faults) -> FitProblem:
    known = with_errors((*BEFORE, *OBSERVABLES, *HEIGHTS))
    ignored = others(table, known, faults)
    present = [name for name in known if name in table.names]
    rows = with_speeds(
        in_units(table, present, gaps=(*OBSERVABLES, "rebound_height"), faults=faults)
    )
    measured = tuple(name for name in OBSERVABLES if name in rows.columns)
    responses = tuple(name for name in measured if np.isfinite(rows[name]).any())
    if not measured:
        faults.settle()
        raise InputError(
            f"data: no measured response among the columns {', '.join(table.names)}; there must be "
            f"one or more of {', '.join(OBSERVABLES)}, or drop_height and rebound_height"
        )
    if not responses:
        faults.settle()
        raise InputError(
            f"data: there is no value in {', '.join(measured)}; '-' means not measured"
        )
    empty = (f"{name} (no value in it)" for name in measured if name not in responses)
    bodies, knows_friction = _bodies(pair, table.case)
    if "drop_height" in rows.columns and len(bodies.moving) > 1:
        raise InputError(
            "drop_height: the second body flies off, too, so that the heights of the first do not "
            "give the speed at which they part; drop the ball on a half-space, or give "
            "normal_speed and normal_speed_out"
        )
    before = {name: rows[name] for name in BEFORE if name in rows.columns}
    if (scaled := {*before, *responses} & {"psi_in", "psi_out"}) and not knows_friction:
        raise InputError(
            f"friction: missing; {min(scaled)} is in units of it, so give that of the bodies"
        )
    _check_sizes(rows, bodies)
    _check_before(rows, before, responses)
    faults.settle()
    problem = FitProblem(
        pair=bodies,
        before=before,
        before_errors={name: rows[name + ERROR] for name in before if name + ERROR in rows.columns},
        responses=responses,
        measured=np.stack([rows[name] for name in responses], axis=-1),
        errors=np.stack([_errors(rows, name) for name in responses], axis=-1),
        rows=rows,
        ignored=(*ignored, *empty),
        knows_friction=knows_friction,
        doi=table.comments.get("doi", ""),
    )
    _check_responses(problem.rows, problem.motion, problem.contact_velocity)
    _check_speed(problem)
    return problem


def _bodies(pair: Pair | None, case: Mapping[str, Any] | None) -> tuple[Pair, bool]:
    """Return the bodies, and whether their friction is known; otherwise it is a guess."""
    own = None if case is None else _bodies_of(case)
    if pair is not None:
        if not isinstance(pair, Pair):
            raise refusal("pair", pair, "must be a Pair of bodies; make one with carom.Pair")
        if own is not None and not alike(pair, own):
            raise InputError(
                "pair: its bodies differ from those in the data; leave it, or --case, out"
            )
        bodies = pair
    elif own is not None:
        bodies = own
    else:
        raise InputError(
            "pair: missing, and the data do not name the bodies; give pair=carom.Pair(...) in "
            "Python or --case FILE in a shell, or write the bodies as JSON into a comment "
            "'# case: {...}' of the file"
        )
    least, most = STORED_CHI
    if not least <= bodies.chi <= most:
        raise InputError(
            f"pair: a chi of {bodies.chi:.3g} cannot be fitted, only one from {least:.2g} to "
            f"{most:.2g}; check radii and gyration_radius"
        )
    known = bodies.friction > 0.0
    return bodies if known else Pair(bodies.first, bodies.second, START), known


def _bodies_of(case: Mapping[str, Any]) -> Pair:
    check_case(case)
    return pair_of({"friction": 0.0, **case})


def _errors(rows: Results, name: str) -> Array:
    """Return the standard deviations of a response, NaN where they are not given."""
    if name + ERROR not in rows.columns:
        return np.full(len(rows), np.nan)
    errors, measured = rows[name + ERROR], np.isfinite(rows[name])
    missing = measured & np.isnan(errors)
    if missing.any():
        rows.faults.add(
            f"{name + ERROR}: missing in {rows.named(missing)}, where {name} was measured; give it "
            "there, too, or leave the column out"
        )
    rows.refuse(name + ERROR, measured & (errors <= 0.0), "a standard deviation is positive")
    return np.where(measured, errors, np.nan)


def _check_sizes(rows: Results, pair: Pair) -> None:
    """Raise InputError for numbers, or errors of them, in a unit that cannot be theirs."""
    most = {"m/s": FASTEST, "rad/s": FASTEST / pair.first.radius}
    for name in rows.columns:
        unit = GLOSSARY[entry(name)].unit if entry(name) in GLOSSARY else ""
        rows.refuse(name, np.abs(rows[name]) > most.get(unit, LARGEST), "check its unit")


def _check_before(rows: Results, before: Mapping[str, Array], responses: Collection[str]) -> None:
    """Raise InputError if the motion before is missing, said twice, or out of range."""
    ways = [name for name in INCIDENCE if name in before]
    if not ways:
        rows.require("angle")
    if len(ways) > 1:
        raise InputError(
            f"data: {' and '.join(ways)} give the same twice; leave all but one of them out"
        )
    for name in ("speed", "normal_speed"):
        if name in before:
            rows.refuse(name, before[name] <= 0.0, "must be positive: the bodies must approach")
            rows.refuse(name, before[name] < SLOWEST, "check its unit")
    needing = sorted(set(SCALED) & {*before, *responses})
    if needing and not {"speed", "normal_speed"} & set(before):
        raise InputError(
            f"speed: column missing; {needing[0]} needs speed and angle, or normal_speed"
        )
    for name in before:
        if name + ERROR in rows.columns:
            negative = rows[name + ERROR] < 0.0
            rows.refuse(name + ERROR, negative, "a standard deviation is zero or positive")
            if name in ("speed", "normal_speed"):
                too_large = rows[name + ERROR] >= before[name]
                rows.refuse(name + ERROR, too_large, f"must be smaller than the {name} itself")


def _check_responses(rows: Results, motion: IncomingMotion, velocity: Array) -> None:
    """Raise InputError for responses that contradict the motion before, or are out of range."""
    for name in RELATIVE:
        if name in rows.columns:
            basis = motion.tangential_speed if name == RELATIVE[0] else velocity
            rested = np.abs(basis) <= NOTHING * motion.normal_speed
            allowed = (
                "the tangential velocity before is zero; write '-', or give tangential_speed_out"
            )
            rows.refuse(name, rested & np.isfinite(rows[name]), allowed)
    if "normal_restitution" in rows.columns:
        values = rows["normal_restitution"]
        rows.refuse(
            "normal_restitution",
            (values < 0.0) | (values > MOST),
            "must lie between 0 and 1, 0.98 for 98 percent",
        )
    if "normal_speed_out" in rows.columns:
        ratio = rows["normal_speed_out"] / motion.normal_speed
        allowed = "must be positive and, apart from scatter, no larger than the normal speed before"
        rows.refuse("normal_speed_out", (ratio < 0.0) | (ratio > MOST), allowed)
    _check_sense(rows, motion, velocity)


def _check_speed(problem: FitProblem) -> None:
    """Raise InputError for a speed after that takes more energy than there was before."""
    if "rebound_speed" not in problem.responses:
        return
    pair, motion, rows = problem.pair, problem.motion, problem.rows
    spins: Any = Tangential(*motion[1:])  # type: ignore[arg-type]
    turning = spins.spin_energy(pair) / (0.5 * pair.normal_mass)
    most = np.sqrt(motion.normal_speed**2 + motion.tangential_speed**2 + turning)
    ratio = rows["rebound_speed"] / most
    allowed = "must be positive and, apart from scatter, no larger than the energy before allows"
    rows.refuse("rebound_speed", (ratio < 0.0) | (ratio > MOST), allowed)


def _check_sense(rows: Results, motion: IncomingMotion, velocity: Array) -> None:
    """Raise InputError if friction drove the spin on in every row: its sign is another's."""
    if "spin_out" not in rows.columns:
        return
    change = (rows["spin_out"] - motion.spin) * np.sign(velocity)
    moving = np.isfinite(change) & (np.abs(velocity) > 0.05 * motion.normal_speed)
    if moving.sum() > 1 and np.all(change[moving] > 0.0):
        raise InputError(
            f"spin_out: friction would have speeded up the contact point in {rows.named(moving)}; "
            "positive spin adds to its tangential speed, so change the signs of the spins"
        )
