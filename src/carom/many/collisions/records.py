"""What collisions take, read from users, and give: motions, a status, bounds of their error."""

import warnings
from collections import namedtuple
from collections.abc import Sequence
from math import prod
from typing import Any, NamedTuple

import array_api_compat
import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies.pairs import Counterbody, Pair
from carom.bodies.shapes import Sphere
from carom.bodies.walls import radiated_share
from carom.dimensionless import neglected
from carom.many.laws.portable import is_floats
from carom.plots.result import card
from carom.quantities.arrays import numbers
from carom.quantities.refusals import InputError, refusal, refuse
from carom.quantities.statuses import WordedStatus

TRACED = (TypeError, RuntimeError)  # what jax and torch raise of arrays without values
LARGEST_SKEW = 1e-5  # of a normal's squared length from 1; so much is rounding, and made up for
UNITS = {"velocity1": "m/s", "spin1": "rad/s", "velocity2": "m/s", "spin2": "rad/s", "normal": "1"}
NAMES = tuple(UNITS)
MOST_PAIRS = 200_000_000  # at once
VECTORS = "must be an array of real numbers of shape (..., 3)"


class CollisionStatus(WordedStatus):
    """What became of a pair in `collide`; `message` says it in words.

    Examples
    --------
    >>> carom.status.CollisionStatus(1).message
    'left alone: the bodies do not approach'
    """

    COLLIDED = 0, "collided"
    SEPARATING = 1, "left alone: the bodies do not approach"
    NOT_FINITE = 2, "left alone: a number is not finite, or too large"
    NORMAL_NOT_UNIT = 3, "left alone: the normal is not a unit vector"
    PLATE_TOO_THIN = 4, "left alone: the plate is a foil (lambda above 2) or below the penetration"
    NOT_SOLVED = 5, "left alone: not solved, as chi is too large"


ADVICE = {
    CollisionStatus.NORMAL_NOT_UNIT: "whose normal is not of length one (divide it by its length)",
    CollisionStatus.NOT_FINITE: "with a number that is not finite or too large (look for NaN)",
    CollisionStatus.PLATE_TOO_THIN: "too fast for so thin a plate (make it thicker, or a wall)",
    CollisionStatus.NOT_SOLVED: "that are not solved (chi is too large)",
}


class EqualByNumbers(tuple[Any, ...]):
    """Arrays that are equal where all numbers are, and have no hash, as they change."""

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and all(map(same_numbers, self, other))

    def __ne__(self, other: object) -> bool:
        return not self == other


After = namedtuple("After", "velocity1 spin1 velocity2 spin2 status")


class Collisions(EqualByNumbers, After):
    """Velocities and spins after collisions, as arrays like those before; SI units.

    `status`, one for each pair, holds values of `CollisionStatus`: 0 where the bodies collided.
    Printed, it is a summary. Two are equal if all their numbers are, NaN and NaN too, in arrays of
    one library and shape.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.0)
    >>> hit = carom.collide(pair, velocity1=[[1.0, 0.0, -2.0]], normal=[0.0, 0.0, -1.0])
    >>> hit.velocity1, hit.status
    (array([[1., 0., 2.]]), array([0], dtype=int8))
    """

    __slots__ = ()

    def __repr__(self) -> str:
        counts = status_counts(self.status)
        if counts is None:  # what jax traces, or no arrays at all
            return tuple.__repr__(self)
        lines = [_title(self), *(f"  {status.message}: {n:,}" for status, n in counts.items())]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        counts = status_counts(self.status) or {}
        return card(_title(self), {status.message: f"{n:,}" for status, n in counts.items()})


def status_counts(status: Any) -> dict[CollisionStatus, int] | None:
    """Return how many pairs have each status that occurs; None of an array without values."""
    try:
        xp = array_api_compat.array_namespace(status)
        where = {each: xp.astype(status == each.value, xp.int32) for each in CollisionStatus}
        counts = {each: int(xp.sum(places)) for each, places in where.items()}
    except TRACED:
        return None
    return {each: count for each, count in counts.items() if count}


def warn_of_unusable(status: Any) -> None:
    """Warn once of pairs with numbers that cannot be used: how many, and what to do."""
    try:  # one look at the largest: this is to cost nothing
        xp = array_api_compat.array_namespace(status)
        if not prod(status.shape) or int(xp.max(status)) < min(ADVICE):
            return
    except TRACED:
        return
    counts = status_counts(status) or {}
    faults = [f"{counts[each]:,} {words}" for each, words in ADVICE.items() if each in counts]
    warnings.warn(
        f"of {_counted(prod(status.shape), 'pair')} these were left alone: {'; '.join(faults)}; "
        "`status` says which",
        UserWarning,
        stacklevel=4,
    )


def _title(collisions: Collisions) -> str:
    shape, kind = tuple(collisions.velocity1.shape), collisions.velocity1.dtype
    number = _counted(prod(shape[:-1]), "collision")
    return f"{number}; velocities and spins of shape {shape}, {kind}"


def _counted(number: int, noun: str) -> str:
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"


def same_numbers(one: Any, other: Any) -> bool:
    """Return whether two arrays have the same numbers, or two other things are equal."""
    try:
        xp = array_api_compat.array_namespace(one, other)
    except TypeError:  # of two libraries, or no arrays
        alike = map(array_api_compat.is_array_api_obj, (one, other))
        return not any(alike) and bool(one == other)
    if tuple(one.shape) != tuple(other.shape):
        return False
    return bool(xp.all((one == other) | ((one != one) & (other != other))))


class Inertia(NamedTuple):
    """How a pair takes an impulse; what stands for a fixed body is zero.

    `factors` are the changes of velocity1, spin1, velocity2 and spin2: -1/M_1, -R_1/I_1, 1/M_2,
    -R_2/I_2, of velocities by the impulse J on the second body, of spins by n x J.
    """

    radius1: float
    radius2: float
    factors: tuple[float, float, float, float]
    normal_mass: float
    tangential_mass: float


def inertia_of(pair: Pair) -> Inertia:
    """Return the inertia of a pair in SI units."""
    radius1, mass1, spin1 = _response(pair.first)
    radius2, mass2, spin2 = _response(pair.second)
    factors = -mass1, -spin1, mass2, -spin2
    return Inertia(radius1, radius2, factors, pair.normal_mass, pair.tangential_mass)


def _response(body: Counterbody) -> tuple[float, float, float]:
    """Return radius, 1/M and R/I = 1/(M R K^2/R^2) of a body; zeros of a fixed one."""
    if not isinstance(body, Sphere):
        return 0.0, 0.0, 0.0
    return body.radius, 1.0 / body.mass, 1.0 / (body.mass * body.radius * body.gyration_ratio)


def vectors(name: str, values: ArrayLike | None) -> NDArray[np.floating] | None:
    """Return what is given as vectors of floating-point numbers, or raise InputError."""
    if values is None:
        return None
    plain = is_floats(values)  # may be written in place: no copy
    array = np.asarray(values) if plain else numbers(name, values, VECTORS, UNITS[name])
    refuse(array.shape[-1:] != (3,) and refusal(name, values, VECTORS))
    return array


def common_shape(arrays: Sequence[Any]) -> tuple[int, ...]:
    """Return the shape to which the arrays broadcast, None left out, or raise InputError."""
    present = ((name, each) for name, each in zip(NAMES, arrays, strict=True) if each is not None)
    shapes = {name: tuple(each.shape) for name, each in present}
    missing = [name for name in ("velocity1", "normal") if name not in shapes]
    refuse(*(f"{name}: missing; give an array of shape (..., 3)" for name in missing))
    try:
        shape = np.broadcast_shapes(*shapes.values())
    except ValueError:
        words = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise InputError(f"shapes: {words} do not broadcast; give (N, 3) or (3,) each") from None
    if prod(shape) > 3 * MOST_PAIRS:
        raise InputError(f"shapes: {prod(shape) // 3:,} pairs are too many at once; split them")
    return shape


class Judgement(WordedStatus):
    """Whether the error in psi_2 of a collision is bounded; `message` says it in words.

    Examples
    --------
    >>> carom.status.Judgement(1).message
    'not studied: materials, inertia, spin or contact size lie outside the study'
    """

    BOUNDED = 0, "bounded: psi_2 is at most as far off as psi_out_error says"
    NOT_STUDIED = 1, "not studied: materials, inertia, spin or contact size lie outside the study"
    NOT_COLLIDED = 2, "not judged: the bodies did not collide"


Judged = namedtuple("Judged", "velocity1 spin1 velocity2 spin2 status psi_out_error judgement")


class JudgedCollisions(EqualByNumbers, Judged):
    """What `collide` returns with `judge=True`: `Collisions`, and bounds of the error in psi_2.

    psi_out_error, shape (...), bounds the error in psi_2 from spin about the normal, slip across
    the motion, the coupling of unlike materials and waves in a wall; mu V_n/kappa times it bounds
    that of the velocity of the contact point along the motion. It is NaN where `judgement`, shape
    (...), is not 0 (`Judgement`). Unlike bodies with spin also leave sideways, which is not
    bounded.

    Examples
    --------
    >>> ball = carom.Sphere(radius="28.6 mm", material="steel")
    >>> pair = carom.Pair(ball, ball, friction=0.2)
    >>> after = carom.collide(
    ...     pair, velocity1=[1.0, 1.0, 0.0], normal=[1.0, 0.0, 0.0], spin1=[20.0, 0.0, 0.0],
    ...     judge=True,
    ... )
    >>> float(after.psi_out_error) < 0.5, int(after.judgement)
    (True, 0)
    """

    __slots__ = ()

    def __repr__(self) -> str:
        lines = [repr(Collisions._make(self[:5])), *map(": ".join, self._counted())]
        return "\n  ".join(lines)

    def _repr_html_(self) -> str:
        return card("Judged collisions", dict(self._counted()))

    def _counted(self) -> list[tuple[str, str]]:
        counts = ((each, np.count_nonzero(self.judgement == each)) for each in Judgement)
        return [(each.message, f"{count:,}") for each, count in counts if count]


class Incidence(NamedTuple):
    """How bodies meet: psi_1, spin about the normal in friction V_n/a_max, a_max/R*; arrays.

    `waves` is the share of the energy that waves take away in a wall.
    """

    psi: NDArray[np.float64]
    spin: NDArray[np.float64]
    reach: NDArray[np.float64]
    waves: NDArray[np.float64]


def incidence(pair: Pair, before: Sequence[NDArray[np.floating]]) -> Incidence:
    """Return how bodies meet: velocity1, spin1, velocity2, spin2 and normals, shape (..., 3)."""
    velocity1, spin1, velocity2, spin2, normal = (
        np.moveaxis(each, -1, 0).astype(float, order="C") for each in before
    )  # components first, which is quicker
    other = pair.second.radius if isinstance(pair.second, Sphere) else 0.0
    with np.errstate(all="ignore"):  # of numbers that are refused, too
        carried = np.cross(pair.first.radius * spin1 + other * spin2, normal, axis=0)
        velocity = velocity1 - velocity2 + carried
        approach = np.sum(velocity * normal, axis=0)
        tangential = velocity - approach * normal
        turning = np.abs(np.sum((spin1 - spin2) * normal, axis=0))
        unit = pair.friction * approach
        radius = pair.scales(1.0).radius * approach**0.4
        psi = pair.kappa * np.linalg.norm(tangential, axis=0) / unit
        waves = radiated_share(pair, pair.scales(1.0)) * approach**0.6
        return Incidence(psi, turning * radius / unit, radius / pair.effective_radius, waves)


def judged(pair: Pair, before: Incidence, after: Collisions) -> JudgedCollisions:
    """Return collisions with how far their psi_2 may be off."""
    collided = after.status == CollisionStatus.COLLIDED
    numbers = pair.kappa, pair.dundurs_beta, pair.friction, pair.chi
    outside = (before.spin > neglected.SPIN.most) | (before.reach > neglected.SMALL_CONTACT)
    outside |= bool(neglected.not_studied(*numbers)) | np.isnan(before.waves)
    held = np.isfinite(before.psi)  # by friction: without it nothing is left out
    kinds, values = [~collided, outside & held], [Judgement.NOT_COLLIDED, Judgement.NOT_STUDIED]
    judgement = np.select(kinds, values, Judgement.BOUNDED).astype(np.int8)
    error = np.zeros(judgement.shape)
    if pair.friction > 0.0:
        with np.errstate(all="ignore"):
            bound = neglected.rebound_error(*numbers, before.psi)
            bound = bound + neglected.spin_error(pair.chi, before.psi, before.spin)
            bound = bound + neglected.wave_error(pair.chi, before.psi, before.waves)
        error = np.where(held, bound, error)
    error = np.where(judgement == Judgement.BOUNDED, error, np.nan)
    return JudgedCollisions._make((*after, error, judgement))
