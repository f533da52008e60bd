"""What a collision takes and gives: status, inertia of the pair, velocities and spins."""

from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np

from carom.bodies import Sphere
from carom.pairs import Counterbody, Pair

SKEW = 1e-5  # of a normal's squared length from 1; so much is rounding, and made up for


class CollisionStatus(IntEnum):
    """What became of a pair; its `message` says so in words.

    Examples
    --------
    >>> import carom
    >>> carom.CollisionStatus(1).message
    'left alone: the bodies do not approach'
    """

    COLLIDED = 0
    SEPARATING = 1
    NOT_FINITE = 2
    NORMAL_NOT_UNIT = 3

    @property
    def message(self) -> str:
        """The status in words."""
        return MESSAGES[self]


MESSAGES = {
    CollisionStatus.COLLIDED: "collided",
    CollisionStatus.SEPARATING: "left alone: the bodies do not approach",
    CollisionStatus.NOT_FINITE: "left alone: a number is not finite, or too large",
    CollisionStatus.NORMAL_NOT_UNIT: "left alone: the normal is not a unit vector",
}


class Inertia(NamedTuple):
    """How a pair takes an impulse; inverse masses and spin rates R/I of a fixed body are zero."""

    radius1: float
    radius2: float
    inverse_mass1: float
    inverse_mass2: float
    spin_rate1: float
    spin_rate2: float
    normal_mass: float
    tangential_mass: float


class Collisions(NamedTuple):
    """Velocities and spins after collisions, as arrays like those before; SI units.

    `status`, one for each pair, holds values of `CollisionStatus`: 0 where the bodies collided.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.0)
    >>> hit = carom.collide(pair, velocity1=[[1.0, 0.0, -2.0]], normal=[0.0, 0.0, -1.0])
    >>> hit.velocity1, hit.status
    (array([[1., 0., 2.]]), array([0], dtype=int8))
    """

    velocity1: Any
    spin1: Any
    velocity2: Any
    spin2: Any
    status: Any

    def _repr_html_(self) -> str:
        """Return a table for a notebook."""
        from carom.notebooks import card

        rows = _counted(self.status)
        return card(f"{sum(rows.values()):,} collisions", {k: f"{n:,}" for k, n in rows.items()})


def _counted(status: Any) -> dict[str, int]:
    """Return how many pairs came out how, in words; arrays of any library."""
    values, counts = np.unique(np.asarray(status), return_counts=True)
    return {MESSAGES[CollisionStatus(int(v))]: int(n) for v, n in zip(values, counts, strict=True)}


def inertia_of(pair: Pair) -> Inertia:
    """Return the inertia of a pair in SI units."""
    radius1, mass1, spin1 = _response(pair.first)
    radius2, mass2, spin2 = _response(pair.second)
    effective = pair.normal_mass, pair.tangential_mass
    return Inertia(radius1, radius2, mass1, mass2, spin1, spin2, *effective)


def _response(body: Counterbody) -> tuple[float, float, float]:
    """Return radius, 1/M and R/I = 1/(M R K^2/R^2) of a body; zeros of a fixed one."""
    if not isinstance(body, Sphere):
        return 0.0, 0.0, 0.0
    return body.radius, 1.0 / body.mass, 1.0 / (body.mass * body.radius * body.gyration_ratio)
