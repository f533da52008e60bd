"""Measurements read and checked: what contradicts itself, or has another unit, is refused."""

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from carom.bodies.cases import check_case, pair_of
from carom.bodies.kinematics import Tangential
from carom.bodies.pairs import Pair, alike, checked_pair
from carom.datasets.observables import (
    BEFORE,
    FASTEST,
    INCIDENCE,
    OBSERVABLES,
    RELATIVE,
    SCALED,
    SLOWEST,
)
from carom.dimensionless.rebound_tables import STORED_CHI
from carom.fitting.heights import HEIGHTS, with_speeds
from carom.fitting.laws import IncomingMotion
from carom.fitting.problem import NOTHING, FitProblem
from carom.io.columns import ERROR, entry, in_units, others, with_errors
from carom.io.tables import read_table
from carom.io.user_table import UserTable
from carom.quantities.arrays import Array
from carom.quantities.faults import Faults
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError
from carom.quantities.units import WHY_POSITIVE

MOST = 1.5  # restitution that scatter may reach; beyond it is a percentage, or another unit
LARGEST = 1e9  # of what has no unit
NO_LARGER = "must be positive and, apart from scatter, no larger than {}"
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


def read_measurements(
    table: UserTable, faults: Faults | None = None
) -> tuple[UserTable, tuple[str, ...]]:
    """Return a table of measurements in SI units, with speeds of drops, and what it holds besides.

    Adds to the faults what no bodies make right: cells, units and names of columns.
    """
    known = with_errors((*BEFORE, *OBSERVABLES, *HEIGHTS))
    ignored = others(table, known, faults)
    rows = in_units(table, known, (*OBSERVABLES, "rebound_height"), faults)
    return with_speeds(rows), ignored


def _problem(table: UserTable, pair: Pair | None, faults: Faults) -> FitProblem:
    rows, ignored = read_measurements(table, faults)
    measured = tuple(name for name in OBSERVABLES if name in rows.columns)
    responses = tuple(name for name in measured if np.isfinite(rows[name]).any())
    if not responses:
        faults.settle()
        raise InputError(
            f"data: there is no value in {', '.join(measured)}; '-' means not measured"
            if measured
            else f"data: no measured response among the columns {', '.join(table.names)}; there "
            f"must be one or more of {', '.join(OBSERVABLES)}, or drop_height and rebound_height"
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
    _check_responses(bodies, rows, problem.motion, problem.contact_velocity)
    return problem


def _bodies(pair: Pair | None, case: Mapping[str, Any] | None) -> tuple[Pair, bool]:
    """Return the bodies, and whether their friction is known; otherwise it is a guess."""
    own = None if case is None else _bodies_of(case)
    if pair is not None:
        checked_pair(pair)
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


def _errors(rows: UserTable, name: str) -> Array:
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


def _check_sizes(rows: UserTable, pair: Pair) -> None:
    """Raise InputError for numbers, or errors of them, in a unit that cannot be theirs."""
    most = {"m/s": FASTEST, "rad/s": FASTEST / pair.first.radius}
    for name in rows.columns:
        unit = GLOSSARY[entry(name)].unit if entry(name) in GLOSSARY else ""
        rows.refuse(name, np.abs(rows[name]) > most.get(unit, LARGEST), "check its unit")


def _check_before(rows: UserTable, before: Mapping[str, Array], responses: Collection[str]) -> None:
    """Raise InputError if the motion before is missing, said twice, or out of range."""
    ways = [name for name in INCIDENCE if name in before]
    needing = sorted(set(SCALED) & {*before, *responses})
    if not ways:
        rows.require("angle")
    if len(ways) > 1:
        raise InputError(
            f"data: {' and '.join(ways)} give the same twice; leave all but one of them out"
        )
    if needing and not {*WHY_POSITIVE} & {*before}:
        raise InputError(
            f"speed: column missing; {needing[0]} needs speed and angle, or normal_speed"
        )
    for name in filter(before.__contains__, WHY_POSITIVE):
        rows.refuse(name, before[name] < SLOWEST, "check its unit")
    for name in before:
        if (error := name + ERROR) in rows.columns:
            rows.refuse(error, rows[error] < 0.0, "a standard deviation is zero or positive")
            if name in WHY_POSITIVE:
                too_large = rows[error] >= before[name]
                rows.refuse(error, too_large, f"must be smaller than the {name} itself")


def _check_responses(pair: Pair, rows: UserTable, motion: IncomingMotion, velocity: Array) -> None:
    """Raise InputError for responses that contradict the motion before, or are out of range."""
    for name in filter(rows.columns.__contains__, RELATIVE):
        basis = velocity if name.startswith("contact") else motion.tangential_speed
        rested = np.abs(basis) <= NOTHING * motion.normal_speed
        allowed = "the tangential velocity before is zero; write '-', or give tangential_speed_out"
        rows.refuse(name, rested & np.isfinite(rows[name]), allowed)
    most = {
        "normal_restitution": (1.0, "must lie between 0 and 1, 0.98 for 98 percent"),
        "normal_speed_out": (motion.normal_speed, NO_LARGER.format("the normal speed before")),
        "rebound_speed": (_most_speed(pair, motion), NO_LARGER.format("the energy before allows")),
    }
    for name in filter(rows.columns.__contains__, most):
        ratio = rows[name] / most[name][0]
        rows.refuse(name, (ratio < 0.0) | (ratio > MOST), most[name][1])
    _check_sense(rows, motion, velocity)


def _most_speed(pair: Pair, motion: IncomingMotion) -> Array:
    """Return the speed of the centre that would take all of the energy before."""
    spins: Any = Tangential(*motion[1:])  # type: ignore[arg-type]
    turning = spins.spin_energy(pair) / (0.5 * pair.normal_mass)
    most: Array = np.sqrt(motion.normal_speed**2 + motion.tangential_speed**2 + turning)
    return most


def _check_sense(rows: UserTable, motion: IncomingMotion, velocity: Array) -> None:
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
