"""Surface fields against point forces, integrated numerically (`tests.oracles.chords`)."""

import math
from itertools import pairwise

import numpy as np
import pytest
from tests.oracles.chords import Load, spread

import carom
from carom import HalfSpace, Material, Pair, Sphere

STEEL = Material(young="210 GPa", poisson=0.3, density=7850)
RUBBER = Material(young="8 MPa", poisson=0.5, density=1100)
GLASS = Material(young="70 GPa", poisson=0.23, density=2500)
MU = 0.15
SPEED = 0.8

# psi_1, chi, phase, part of the phase that has passed
MOMENTS = {
    "stick from the first touch": (0.3, 1.75, 0, 0.6),
    "backward ring while loading": (0.3, 1.75, 1, 0.08),
    "backward ring while unloading": (0.3, 1.75, 1, 0.7),
    "ring after the ring closed": (0.3, 1.75, 2, 0.5),
    "gross slip at the end": (0.3, 1.75, 3, 0.5),
    "gross slip while loading": (1.5, 1.44, 0, 0.7),
    "stick after gross slip": (1.5, 1.44, 1, 0.5),
    "ring around stick and slip of old": (1.5, 1.44, 2, 0.4),
    "retraced": (0.2, 4.0, 0, 0.8),
    "ring while loading": (0.9525, 4.3, 1, 0.3),
    "stick again": (0.9525, 4.3, 2, 0.8),
    "ring after stick again": (0.9525, 4.3, 3, 0.2),
    "mirrored": (-0.5, 1.44, 1, 0.5),
}


def traction_of(memory):
    """Return f(r) of (6), from g(s) alone, as a function of r = sqrt(s), and the edges of rings."""
    edges = np.array([0.0, *(annulus.outer for annulus in memory.annuli)])

    def f(r):
        total = 0.0
        for inner, outer in pairwise(edges):
            if outer > r:
                low = math.sqrt(max(inner**2 - r**2, 0.0))
                w, weights = spread(low, math.sqrt(outer**2 - r**2))
                total += weights @ memory.g(r * r + w * w)
        return total

    return f, edges


def displacements(pair, length, tangential, normal, x, y):
    """Return the combined u_x, u_y, u_z in m at (x, y) in sqrt(R* length), from two loads.

    Loads are in units of 2 E*/(pi R*) sqrt(R* length), the tangential one without mu.
    """
    unit = 2.0 * pair.effective_modulus * length / math.pi
    total = np.zeros(3)
    whole, along, across = pair.friction * tangential.integrals(x, y)
    pressed = normal.integrals(x, y)[0]
    for body in (pair.first, pair.second):
        nu, shear = body.material.poisson, body.material.shear_modulus
        each = ((1 - nu) * whole + nu * along, nu * across, (1 - nu) * pressed)
        total += np.array(each) * unit / (2.0 * math.pi * shear)
    return total


def hertz_load(b):
    return Load(lambda r: math.sqrt(b * b - r * r), [0.0, b])


def impact_with(psi, chi, ball=STEEL, plate=STEEL):
    """Return an impact of given psi_1 and chi; the radius of gyration makes the chi."""
    like = Pair(Sphere(radius="10 mm", material=ball), HalfSpace(material=plate), MU)
    gyration = like.first.radius / math.sqrt(2.0 * chi / like.kappa - 1.0)
    sphere = Sphere(radius="10 mm", material=ball, gyration_radius=gyration)
    pair = Pair(sphere, like.second, MU)
    assert pair.chi == pytest.approx(chi, rel=1e-14)
    speed = psi * MU * SPEED / pair.kappa
    return carom.impact(pair, normal_speed=SPEED, tangential_speed=speed)


def places(edges):
    """Return points on axes, diagonal and elsewhere: in every ring, at the edge, and outside."""
    radii = [0.5 * (low + high) for low, high in pairwise(edges)]
    radii += [0.999 * edges[-1], 1.02 * edges[-1], 2.5 * edges[-1]]
    angles = (0.0, 0.5 * math.pi, 0.25 * math.pi, -2.7)
    return np.array([(r * math.cos(a), r * math.sin(a)) for r in radii for a in angles])


def fields_at(hit, time, points):
    """Return fields at points in units of sqrt(R* d_max), and their displacements as one array."""
    fields = hit.fields(time * hit.scales.time, points=points * hit.scales.radius)
    names = ("displacement_x", "displacement_y", "displacement_z")
    return fields, np.stack([fields[name].values for name in names], axis=-1)


def test_the_integration_gives_gross_slip_of_the_paper():
    """The oracle itself: (28) gives (29) and Hertz's u_z = d - r^2/(2 R*), to 1e-14."""
    b, nu, length = 0.8, 0.3, 1e-5
    pair = impact_with(0.5, 1.44).pair
    load = hertz_load(b)
    inside = np.array([(0.3, 0.0), (0.0, 0.5), (0.4, 0.4), (-0.3, 0.6)])
    unit = MU * length / (8.0 * (1.0 - nu))
    for x, y in inside:
        x2, y2 = x * x, y * y
        expected = [
            unit * (2.0 * (2.0 - nu) * (2.0 * b * b - x2 - y2) + nu * (x2 - y2)),
            unit * nu * 2.0 * x * y,
            length * (b * b - 0.5 * (x2 + y2)),
        ]
        actual = displacements(pair, length, load, load, x, y)
        assert np.allclose(actual, expected, rtol=0.0, atol=1e-14 * length)


def test_the_integration_agrees_with_plain_quadrature_outside():
    """The oracle itself: outside the contact nothing is singular, and Cartesian rho will do."""
    hit = impact_with(0.3, 1.75, STEEL, GLASS)
    f, edges = traction_of(hit.solution.memory(1.6))
    load, x, y = Load(f, edges), 0.9, -0.8
    angles = np.arange(256) * (2.0 * math.pi / 256)
    along = across = 0.0
    for (inner, outer), series in zip(pairwise(load.edges), load.series, strict=True):
        w, weights = spread(0.0, math.sqrt(outer**2 - inner**2))
        for w_i, part in zip(w, weights, strict=True):  # r dr = -w dw
            r = math.sqrt(outer**2 - w_i**2)
            dx, dy = x - r * np.cos(angles), y - r * np.sin(angles)
            area = part * w_i * series(w_i) * (2.0 * math.pi / 256)
            along += area * np.sum(dx**2 / np.hypot(dx, dy) ** 3)
            across += area * np.sum(dx * dy / np.hypot(dx, dy) ** 3)
    assert load.integrals(x, y)[1:] == pytest.approx([along, across], rel=1e-11)


@pytest.mark.first_case
@pytest.mark.parametrize("name", MOMENTS)
def test_fields_against_the_point_force_solution(name):
    """Tractions to 1e-12 of their largest value, displacements to 1e-12 of mu d/kappa and d."""
    psi, chi, index, part = MOMENTS[name]
    hit = impact_with(psi, chi)
    phase = hit.solution.phases[index]
    compare(hit, phase.start + part * (phase.end - phase.start))


@pytest.mark.parametrize(("ball", "plate"), [(STEEL, GLASS), (GLASS, RUBBER)])
def test_fields_between_unlike_materials(ball, plate):
    """Each body has its own nu and G; their displacements add up."""
    compare(impact_with(1.5, 1.6, ball, plate), 1.4)


def compare(hit, time):
    f, edges = traction_of(hit.solution.memory(time))
    tangential, normal = Load(f, edges), hertz_load(edges[-1])
    points = places(edges)
    fields, actual = fields_at(hit, time, points)
    length, pair = hit.scales.length, hit.pair
    unit = np.array([MU / pair.kappa, MU / pair.kappa, 1.0]) * length * edges[-1] ** 2
    for row, (x, y) in zip(actual, points, strict=True):
        expected = displacements(pair, length, tangential, normal, x, y)
        assert np.all(np.abs(row - expected) <= 1e-12 * unit)
    pressure = 2.0 * pair.effective_modulus / math.pi * math.sqrt(length / pair.effective_radius)
    for traction, (x, y) in zip(fields.traction_x.values, points, strict=True):
        r = math.hypot(x, y)
        expected = MU * pressure * f(r) if r < edges[-1] else 0.0
        assert abs(traction - expected) <= 1e-12 * MU * pressure * edges[-1]


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("psi", "chi", "index"), [(0.5, 1.44, 1), (0.3, 1.75, 1), (0.9525, 4.3, 3)]
)
def test_angle_between_slip_and_traction(psi, chi, index):
    """Its mean over a phase, by quadrature over time, radius and angle, weighted by |f| |dw/dt|."""
    hit = impact_with(psi, chi)
    phase, angle = hit.phases[index], hit.slip_angles[index]
    theta, weights = spread(0.0, 0.5 * math.pi)
    passed, share = np.sin(theta) ** 2, weights * np.sin(2.0 * theta)  # smooth at square roots
    turned = power = 0.0
    for part, weight in zip(passed, share, strict=True):
        time = phase.start + part * (phase.end - phase.start)
        contact = hit.contact(time)
        inner, outer = contact.stick_radius * hit.scales.radius, contact.radius
        span = outer**2 - inner**2
        r, a = np.meshgrid(np.sqrt(inner**2 + span * passed), theta, indexing="ij")
        points = np.stack([(r * np.cos(a)).ravel(), (r * np.sin(a)).ravel()], axis=-1)
        fields = hit.fields(time, points=points)
        slip = np.stack([fields.slip_velocity_x, fields.slip_velocity_y])
        rate = np.abs(fields.traction_x.values * slip[0])  # the work of friction
        lean = np.arctan2(np.abs(slip[1]), np.abs(slip[0]))
        area = weight * span * np.outer(share, weights).ravel()
        power += area @ rate
        turned += area @ (rate * lean)
        assert np.all(lean <= angle.largest)
    assert turned / power == pytest.approx(angle.mean, rel=1e-8)
    assert angle.largest == pytest.approx(math.asin(0.3 / (2.0 - 0.3)), rel=1e-14)
