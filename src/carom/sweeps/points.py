"""Impacts of many points at once: bodies whose numbers are arrays, and a status for each point."""

from collections.abc import Callable, Mapping, Sequence
from math import pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.cases import RATIO, law_of
from carom.bodies.kinematics import components
from carom.bodies.losses import SMALLEST_RESTITUTION, STIFFEST, LossLaw
from carom.bodies.materials import STRENGTHS, Material, unchecked
from carom.bodies.pairs import Counterbody, Pair
from carom.bodies.shapes import Cup, HalfSpace, Sphere
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import LossNumbers
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.numerics import hertz
from carom.dimensionless.rebounds import rebound
from carom.impacts.history import PAIR
from carom.impacts.outcome import Outcome
from carom.quantities.arrays import Array
from carom.quantities.statuses import WordedStatus
from carom.sweeps.inputs import ELASTIC, leaf
from carom.sweeps.strength import WANTED, strength_values

Codes = NDArray[np.int8]
Columns = Mapping[str, Any]  # inputs by name: a number, or an array with one for every point


class PointStatus(WordedStatus):
    """What became of one point of a sweep; `message` says it in words.

    Examples
    --------
    >>> import carom
    >>> carom.status.PointStatus(3).message
    'bodies do not approach'
    """

    NOT_RUN = -1, "not run yet"
    SOLVED = 0, "solved"
    NOT_A_NUMBER = 1, "input missing or not a finite number"
    OUT_OF_RANGE = 2, "input out of range"
    NOT_APPROACHING = 3, "bodies do not approach"
    BEYOND_FLOATING_POINT = 4, "numbers beyond floating point"
    TOO_MANY_PHASES = 5, "not solved as chi is too large"
    UNRESOLVED = 6, "not solved as a phase did not end"
    STRENGTH_NOT_KNOWN = 7, "solved, but a strength is not known or a body is rigid"


OF_SOLVER = {
    Status.SOLVED: PointStatus.SOLVED,
    Status.PSI_NOT_FINITE: PointStatus.BEYOND_FLOATING_POINT,
    Status.CHI_NOT_POSITIVE: PointStatus.BEYOND_FLOATING_POINT,
    Status.TOO_MANY_PHASES: PointStatus.TOO_MANY_PHASES,
    Status.UNRESOLVED: PointStatus.UNRESOLVED,
}
FROM_SOLVER = np.array([OF_SOLVER[status] for status in Status], dtype=np.int8)
POSITIVE = ("radius", "gyration_radius", "young", "density", "yield_velocity")
NOT_NEGATIVE = ("friction", "inner_radius", "loss_time", "relaxation_time")
IN_RANGE: dict[str, Callable[[Any], Any]] = {
    **dict.fromkeys(POSITIVE, lambda values: values > 0.0),
    **dict.fromkeys(NOT_NEGATIVE, lambda values: values >= 0.0),
    "poisson": lambda values: (values > -1.0) & (values <= 0.5),
    RATIO: lambda values: (values >= 1.0) & (values <= STIFFEST),
    "restitution": lambda values: (values >= SMALLEST_RESTITUTION) & (values <= 1.0),
}


class BlockSolution(NamedTuple):
    """What an outcome needs of many solutions, without losses unless it is told."""

    psi_out: Any
    restitution: Any = 1.0
    duration: Any = hertz.DURATION
    max_penetration: Any = 1.0
    max_force: Any = 1.0
    max_radius: Any = 1.0
    max_pressure: Any = 1.0
    shear_lost: Any = 0.0


def evaluate(
    columns: Columns,
    kind: str,
    loss: str | None,
    size: int,
    outputs: Sequence[str],
    threads: int | None,
) -> tuple[dict[str, Array], Codes]:
    """Return the outputs of so many impacts, NaN where one is not solved, and their status."""
    with np.errstate(all="ignore"):
        status = _status(columns, kind, size)
        count = 1 if loss is None else len(BlockSolution._fields)
        solution = BlockSolution(*np.full((count, size), np.nan))
        outcome = _outcome(columns, kind, solution)  # which is filled before it is asked for
        lost = (status == PointStatus.SOLVED) & np.logical_not(outcome.fits)
        status[lost] = PointStatus.BEYOND_FLOATING_POINT
        if loss is None:
            solve_elastic(outcome, solution, status, threads)
        else:
            law = law_of(loss, columns.get(loss), columns.get(RATIO))
            solve_with_losses(outcome, law, solution, status, threads)
        solved = status == PointStatus.SOLVED
        searched = [name for name in outputs if name in WANTED]
        told = strength_values(outcome, size, solved, searched) if searched else {}
        plain = (name for name in outputs if name not in WANTED)
        found = {name: getattr(outcome.pair if name in PAIR else outcome, name) for name in plain}
        unknown = np.logical_or.reduce([solved & np.isnan(values) for values in told.values()])
        status[unknown & solved] = PointStatus.STRENGTH_NOT_KNOWN
        values = {name: np.where(solved, value, np.nan) for name, value in (found | told).items()}
    return values, status


def solve_elastic(
    outcome: Outcome, solution: BlockSolution, status: Codes, threads: int | None
) -> None:
    """Fill in the elastic impacts whose status is SOLVED, and what became of them."""
    psi, chi = (np.broadcast_to(x, status.shape) for x in (outcome.psi_in, outcome.pair.chi))
    run = (status == PointStatus.SOLVED) & np.isfinite(psi)  # without friction psi is infinite
    found, ended = rebound(psi[run], chi[run], threads=threads, return_status=True)
    solution.psi_out[run], status[run] = found, FROM_SOLVER[ended]


def solve_with_losses(
    outcome: Outcome, law: LossLaw, solution: BlockSolution, status: Codes, threads: int | None
) -> None:
    """Fill in the impacts with losses, also those without friction: e and the like differ."""
    loss, *numbers = law.loss(outcome.pair, outcome.normal_speed)
    given = (outcome.psi_in, outcome.pair.chi, *numbers)
    psi, chi, parameter, extra = (np.broadcast_to(x, status.shape) for x in given)
    unknown = np.isnan(parameter) | np.isnan(extra)
    status[(status == PointStatus.SOLVED) & unknown] = PointStatus.NOT_A_NUMBER
    run = status == PointStatus.SOLVED
    psi = np.where(np.isfinite(psi), psi, 0.0)
    losses = LossNumbers(loss, parameter[run], extra[run])
    found = lossy_rebounds(psi[run], chi[run], losses, threads)
    for name in BlockSolution._fields:
        getattr(solution, name)[run] = getattr(found, name)
    status[run] = FROM_SOLVER[found.status]


def _status(columns: Columns, kind: str, size: int) -> Codes:
    """Return what is known before solving; of two faults the one that is marked later."""
    status = np.zeros(size, dtype=np.int8)

    def mark(bad: Any, reason: PointStatus) -> None:
        status[np.broadcast_to(bad, size)] = reason

    for name, values in columns.items():
        if leaf(name) in IN_RANGE:
            mark(~IN_RANGE[leaf(name)](values), PointStatus.OUT_OF_RANGE)
    mark(_misfit(columns, kind), PointStatus.OUT_OF_RANGE)
    mark(~approaches(columns), PointStatus.NOT_APPROACHING)
    for name, values in columns.items():
        rigid = values == np.inf if leaf(name) == "young" else False
        unneeded = leaf(name) in STRENGTHS  # that of the other body may do
        mark(~(np.isfinite(values) | rigid | unneeded), PointStatus.NOT_A_NUMBER)
    return status


def approaches(columns: Columns) -> Any:
    """Return where bodies approach each other."""
    if "speed" in columns:
        return (columns["speed"] > 0.0) & (np.abs(columns["angle"]) < pi / 2)
    return np.asarray(columns["normal_speed"]) > 0.0


def _misfit(columns: Columns, kind: str) -> Any:
    """Return where bodies are out of proportion, or both rigid."""
    spheres = ("first", "second") if kind == "sphere" else ("first",)
    young = np.isinf(columns["first.material.young"]) & np.isinf(columns["second.material.young"])
    hollow = [
        columns[f"{body}.inner_radius"] >= columns[f"{body}.radius"]
        for body in spheres
        if f"{body}.inner_radius" in columns
    ]
    tight = [columns["second.radius"] <= columns["first.radius"]] if kind == "cup" else []
    return np.logical_or.reduce(np.broadcast_arrays(young, *hollow, *tight))


def _outcome(columns: Columns, kind: str, solution: BlockSolution) -> Outcome:
    first, second = _sphere(columns, "first"), _second(columns, kind)
    pair = unchecked(Pair, first=first, second=second, friction=columns["friction"])
    if "speed" in columns:
        normal, tangential = components(columns["speed"], columns["angle"])
    else:
        normal, tangential = columns["normal_speed"], columns["tangential_speed"]
    return Outcome(pair, normal, tangential, columns["spin"], columns["spin2"], solution)


def _second(columns: Columns, kind: str) -> Counterbody:
    if kind == "sphere":
        return _sphere(columns, "second")
    stuff = _material(columns, "second")
    if kind == "cup":
        return unchecked(Cup, radius=columns["second.radius"], material=stuff)
    return unchecked(HalfSpace, material=stuff)


def _sphere(columns: Columns, body: str) -> Sphere:
    return unchecked(
        Sphere,
        radius=columns[f"{body}.radius"],
        material=_material(columns, body),
        gyration_radius=columns.get(f"{body}.gyration_radius"),
        inner_radius=columns.get(f"{body}.inner_radius", 0.0),
    )


def _material(columns: Columns, body: str) -> Material:
    names = (*ELASTIC, *STRENGTHS)
    return unchecked(
        Material, name=None, **{name: columns.get(f"{body}.material.{name}") for name in names}
    )
