"""Bodies of common shapes: how they are given, how they print, and what is refused."""

import pytest
from tests.checks import refused

import carom
from carom.bodies.solids import clump, cylinder, ellipsoid, rod

STEEL = {"material": "steel"}
ROD = {"length": "60 mm", "radius": "5 mm", **STEEL}
DISC = {"length": "6 mm", "radius": "20 mm", "edge_radius": "2 mm", "angle": "45 deg", **STEEL}
OVAL = {"semi_axes": ("1 cm", "20 mm", 0.03), **STEEL}
TWO = {"centres": [(0, 0), ("3 mm", "8 mm")], "radii": "5 mm", **STEEL}
MIRROR = [[1, 0, 0], [0, -1, 0], [0, 0, 1]]


@pytest.mark.parametrize(
    ("make", "given"), [(rod, ROD), (cylinder, DISC), (ellipsoid, OVAL), (clump, TWO)]
)
def test_they_are_bodies_in_a_plane_and_in_space(make, given):
    body, whole = make(**given), make(**given, in_space=True)
    assert str(body) == str(whole)
    assert str(body).startswith(f"{make.__name__} (steel, M = ")
    assert body.is_planar
    assert not whole.is_planar
    assert body.inertia == whole.inertia[1][1]
    assert body.contact == whole.contact[::2]


def test_units_are_read():
    assert rod(**ROD, angle="0.5 rad") == rod(length=0.06, radius=0.005, **STEEL, angle=0.5)
    same = clump(centres=[(0, 0, 0), (0.003, 0, 0.008)], radii=[0.005, 0.005], **STEEL)
    assert clump(**TWO) == same


def test_what_leaves_its_plane_is_in_space():
    """A rotation in space, and spheres beside each other; in a plane y = const they are not."""
    assert not ellipsoid(**OVAL, orientation=[[1, 0, 0], [0, 0, -1], [0, 1, 0]]).is_planar
    assert not clump(centres=[(0, 0, 0), (0, 1, 1)], radii=1, **STEEL).is_planar
    assert clump(centres=[(0, 4, 0), (0, 4, 1)], radii=1, **STEEL).is_planar


def test_any_other_body_has_a_name_of_its_own():
    club = {"mass": "200 g", "inertia": 3e-4, "contact": (0.01, -0.02), "curvature_radius": "25 cm"}
    assert str(carom.Body(**club, **STEEL, name="driver")) == "driver (steel, M = 200 g)"
    assert str(carom.Body(**club, **STEEL)) == "body (steel, M = 200 g)"
    refused(r"name: 3 .* must be a text", carom.Body, **club, **STEEL, name=3)


@pytest.mark.parametrize(
    ("make", "given", "words"),
    [
        (rod, ROD | {"angle": "90 deg"}, "angle: '90 deg' .* touches in a line; incline it"),
        (rod, ROD | {"angle": -95}, "angle: -95 .* from -90 deg to 90 deg; a bare angle is in rad"),
        (rod, ROD | {"length": "9 mm"}, "length: '9 mm' .* twice the radius at least"),
        (
            rod,
            ROD | {"material": carom.Material(young=1e9, poisson=0.3)},
            "density: .* moves needs",
        ),
        (rod, ROD | {"length": 1e200}, "rod: floating point cannot hold"),
        (rod, ROD | {"in_space": 1}, "in_space: 1 .* True or False"),
        (cylinder, DISC | {"angle": 0}, "angle: 0 .* a flat end lies on the wall; incline it"),
        (cylinder, DISC | {"angle": "90 deg"}, "angle: .* straight side lies on the wall"),
        (cylinder, DISC | {"edge_radius": "3.1 mm"}, "edge_radius: .* and half of the length"),
        (cylinder, DISC | {"radius": "1 mm"}, "edge_radius: .* at most the radius"),
        (cylinder, DISC | {"inner_radius": "19 mm"}, "inner_radius: .* radius less edge_radius"),
        (ellipsoid, OVAL | {"semi_axes": (1, 2)}, "semi_axes: .* three positive numbers"),
        (ellipsoid, OVAL | {"semi_axes": (1, 2, 0)}, "semi_axes: .* three positive numbers"),
        (ellipsoid, OVAL | {"orientation": MIRROR}, "orientation: .* a rotation in space"),
        (
            ellipsoid,
            OVAL | {"orientation": [[2, 0], [0, 1]]},
            "orientation: .* a rotation in space",
        ),
        (
            ellipsoid,
            OVAL | {"orientation": MIRROR, "angle": 1},
            "angle: .* or orientation, not both",
        ),
        (clump, TWO | {"centres": []}, "centres: .* places in m"),
        (clump, TWO | {"centres": [(0, 0), (1, 0)]}, "centres: spheres 1 and 2 touch .* at once"),
        (clump, TWO | {"angle": "69.4439547804165 deg"}, "centres: spheres [12] and [12] touch"),
        (clump, TWO | {"radii": [1, 2, 3]}, "radii: .* or one for each sphere"),
        (
            clump,
            TWO | {"radii": -1, "centres": [1], "angle": "x"},
            "3 faults: .*angle.*cent.*radii",
        ),
        (rod, ROD | {"length": -1, "radius": "x", "angle": "4 m", "material": "?"}, "4 faults"),
    ],
)
def test_what_cannot_be_is_refused(make, given, words):
    refused(words, make, **given)
