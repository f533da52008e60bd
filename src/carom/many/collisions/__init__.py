"""Collisions of rigid bodies in three dimensions: velocities and spins in, the same out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, Protocol, Required, TypedDict, Unpack, overload

import numpy as np
from numpy.typing import NDArray

from carom.bodies.checks import check_second_spin, checked_pair
from carom.bodies.pairs import Pair
from carom.many.collisions import records
from carom.many.collisions.compiled import Motions, PlateRule, collide_all, plate_rule
from carom.many.collisions.portable import collide_arrays
from carom.many.collisions.records import Collisions, JudgedCollisions
from carom.many.laws.exact import ReboundLaw, law_of
from carom.many.laws.portable import is_foreign
from carom.many.laws.rules import Rule
from carom.quantities.arrays import along_the_same
from carom.quantities.refusals import flag, known_keywords, refusal
from carom.quantities.units import threads_or_none

OF_NUMPY = (
    "a plate takes NumPy arrays; convert yours, leave it out, or pass a law for one lambda, "
    "law=carom.laws.ReboundLaw(pair.chi, losses=carom.ZenerPlate(inelasticity=...))"
)


class CollisionLaw(Protocol):
    """What `collide` takes as a law: the exact one, smooth, rough, Walton's."""

    def rule(self, pair: Pair) -> Rule:
        """Return what a collision of this pair needs."""


class CollisionInputs(TypedDict, total=False):
    """Collisions and how they are computed, by the names of `collide`."""

    velocity1: Required[Any]
    spin1: Any
    velocity2: Any
    spin2: Any
    normal: Required[Any]
    law: CollisionLaw | None
    inplace: bool
    threads: int | None


@overload
def collide(
    pair: Pair, *, judge: Literal[False] = False, **inputs: Unpack[CollisionInputs]
) -> Collisions: ...
@overload
def collide(
    pair: Pair, *, judge: Literal[True], **inputs: Unpack[CollisionInputs]
) -> JudgedCollisions: ...
@overload
def collide(
    pair: Pair, *, judge: bool, **inputs: Unpack[CollisionInputs]
) -> Collisions | JudgedCollisions: ...
@known_keywords
def collide(
    pair: Pair,
    *,
    velocity1: Any,
    spin1: Any = None,
    velocity2: Any = None,
    spin2: Any = None,
    normal: Any,
    law: CollisionLaw | None = None,
    inplace: bool = False,
    threads: int | None = None,
    judge: bool = False,
) -> Collisions | JudgedCollisions:
    """Return velocities and spins after collisions of a pair of bodies in three dimensions.

    The velocity at the contact point is V = v_1 - v_2 + (R_1 omega_1 + R_2 omega_2) x n, with V_n =
    V . n and V_t = V - V_n n. The impulse is J = (1 + e) m_n V_n n + m_t (1 + beta) V_t, and after
    the collision v_1' = v_1 - J/M_1, v_2' = v_2 + J/M_2, omega_i' = omega_i - (R_i/I_i) n x J. The
    law gives e and beta = -V_t'/V_t. By default e = 1, and beta is that of the exact rebound, to
    1e-9 (Maw, Barber & Fawcett 1976; for rigid rough spheres Walton 1993). For losses pass
    `law=ReboundLaw(pair.chi, losses=KelvinVoigt(restitution=e))`, which takes 0.1 to 0.3 s to make,
    once. How far a plate (`HalfSpace` with a thickness) gives way depends on V_n, lambda growing as
    V_n^(1/5) (Zener 1941): each collision is solved, with e and psi_2 to 1e-9, which takes some
    20 us for chi up to 3.

    Parameters
    ----------
    pair : Pair
        The bodies; they are the same in every collision.
    velocity1, spin1, velocity2, spin2 : array_like, shape (..., 3)
        Velocities in m/s and spins in rad/s, or texts with units. They are broadcast against each
        other, and zero if left out. A half-space or cup keeps its velocity and does not spin.
    normal : array_like, shape (..., 3)
        Unit vectors from the first body to the second.
    law : ReboundLaw, SmoothLaw, RoughLaw or WaltonLaw, optional
        By default the exact law of the pair, built once for each chi. For a plate only a ReboundLaw
        with `ZenerPlate` losses, whose lambda is then that of every collision, in 20 to 60 ns.
    inplace : bool
        Write the results into the given arrays, which must be writable and of full shape.
    threads : int, optional
        How many threads to use on NumPy arrays, all cores by default; the result does not depend
        on it.
    judge : bool
        Whether to bound, for each collision, the error in psi_2 from what the theory neglects:
        spin about the normal, slip across the motion, and the coupling of unlike materials; not for
        plates.

    Returns
    -------
    Collisions, or JudgedCollisions if judge is true
        velocity1, spin1, velocity2, spin2 in the shape and type of the given arrays, float32 or
        float64, and status, shape (...), with values of `CollisionStatus`. Pairs that do not
        approach, or have numbers that cannot be used, keep their velocities and spins, and so do
        those for which a plate is too thin (lambda above 2, or a penetration above the thickness);
        a UserWarning says how many have normals that are not of length one, numbers that are not
        finite, or too thin a plate. Given arrays of another library (JAX, torch, CuPy), the results
        are arrays of that library and can be differentiated; lists and NumPy arrays among them take
        their type and device.

    Raises
    ------
    InputError
        If shapes do not broadcast, the last axis is not 3, types or units do not fit, there are
        more than 200 million pairs, or arrays of another library than NumPy meet a plate.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> after = carom.collide(pair, velocity1=[[1.0, 0.0, 1.732]], normal=[0.0, 0.0, 1.0])
    >>> after.velocity1.round(3), after.spin1.round(1), after.status
    (array([[ 0.583,  0.   , -1.732]]), array([[   0. , -208.5,    0. ]]), array([0], dtype=int8))
    """
    checked_pair(pair, plates=True)
    check_second_spin(pair, spin2, spins=spin2 is not None)
    threads, inplace = threads_or_none(threads), flag("inplace", inplace)
    rule, inertia = _rule(law, pair), records.inertia_of(pair)
    inputs = (velocity1, spin1, velocity2, spin2, normal)
    along_the_same(**dict(zip(records.NAMES, inputs, strict=True)))
    before = _incidence(pair, inputs, law) if flag("judge", judge) else None
    if not any(map(is_foreign, inputs)):
        after = _collide_numpy(inputs, inertia, rule, inplace, threads)
    elif inplace:
        raise refusal("inplace", inplace, "only NumPy arrays can be written in place; leave it out")
    elif isinstance(rule, PlateRule):
        raise refusal("thickness", pair.thickness, OF_NUMPY)
    else:
        after = collide_arrays(inputs, inertia, rule)
    records.warn_of_unusable(after.status)
    return after if before is None else records.judged(pair, before, after)


def _incidence(pair: Pair, inputs: tuple[Any, ...], law: CollisionLaw | None) -> records.Incidence:
    """Return how bodies meet, before they may be written over."""
    if law is not None:
        raise refusal("law", law, "judge=True judges the exact law; leave law or judge out")
    if pair.thickness is not None:
        raise refusal("judge", True, "it judges thick walls; leave judge or thickness out")
    if any(map(is_foreign, inputs)):
        raise refusal("judge", True, "it needs NumPy arrays; convert yours, or leave judge out")
    return records.incidence(pair, _vectors(inputs, np.dtype(float)))


def _vectors(inputs: tuple[Any, ...], kind: np.dtype[Any]) -> list[NDArray[np.floating]]:
    """Return vectors of one shape and type, zeros for those left out; copies only where needed."""
    arrays = [
        records.vectors(name, values) for name, values in zip(records.NAMES, inputs, strict=True)
    ]
    shape = records.common_shape(arrays)
    return [np.zeros(shape, kind) if each is None else _whole(each, shape, kind) for each in arrays]


def _rule(law: CollisionLaw | None, pair: Pair) -> Rule | PlateRule:
    if law is None and pair.thickness is not None:
        return plate_rule(pair)
    chosen = law_of(pair.chi) if law is None else law
    if isinstance(chosen, type) or not callable(getattr(chosen, "rule", None)):
        raise refusal("law", law, "must be a ReboundLaw, SmoothLaw, RoughLaw or WaltonLaw")
    plate = isinstance(chosen, ReboundLaw) and chosen.inelasticity > 0.0
    if pair.thickness is not None and not plate:
        allowed = "it leaves out that the plate gives way; leave it or the thickness out"
        raise refusal("law", law, allowed)
    return chosen.rule(pair)


def _collide_numpy(
    inputs: tuple[Any, ...],
    inertia: records.Inertia,
    rule: Rule | PlateRule,
    inplace: bool,
    threads: int | None,
) -> Collisions:
    *before, axis = whole = _vectors(inputs, _kind(inputs))
    moving = 4 if inertia.factors[2] > 0.0 else 2
    if inplace:
        _check_writable(inputs, whole, moving)
        fixed = (each if each.flags.writeable else each.copy() for each in before[moving:])
        after = [*before[:moving], *fixed]
    else:
        after = [np.empty_like(each) for each in before[:moving]]
        after += [each.copy() for each in before[moving:]]
    status = np.empty(axis.shape[:-1], dtype=np.int8)
    old, normal = Motions(*(_read_only(each) for each in before)), _read_only(axis)
    new = Motions(*(each.reshape(-1) for each in after))
    collide_all(old, normal, inertia, rule, new, status.reshape(-1), threads)
    return Collisions._make((*after, status))


def _kind(inputs: tuple[Any, ...]) -> np.dtype[Any]:
    """Return the type of the arrays that were given; lists take it."""
    types = [each.dtype for each in inputs if isinstance(each, np.ndarray)]
    single = bool(types) and all(each == np.float32 for each in types)
    return np.dtype(np.float32 if single else np.float64)


def _read_only(array: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return a flat view that is not written to: one compiled kernel serves whatever is given."""
    flat = array.reshape(-1)
    flat.setflags(write=False)
    return flat


def _whole(
    array: NDArray[np.floating], shape: tuple[int, ...], kind: np.dtype[Any]
) -> NDArray[np.floating]:
    whole = array if array.shape == shape else np.broadcast_to(array, shape)
    return np.ascontiguousarray(whole, dtype=kind)


def _check_writable(
    inputs: tuple[Any, ...], used: Sequence[NDArray[np.floating]], moving: int
) -> None:
    """Refuse to write into what had to be copied to be used, or lies in the same memory."""
    for name, values, whole in zip(records.NAMES[:moving], inputs, used, strict=False):
        if values is None:
            continue
        kind = whole.shape, whole.dtype
        wanted = f"a C-ordered {whole.dtype} array of shape {whole.shape}"
        if not isinstance(values, np.ndarray) or (values.shape, values.dtype) != kind:
            raise refusal(name, values, f"to be written in place it must be {wanted}")
        if not values.flags.c_contiguous:
            raise refusal(
                name, values, f"its memory has gaps or another order; it must be {wanted}"
            )
        if not values.flags.writeable:
            raise refusal(name, values, "it is read-only; pass inplace=False")
        for other, array in zip(records.NAMES, used, strict=True):
            if other != name and np.may_share_memory(whole, array):
                raise refusal(name, values, f"it shares memory with {other}; pass inplace=False")
