"""How far the full contact may leave collisions elsewhere than the theory does."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.pairs import Pair
from carom.bodies.shapes import Sphere
from carom.collisions.records import Collisions, CollisionStatus, same_numbers
from carom.dimensionless import neglected
from carom.plots.result import card
from carom.quantities.statuses import WordedStatus


class Judgement(WordedStatus):
    """Whether the error in psi_2 of a collision is bounded; `message` says it in words.

    Examples
    --------
    >>> import carom
    >>> carom.status.Judgement(1).message
    'not studied: materials, inertia, spin or contact size lie outside the study'
    """

    BOUNDED = 0, "bounded: psi_2 is at most as far off as psi_out_error says"
    NOT_STUDIED = 1, "not studied: materials, inertia, spin or contact size lie outside the study"
    NOT_COLLIDED = 2, "not judged: the bodies did not collide"


class JudgedCollisions(NamedTuple):
    """What `collide` returns with `judge=True`: `Collisions`, and bounds of the error in psi_2.

    psi_out_error, shape (...), bounds the error in psi_2 from spin about the normal, slip across
    the motion and the coupling of unlike materials; mu V_n/kappa times it bounds that of the
    velocity of the contact point along the motion. It is NaN where `judgement`, shape (...), is not
    0 (`Judgement`). Unlike bodies with spin also leave sideways, which is not bounded.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="28.6 mm", material="steel")
    >>> pair = carom.Pair(ball, ball, friction=0.2)
    >>> found = carom.collide(
    ...     pair, velocity1=[1.0, 1.0, 0.0], normal=[1.0, 0.0, 0.0], spin1=[20.0, 0.0, 0.0],
    ...     judge=True,
    ... )
    >>> float(found.psi_out_error) < 0.5, int(found.judgement)
    (True, 0)
    """

    velocity1: Any
    spin1: Any
    velocity2: Any
    spin2: Any
    status: Any
    psi_out_error: NDArray[np.float64]
    judgement: NDArray[np.int8]

    def __repr__(self) -> str:
        """Return in a few lines how many pairs there are, what became of them, what is known."""
        lines = [repr(Collisions._make(self[:5])), *map(": ".join, self._counted())]
        return "\n  ".join(lines)

    def __eq__(self, other: object) -> bool:
        """Return whether all numbers are the same."""
        return isinstance(other, JudgedCollisions) and all(map(same_numbers, self, other))

    def __ne__(self, other: object) -> bool:
        """Return whether any number differs."""
        return not self == other

    def __hash__(self) -> int:
        """Raise TypeError: arrays can change."""
        raise TypeError(f"unhashable type: {type(self).__name__!r}")

    def _repr_html_(self) -> str:
        """Return a table for a notebook."""
        return card("Judged collisions", dict(self._counted()))

    def _counted(self) -> list[tuple[str, str]]:
        counts = ((each, np.count_nonzero(self.judgement == each)) for each in Judgement)
        return [(each.message, f"{count:,}") for each, count in counts if count]


class Incidence(NamedTuple):
    """How bodies meet: psi_1, spin about the normal in friction V_n/a_max, a_max/R*; arrays."""

    psi: NDArray[np.float64]
    spin: NDArray[np.float64]
    reach: NDArray[np.float64]


def incidence(pair: Pair, before: tuple[NDArray[np.floating], ...]) -> Incidence:
    """Return how bodies meet: velocity1, spin1, velocity2, spin2 and normals, shape (..., 3)."""
    velocity1, spin1, velocity2, spin2, normal = (each.astype(float) for each in before)
    other = pair.second.radius if isinstance(pair.second, Sphere) else 0.0
    carried = np.cross(pair.first.radius * spin1 + other * spin2, normal)
    velocity = velocity1 - velocity2 + carried
    approach = np.sum(velocity * normal, axis=-1)
    tangential = velocity - approach[..., None] * normal
    turning = np.abs(np.sum((spin1 - spin2) * normal, axis=-1))
    with np.errstate(all="ignore"):
        unit = pair.friction * approach
        radius = pair.scales(1.0).radius * approach**0.4
        psi = pair.kappa * np.linalg.norm(tangential, axis=-1) / unit
        return Incidence(psi, turning * radius / unit, radius / pair.effective_radius)


def judged(pair: Pair, met: Incidence, found: Collisions) -> JudgedCollisions:
    """Return collisions with how far their psi_2 may be off."""
    collided = found.status == CollisionStatus.COLLIDED
    numbers = pair.kappa, pair.dundurs_beta, pair.friction, pair.chi
    outside = (met.spin > neglected.SPIN.most) | (met.reach > neglected.SMALL_CONTACT)
    outside |= bool(neglected.not_studied(*numbers))
    held = np.isfinite(met.psi)  # by friction: without it nothing is left out
    kinds, values = [~collided, outside & held], [Judgement.NOT_COLLIDED, Judgement.NOT_STUDIED]
    judgement = np.select(kinds, values, Judgement.BOUNDED).astype(np.int8)
    error = np.zeros(judgement.shape)
    if pair.friction > 0.0:
        with np.errstate(all="ignore"):
            bound = neglected.rebound_error(*numbers, met.psi)
            bound = bound + neglected.spin_error(pair.chi, met.psi, met.spin)
        error = np.where(held, bound, error)
    error = np.where(judgement == Judgement.BOUNDED, error, np.nan)
    return JudgedCollisions(*found, error, judgement)
