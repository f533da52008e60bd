"""Collisions against the array API standard: JAX, torch, CuPy and others; differentiable.

The physics of `compiled`, on whole arrays and in their own precision.
"""

from functools import reduce
from typing import Any, NamedTuple

import array_api_compat
import numpy as np

from carom.many.collisions import records
from carom.many.collisions.records import CollisionStatus
from carom.many.laws.portable import constants, floating, is_foreign, part_lost
from carom.many.laws.rules import Rule
from carom.quantities.refusals import InputError, refusal, refuse


class Approach(NamedTuple):
    """How the contact points approach."""

    axis: Any  # the normal, of length one to the last bit
    skew: Any  # of the squared length of the normal from 1
    closing: Any  # V_n
    sliding: Any  # V_t
    square: Any  # |V_t|^2


def collide_arrays(
    inputs: tuple[Any, ...], inertia: records.Inertia, rule: Rule
) -> records.Collisions:
    """Return velocities and spins as `compiled.collide_all`, from arrays of one library."""
    arrays, xp = _alike(inputs)
    shape = records.common_shape(arrays)
    kind = next(each for each in arrays if each is not None)
    whole = [
        constants(np.zeros(shape), kind, xp) if each is None else xp.broadcast_to(each, shape)
        for each in arrays
    ]
    status = _status(_approach(whole, inertia, xp), xp)
    hit = xp.expand_dims(status == CollisionStatus.COLLIDED.value, axis=-1)
    # rows that are left alone must have finite gradients, too: those of a head-on collision
    along = constants([0.0, 0.0, 1.0], kind, xp)
    harmless = (along, 0.0 * along, 0.0 * along, 0.0 * along, along)
    safe = [xp.where(hit, each, calm) for each, calm in zip(whole, harmless, strict=True)]
    impulse, twist = _impulses(_approach(safe, inertia, xp), inertia, rule, xp)
    velocity1, spin1, velocity2, spin2 = (
        xp.where(hit, before + factor * change, before) if factor else before
        for before, factor, change in zip(
            whole, inertia.factors, 2 * (impulse, twist), strict=False
        )
    )
    return records.Collisions(velocity1, spin1, velocity2, spin2, status)


def _alike(inputs: tuple[Any, ...]) -> tuple[list[Any], Any]:
    """Return arrays of one library and type, and that library."""
    named = dict(zip(records.NAMES, inputs, strict=True))
    foreign = {name: each for name, each in named.items() if is_foreign(each)}
    try:
        xp = array_api_compat.array_namespace(*foreign.values())
    except TypeError:
        names = sorted({type(each).__module__.partition(".")[0] for each in foreign.values()})
        raise InputError(
            f"arrays: those of {' and '.join(names)} cannot be mixed; give all of one library"
        ) from None
    for name, array in foreign.items():
        refuse(tuple(array.shape[-1:]) != (3,) and refusal(name, array, records.VECTORS))
        foreign[name] = floating(name, array)[0]
    kind = reduce(xp.result_type, (each.dtype for each in foreign.values()))
    alike = {name: xp.astype(each, kind, copy=False) for name, each in foreign.items()}
    sample = next(iter(alike.values()))
    for name, each in named.items():
        if name not in alike:
            plain = records.vectors(name, each)
            alike[name] = None if plain is None else constants(plain, sample, xp)
    return [alike[name] for name in named], xp


def _approach(motions: list[Any], inertia: records.Inertia, xp: Any) -> Approach:
    velocity1, spin1, velocity2, spin2, normal = motions
    linear = velocity1 - velocity2
    angular = inertia.radius1 * spin1 + inertia.radius2 * spin2
    skew = _dot(normal, normal, xp) - 1.0
    axis = (1.0 - skew * (0.5 - 0.375 * skew)) * normal  # n/|n|
    closing = _dot(linear, axis, xp)
    sliding = linear - closing * axis + _cross(angular, axis, xp)
    return Approach(axis, skew, closing, sliding, _dot(sliding, sliding, xp))


def _status(approach: Approach, xp: Any) -> Any:
    skew, closing = xp.abs(approach.skew), approach.closing

    def code(status: CollisionStatus) -> Any:
        return xp.full_like(closing, status.value, dtype=xp.int8)

    status = xp.where(
        closing > 0.0, code(CollisionStatus.COLLIDED), code(CollisionStatus.SEPARATING)
    )
    status = xp.where(skew <= records.LARGEST_SKEW, status, code(CollisionStatus.NORMAL_NOT_UNIT))
    finite = xp.isfinite(xp.abs(closing) + approach.square + skew)
    return xp.where(finite, status, code(CollisionStatus.NOT_FINITE))[..., 0]


def _impulses(approach: Approach, inertia: records.Inertia, rule: Rule, xp: Any) -> tuple[Any, Any]:
    """Return the impulse J on the second body and n x J, where all pairs collide."""
    axis, closing = approach.axis, approach.closing
    largest = xp.max(xp.abs(approach.sliding), axis=-1, keepdims=True)
    moves, one = largest > 0.0, xp.ones_like(largest)
    unit = xp.where(moves, largest, one)  # squares of single precision vanish early
    square = _dot(approach.sliding / unit, approach.sliding / unit, xp)
    root = unit * xp.sqrt(xp.where(moves, square, one))  # has a slope at zero, too
    speed = rule.scale * xp.where(moves, root, xp.zeros_like(root))
    drag = inertia.tangential_mass * part_lost(speed, closing, rule, xp) * approach.sliding
    push = (1.0 + rule.restitution) * inertia.normal_mass * closing * axis
    return push + drag, _cross(axis, drag, xp)


def _dot(one: Any, two: Any, xp: Any) -> Any:
    return xp.sum(one * two, axis=-1, keepdims=True)


def _cross(one: Any, two: Any, xp: Any) -> Any:
    ax, ay, az = (one[..., k] for k in range(3))
    bx, by, bz = (two[..., k] for k in range(3))
    return xp.stack((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), axis=-1)
