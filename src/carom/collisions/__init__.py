"""Collisions of rigid bodies in three dimensions: velocities and spins in, the same out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import array_api_compat
import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Sphere
from carom.collisions.compiled import Motions, collide_all
from carom.collisions.portable import collide_arrays
from carom.collisions.records import Collisions, CollisionStatus, Inertia, inertia_of
from carom.laws.exact import law_of
from carom.laws.rules import Rule
from carom.pairs import Pair
from carom.quantities import InputError, refusal

__all__ = ["CollisionLaw", "CollisionStatus", "Collisions", "collide"]

NAMES = ("velocity1", "spin1", "velocity2", "spin2", "normal")


class CollisionLaw(Protocol):
    """What `collide` takes as a law: the exact one, smooth, rough, Walton's."""

    def rule(self, pair: Pair) -> Rule:
        """Return what a collision of this pair needs."""


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
) -> Collisions:
    """Return velocities and spins after collisions of a pair of bodies in three dimensions.

    With V = v_1 - v_2 + (R_1 omega_1 + R_2 omega_2) x n at the contact point, V_n = V . n and
    V_t = V - V_n n: J = (1 + e) m_n V_n n + m_t (1 + beta) V_t, v_1' = v_1 - J/M_1,
    v_2' = v_2 + J/M_2, omega_i' = omega_i - (R_i/I_i) n x J; e and beta = -V_t'/V_t are the law's,
    by default e = 1 and the exact rebound to 1e-9 (Maw, Barber & Fawcett 1976; for rigid rough
    spheres Walton 1993).

    Parameters
    ----------
    pair : Pair
        The bodies; they are the same in every collision.
    velocity1, spin1, velocity2, spin2 : array_like, shape (..., 3)
        In m/s and rad/s, broadcast; zero where left out. A half-space or cup keeps its velocity,
        and does not spin.
    normal : array_like, shape (..., 3)
        Unit vectors from the first body to the second.
    law : ReboundLaw, SmoothLaw, RoughLaw or WaltonLaw, optional
        By default the exact law of the pair, built once for each chi.
    inplace : bool
        Write into the arrays that were given; they must be writable and of full shape.
    threads : int, optional
        How many threads to use on NumPy arrays, all cores by default; the result does not depend
        on it.

    Returns
    -------
    Collisions
        velocity1, spin1, velocity2, spin2 in the shape and type of what was given, float32 or
        float64, and status, shape (...): `CollisionStatus`. Pairs that do not approach, or with
        numbers that cannot be used, are left alone. Arrays of other libraries (JAX, torch, CuPy)
        are answered in kind, and can be differentiated.

    Raises
    ------
    InputError
        If shapes do not broadcast, the last axis is not 3, or types do not fit.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> after = carom.collide(pair, velocity1=[[1.0, 0.0, 1.732]], normal=[0.0, 0.0, 1.0])
    >>> after.velocity1.round(3), after.spin1.round(1), after.status
    (array([[ 0.583,  0.   , -1.732]]), array([[   0. , -208.6,    0. ]]), array([0], dtype=int8))
    """
    if not isinstance(pair, Pair):
        raise refusal("pair", pair, "must be a Pair of bodies; make one with carom.Pair")
    if spin2 is not None and not isinstance(pair.second, Sphere):
        raise refusal("spin2", spin2, "only a second sphere can spin; leave it out")
    rule = (law or law_of(pair.chi)).rule(pair)
    given = (velocity1, spin1, velocity2, spin2, normal)
    if any(_is_foreign(each) for each in given):
        if inplace:
            raise refusal("inplace", inplace, "only NumPy arrays can be written into")
        return collide_arrays(given, inertia_of(pair), rule)
    return _collide_numpy(given, inertia_of(pair), rule, inplace, threads)


def _is_foreign(values: Any) -> bool:
    return array_api_compat.is_array_api_obj(values) and not isinstance(
        values, np.ndarray | np.generic
    )


def _collide_numpy(
    given: tuple[Any, ...], inertia: Inertia, rule: Rule, inplace: bool, threads: int | None
) -> Collisions:
    arrays = [_vectors(name, values) for name, values in zip(NAMES, given, strict=True)]
    shape = _common_shape(arrays)
    kind = np.result_type(*(each for each in arrays if each is not None))
    *before, axis = (_whole(each, shape, kind) for each in arrays)
    moving = (True, True, inertia.inverse_mass2 > 0.0, inertia.inverse_mass2 > 0.0)
    if inplace:
        for name, values, whole, moves in zip(NAMES, given, before, moving, strict=False):
            _check_writable(name, values, whole, moves)
    after = [
        np.empty_like(each) if moves and not inplace else each
        for each, moves in zip(before, moving, strict=True)
    ]
    status = np.empty(shape[:-1], dtype=np.int8)
    old, normal = Motions(*(_read_only(each) for each in before)), _read_only(axis)
    new = Motions(*(each.reshape(-1) for each in after))
    collide_all(old, normal, inertia, rule, new, status.reshape(-1), threads)
    velocities1, spins1, velocities2, spins2 = after
    return Collisions(velocities1, spins1, velocities2, spins2, status)


def _read_only(array: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return a flat view that is not written to: one compiled kernel serves whatever is given."""
    flat = array.reshape(-1)
    flat.setflags(write=False)
    return flat


def _vectors(name: str, values: ArrayLike | None) -> NDArray[np.floating] | None:
    """Return what is given as vectors of floating-point numbers."""
    if values is None:
        return None
    try:
        array = np.asarray(values)
    except ValueError:
        raise refusal(name, values, "must be an array of shape (..., 3)") from None
    if array.dtype.kind not in "fiu" or array.shape[-1:] != (3,):
        raise refusal(name, values, "must be an array of real numbers of shape (..., 3)")
    return array if array.dtype == np.float32 else np.asarray(array, dtype=np.float64)


def _common_shape(arrays: Sequence[NDArray[np.floating] | None]) -> tuple[int, ...]:
    shapes = {name: a.shape for name, a in zip(NAMES, arrays, strict=True) if a is not None}
    for name in ("velocity1", "normal"):
        if name not in shapes:
            raise InputError(f"{name}: missing; give an array of shape (..., 3)")
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        words = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise InputError(f"shapes: {words} do not broadcast; give (N, 3) or (3,) each") from None


def _whole(
    array: NDArray[np.floating] | None, shape: tuple[int, ...], kind: np.dtype[Any]
) -> NDArray[np.floating]:
    if array is None:
        return np.zeros(shape, dtype=kind)
    whole = array if array.shape == shape else np.broadcast_to(array, shape)
    return np.ascontiguousarray(whole, dtype=kind)


def _check_writable(name: str, given: Any, whole: NDArray[np.floating], moves: bool) -> None:
    """Refuse what cannot be written into: whatever had to be copied to be used."""
    if given is None or not moves:
        return
    if not (isinstance(given, np.ndarray) and np.shares_memory(given, whole)):
        allowed = f"to be written in place it must be a C-ordered {whole.dtype} array of full shape"
        raise refusal(name, given, f"{allowed}, {whole.shape}")
    if not given.flags.writeable:
        raise refusal(name, given, "it is read-only; pass inplace=False")
