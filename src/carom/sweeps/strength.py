"""What many impacts do to their bodies: the largest stresses, the speeds that bodies bear."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass
from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom.bodies.materials import STRENGTHS, unchecked
from carom.dimensionless.solution import solve
from carom.impacts.outcome import Outcome
from carom.impacts.peaks import BODIES, MEASURES, StruckBody, growth, struck_bodies
from carom.quantities.arrays import Array
from carom.quantities.glossary import NEEDED_STRENGTHS

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Wanted(NamedTuple):
    """An output of a sweep that is of one of the bodies."""

    quantity: str
    body: str


WANTED = {
    f"{quantity}_{body}": Wanted(quantity, body) for quantity in NEEDED_STRENGTHS for body in BODIES
}
SPEEDS: dict[str, Callable[[StruckBody], float]] = {  # as a multiple of the speed of the impact
    "yield_speed": lambda body: growth(body.yield_ratio()),
    "tensile_speed": lambda body: growth(body.tension_ratio()),
    "crack_speed": StruckBody.cracking,
}


def needed_strengths(outputs: Sequence[str]) -> tuple[str, ...]:
    """Return the strengths of materials on which outputs depend."""
    needed = {name for each in outputs for name in needed_by(each)}
    return tuple(name for name in STRENGTHS if name in needed)


def needed_by(output: str) -> tuple[str, ...]:
    """Return the strengths of its body that an output needs."""
    return NEEDED_STRENGTHS[WANTED[output].quantity] if output in WANTED else ()


def strength_values(
    outcome: Outcome, size: int, solved: NDArray[np.bool_], names: Sequence[str]
) -> dict[str, Array]:
    """Return these outputs of so many impacts, NaN where they are not solved or cannot be told."""
    found = {name: np.full(size, nan) for name in names}
    for i in np.flatnonzero(solved).tolist():
        psi, chi = _number(outcome.psi_in, i), _number(outcome.pair.chi, i)
        solution = solve(psi if np.isfinite(psi) else 0.0, chi)
        bodies = struck_bodies(_entry(outcome.pair, i), _entry(outcome.scales, i), solution)
        speed = np.hypot(_number(outcome.normal_speed, i), _number(outcome.tangential_speed, i))
        for name in names:
            quantity, body = WANTED[name]
            if body in bodies:
                found[name][i] = _value(quantity, bodies[body], speed)
    return found


def _value(quantity: str, body: StruckBody, speed: float) -> float:
    if quantity in SPEEDS:
        return float(speed * SPEEDS[quantity](body))
    return body.peak(quantity).value if quantity in MEASURES else body.intensity().value


def _entry(record: Any, i: int) -> Any:
    """Return a record of numbers and arrays at one point: numbers alone."""
    if is_dataclass(record):
        own = {each.name: getattr(record, each.name) for each in fields(record)}
        return unchecked(type(record), **{name: _entry(value, i) for name, value in own.items()})
    return record if record is None or isinstance(record, str) else _number(record, i)


def _number(values: Any, i: int) -> float:
    return float(values[i] if np.ndim(values) else values)
