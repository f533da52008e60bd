"""What was measured, read and checked: rows of motion before, responses after, their errors."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies.cases import pair_of
from carom.bodies.pairs import Pair
from carom.datasets.observables import BEFORE, OBSERVABLES, SCALED, convert
from carom.fitting.interpolation import LEAST_CHI, MOST_CHI
from carom.fitting.laws import IncomingMotion
from carom.io.columns import ERROR, Results, in_units, others, with_errors
from carom.io.tables import read_table
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.units import InputError, refusal

Mask = NDArray[np.bool_]

MOST = 1.5  # normal restitution that scatter may reach; beyond it is a percentage
NOTHING = 1e-9  # part of the speed that is no tangential speed
RELATIVE = ("tangential_restitution", "contact_restitution", "contact_beta")
START = 0.3  # friction of bodies of which none is known, to begin with
STEEPEST = np.radians(89.9)


@dataclass(frozen=True, eq=False)
class FitProblem:
    """Measured rebounds in SI units: `measured` and `errors` have the shape (rows, responses).

    NaN stands for what was not measured, and for errors that are not known; `doi` is that of the
    publication, if the data tell it.
    """

    pair: Pair
    before: Mapping[str, Array]
    before_errors: Mapping[str, Array]
    responses: tuple[str, ...]
    measured: Array
    errors: Array
    rows: Results
    ignored: tuple[str, ...] = ()
    doi: str = ""

    @property
    def present(self) -> Mask:
        """Where there is a measured value."""
        return np.isfinite(self.measured)

    @property
    def count(self) -> int:
        """The number of measured values."""
        return int(self.present.sum())

    @property
    def all_errors_known(self) -> bool:
        """Whether every measured value has a standard deviation."""
        return bool(np.all(np.isfinite(self.errors) | ~self.present))

    @property
    def has_speeds(self) -> bool:
        """Whether speeds are known, not only ratios of them."""
        return bool({"speed", "normal_speed"} & set(self.before))

    @property
    def is_normal(self) -> bool:
        """Whether every impact is a normal one, and nothing moves sideways."""
        sideways = np.abs(self.contact_velocity) > NOTHING * self.motion.normal_speed
        return not bool(sideways.any())

    @cached_property
    def motion(self) -> IncomingMotion:
        """The motion before, as it was measured."""
        return self.moved({})

    @cached_property
    def contact_velocity(self) -> Array:
        """Tangential velocity of the contact point before."""
        motion = self.motion
        radius2 = self.pair.moving[1].radius if len(self.pair.moving) > 1 else 0.0
        return (
            motion.tangential_speed + self.pair.first.radius * motion.spin + radius2 * motion.spin2
        )

    @cached_property
    def sizes(self) -> Array:
        """What each response is of the order of: 1, the speed, or the spin that rolls with it."""
        motion = self.motion
        speed = float(np.median(np.hypot(motion.normal_speed, motion.tangential_speed)))
        units = {"rad/s": speed / self.pair.first.radius, "m/s": speed}
        return np.array([units.get(GLOSSARY[name].unit, 1.0) for name in self.responses])

    def moved(self, changes: Mapping[str, Array]) -> IncomingMotion:
        """Return the motion before with some of its columns changed by so much."""
        known = {name: values + changes.get(name, 0.0) for name, values in self.before.items()}
        for name in {"angle", "contact_angle"} & set(known):
            known[name] = np.clip(known[name], -STEEPEST, STEEPEST)
        if not self.has_speeds:
            known["normal_speed"] = np.ones(len(self.measured))
        speeds = (
            convert(self.pair, known=known, wanted=name)
            for name in ("normal_speed", "tangential_speed")
        )
        spins = (known.get(name, np.zeros(len(self.measured))) for name in ("spin", "spin2"))
        return IncomingMotion(*speeds, *spins)

    @cached_property
    def shaken(self) -> tuple[tuple[IncomingMotion, IncomingMotion], ...]:
        """The motion with each of its uncertain columns one standard deviation up, and down."""
        return tuple(
            (self.moved({name: error}), self.moved({name: -error}))
            for name, error in self.before_errors.items()
        )


def read_problem(data: Any, pair: Pair | None) -> FitProblem:
    """Return what was measured, or raise InputError for what cannot be used."""
    table = read_table(data)
    known = with_errors((*BEFORE, *OBSERVABLES))
    ignored = others(table, known)
    rows = in_units(table, [name for name in known if name in table.names], gaps=OBSERVABLES)
    measured = tuple(name for name in OBSERVABLES if name in rows.columns)
    responses = tuple(name for name in measured if np.isfinite(rows[name]).any())
    if not measured:
        raise InputError(
            f"data: no measured response among the columns {', '.join(table.names)}; there must be "
            f"one or more of {', '.join(OBSERVABLES)}"
        )
    if not responses:
        raise InputError(f"data: no value in {', '.join(measured)}; '-' is what was not measured")
    empty = (f"{name} (no value in it)" for name in measured if name not in responses)
    bodies = _bodies(pair, table.case)
    before = {name: rows[name] for name in BEFORE if name in rows.columns}
    _check_before(rows, before, responses)
    problem = FitProblem(
        pair=bodies,
        before=before,
        before_errors={name: rows[name + ERROR] for name in before if name + ERROR in rows.columns},
        responses=responses,
        measured=np.stack([rows[name] for name in responses], axis=-1),
        errors=np.stack([_errors(rows, name) for name in responses], axis=-1),
        rows=rows,
        ignored=(*ignored, *empty),
        doi=table.comments.get("doi", ""),
    )
    _check_responses(problem.rows, problem.motion, problem.contact_velocity)
    return problem


def _bodies(pair: Pair | None, case: Mapping[str, Any] | None) -> Pair:
    if pair is not None:
        if not isinstance(pair, Pair):
            raise refusal("pair", pair, "must be a Pair of bodies; make one with carom.Pair")
        bodies = pair
    elif case is not None:
        bodies = pair_of({"friction": START, **case})
    else:
        raise InputError(
            "pair: missing, and the data hold no case; give pair=carom.Pair(...) in Python or "
            "--case FILE in a shell, or write the bodies as JSON into a comment '# case: {...}' "
            "of the file"
        )
    if not LEAST_CHI <= bodies.chi <= MOST_CHI:
        raise InputError(
            f"pair: chi of {bodies.chi:.3g} cannot be fitted, curves are known from "
            f"{LEAST_CHI:.2g} to {MOST_CHI:.2g}; check radii and gyration_radius"
        )
    return bodies if bodies.friction > 0.0 else Pair(bodies.first, bodies.second, START)


def _errors(rows: Results, name: str) -> Array:
    """Return the standard deviations of a response, NaN where they are not given."""
    if name + ERROR not in rows.columns:
        return np.full(len(rows), np.nan)
    errors, measured = rows[name + ERROR], np.isfinite(rows[name])
    missing = measured & np.isnan(errors)
    if missing.any():
        raise InputError(
            f"{name + ERROR}: missing in {rows.named(missing)}, where {name} was measured; give it "
            "there, too, or leave the column out"
        )
    rows.refuse(name + ERROR, measured & ~(errors > 0.0), "a standard deviation is positive")
    return np.where(measured, errors, np.nan)


def _check_before(rows: Results, before: Mapping[str, Array], responses: Collection[str]) -> None:
    """Raise InputError if the motion before is missing, said twice, or out of range."""
    ways = [n for n in ("tangential_speed", "angle", "contact_angle", "psi_in") if n in before]
    if not ways:
        rows.require("angle")
    if len(ways) > 1:
        raise InputError(
            f"data: {' and '.join(ways)} say the same twice; leave all but one of them out"
        )
    for name in ("speed", "normal_speed"):
        if name in before:
            rows.refuse(name, before[name] <= 0.0, "must be positive: the bodies must approach")
    needing = sorted(set(SCALED) & {*before, *responses})
    if needing and not {"speed", "normal_speed"} & set(before):
        raise InputError(
            f"speed: column missing; {needing[0]} needs speed and angle, or normal_speed"
        )
    for name in before:
        if name + ERROR in rows.columns:
            negative = ~(rows[name + ERROR] >= 0.0)
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
            allowed = "nothing moved sideways there before; write '-', or give tangential_speed_out"
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
        allowed = "must be positive and no larger than the normal speed before, but for scatter"
        rows.refuse("normal_speed_out", (ratio < 0.0) | (ratio > MOST), allowed)
    _check_sense(rows, motion, velocity)


def _check_sense(rows: Results, motion: IncomingMotion, velocity: Array) -> None:
    """Raise InputError if friction drove the spin on in every row: its sign is another's."""
    if "spin_out" not in rows.columns:
        return
    change = (rows["spin_out"] - motion.spin) * np.sign(velocity)
    moving = np.isfinite(change) & (np.abs(velocity) > 0.05 * motion.normal_speed)
    if moving.sum() > 1 and np.all(change[moving] > 0.0):
        raise InputError(
            f"spin_out: friction would have driven the contact point on in {rows.named(moving)}; "
            "positive spin adds to its tangential speed, so change the signs of the spins"
        )
