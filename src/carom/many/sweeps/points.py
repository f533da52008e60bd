"""Impacts of many points at once: bodies whose numbers are arrays, and a status for each point."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from math import nan, pi
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from carom.bodies.cases import RATIO, law_of
from carom.bodies.kinematics import components
from carom.bodies.losses import SMALLEST_RESTITUTION, STIFFEST, LossLaw
from carom.bodies.materials import STRENGTHS, VALUES, Material, unchecked
from carom.bodies.pairs import Counterbody, Pair
from carom.bodies.shapes import Cup, HalfSpace, Sphere
from carom.bodies.walls import quiet_width
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.numerics import hertz
from carom.dimensionless.rebounds import lossy_rebounds, rebound
from carom.dimensionless.solution import solve
from carom.impacts.contacts.fields import BODIES
from carom.impacts.outcome import PAIR, Outcome, outcome_fits
from carom.impacts.peaks import MEASURES, StruckBody, growth, struck_bodies
from carom.many.sweeps.inputs import leaf
from carom.quantities.arrays import Array, where
from carom.quantities.glossary import NEEDED_STRENGTHS
from carom.quantities.statuses import WordedStatus

WANTED = {  # outputs of a sweep that are of one of the bodies: quantity and body
    f"{quantity}_{body}": (quantity, body) for quantity in NEEDED_STRENGTHS for body in BODIES
}
BEARABLE: dict[str, Callable[[StruckBody], float]] = {  # as a multiple of the speed of the impact
    "yield_speed": lambda body: growth(body.ratio("yield_ratio")),
    "tensile_speed": lambda body: growth(body.ratio("tension_ratio")),
    "crack_speed": StruckBody.cracking,
}


def needed_strengths(outputs: Sequence[str]) -> tuple[str, ...]:
    """Return the strengths of materials on which outputs depend."""
    needed = {name for each in outputs for name in needed_by(each)}
    return tuple(name for name in STRENGTHS if name in needed)


def needed_by(output: str) -> tuple[str, ...]:
    """Return the strengths of its body that an output needs."""
    return NEEDED_STRENGTHS[WANTED[output][0]] if output in WANTED else ()


def strength_values(
    outcome: Outcome, size: int, solved: NDArray[np.bool_], names: Sequence[str]
) -> dict[str, Array]:
    """Return these outputs of so many impacts, NaN where they are not solved or cannot be told."""
    outputs = {name: np.full(size, nan) for name in names}
    for i in np.flatnonzero(solved).tolist():
        psi, chi = _number(outcome.psi_in, i), _number(outcome.pair.chi, i)
        solution = solve(psi if np.isfinite(psi) else 0.0, chi)
        bodies = struck_bodies(_entry(outcome.pair, i), _entry(outcome.scales, i), solution)
        speed = np.hypot(_number(outcome.normal_speed, i), _number(outcome.tangential_speed, i))
        for name in names:
            quantity, body = WANTED[name]
            if body not in bodies:
                continue
            struck = bodies[body]
            if quantity in BEARABLE:
                outputs[name][i] = speed * BEARABLE[quantity](struck)
            else:
                peak = struck.peak(quantity) if quantity in MEASURES else struck.intensity()
                outputs[name][i] = peak.value
    return outputs


def _entry(record: Any, i: int) -> Any:
    """Return a record of numbers and arrays at one point: numbers alone."""
    if is_dataclass(record):
        own = {each.name: getattr(record, each.name) for each in fields(record)}
        return unchecked(type(record), **{name: _entry(value, i) for name, value in own.items()})
    return record if record is None or isinstance(record, str) else _number(record, i)


def _number(values: Any, i: int) -> float:
    return float(values[i] if np.ndim(values) else values)


Codes = NDArray[np.int8]
Columns = Mapping[str, Any]  # inputs by name: a number, or an array with one for every point


class PointStatus(WordedStatus):
    """What became of one point of a sweep; `message` says it in words.

    Examples
    --------
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
    PLATE_GIVES_WAY = 8, "not solved as so thin a plate gives way like a foil"
    RIM_ANSWERS = 9, "solved, but waves come back from the rim of the plate within the contact"


OF_SOLVER = {
    Status.SOLVED: PointStatus.SOLVED,
    Status.PSI_NOT_FINITE: PointStatus.BEYOND_FLOATING_POINT,
    Status.CHI_NOT_POSITIVE: PointStatus.BEYOND_FLOATING_POINT,
    Status.TOO_MANY_PHASES: PointStatus.TOO_MANY_PHASES,
    Status.UNRESOLVED: PointStatus.UNRESOLVED,
    Status.PLATE_GIVES_WAY: PointStatus.PLATE_GIVES_WAY,
}
WITH_RESULTS = (PointStatus.SOLVED, PointStatus.STRENGTH_NOT_KNOWN, PointStatus.RIM_ANSWERS)
FROM_SOLVER = np.array([OF_SOLVER[status] for status in Status], dtype=np.int8)
POSITIVE = (
    *("radius", "gyration_radius", "thickness", "width", "young", "density"),
    *("yield_velocity", "flow_stress"),
)
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

    @classmethod
    def blank(cls, size: int, loses: bool) -> BlockSolution:
        """Return what is filled before an outcome is asked: all with losses, else psi_out."""
        return cls(*np.full((len(cls._fields) if loses else 1, size), np.nan))


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
        first, second = _sphere(columns, "first"), _second(columns, kind)
        pair = unchecked(Pair, first=first, second=second, friction=columns["friction"])
        loses = loss is not None or pair.thickness is not None
        solution, spins = BlockSolution.blank(size, loses), (columns["spin"], columns["spin2"])
        normal, tangential = velocities(columns)
        scales = pair.scales(normal)
        outcome = Outcome(pair, normal, tangential, *spins, solution, scales=scales)
        lost = (status == PointStatus.SOLVED) & np.logical_not(outcome_fits(outcome))
        status[lost] = PointStatus.BEYOND_FLOATING_POINT
        if pair.thickness is not None:
            thin = np.logical_not(pair.thickness > scales.length)
            status[(status == PointStatus.SOLVED) & thin] = PointStatus.OUT_OF_RANGE
        law = None if loss is None else law_of(loss, columns.get(loss), columns.get(RATIO))
        solve_block(outcome, law, status, threads)
        solved = status == PointStatus.SOLVED
        searched = [name for name in outputs if name in WANTED]
        strengths = strength_values(outcome, size, solved, searched) if searched else {}
        others = (name for name in outputs if name not in WANTED)
        results = {n: getattr(outcome.pair if n in PAIR else outcome, n) for n in others}
        unknown = np.logical_or.reduce([solved & np.isnan(values) for values in strengths.values()])
        status[unknown & solved] = PointStatus.STRENGTH_NOT_KNOWN
        if "second.width" in columns and pair.thickness is not None:
            quiet = quiet_width(pair, scales, outcome.duration)
            narrow = columns["second.width"] < quiet
            status[solved & narrow] = PointStatus.RIM_ANSWERS
        results |= strengths
        values = {name: np.where(solved, value, np.nan) for name, value in results.items()}
    return values, status


def solve_block(outcome: Outcome, law: LossLaw | None, status: Codes, threads: int | None) -> None:
    """Fill in the solution of the impacts whose status is SOLVED, and what became of them."""
    solution = cast(BlockSolution, outcome.solution)
    loss, *numbers = (None,) if law is None else law._loss(outcome.pair, outcome.scales)
    if outcome.pair.thickness is not None:
        pair, scales = outcome.pair, outcome.scales
        give = where(pair.gives_way(scales), pair.plate_give(scales.speed), 0.0)
        loss, *numbers = LossNumbers(Loss.PLATE, give)
    arguments = (outcome.psi_in, outcome.pair.chi, *numbers)
    psi, chi, *parameters = (np.broadcast_to(x, status.shape) for x in arguments)
    run = status == PointStatus.SOLVED
    if loss is None:
        run &= np.isfinite(psi)  # without friction psi is infinite
        psi_out, ended = rebound(psi[run], chi[run], threads=threads, return_status=True)
        solution.psi_out[run], status[run] = psi_out, FROM_SOLVER[ended]
        return
    unknown = np.logical_or.reduce(np.isnan(parameters))
    status[run & unknown] = PointStatus.NOT_A_NUMBER
    run &= ~unknown
    psi = np.where(np.isfinite(psi), psi, 0.0)  # e and the like differ without friction, too
    losses = LossNumbers(loss, *(values[run] for values in parameters))
    lossy = lossy_rebounds(psi[run], chi[run], losses, threads)
    for name in BlockSolution._fields:
        getattr(solution, name)[run] = getattr(lossy, name)
    status[run] = FROM_SOLVER[lossy.status]


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


def velocities(columns: Columns) -> tuple[Any, Any]:
    """Return normal and tangential speeds."""
    if "speed" in columns:
        return components(columns["speed"], columns["angle"])
    return columns["normal_speed"], columns["tangential_speed"]


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


def _second(columns: Columns, kind: str) -> Counterbody:
    if kind == "sphere":
        return _sphere(columns, "second")
    stuff = _material(columns, "second")
    if kind == "cup":
        return unchecked(Cup, radius=columns["second.radius"], material=stuff)
    return unchecked(HalfSpace, material=stuff, thickness=columns.get("second.thickness"))


def _sphere(columns: Columns, body: str) -> Sphere:
    return unchecked(
        Sphere,
        radius=columns[f"{body}.radius"],
        material=_material(columns, body),
        gyration_radius=columns.get(f"{body}.gyration_radius"),
        inner_radius=columns.get(f"{body}.inner_radius", 0.0),
    )


def _material(columns: Columns, body: str) -> Material:
    return unchecked(
        Material, name=None, **{name: columns.get(f"{body}.material.{name}") for name in VALUES}
    )
