"""A solid above a wall: volume, second moments, where it touches, and how curved it is there."""

from math import cos, pi, sin
from typing import NamedTuple, cast

import numpy as np

from carom.bodies.materials import Material
from carom.bodies.smooth_body import Body
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError, refusal, refuse
from carom.quantities.units import Value

ON_SIDE = "a straight side lies on the wall and touches in a line; incline it"
ON_END = "a flat end lies on the wall; incline it"
SAME = 1e-9  # part of a size by which lengths or heights may differ that are the same
NODES, WEIGHTS = np.polynomial.legendre.leggauss(32)  # a quarter of a circle, to rounding


class Solid(NamedTuple):
    """A solid in the frame of the wall, z away from it; places from the centre of mass."""

    volume: float
    spread: Array  # integral of r r^T over the volume
    contact: Array
    curvatures: Array  # along x and y


@np.errstate(all="ignore")  # what is too large or small is refused with the mass
def ellipsoid_of(axes: Array, turn: Array) -> Solid:
    """Return an ellipsoid r^T A^-1 r = 1, whose support function is the root of n^T A n."""
    matrix, inverse = (turn @ np.diag(axes**power) @ turn.T for power in (2, -2))
    volume, reach = 4.0 / 3.0 * pi * np.prod(axes), np.sqrt(matrix[2, 2])
    return Solid(volume, volume / 5.0 * matrix, -matrix[:, 2] / reach, reach * inverse[:2, :2])


@np.errstate(all="ignore")
def clump_of(places: Array, radii: Array) -> Solid:
    """Return spheres together, or raise InputError if two of them touch the wall."""
    volumes = 4.0 / 3.0 * pi * radii**3
    places = places - volumes @ places / volumes.sum()
    spread = places.T * volumes @ places + volumes @ radii**2 / 5.0 * np.eye(3)
    heights = places[:, 2] - radii
    first, *others = np.argsort(heights, kind="stable")[:2].tolist()
    for other in others:
        both = (
            f"centres: spheres {first + 1} and {other + 1} touch the wall at once; turn the clump"
        )
        refuse(heights[other] - heights[first] <= SAME * radii[first] and both)
    contact = places[first] - [0.0, 0.0, radii[first]]
    return Solid(volumes.sum(), spread, contact, np.eye(2) / radii[first])


@np.errstate(all="ignore")
def cylinder_of(sizes: Array, lean: float, angle: Value) -> Solid:
    """Return a cylinder of length, radius, radius of the edges and of a hole; refuse its flats."""
    length, radius, edge, hole = sizes
    half = 0.5 * length
    straight, flat = (x if x > SAME * edge else 0.0 for x in (half - edge, radius - edge))
    up, aside = cos(lean), abs(sin(lean))
    refuse(
        straight > 0.0 and up <= SAME and refusal("angle", angle, ON_SIDE),
        flat > 0.0 and aside <= SAME and refusal("angle", angle, ON_END),
    )
    axis = np.array([sin(lean), 0.0, up])
    outward = np.sign(lean) * np.array([up, 0.0, -sin(lean)])  # from the axis to the contact
    contact = flat * outward - straight * axis - [0.0, 0.0, edge]
    around = aside / (flat + edge * aside) if flat else 1.0 / edge
    bore = pi * hole**2 * length * np.array([1.0, half**2 / 3.0, hole**2 / 4.0])
    volume, along, across = _moments(straight, flat, edge) - bore
    spread = across * np.eye(3) + (along - across) * np.outer(axis, axis)
    return Solid(volume, spread, contact, np.diag([1.0 / edge, around]))


def _moments(straight: float, flat: float, edge: float) -> Array:
    """Return integrals of 1 and of squares, along the axis and across it, over a cylinder."""
    turn, outer = 0.25 * pi * (NODES + 1.0), flat + edge
    steps = 0.25 * pi * WEIGHTS * edge * np.cos(turn)  # along the axis, of the round part
    z, r = straight + edge * np.sin(turn), flat + edge * np.cos(turn)
    volume = straight * outer**2 + steps @ r**2
    along = straight**3 / 3.0 * outer**2 + steps @ (z * r) ** 2
    return 2.0 * pi * np.array([volume, along, (straight * outer**4 + steps @ r**4) / 4.0])


def body_of(kind: str, stuff: Material, solid: Solid, in_space: bool) -> Body:
    """Return a solid of a material as a body, in its plane of symmetry or in space."""
    density = cast(float, stuff.density)
    mass, spread = density * solid.volume, density * solid.spread
    inertia = np.trace(spread) * np.eye(3) - 0.5 * (spread + spread.T)
    held = all(np.isfinite(each).all() for each in (mass, inertia, *solid))
    if not (held and mass > 0.0 and np.trace(inertia) > 0.0):
        raise InputError(f"{kind}: floating point cannot hold mass and inertia; check the units")
    x, y, z = solid.contact.tolist()
    return Body(
        material=stuff,
        mass=float(mass),
        inertia=inertia if in_space else float(inertia[1, 1]),
        contact=(x, y, z) if in_space else (x, z),
        curvatures=0.5 * (solid.curvatures + solid.curvatures.T),
        name=kind,
    )
