"""Bodies of common shapes: each number against integrals and surfaces of the shape as a set.

A shape is here what its definition says: a function of places that is negative inside. It knows
nothing of second moments, of support functions, or of curvatures.
"""

from math import pi

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from scipy.stats import qmc
from tests.checks import FLOOR

import carom
from carom.bodies.solids import clump, cylinder, ellipsoid, rod

STUFF = carom.Material(young="10 GPa", poisson=0.3, density=2000)
TURN = Rotation.from_euler("zxy", [0.4, -0.7, 1.1])
PLACES = np.array([[0.1, 0.2, 0.0], [0.9, -0.3, 0.4], [0.5, 0.1, 1.0]])
RADII = np.array([0.5, 0.45, 0.6])


def rounded(length, radius, edge, hole=-1.0):
    """All places nearer than `edge` to a cylinder that is smaller by as much, and in no hole."""

    def outside(p):
        aside = np.hypot(p[..., 0], p[..., 1])
        beyond = np.maximum(np.abs(p[..., 2]) - (length / 2 - edge), 0.0)
        near = np.hypot(np.maximum(aside - (radius - edge), 0.0), beyond) - edge
        return np.maximum(near, hole - aside)

    return outside


def oval(*axes):
    return lambda p: np.linalg.norm(p / np.array(axes), axis=-1) - 1.0


def spheres(p):
    """The clump about its centre of mass, each sphere counted, as its lowest is what touches."""
    centre = RADII**3 @ PLACES / np.sum(RADII**3)
    return np.min(
        [np.linalg.norm(p - c, axis=-1) - r for c, r in zip(PLACES - centre, RADII, strict=True)], 0
    )


def about_y(angle):
    return Rotation.from_euler("y", angle, degrees=True)


def deg(angle):
    return {"angle": f"{angle} deg", "material": STUFF, "in_space": True}


ROUND = {"length": 1.2, "radius": 0.7, "edge_radius": 0.2}
SHAPES = {  # of a kind: the body, the shape as a set, how it is turned
    "rod": (rod(length=2.0, radius=0.3, **deg(35)), rounded(2.0, 0.3, 0.3), about_y(35)),
    "rod upright": (rod(length=2.0, radius=0.3, **deg(0)), rounded(2.0, 0.3, 0.3), about_y(0)),
    "rod to -x": (rod(length=0.9, radius=0.3, **deg(-70)), rounded(0.9, 0.3, 0.3), about_y(-70)),
    "disc": (cylinder(**ROUND, **deg(50)), rounded(1.2, 0.7, 0.2), about_y(50)),
    "disc to -x": (cylinder(**ROUND, **deg(-20)), rounded(1.2, 0.7, 0.2), about_y(-20)),
    "tube": (
        cylinder(**ROUND, inner_radius=0.45, **deg(65)),
        rounded(1.2, 0.7, 0.2, 0.45),
        about_y(65),
    ),
    "wheel": (
        cylinder(length=0.4, radius=0.7, edge_radius=0.2, **deg(90)),
        rounded(0.4, 0.7, 0.2),
        about_y(90),
    ),
    "ellipsoid": (
        ellipsoid(semi_axes=(0.5, 0.8, 1.1), **deg(130)),
        oval(0.5, 0.8, 1.1),
        about_y(130),
    ),
    "ellipsoid in space": (
        ellipsoid(semi_axes=(0.5, 0.8, 1.1), orientation=TURN, material=STUFF),
        oval(0.5, 0.8, 1.1),
        TURN,
    ),
    "clump": (clump(centres=PLACES, radii=RADII, **deg(25)), spheres, about_y(25)),
    "clump in space": (
        clump(centres=PLACES + 7.0, radii=RADII, orientation=TURN.as_matrix(), material=STUFF),
        spheres,
        TURN,
    ),
}
OVAL = {"semi_axes": (0.5, 0.8, 1.1), "angle": "30 deg", "material": STUFF}
REACH = 1.2  # of all of them from their centres
OVERLAPPING = {"clump", "clump in space"}  # counts twice there; see below


def shape(name):
    """Return a body, and its shape as a set in the frame of the wall."""
    body, outside, turn = SHAPES[name]
    return body, lambda p: outside(turn.inv().apply(p.reshape(-1, 3)).reshape(p.shape))


def lowest(outside, body, x, y):
    """Return the height at which a vertical line through a place enters the body."""
    z = body.contact[2]
    return brentq(lambda h: outside(np.array([x, y, h])), z - 0.05, z + 0.05, xtol=1e-15)


@pytest.mark.parametrize("name", SHAPES)
def test_it_touches_with_its_lowest_place(name):
    """None of its places is lower, and the contact is on the surface, to rounding."""
    body, outside = shape(name)
    places = REACH * (2.0 * qmc.Sobol(3, seed=1).random(2**17) - 1.0)
    inside = places[outside(places) <= 0.0]
    assert len(inside) > 1000
    assert inside[:, 2].min() > body.contact[2]
    assert lowest(outside, body, *body.contact[:2]) == pytest.approx(body.contact[2], abs=1e-12)
    around = body.contact[:2] + 0.003 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1], [0.5, 0.7]])
    assert all(lowest(outside, body, *place) > body.contact[2] + 1e-7 for place in around)


@pytest.mark.parametrize("name", SHAPES)
def test_its_curvatures_are_those_of_its_surface_there(name):
    """Differences of fourth order of the heights of the surface."""
    body, outside = shape(name)
    x, y, _ = body.contact
    steps, weights = np.arange(-2, 3), np.array([-1, 16, -30, 16, -1]) / 12
    h = 0.004

    def along(u, v):
        heights = [lowest(outside, body, x + h * s * u, y + h * s * v) for s in steps]
        return weights @ heights / h**2

    (xx, xy), (_, yy) = body.curvatures
    both = 0.5 * (along(1, 1) - along(1, -1)) / 2
    assert np.allclose([along(1, 0), along(0, 1), both], [xx, yy, xy], rtol=3e-6, atol=3e-6)


@pytest.mark.first_case
@pytest.mark.parametrize("name", sorted(set(SHAPES) - OVERLAPPING))
def test_its_mass_and_inertia_are_those_of_the_set(name):
    """By quasi Monte Carlo in the frame of the wall, which finds signs and axes."""
    body, outside = shape(name)
    unit = 2.0 * qmc.Sobol(3, seed=2).random(2**19) - 1.0
    box = REACH * (np.abs(unit[outside(REACH * unit) <= 0.0]).max(axis=0) + 0.02)
    inside = (box * unit)[outside(box * unit) <= 0.0]
    each = 2000 * np.prod(2.0 * box) / len(unit)
    spread = each * inside.T @ inside
    assert np.abs(inside.mean(axis=0)).max() < 1e-3
    assert len(inside) * each == pytest.approx(body.mass, rel=1e-3)
    assert np.allclose(
        np.trace(spread) * np.eye(3) - spread, body.inertia, atol=2e-3 * spread.max()
    )


@pytest.mark.parametrize(
    "sizes", [(2.0, 0.3, 0.3, 0.0), (1.2, 0.7, 0.2, 0.45), (0.4, 0.7, 0.2, 0.1)]
)
def test_cylinders_against_their_slices(sizes):
    """Discs or rings, whose radius is where the set ends, are summed along the axis."""
    length, radius, edge, hole = sizes
    outside = rounded(length, radius, edge)

    def rim(z):
        def end(r):
            return outside(np.array([r, 0.0, z]))

        return (
            radius - edge if end(radius - edge) >= 0.0 else brentq(end, radius - edge, 2 * radius)
        )

    def summed(of):
        parts = ((0.0, length / 2 - edge), (length / 2 - edge, length / 2))
        return 4000 * sum(quad(of, *part, epsabs=1e-13, limit=200)[0] for part in parts)

    mass = summed(lambda z: pi * (rim(z) ** 2 - hole**2))
    spin = summed(lambda z: pi / 2 * (rim(z) ** 4 - hole**4))
    along = summed(lambda z: pi * (rim(z) ** 2 - hole**2) * z**2)
    body = cylinder(
        **dict(zip(("length", "radius", "edge_radius", "inner_radius"), sizes, strict=True)),
        **deg(40),
    )
    principal = np.diag([along + spin / 2, along + spin / 2, spin])
    turn = about_y(40).as_matrix()
    assert body.mass == pytest.approx(mass, rel=1e-9)
    assert np.allclose(body.inertia, turn @ principal @ turn.T, rtol=1e-9, atol=1e-9 * spin)


def test_a_rod_is_that_of_the_textbooks():
    """A cylinder and two hemispheres, whose centres are 3 R/8 from their flats."""
    r, h = 0.3, 0.7
    drum, ball = 2000 * pi * r**2 * 2 * h, 2000 * 4 / 3 * pi * r**3
    across = drum * (r**2 / 4 + h**2 / 3) + ball * (2 / 5 * r**2 + h**2 + 3 / 4 * h * r)
    body = rod(length=2.0, radius=0.3, angle="35 deg", material=STUFF)
    assert body.mass == pytest.approx(drum + ball, rel=1e-14)
    assert body.inertia == pytest.approx(across, rel=1e-14)
    x, z = -h * np.sin(np.radians(35)), -h * np.cos(np.radians(35)) - r
    assert body.contact == pytest.approx((x, z), rel=1e-14)


def test_an_ellipsoid_is_that_of_the_textbooks():
    a, b, c = 0.5, 0.8, 1.1
    body = ellipsoid(semi_axes=(a, b, c), orientation=TURN, material=STUFF)
    principal = body.mass / 5 * np.diag([b**2 + c**2, a**2 + c**2, a**2 + b**2])
    turn = TURN.as_matrix()
    assert body.mass == pytest.approx(2000 * 4 / 3 * pi * a * b * c, rel=1e-14)
    assert np.allclose(body.inertia, turn @ principal @ turn.T, rtol=1e-13, atol=1e-13 * body.mass)


def test_a_clump_is_the_sum_of_its_spheres():
    """By the parallel axes of Steiner, in the frame of the wall."""
    body = clump(centres=PLACES, radii=RADII, orientation=TURN, material=STUFF)
    masses = 2000 * 4 / 3 * pi * RADII**3
    places = TURN.apply(PLACES - masses @ PLACES / masses.sum())
    inertia = sum(
        m * (2 / 5 * r**2 * np.eye(3) + p @ p * np.eye(3) - np.outer(p, p))
        for m, r, p in zip(masses, RADII, places, strict=True)
    )
    assert body.mass == pytest.approx(masses.sum(), rel=1e-14)
    assert np.allclose(body.inertia, inertia, rtol=1e-13, atol=1e-13 * body.mass)


LONE = {  # a sphere of 5 mm, made in each way
    "rod": rod(length="10 mm", radius="5 mm", angle="70 deg", material="steel"),
    "rod on its side": rod(length="10 mm", radius="5 mm", angle="90 deg", material="steel"),
    "cylinder": cylinder(
        length="10 mm", radius="5 mm", edge_radius="5 mm", angle=0, material="steel"
    ),
    "ellipsoid": ellipsoid(semi_axes=("5 mm",) * 3, angle="20 deg", material="steel"),
    "clump": clump(centres=[(3, 4)], radii="5 mm", material="steel"),
    "in space": ellipsoid(semi_axes=("5 mm",) * 3, orientation=TURN, material="steel"),
}


@pytest.mark.parametrize("name", LONE)
def test_a_sphere_is_the_limit_of_each(name):
    ball = carom.Sphere(radius="5 mm", material="steel")
    hit, same = (
        carom.impact(carom.Pair(body, FLOOR, 0.2), speed=2.0, angle="30 deg")
        for body in (LONE[name], ball)
    )
    assert np.ravel(hit.psi_out)[0] == pytest.approx(same.psi_out, rel=1e-6)
    assert hit.normal_restitution == pytest.approx(1.0, rel=1e-6)
    assert hit.duration == pytest.approx(same.duration, rel=1e-6)
    assert LONE[name].mass == pytest.approx(ball.mass, rel=1e-14)


@pytest.mark.first_case
@pytest.mark.parametrize("name", SHAPES)
def test_the_wall_pushes_at_the_contact(name):
    """About the contact the angular momentum stays; along the wall friction alone acts."""
    body = SHAPES[name][0]
    pair = carom.Pair(body, carom.HalfSpace(STUFF), 0.3)
    before = np.array([0.4, -0.2, -1.0])
    hit = carom.impact(pair, normal_speed=1.0, tangential_speed=before[:2], spin=(0.1, 0.2, 0.3))
    impulse = body.mass * (np.array([*hit.tangential_speed_out, hit.normal_speed_out]) - before)
    turned = np.asarray(body.inertia) @ (hit.spin_out - np.array([0.1, 0.2, 0.3]))
    assert impulse[2] > 0.0
    assert np.allclose(turned, np.cross(body.contact, impulse), atol=1e-12 * body.mass)


def test_a_body_that_leans_to_x_turns_over_to_x():
    """Its contact is at x < 0, so that the wall turns it about +y: its spin is negative."""
    for body in (SHAPES["rod"][0], clump(centres=[(0, 0), (0.3, 1)], radii=0.5, material=STUFF)):
        assert body.contact[0] < 0.0
    body = rod(length=2.0, radius=0.3, angle="35 deg", material=STUFF)
    hit = carom.impact(carom.Pair(body, carom.HalfSpace(STUFF), 0.0), normal_speed=1.0)
    assert hit.spin_out < 0.0


def test_in_space_a_body_leaves_as_in_its_plane():
    planar, whole = (
        carom.impact(
            carom.Pair(ellipsoid(**OVAL, in_space=in_space), carom.HalfSpace(STUFF), 0.3),
            normal_speed=1.0,
            tangential_speed=along,
        )
        for in_space, along in ((False, 0.2), (True, (0.2, 0.0)))
    )
    assert whole.psi_out[0] == pytest.approx(planar.psi_out, abs=1e-5)
    assert whole.psi_out[1] == pytest.approx(0.0, abs=1e-12)
    assert -whole.spin_out[1] == pytest.approx(planar.spin_out, rel=1e-5)
