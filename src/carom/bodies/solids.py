"""Solid bodies of common shapes: their mass, inertia, place of the contact and curvatures there.

Each lies above a flat wall across z and touches it in one place; an angle turns it in the plane of
x and z. Inertia and curvatures are those of the ideal shape, to rounding.
"""

from math import cos, inf, sin
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.materials import Material, as_material
from carom.bodies.smooth_body import Body
from carom.bodies.solid_shapes import SAME, body_of, clump_of, cylinder_of, ellipsoid_of
from carom.quantities.arrays import Array, numbers, pure_numbers
from carom.quantities.refusals import Faults, flag, known_keywords, refusal, refuse
from carom.quantities.units import Value, finite, not_negative, positive

LEANS = "must be from -{0:g} deg to {0:g} deg; a bare angle is in radians: write e.g. '40 deg'"
TURNED_TWICE = "give angle or orientation, not both"
ALLOWED = {
    "length": "must be twice the radius at least",
    "edge_radius": "must be at most the radius, and half of the length",
    "inner_radius": "must be at most the radius less edge_radius",
    "orientation": "must be a rotation in space: one of SciPy's, or its matrix of 3 x 3",
    "semi_axes": "must be three positive numbers in m, along x, y and z",
    "centres": "must be places in m: for each sphere x and z, or in space x, y and z",
    "radii": "must be a positive number in m, or one for each sphere",
}


@known_keywords
def rod(
    *,
    length: Value,
    radius: Value,
    material: Material | str,
    angle: Value = 0.0,
    in_space: bool = False,
) -> Body:
    """Return a round rod with hemispherical ends, which touches the wall with its lower end.

    When the upper end comes down, this is another impact.

    Parameters
    ----------
    length, radius : float or str
        Whole length, at least twice the radius, and radius of the rod and its ends in m.
    material : Material or str
        Material with a density, or the name of a material of the catalogue.
    angle : float or str, optional
        Angle between the axis and the normal of the wall in rad, below 90 deg. A positive one
        leans the upper end to +x, so that the contact lies at x < 0.
    in_space : bool, optional
        Whether the inertia is a tensor, so that the body can be struck in any direction.

    Returns
    -------
    Body
        The rod.

    Raises
    ------
    InputError
        If a size is not positive, the rod is too short or lies on its side, or there is no density.

    Examples
    --------
    >>> rod = carom.shapes.rod(length="100 mm", radius="3 mm", angle="40 deg", material="steel")
    >>> print(rod)
    rod (steel, M = 21.7514 g)
    >>> hit = carom.impact(carom.Pair(rod, carom.HalfSpace("steel"), 0.5), normal_speed=1.0)
    >>> round(hit.normal_restitution, 3)
    0.841
    """
    return _cylinder("rod", material, angle, in_space, length=length, radius=radius)


@known_keywords
def cylinder(
    *,
    length: Value,
    radius: Value,
    edge_radius: Value,
    material: Material | str,
    angle: Value,
    inner_radius: Value = 0.0,
    in_space: bool = False,
) -> Body:
    """Return a disc, coin, roller or tube with rounded edges, which touches with its lower edge.

    The contact must be small against the round part of the edge below the body, also where a disc
    is almost flat on the wall. That the wall of a tube bends is neglected.

    Parameters
    ----------
    length, radius : float or str
        Length along the axis, of a disc its thickness, and outer radius in m.
    edge_radius : float or str
        Radius of the round edges in m, at most the radius, and half of the length.
    material : Material or str
        Material with a density, or the name of a material of the catalogue.
    angle : float or str
        Angle between the axis and the normal of the wall in rad: at 0 a disc lies flat, at 90 deg
        it stands on its edge. A positive one leans the upper end of the axis to +x.
    inner_radius : float or str, optional
        Radius of a hole along the axis in m.
    in_space : bool, optional
        Whether the inertia is a tensor, so that the body can be struck in any direction.

    Returns
    -------
    Body
        The cylinder.

    Raises
    ------
    InputError
        If a size is not positive or does not fit the others, a flat end or a straight side lies on
        the wall, or the material has no density.

    Examples
    --------
    >>> coin = carom.shapes.cylinder(length="2 mm", radius="12 mm", edge_radius="0.5 mm",
    ...     angle="60 deg", material="copper")
    >>> [round(1e3 * place, 2) for place in coin.contact]  # x and z from the centre, in mm
    [5.32, -10.71]
    """
    sizes = {"edge_radius": edge_radius, "inner_radius": inner_radius}
    return _cylinder("cylinder", material, angle, in_space, length=length, radius=radius, **sizes)


@known_keywords
def ellipsoid(
    *,
    semi_axes: ArrayLike,
    material: Material | str,
    angle: Value | None = None,
    orientation: Any = None,
    in_space: bool = False,
) -> Body:
    """Return an ellipsoid, which touches the wall with its lowest point.

    Parameters
    ----------
    semi_axes : array_like, shape (3,)
        Semi-axes in m, along x, y and z before it is turned.
    material : Material or str
        Material with a density, or the name of a material of the catalogue.
    angle : float or str, optional
        Angle in rad by which it is turned about y. A positive one leans the upper end of its third
        axis to +x.
    orientation : scipy.spatial.transform.Rotation or array_like, shape (3, 3), optional
        Rotation in space instead, which makes the inertia a tensor.
    in_space : bool, optional
        Whether the inertia is a tensor, so that the body can be struck in any direction.

    Returns
    -------
    Body
        The ellipsoid.

    Raises
    ------
    InputError
        If there are not three positive semi-axes, the rotation is none or given twice, or the
        material has no density.

    Examples
    --------
    >>> shell = carom.Material(young="30 GPa", poisson=0.3, density=1080)
    >>> egg = carom.shapes.ellipsoid(semi_axes=("22 mm", "22 mm", "29 mm"), angle="30 deg",
    ...     material=shell)
    >>> [round(1e3 * place, 2) for place in egg.contact]  # x and z from the centre, in mm
    [-5.64, -27.42]
    """
    with Faults() as faults:
        stuff, whole = faults.trying(_moving, material), faults.trying(flag, "in_space", in_space)
        turn = faults.trying(_turn, angle, orientation)
        axes = faults.trying(_positives, "semi_axes", semi_axes, (3,))
    return body_of("ellipsoid", stuff, ellipsoid_of(axes, turn), whole or orientation is not None)


@known_keywords
def clump(
    *,
    centres: ArrayLike,
    radii: ArrayLike,
    material: Material | str,
    angle: Value | None = None,
    orientation: Any = None,
    in_space: bool = False,
) -> Body:
    """Return a rigid clump of spheres, as DEM codes have them, which touches with its lowest one.

    Mass and inertia are the sums of those of all spheres, so that what overlaps counts twice. The
    other spheres must not come down while the lowest is in contact; later, this is another impact.

    Parameters
    ----------
    centres : array_like, shape (n, 2) or (n, 3)
        Centres of the spheres in m, from any origin: x and z, or in space x, y and z.
    radii : array_like, shape () or (n,)
        Radii of the spheres in m.
    material : Material or str
        Material with a density, or the name of a material of the catalogue.
    angle : float or str, optional
        Angle in rad by which it is turned about y. A positive one leans the upper end to +x.
    orientation : scipy.spatial.transform.Rotation or array_like, shape (3, 3), optional
        Rotation in space instead, which makes the inertia a tensor.
    in_space : bool, optional
        Whether the inertia is a tensor, as it is if centres differ in y, so that the body can be
        struck in any direction.

    Returns
    -------
    Body
        The clump.

    Raises
    ------
    InputError
        If there are no spheres, a radius is not positive, two spheres touch the wall at once, the
        rotation is none or given twice, or the material has no density.

    Examples
    --------
    >>> two = carom.shapes.clump(centres=[(0, 0), (0, "6 mm")], radii="5 mm", angle="30 deg",
    ...     material="glass")
    >>> [round(1e3 * place, 2) for place in two.contact]  # x and z from the centre, in mm
    [-1.5, -7.6]
    """
    with Faults() as faults:
        stuff, whole = faults.trying(_moving, material), faults.trying(flag, "in_space", in_space)
        turn, places = faults.trying(_turn, angle, orientation), faults.trying(_places, centres)
        count = np.shape(radii if places is None else places)[:1]
        sizes = faults.trying(_positives, "radii", radii, (), count)
    sizes = np.broadcast_to(sizes, len(places))
    lean = orientation is None and bool(np.all(places[:, 1] == places[0, 1]))
    return body_of("clump", stuff, clump_of(places @ turn.T, sizes), whole or not lean)


def _cylinder(kind: str, material: Any, angle: Any, in_space: Any, **sizes: Any) -> Body:
    """Return a cylinder with round edges; without a radius of the edges its ends are round."""
    with Faults() as faults:
        stuff, whole = faults.trying(_moving, material), faults.trying(flag, "in_space", in_space)
        lean, profile = faults.trying(_lean, angle, 90.0), faults.trying(_profile, sizes)
    return body_of(kind, stuff, cylinder_of(profile, lean, angle), whole)


def _moving(material: Any) -> Material:
    stuff = as_material(material)
    needs = "a body that moves needs a material with a density"
    refuse(stuff.density is None and refusal("density", None, needs))
    return stuff


def _profile(sizes: dict[str, Any]) -> Array:
    """Return length, outer radius, radius of the edges and of the hole, or raise InputError."""
    readers = {"inner_radius": not_negative}
    with Faults() as faults:
        values = [faults.trying(readers.get(n, positive), n, s, "m") for n, s in sizes.items()]
    length, radius, edge, hole = [*values, values[1], 0.0][:4]
    most = {
        "length": length,
        "edge_radius": min(radius, 0.5 * length),
        "inner_radius": radius - edge,
    }
    over = {"length": 2.0 * radius, "edge_radius": edge, "inner_radius": hole}
    names = list(sizes)[2:] or ["length"]
    bad = [name for name in names if over[name] > most[name] * (1.0 + SAME)]
    refuse(*(refusal(name, sizes[name], ALLOWED[name]) for name in bad))
    return np.array([length, radius, edge, hole])


def _positives(name: str, values: Any, *shapes: tuple[int, ...]) -> Array:
    """Return positive lengths in m, an array of one of these shapes, or raise InputError."""
    read = numbers(name, values, ALLOWED[name], "m")
    good = read.shape in shapes and bool(np.all((read > 0.0) & (read < inf)))
    refuse(not good and refusal(name, values, ALLOWED[name]))
    return read


def _places(centres: Any) -> Array:
    places = numbers("centres", centres, ALLOWED["centres"], "m")
    if places.ndim == 2 and places.shape[1] == 2:
        places = np.insert(places, 1, 0.0, axis=1)
    good = places.ndim == 2 and places.shape[1] == 3 and len(places) and np.isfinite(places).all()
    refuse(not good and refusal("centres", centres, ALLOWED["centres"]))
    return places


def _lean(angle: Any, most: float) -> float:
    lean = finite("angle", angle)
    over = abs(np.degrees(lean)) > most * (1.0 + SAME)
    refuse(over and refusal("angle", angle, LEANS.format(most)))
    return lean


def _turn(angle: Any, orientation: Any) -> Array:
    """Return the matrix of a rotation, which is given in either way, or raise InputError."""
    if orientation is None:
        lean = _lean(0.0 if angle is None else angle, 180.0)
        return np.array(
            [[cos(lean), 0.0, sin(lean)], [0.0, 1.0, 0.0], [-sin(lean), 0.0, cos(lean)]]
        )
    refuse(angle is not None and refusal("angle", angle, TURNED_TWICE))
    given = orientation.as_matrix() if hasattr(orientation, "as_matrix") else orientation
    turn = pure_numbers("orientation", given, ALLOWED["orientation"])
    is_turn = turn.shape == (3, 3) and np.abs(turn @ turn.T - np.eye(3)).max() <= SAME
    good = is_turn and np.linalg.det(turn) > 0.0
    refuse(not good and refusal("orientation", given, ALLOWED["orientation"]))
    return turn
