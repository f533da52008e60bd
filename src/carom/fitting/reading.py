"""Measured rebounds as a user gives them to a fit, read and checked."""

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from carom.bodies.cases import check_case, pair_of
from carom.bodies.kinematics import Tangential
from carom.bodies.pairs import Pair, alike, checked_pair
from carom.bodies.shapes import HalfSpace
from carom.datasets import observables
from carom.datasets.observables import BEFORE, NORMAL, OBSERVABLES
from carom.dimensionless.numerics import hertz
from carom.dimensionless.rebound_tables import STORED_CHI
from carom.fitting import plates
from carom.fitting.plates import DURATION, THICKNESS
from carom.fitting.problem import NO_SPEED, FitProblem, IncomingMotion
from carom.impacts.validity import GRAVITY
from carom.io.tables import read_table
from carom.io.user_table import ERROR, UserTable, entry, in_units, others, with_errors
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import Faults, InputError
from carom.quantities.units import WHY_POSITIVE

MOST_RESTITUTION = 1.5  # that scatter may reach; beyond it is a percentage, or another unit
LARGEST = 1e9  # of what has no unit
NO_LARGER = "must be positive and, apart from scatter, no larger than {}"
START_FRICTION = 0.3  # of bodies of which none is known
HEIGHTS = {"drop_height": "normal_speed", "rebound_height": "normal_speed_out"}
TWICE = ("speed", "angle", "tangential_speed", "contact_angle", "psi_in", "normal_restitution")
DRAG, AIR = 0.45, 1.2  # drag coefficient of a sphere at Reynolds numbers of 1e3 to 1e5; kg/m^3
NO_BODIES = (
    "pair: missing, and the data do not name the bodies; give pair=carom.Pair(...) in Python or "
    "--case FILE in a shell, or write the bodies as JSON into a comment '# case: {...}' of the file"
)
FAR_OFF = 30.0  # times: a contact time in another unit


def case_of_data(data: Any) -> Mapping[str, Any]:
    """Return the case that stands in the data, or raise InputError if there is none."""
    case = read_table(data, None).case
    if case is None:
        raise InputError(NO_BODIES)
    check_case(case)
    return case


def read_problem(
    data: Any, pair: Pair | None, columns: Mapping[str, str] | None = None
) -> FitProblem:
    """Return what was measured, or raise InputError for all that cannot be used."""
    table = read_table(data, columns)
    with Faults() as faults:
        return _problem(table, pair, faults)


def read_measurements(
    table: UserTable, faults: Faults | None = None, more: Sequence[str] = ()
) -> tuple[UserTable, tuple[str, ...]]:
    """Return measurements in SI units, with speeds of drops, and what the table holds besides.

    `more` are names of columns that are read as well.
    """
    names = with_errors((*BEFORE, *OBSERVABLES, *HEIGHTS, *more))
    ignored = others(table, names, faults)
    rows = in_units(table, names, (*OBSERVABLES, "rebound_height", DURATION), faults)
    return with_speeds(rows), ignored


def _problem(table: UserTable, pair: Pair | None, faults: Faults) -> FitProblem:
    of_plates = _columns_of_plates(pair, table)
    rows, ignored = read_measurements(table, faults, of_plates)
    possible = (*OBSERVABLES, *of_plates[1:])
    measured = tuple(name for name in possible if name in rows.columns)
    responses = tuple(name for name in measured if np.isfinite(rows[name]).any())
    if not responses:
        faults.settle()
        raise InputError(
            f"data: there is no value in {', '.join(measured)}; '-' means not measured"
            if measured
            else f"data: no measured response among the columns {', '.join(table.names)}; there "
            f"must be one or more of {', '.join(possible)}, or drop_height and rebound_height"
        )
    empty = (f"{name} (no value in it)" for name in measured if name not in responses)
    bodies, knows_friction = _bodies(pair, table.case)
    if of_plates and THICKNESS in rows.columns:
        rows.refuse(THICKNESS, rows[THICKNESS] <= 0.0, "must be positive")
        faults.settle()
        bodies = plates.with_thickness(bodies, float(np.median(rows[THICKNESS])))
    if "drop_height" in rows.columns and len(bodies.moving) > 1:
        raise InputError(
            "drop_height: the second body flies off, too, so that the heights of the first do not "
            "give the speed at which they part; drop the ball on a half-space, or give "
            "normal_speed and normal_speed_out"
        )
    before = {name: rows[name] for name in (*BEFORE, THICKNESS) if name in rows.columns}
    is_open = "normal_speed" in before and not {*observables.INCIDENCE} & {*before}
    if is_open and {*responses} <= {*NORMAL, DURATION}:  # for which the normal speed suffices
        before["tangential_speed"] = np.zeros(len(rows))
    if (scaled := {*before, *responses} & {"psi_in", "psi_out"}) and not knows_friction:
        raise InputError(
            f"friction: missing; {min(scaled)} is in units of it, so give that of the bodies"
        )
    _check_sizes(rows, bodies)
    _check_before(rows, before, responses)
    faults.settle()
    if bodies.thickness is not None and not {*WHY_POSITIVE} & {*before}:
        raise InputError(
            "speed: column missing; how far a plate gives way depends on the speed, so add speed "
            "and angle, or normal_speed"
        )
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


def _columns_of_plates(pair: Pair | None, table: UserTable) -> tuple[str, ...]:
    """Return the columns that only rebounds from a plate have, if there is one."""
    with suppress(InputError):  # which is told later
        wall = _bodies(pair, table.case)[0].second
        named = THICKNESS in table.names
        if isinstance(wall, HalfSpace) and (named or wall.thickness is not None):
            return THICKNESS, DURATION
    return ()


def _bodies(pair: Pair | None, case: Mapping[str, Any] | None) -> tuple[Pair, bool]:
    """Return the bodies, and whether their friction is known; otherwise it is a guess."""
    own = None
    if case is not None:
        check_case(case)
        own = pair_of({"friction": 0.0, **case})
    if pair is not None:
        checked_pair(pair, plates=True)
        if own is not None and pair.thickness is not None and isinstance(own.second, HalfSpace):
            own = plates.with_thickness(own, pair.thickness)  # as its friction, of no account
        if own is not None and not alike(pair, own):
            raise InputError(
                "pair: its bodies differ from those in the data; leave it, or --case, out"
            )
    bodies = own if pair is None else pair
    if bodies is None:
        raise InputError(NO_BODIES)
    least, most = STORED_CHI
    if not least <= bodies.chi <= most:
        raise InputError(
            f"pair: a chi of {bodies.chi:.3g} cannot be fitted, only one from {least:.2g} to "
            f"{most:.2g}; check radii and gyration_radius"
        )
    rubs = bodies.friction > 0.0
    return bodies if rubs else Pair(bodies.first, bodies.second, START_FRICTION), rubs


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
    most = {"m/s": observables.FASTEST, "rad/s": observables.FASTEST / pair.first.radius}
    for name in rows.columns:
        unit = GLOSSARY[entry(name)].unit if entry(name) in GLOSSARY else ""
        rows.refuse(name, np.abs(rows[name]) > most.get(unit, LARGEST), "check its unit")


def _check_before(rows: UserTable, before: Mapping[str, Array], responses: Collection[str]) -> None:
    """Raise InputError if the motion before is missing, said twice, or out of range."""
    ways = [name for name in observables.INCIDENCE if name in before]
    needing = sorted(observables.SCALED & {*before, *responses})
    if not ways and "speed" in before:
        head_on = "call the speeds of head-on impacts normal_speed"
        raise InputError(f"angle: column missing; speed needs it; {head_on}")
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
        rows.refuse(name, before[name] < observables.SLOWEST, "check its unit")
    for name in before:
        if (error := name + ERROR) in rows.columns:
            rows.refuse(error, rows[error] < 0.0, "a standard deviation is zero or positive")
            if name in (*WHY_POSITIVE, THICKNESS):
                too_large = rows[error] >= before[name]
                rows.refuse(error, too_large, f"must be smaller than the {name} itself")


def _check_responses(pair: Pair, rows: UserTable, motion: IncomingMotion, velocity: Array) -> None:
    """Raise InputError for responses that contradict the motion before, or are out of range."""
    for name in filter(rows.columns.__contains__, observables.RELATIVE):
        basis = velocity if name.startswith("contact") else motion.tangential_speed
        rested = np.abs(basis) <= NO_SPEED * motion.normal_speed
        allowed = "the tangential velocity before is zero; write '-', or give tangential_speed_out"
        rows.refuse(name, rested & np.isfinite(rows[name]), allowed)
    most = {
        "normal_restitution": (1.0, "must lie between 0 and 1, 0.98 for 98 percent"),
        "normal_speed_out": (motion.normal_speed, NO_LARGER.format("the normal speed before")),
        "rebound_speed": (_most_speed(pair, motion), NO_LARGER.format("the energy before allows")),
    }
    for name in filter(rows.columns.__contains__, most):
        ratio = rows[name] / most[name][0]
        rows.refuse(name, (ratio < 0.0) | (ratio > MOST_RESTITUTION), most[name][1])
    if DURATION in rows.columns:
        usual = hertz.DURATION * np.asarray(pair.scales(motion.normal_speed).time)  # type: ignore[arg-type]
        off = np.abs(np.log(np.maximum(rows[DURATION], 1e-300) / usual)) > np.log(FAR_OFF)
        allowed = f"on a thick wall it is {GLOSSARY[DURATION].text(float(np.median(usual)), 3)}"
        rows.refuse(DURATION, off, f"{allowed}; check its unit")
    _check_sense(rows, motion, velocity)


def _most_speed(pair: Pair, motion: IncomingMotion) -> Array:
    """Return the speed of the centre that would take all of the energy before."""
    spins: Any = Tangential(*motion[1:4])  # type: ignore[arg-type]
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


def with_speeds(rows: UserTable) -> UserTable:
    """Return the columns with the speeds of drops, V = sqrt(2 g h) and V' = sqrt(2 g h')."""
    there = [name for name in HEIGHTS if name in rows.columns]
    if not there:
        return rows
    rows.require("drop_height")
    twice = [name for name in (*TWICE, *HEIGHTS.values()) if name in rows.columns]
    if twice:
        raise InputError(f"{there[0]}: it gives the same as {twice[0]}; leave one of them out")
    columns = dict(rows.columns)
    for height, speed in HEIGHTS.items():
        if height in columns:
            rows.refuse(height, columns[height] <= 0.0, "must be positive")
            values = np.where(columns[height] > 0.0, columns[height], np.nan)
            columns[speed] = np.sqrt(2.0 * GRAVITY * values)
        if height + ERROR in columns:
            with np.errstate(divide="ignore", invalid="ignore"):
                columns[speed + ERROR] = GRAVITY * columns[height + ERROR] / columns[speed]
    columns["tangential_speed"] = np.zeros(len(rows))
    if "rebound_height" in columns:
        too_high = columns["normal_speed_out"] > MOST_RESTITUTION * columns["normal_speed"]
        allowed = "must, apart from scatter, be no larger than drop_height"
        rows.refuse("rebound_height", too_high, allowed)
    return replace(rows, columns=columns)


def taken_by_air(heights: Mapping[str, Array], radius: float, mass: float) -> float:
    """Return by which part of itself a restitution from heights is too small, to first order.

    e = sqrt(h'/h) (1 + k (h + h')/4), k = C_d rho pi R^2/m, in air.
    """
    k = DRAG * AIR * np.pi * radius**2 / mass
    whole = heights["drop_height"] + heights["rebound_height"]
    return float(0.25 * k * np.nanmedian(whole))
