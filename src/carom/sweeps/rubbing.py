"""Many impacts of one pair side by side: what friction does in each, and a status for each."""

from collections.abc import Mapping
from math import nan
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.kinematics import Tangential, components
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair, check_second_spin
from carom.bodies.shapes import Sphere
from carom.impacts.outcome import Outcome
from carom.impacts.wear import rubbed
from carom.io.progress import Progress, advancing
from carom.quantities.arrays import Array, along_the_same, numbers, together
from carom.quantities.refusals import InputError
from carom.sweeps.points import (
    BlockSolution,
    Codes,
    PointStatus,
    approaches,
    solve_elastic,
    solve_with_losses,
)

REALS = "give real numbers, one or an array of them"
HUGE = 1e250  # N m; per area it is more
BLOCK = 20_000  # impacts that are solved before progress is told


class Many(NamedTuple):
    """Impacts of one pair side by side: how they meet and how often, and what comes of each.

    `rubbed` is the integral of pressure times slip rate in N m, `radii` the largest of the contact.
    """

    columns: dict[str, Array]
    counts: Array
    status: Codes
    rubbed: Array
    radii: Array

    @property
    def solved(self) -> Any:
        """Which of them are solved."""
        return self.status == PointStatus.SOLVED

    def part(self, which: slice) -> "Many":
        """Return some of the impacts; what is written there is written here."""
        columns = {name: values[which] for name, values in self.columns.items()}
        counts, status = self.counts[which], self.status[which]
        return Many(columns, counts, status, self.rubbed[which], self.radii[which])

    @property
    def total(self) -> float:
        """What all solved impacts rub, each as often as it happens, in N m; NaN if none is."""
        if self.status.size and not self.solved.any():
            return nan
        return float(self.rubbed[self.solved] @ self.counts[self.solved])


def read_columns(pair: Pair, motion: dict[str, ArrayLike | None]) -> dict[str, Array]:
    """Return what was given as lines of one length, by name, or raise InputError."""
    by_speed = motion["speed"] is not None
    if by_speed == (motion["normal_speed"] is not None):
        raise InputError("speed: give speed and angle, or normal_speed and tangential_speed")
    for name in ("normal_speed", "tangential_speed") if by_speed else ("angle",):
        if motion.pop(name) is not None:
            raise InputError(f"{name}: give speed and angle, or normal_speed and tangential_speed")
    motion.pop("normal_speed" if by_speed else "speed", None)
    given = {name: 0.0 if value is None else value for name, value in motion.items()}
    along_the_same(**given)
    read = {name: numbers(name, value, REALS, gaps=True) for name, value in given.items()}
    check_second_spin(pair, given["spin2"], spins=bool(read["spin2"].any()))
    shape = together(read)
    if not isinstance(pair.second, Sphere):
        del read["spin2"]
    return {name: np.broadcast_to(values, shape).ravel() for name, values in read.items()}


def motion_of(columns: Mapping[str, Any]) -> tuple[Any, Any]:
    """Return normal speeds and tangential motions."""
    if "speed" in columns:
        normal, tangential = components(columns["speed"], columns["angle"])
    else:
        normal, tangential = columns["normal_speed"], columns["tangential_speed"]
    return normal, Tangential(
        tangential, columns["spin"], columns.get("spin2", np.zeros_like(normal))
    )


def solve_all(
    pair: Pair, columns: dict[str, Array], losses: LossLaw | None, progress: Progress
) -> Many:
    """Return all impacts with what each of them rubs, and a status for each."""
    counts = columns.pop("counts")
    status = np.full(counts.size, PointStatus.NOT_RUN, dtype=np.int8)
    nothing = np.full(counts.size, np.nan)
    many = Many(columns, counts, status, nothing, nothing.copy())
    with advancing("solving the impacts", counts.size, progress, unit="impacts") as advance:
        for start in range(0, counts.size, BLOCK):
            part = slice(start, start + BLOCK)
            with np.errstate(all="ignore"):
                _fill(pair, losses, many.part(part))
            advance(many.status[part].size)
    return many


def _fill(pair: Pair, losses: LossLaw | None, block: Many) -> None:
    """Solve a block of impacts and write what comes of it."""
    normal, motion = motion_of(block.columns)
    size = block.counts.size
    told = np.full((1 if losses is None else len(BlockSolution._fields), size), np.nan)
    solution = BlockSolution(*told)
    tangential, spin, spin2 = motion
    outcome = Outcome(pair, normal, tangential, spin, spin2, solution)
    block.status[:] = _status(block.columns, block.counts, outcome)
    if losses is None:
        solve_elastic(outcome, solution, block.status, None)
    else:
        solve_with_losses(outcome, losses, solution, block.status, None)
    found = np.asarray(rubbed(outcome), dtype=np.float64)
    block.status[block.solved & ~(found < HUGE)] = PointStatus.BEYOND_FLOATING_POINT
    block.rubbed[block.solved] = found[block.solved]
    block.radii[block.solved] = np.asarray(outcome.max_radius)[block.solved]


def _status(columns: Mapping[str, Array], counts: Array, outcome: Outcome) -> Codes:
    """Return what is known before solving; of two faults the one that is marked later."""
    status = np.full(counts.size, PointStatus.SOLVED, dtype=np.int8)
    status[~np.broadcast_to(outcome.fits, status.shape)] = PointStatus.BEYOND_FLOATING_POINT
    status[~(counts >= 0.0)] = PointStatus.OUT_OF_RANGE
    status[~approaches(columns)] = PointStatus.NOT_APPROACHING
    for values in (*columns.values(), counts):
        status[~np.isfinite(values)] = PointStatus.NOT_A_NUMBER
    return status
