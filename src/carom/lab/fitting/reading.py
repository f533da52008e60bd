"""Measured rebounds as a user gives them to a fit, read and checked."""

import os
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from carom.bodies import observables
from carom.bodies.cases import check_case, pair_of
from carom.bodies.checks import alike, checked_pair
from carom.bodies.kinematics import Tangential, inertia
from carom.bodies.observables import BEFORE, NORMAL, OBSERVABLES
from carom.bodies.pairs import Pair
from carom.bodies.shapes import HalfSpace
from carom.dimensionless.numerics import hertz
from carom.dimensionless.rebound_tables import STORED_CHI
from carom.io.remedies import REMEDIES
from carom.io.tables import read_table
from carom.io.user_table import ERROR, UserTable, entry, in_units, others, with_errors
from carom.lab.fitting import bounces, plates
from carom.lab.fitting.bounces import about_air
from carom.lab.fitting.groups import GROUP
from carom.lab.fitting.plates import DURATION, THICKNESS
from carom.lab.fitting.problem import NO_SPEED, Bounces, FitProblem, IncomingMotion
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import Faults, InputError, refuse
from carom.quantities.units import WHY_POSITIVE

LARGEST = 1e9  # of what has no unit
NO_LARGER = "must be positive and, apart from scatter, no larger than {}"
TRACK = "track"  # whose names of tracks say which impact a row is
NEARLY = 0.1  # of a spin: so far outside of what friction allows it may be by scatter
ROUNDING = 1e-9  # rad
START_FRICTION = 0.3  # of bodies of which none is known
FROM_SURFACE = {"surface_angle": "angle", "surface_angle_out": "rebound_angle"}
UNSIGNED, SIGNED = "spin_out_magnitude", "spin_out"
NEVER_MISSING = ("surface_angle", "drop_height")
RECORDED = (*FROM_SURFACE, UNSIGNED, *bounces.BOUNCES)  # what is read as something else
NO_BODIES = (
    "pair: missing, and the data do not name the bodies; give pair=carom.Pair(...) in Python or "
    "--case FILE in a shell, or write the bodies as JSON into a comment '# case: {...}' of the file"
)
FAR_OFF = 30.0  # times: a contact time in another unit


def read_rebounds(data: Any, **how: Any) -> UserTable:
    """Return the cells of a table, which may have one column if that is times of bounces."""
    try:
        return read_table(data, lenient=True, **how)
    except InputError:
        if isinstance(data, str | Path) and os.path.isfile(data):  # it can be read again
            with suppress(InputError):
                table = read_table(data, lenient=True, fewest=1, **how)
                names = [*map(bounces.base, table.names)]
                if names in ([bounces.INTERVAL], [bounces.TIME]):
                    return table
        raise


def case_of_data(table: UserTable) -> Mapping[str, Any]:
    """Return the case that stands in the data, or raise InputError if there is none."""
    if table.case is None:
        raise InputError(NO_BODIES)
    check_case(table.case)
    return table.case


def read_problem(table: UserTable, pair: Pair | None) -> FitProblem:
    """Return what was measured, or raise InputError for all that cannot be used."""
    with Faults() as faults:
        return _problem(table.told(faults), pair)


def read_measurements(
    table: UserTable, more: Sequence[str] = ()
) -> tuple[UserTable, tuple[str, ...], list[str]]:
    """Return measurements in SI units, columns that mean nothing here, what is to be said of all.

    `more` are names of columns that are read as well.
    """
    names = with_errors((*BEFORE, *OBSERVABLES, *RECORDED, *more))
    table, later = bounces.parted(table)
    ignored = tuple(n for n in others(table, (*names, GROUP)) if n != TRACK)
    gaps = (*OBSERVABLES, *RECORDED, DURATION)
    may_miss = [name for name in gaps if name not in NEVER_MISSING]
    is_series = bool(later) or bounces.INTERVAL in table.names  # where an empty row parts two drops
    rows = in_units(table, names, may_miss, whole=is_series)
    rows, remarks = bounces.with_speeds(_from_normal(rows), later)
    return _with_magnitudes(rows), ignored, remarks


def _from_normal(rows: UserTable) -> UserTable:
    """Return the columns with angles from the normal in place of those from the surface."""
    columns = dict(rows.columns)
    for name in filter(columns.__contains__, FROM_SURFACE):
        angle = FROM_SURFACE[name]
        if angle in columns:
            raise InputError(f"{name}: it gives the same as {angle}; leave one of them out")
        is_out = angle == "rebound_angle"  # which may turn back
        most = "pi, 180 deg" if is_out else "pi/2, 90 deg"
        allowed = f"must lie between 0 and {most}; for degrees write '{name} [deg]'"
        far = columns[name] >= np.pi if is_out else columns[name] > 0.5 * np.pi + ROUNDING
        rows.refuse(name, (columns[name] <= 0.0) | far, allowed)
        columns[angle] = 0.5 * np.pi - columns[name]
        if name + ERROR in columns:
            columns[angle + ERROR] = columns[name + ERROR]
    return replace(rows, columns=columns)


def _with_magnitudes(rows: UserTable) -> UserTable:
    """Return the columns with magnitudes of spins where there is none with a sign."""
    columns = dict(rows.columns)
    if UNSIGNED not in columns:
        return rows
    signed = columns.get(SIGNED, np.full(len(rows), np.nan))
    both = np.isfinite(signed) & np.isfinite(rows[UNSIGNED])
    rows.refuse(UNSIGNED, rows[UNSIGNED] < 0.0, f"a magnitude is not negative; call it {SIGNED}")
    rows.refuse(UNSIGNED, both, f"{SIGNED} is there, too; leave one of them out")
    for end in (end for end in ("", ERROR) if UNSIGNED + end in columns):
        own = columns[UNSIGNED + end]
        signed = columns.get(SIGNED + end, np.nan * own)
        columns[SIGNED + end] = np.where(np.isnan(signed), own, signed)
    return replace(rows, columns=columns)


def with_signs(problem: FitProblem) -> tuple[FitProblem, list[str]]:
    """Return the problem with signs of spins that have none, and what is to be said of them.

    Friction opposes the slide and does no more than turn it, 0 <= J_t <= 2 m_t V_x, so that the
    spin afterwards lies between omega and omega - 2 m_t V_x R/I. Adds to the faults the rows in
    which both signs are possible, or neither is nearer.
    """
    rows, pair, ball = problem.rows, problem.pair, problem.pair.first
    if UNSIGNED not in rows.columns or SIGNED not in problem.responses:
        return problem, []
    own, spin = np.isfinite(rows[UNSIGNED]), problem.motion.spin
    size = np.where(own, rows[UNSIGNED], 0.0)
    turned = 2.0 * pair.tangential_mass * problem.contact_velocity * ball.radius / inertia(ball)
    low, high = np.minimum(spin, spin - turned), np.maximum(spin, spin - turned)
    up, down = (np.maximum(0.0, np.maximum(low - s, s - high)) for s in (size, -size))
    near, there = np.maximum(up, down) <= NEARLY * size, own & (size > 0.0)
    unsure = there & (near | (up == down))
    rows.refuse(UNSIGNED, unsure, f"both signs are possible there; give {SIGNED} with its sign")
    signs = np.where(up < down, 1.0, -1.0)
    column = np.where(own, signs * size, rows[SIGNED])
    measured = problem.measured.copy()
    measured[:, problem.responses.index(SIGNED)] = column
    rows = replace(rows, columns={**rows.columns, SIGNED: column})
    remarks = [
        f"{UNSIGNED}: {word} in {rows.named(there & which)}, as friction opposes the slide"
        for word, which in (("negative", signs < 0.0), ("positive", signs > 0.0))
        if np.any(there & which)
    ]
    return replace(problem, measured=measured, rows=rows), remarks


def _problem(table: UserTable, pair: Pair | None) -> FitProblem:
    of_plates, faults = _columns_of_plates(pair, table), table.faults
    rows, ignored, remarks = read_measurements(table, of_plates)
    possible = (*OBSERVABLES, *of_plates[1:])
    measured = tuple(name for name in possible if name in rows.columns)
    responses = tuple(name for name in measured if np.isfinite(rows[name]).any())
    if not responses:
        faults.settle()
        raise _unmeasured(table, measured, possible)
    empty = (f"{name} (no value in it)" for name in measured if name not in responses)
    bodies, knows_friction = _bodies(pair, table.case)
    if of_plates and THICKNESS in rows.columns:
        rows.refuse(THICKNESS, rows[THICKNESS] <= 0.0, "must be positive")
        faults.settle()
        bodies = plates.with_thickness(bodies, float(np.median(rows[THICKNESS])))
    dropped = [name for name in bounces.BOUNCES if name in rows.columns]
    if dropped and len(bodies.moving) > 1:
        raise InputError(
            f"{dropped[0]}: the second body flies off, too, so that bounces of the first do not "
            "give the speed at which they part; drop the ball on a half-space, or give "
            "normal_speed and normal_speed_out"
        )
    before = {name: rows[name] for name in (*BEFORE, THICKNESS) if name in rows.columns}
    is_open = "normal_speed" in before and not {*observables.INCIDENCE} & {*before}
    if is_open and {*responses} <= {*NORMAL, DURATION}:  # for which the normal speed suffices
        before["tangential_speed"] = np.zeros(len(rows))
    if (scaled := {*before, *responses} & {"psi_in", "psi_out"}) and not knows_friction:
        unit = f"{min(scaled)} is in units of it, so give that of the bodies"
        raise InputError(f"friction: missing; {unit}")
    _check_sizes(rows, bodies)
    _check_before(rows, before, responses, is_plate=bodies.thickness is not None)
    faults.settle()
    places, are_times = rows.columns.get(bounces.PLACE), bounces.TIME in rows.columns
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
        bounces=None if places is None else Bounces(places.astype(np.int64), are_times),
        trials=len(rows),
    )
    problem, signs = with_signs(problem)
    faults.settle()
    if "spin_out" not in responses and np.any(before.get("spin", 0.0)):
        remarks.append("spin: taken as that before the impact; that after it is spin_out")
    remarks += [*signs, *about_air(rows, {*dropped, *table.names}, bodies)]
    _check_responses(bodies, problem.rows, problem.motion, problem.contact_velocity)
    return replace(problem, remarks=tuple(remarks))


def _unmeasured(table: UserTable, measured: Sequence[str], possible: Sequence[str]) -> InputError:
    """Return the error that refuses data without a response."""
    if measured:
        return InputError(
            f"data: there is no value in {', '.join(measured)}; '-' means not measured"
        )
    remedy = REMEDIES.get().columns({"HEAD": "spin_out"})
    return InputError(
        f"data: no measured response among the columns {', '.join(table.names)}; there must be one "
        f"or more of {', '.join(possible)}, drop_height and rebound_height, bounce_interval or "
        f"bounce_time; if one has another name, {remedy}"
    )


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
        others = "pair: its bodies differ from those in the data; leave it, or --case, out"
        refuse(own is not None and not alike(pair, own) and others)
    bodies = own if pair is None else pair
    if bodies is None:
        raise InputError(NO_BODIES)
    least, most = STORED_CHI
    span = f"only one from {least:.2g} to {most:.2g}; check radii and gyration_radius"
    chi = f"pair: a chi of {bodies.chi:.3g} cannot be fitted, {span}"
    refuse(not least <= bodies.chi <= most and chi)
    rubs = bodies.friction > 0.0
    if not rubs:
        guess = START_FRICTION
        bodies = Pair(bodies.first, bodies.second, guess, roughness=bodies.roughness)
    return bodies, rubs


def _errors(rows: UserTable, name: str) -> Array:
    """Return the standard deviations of a response, NaN where they are not given."""
    if name + ERROR not in rows.columns:
        return np.full(len(rows), np.nan)
    errors, measured = rows[name + ERROR], np.isfinite(rows[name])
    if (missing := measured & np.isnan(errors)).any():
        where = f"{name + ERROR}: missing in {rows.named(missing)}, where {name} was measured"
        rows.faults.add(f"{where}; give it there, too, or leave the column out")
    rows.refuse(name + ERROR, measured & (errors <= 0.0), "a standard deviation is positive")
    return np.where(measured, errors, np.nan)


def _check_sizes(rows: UserTable, pair: Pair) -> None:
    """Raise InputError for numbers, or errors of them, in a unit that cannot be theirs."""
    most = {"m/s": observables.FASTEST, "rad/s": observables.FASTEST / pair.first.radius}
    for name in rows.columns:
        unit = GLOSSARY[entry(name)].unit if entry(name) in GLOSSARY else ""
        rows.refuse(name, np.abs(rows[name]) > most.get(unit, LARGEST), "check its unit")


def _check_before(
    rows: UserTable, before: Mapping[str, Array], responses: Collection[str], *, is_plate: bool
) -> None:
    """Raise InputError if the motion before is missing, said twice, or out of range."""
    ways = [name for name in observables.INCIDENCE if name in before]
    needing = sorted(observables.SCALED & {*before, *responses})
    needing += ["a plate"] * is_plate  # which gives way the more the faster it is struck
    head_on = (
        "angle: column missing; speed needs it; call the speeds of head-on impacts normal_speed"
    )
    if not ways and not rows.hinted.intersection((*observables.INCIDENCE, *FROM_SURFACE)):
        refuse("speed" in before and head_on)
        rows.require("angle")
    twice = f"data: {' and '.join(ways)} give the same twice; leave all but one of them out"
    refuse(len(ways) > 1 and twice)
    if needing and not {*WHY_POSITIVE} & {*before, *rows.hinted}:
        needs = f"{needing[0]} needs speed and angle, or normal_speed"
        raise InputError(f"speed: column missing; {needs}")
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
    spins: Any = Tangential(*motion[1:4])  # type: ignore[arg-type]
    turning = spins.spin_energy(pair) / (0.5 * pair.normal_mass)
    all_energy = np.sqrt(motion.normal_speed**2 + motion.tangential_speed**2 + turning)
    most = {
        "normal_restitution": (1.0, "must lie between 0 and 1, 0.98 for 98 percent"),
        "normal_speed_out": (motion.normal_speed, NO_LARGER.format("the normal speed before")),
        "rebound_speed": (all_energy, NO_LARGER.format("the energy before allows")),
    }
    for name in filter(rows.columns.__contains__, most):
        ratio = rows[name] / most[name][0]
        rows.refuse(name, (ratio < 0.0) | (ratio > bounces.MOST_RESTITUTION), most[name][1])
    if DURATION in rows.columns:
        usual = hertz.DURATION * np.asarray(pair.scales(motion.normal_speed).time)  # type: ignore[arg-type]
        off = np.abs(np.log(np.maximum(rows[DURATION], 1e-300) / usual)) > np.log(FAR_OFF)
        allowed = f"on a thick wall it is {GLOSSARY[DURATION].text(float(np.median(usual)), 3)}"
        rows.refuse(DURATION, off, f"{allowed}; check its unit")
    _check_sense(rows, motion, velocity)


def _check_sense(rows: UserTable, motion: IncomingMotion, velocity: Array) -> None:
    """Raise InputError if friction drove the spin on in every row: its sign is another's."""
    if "spin_out" not in rows.columns:
        return
    change = (rows["spin_out"] - motion.spin) * np.sign(velocity)
    moving = np.isfinite(change) & (np.abs(velocity) > 0.05 * motion.normal_speed)
    wrong = f"spin_out: friction would have speeded up the contact point in {rows.named(moving)}"
    cure = "positive spin adds to its tangential speed, so change the signs of the spins"
    refuse(moving.sum() > 1 and np.all(change[moving] > 0.0) and f"{wrong}; {cure}")
