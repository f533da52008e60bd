"""What many impacts do to their bodies: the largest stresses, the speeds that bodies bear."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom.bodies.cases import case_of
from carom.bodies.materials import STRENGTHS
from carom.bodies.pairs import Pair
from carom.dimensionless.solution import solve
from carom.dimensionless.strength.searching import Contacts
from carom.impacts.outcome import Outcome
from carom.impacts.peaks import BODIES, MEASURES, Strengths, StruckBody, Units, growth, units_of
from carom.quantities.arrays import Array
from carom.quantities.glossary import NEEDED_STRENGTHS
from carom.quantities.refusals import InputError

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
    points = _points(outcome, size)
    for i in np.flatnonzero(solved).tolist():
        bodies = points.bodies(i)
        for name in names:
            quantity, body = WANTED[name]
            if body in bodies:
                found[name][i] = _value(quantity, bodies[body], points.speed[i])
    return found


def _value(quantity: str, body: StruckBody, speed: float) -> float:
    if quantity in SPEEDS:
        return float(speed * SPEEDS[quantity](body))
    return body.peak(quantity).value if quantity in MEASURES else body.intensity().value


class _Points(NamedTuple):
    """What the peaks of impacts depend on, an entry of each array for each impact."""

    psi: Array
    chi: Array
    friction: Array
    speed: Array
    units: Array  # a row for each of `Units`
    poisson: dict[str, Array]
    rigid: dict[str, NDArray[np.bool_]]
    strengths: dict[str, Array]  # a row for each of `Strengths`

    def bodies(self, i: int) -> dict[str, StruckBody]:
        """Return the bodies of one impact that deform."""
        psi = float(self.psi[i])
        solution = solve(psi if np.isfinite(psi) else 0.0, float(self.chi[i]))
        contacts = Contacts(solution, float(self.friction[i]))
        units = Units(*self.units[:, i].tolist())
        return {
            body: StruckBody(
                contacts,
                float(self.poisson[body][i]),
                units,
                Strengths(*self.strengths[body][:, i].tolist()),
                side,
            )
            for body, side in zip(BODIES, (-1.0, 1.0), strict=True)
            if not self.rigid[body][i]
        }


def _points(outcome: Outcome, size: int) -> _Points:
    def spread(values: Any) -> Array:
        return np.broadcast_to(np.asarray(nan if values is None else values, float), (size,))

    pair, scales = outcome.pair, outcome.scales
    stuff = {body: getattr(pair, body).material for body in BODIES}
    return _Points(
        psi=spread(outcome.psi_in),
        chi=spread(pair.chi),
        friction=spread(pair.friction),
        speed=np.hypot(spread(outcome.normal_speed), spread(outcome.tangential_speed)),
        units=np.stack([spread(unit) for unit in units_of(scales)]),
        poisson={body: spread(each.poisson) for body, each in stuff.items()},
        rigid={body: np.isinf(spread(each.young)) for body, each in stuff.items()},
        strengths={
            body: np.stack([spread(getattr(each, name)) for name in Strengths._fields])
            for body, each in stuff.items()
        },
    )


def speeds_known(pair: Pair) -> tuple[str, ...]:
    """Return which speeds the strengths of a pair give, or raise InputError if none."""
    known = [
        name
        for name, (quantity, body) in WANTED.items()
        if quantity in SPEEDS and _bears(getattr(pair, body).material, needed_by(name))
    ]
    if not known:
        raise InputError(
            "strength: no strength of either body is known; give yield_strength, tensile_strength, "
            "or fracture_toughness with flaw_size, to carom.Material or carom.material(name, ...)"
        )
    return tuple(known)


def _bears(material: Any, needed: Sequence[str]) -> bool:
    return not material.is_rigid and all(getattr(material, name) is not None for name in needed)


def unit_case(pair: Pair) -> dict[str, Any]:
    """Return the case of a pair that meets at 1 m/s: the speeds that bodies bear are multiples."""
    return {**case_of(pair), "speed": 1.0}
