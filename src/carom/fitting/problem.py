"""What was measured, read and checked: rows of motion before, responses after, their errors."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.cases import pair_of
from carom.fitting.checks import NOTHING, check_before, check_responses
from carom.fitting.prediction import Motion
from carom.observables import BEFORE, OBSERVABLES, SCALED, convert
from carom.pairs import Pair
from carom.quantities import InputError, refusal
from carom.readings import ERROR, Results, in_units, others, read_table, with_errors

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

START = 0.3  # friction of bodies of which none is known, to begin with
STEEPEST = np.radians(89.9)


@dataclass(frozen=True, eq=False)
class Problem:
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
    def motion(self) -> Motion:
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

    def moved(self, changes: Mapping[str, Array]) -> Motion:
        """Return the motion before with some of its columns changed by so much."""
        known = {name: values + changes.get(name, 0.0) for name, values in self.before.items()}
        if "angle" in known:
            known["angle"] = np.clip(known["angle"], -STEEPEST, STEEPEST)
        if not self.has_speeds:
            known["normal_speed"] = np.ones(len(self.measured))
        speeds = (
            convert(self.pair, known=known, wanted=name)
            for name in ("normal_speed", "tangential_speed")
        )
        spins = (known.get(name, np.zeros(len(self.measured))) for name in ("spin", "spin2"))
        return Motion(*speeds, *spins)

    @cached_property
    def shaken(self) -> tuple[tuple[Motion, Motion], ...]:
        """The motion with each of its uncertain columns one standard deviation up, and down."""
        return tuple(
            (self.moved({name: error}), self.moved({name: -error}))
            for name, error in self.before_errors.items()
        )


def read_problem(data: Any, pair: Pair | None) -> Problem:
    """Return what was measured, or raise InputError for what cannot be used."""
    table = read_table(data)
    known = with_errors((*BEFORE, *OBSERVABLES))
    ignored = others(table, known)
    rows = in_units(table, [name for name in known if name in table.names], gaps=OBSERVABLES)
    responses = tuple(name for name in OBSERVABLES if name in rows.columns)
    if not responses:
        raise InputError(
            f"data: no measured response among the columns {', '.join(table.names)}; there must be "
            f"one or more of {', '.join(OBSERVABLES)}"
        )
    bodies = _bodies(pair, table.case)
    before = {name: rows[name] for name in BEFORE if name in rows.columns}
    check_before(rows, before, responses, SCALED)
    problem = Problem(
        pair=bodies,
        before=before,
        before_errors={name: rows[name + ERROR] for name in before if name + ERROR in rows.columns},
        responses=responses,
        measured=np.stack([rows[name] for name in responses], axis=-1),
        errors=np.stack([_errors(rows, name) for name in responses], axis=-1),
        rows=rows,
        ignored=ignored,
        doi=table.comments.get("doi", ""),
    )
    check_responses(problem.rows, problem.motion, problem.contact_velocity)
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
    if bodies.friction > 0.0:
        return bodies
    return Pair(bodies.first, bodies.second, START)


def _errors(rows: Results, name: str) -> Array:
    """Return the standard deviations of a response, NaN where they are not given."""
    unknown = np.full(len(rows), np.nan)
    errors = np.asarray(rows.get(name + ERROR, unknown))
    rows_with = np.isfinite(rows[name])
    if name + ERROR in rows.columns:
        rows.refuse(name + ERROR, rows_with & ~(errors > 0.0), "a standard deviation is positive")
    return np.where(rows_with, errors, np.nan)
