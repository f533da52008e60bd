"""What a pair must be for those who take it, and whether floating point holds its impacts."""

from contextlib import suppress
from functools import partial, reduce
from operator import and_
from typing import Any

import numpy as np

from carom.bodies.kinematics import READERS, Tangential, approach
from carom.bodies.pairs import MOST, Pair, Scales, holds
from carom.bodies.shapes import Sphere
from carom.quantities.arrays import Array, numbers
from carom.quantities.prefixes import text
from carom.quantities.refusals import Faults, InputError, checked_type, refusal, refuse
from carom.quantities.units import Value, finite

LEAST_SCALE = 1e-300  # of what may vanish: less loses digits
OF_FRICTION = ("tangential_length", "tangential_force", "tangential_speed")  # zero without it
SAME_BODIES = 1e-6  # part by which their numbers may differ, as written in few digits
IN_PLANE = "must be one number, as the bodies move in a plane; for space give an inertia of 3 x 3"
IN_SPACE = "must be {} numbers, along x, y{}, all finite, as the bodies move in space"


def scales_fit(pair: Pair, scales: Scales, contact_velocity: float = 0.0, *parts: float) -> bool:
    """Tell whether floating point holds what an impact is calculated from; `parts` may be tiny."""
    units = dict(vars(scales))
    of_friction = [pair.friction, *(units.pop(name) for name in OF_FRICTION)]
    sizes = [holds(size) for size in (*pair.constants, *units.values())]
    sizes += [holds(size) | (size == 0.0) for size in of_friction]
    sizes += [abs(part) <= MOST for part in (contact_velocity, *parts)]
    impulse = pair.tangential_mass * contact_velocity
    turning = (impulse * body.radius for body in pair.moving if isinstance(body, Sphere))
    for tiny in (pair.psi(contact_velocity, scales.speed), contact_velocity, impulse, *turning):
        sizes.append((abs(tiny) >= LEAST_SCALE) | (contact_velocity == 0.0))
    return reduce(and_, sizes)


def checked_scales(
    pair: Pair, normal_speed: float, contact_velocity: float = 0.0, *parts: float
) -> Scales:
    """Return the scales of an impact, or raise InputError if floating point cannot hold them."""
    with suppress(OverflowError, ZeroDivisionError):
        scales = pair.scales(normal_speed)
        if scales_fit(pair, scales, contact_velocity, *parts):
            return scales
    sliding = contact_velocity or any(parts)
    along = f", {text(contact_velocity, 'm/s')} along the surface" if sliding else ""
    raise InputError(
        f"speed: {text(normal_speed, 'm/s')} at a radius of {text(pair.first.reach, 'm')}, a "
        f"friction of {pair.friction:g}{along} gives numbers that floating point cannot hold; "
        "check the units"
    )


def checked_pair(pair: Any, *, plates: bool = False, any_shape: bool = False) -> Pair:
    """Return a pair, or raise InputError if it is none, or has a plate or shape that none takes."""
    allowed = "must be a Pair of bodies; make one with carom.Pair"
    bodies: Pair = checked_type("pair", pair, Pair, allowed)
    spheres = "only carom.impact takes such bodies; give spheres here"
    refuse(not (any_shape or bodies.is_round) and refusal("pair", str(bodies), spheres))
    only = "no plate can be taken here so far; leave it out for a thick wall"
    thin = bodies.thickness is not None and not plates
    refuse(thin and refusal("thickness", bodies.thickness, only))
    return bodies


def with_friction(pair: Any, why: str) -> Pair:
    """Return a pair that has friction, or raise InputError and say why it must."""
    if checked_pair(pair).friction == 0.0:
        raise refusal("friction", 0.0, f"must be positive; {why}")
    return checked_pair(pair)


def checked_motion(
    pair: Pair | None,
    speed: Value | None = None,
    angle: Value | None = None,
    normal_speed: Value | None = None,
    tangential_speed: Any = None,
    spin: Any = 0.0,
    spin2: Any = 0.0,
) -> tuple[float, Tangential]:
    """Return the normal speed and what is tangential, or raise InputError with all faults."""
    readers = READERS if pair is None or pair.is_round else _readers_of_bodies(pair)
    with Faults() as faults:
        speeds = speed, angle, normal_speed, tangential_speed
        both = faults.trying(approach, *speeds, readers)
        spins = [faults.trying(readers[n], n, s) for n, s in (("spin", spin), ("spin2", spin2))]
        if pair is not None and spins[1] is not None:
            faults.trying(check_second_spin, pair, spin2, spins=bool(np.any(spins[1])))
    return both[0], Tangential(both[1], *spins)


def _readers_of_bodies(pair: Pair) -> dict[str, Any]:
    """Return how to read the motion of bodies of any shape, whose centre may move away."""
    size = 1 if pair.is_planar else 3
    along, spin = partial(_vector, size=min(size, 2)), partial(_vector, size=size)
    return READERS | {
        "normal_speed": finite,
        "tangential_speed": along,
        "spin": spin,
        "spin2": spin,
    }


def _vector(name: str, value: Any, size: int) -> float | Array:
    """Return so many finite numbers, or one in a plane; none, or one that is zero, are zeros."""
    if size == 1:
        refuse(isinstance(value, list | tuple | np.ndarray) and refusal(name, value, IN_PLANE))
        return 0.0 if value is None else finite(name, value)
    allowed = IN_SPACE.format(("two", "three")[size - 2], " and z" * (size - 2))
    values = np.zeros(size) if value is None else numbers(name, value, allowed)
    if values.ndim == 0 and values == 0.0:
        return np.zeros(size)
    bad = values.shape != (size,) or not np.all(np.isfinite(values))
    refuse(bad and refusal(name, value, allowed))
    return values


def check_second_spin(pair: Pair, spin2: Any, *, spins: bool) -> None:
    """Raise InputError if the second body spins, but cannot."""
    why = "only a second sphere can spin" if pair.is_round else "the second body does not move"
    refuse(spins and len(pair.moving) == 1 and refusal("spin2", spin2, f"{why}; leave it out"))


def alike(one: Pair, other: Pair, *, friction: bool = False) -> bool:
    """Tell whether impacts of two pairs are the same, but for the friction unless that counts."""
    names = ("chi", "kappa", "effective_radius", "normal_mass", *(["friction"] * friction))
    if one.thickness != other.thickness:
        return False
    values = ((getattr(one, name), getattr(other, name)) for name in names)
    return all(abs(a - b) <= SAME_BODIES * abs(b) for a, b in values)
