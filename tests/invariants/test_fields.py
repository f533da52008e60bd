"""What holds for the fields of every impact at every time: forces, work, rigid stick, symmetry."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq

import carom
from carom import HalfSpace, Material, Pair, Sphere

MU = 0.3
BALL = Material(young="70 GPa", poisson=0.35, density=2700)
PLATE = Material(young="20 GPa", poisson=0.1, density=1000)
LIKE = Pair(Sphere(radius="4 mm", material=BALL), HalfSpace(material=PLATE), MU)
LATERAL = sum(m.poisson / m.shear_modulus for m in (BALL, PLATE)) / sum(
    (2.0 - m.poisson) / m.shear_modulus for m in (BALL, PLATE)
)
PSI = st.one_of(st.floats(-8.0, 8.0), st.floats(-1.0, 1.0)).filter(lambda p: abs(p) >= 1e-6)
CHI = st.one_of(st.floats(0.6, 10.0), st.floats(1.2, 2.2), st.sampled_from([4.0, 40.0]))
PLACE = st.floats(0.02, 0.98)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(120)
ANGLES = np.arange(8) * (math.pi / 4.0) + 0.3

examples = settings(max_examples=25, deadline=None, derandomize=True)


def impact_with(psi, chi):
    """Return an impact of given psi_1 and chi; the radius of gyration makes the chi."""
    gyration = LIKE.first.radius / math.sqrt(2.0 * chi / LIKE.kappa - 1.0)
    sphere = Sphere(radius=LIKE.first.radius, material=BALL, gyration_radius=gyration)
    pair = Pair(sphere, LIKE.second, MU)
    return carom.impact(pair, normal_speed=1.3, tangential_speed=psi * MU * 1.3 / pair.kappa)


def polar(radii, angles):
    """Return points (x, y), one row each."""
    r, a = np.meshgrid(radii, angles, indexing="ij")
    return np.stack([r * np.cos(a), r * np.sin(a)], axis=-1).reshape(-1, 2)


def rings(hit, time):
    """Return radii and weights r dr of quadrature over the contact, ring by ring."""
    memory = hit.solution.memory(time / hit.scales.time)
    edges = [0.0, *(annulus.outer * hit.scales.radius for annulus in memory.annuli)]
    radii, weights = [], []
    for inner, outer in pairwise(edges):  # square roots at either edge become smooth in the angle
        angle = 0.25 * math.pi * (1.0 + NODES)
        span = outer**2 - inner**2
        radii.append(np.sqrt(inner**2 + span * np.sin(angle) ** 2))
        weights.append(0.25 * math.pi * WEIGHTS * span * np.sin(angle) * np.cos(angle))
    return np.concatenate(radii), np.concatenate(weights)


def over_contact(hit, time, quantity):
    """Return the integral over the contact of what `quantity` makes of the fields."""
    radii, weights = rings(hit, time)
    values = quantity(hit.fields(time, points=polar(radii, ANGLES)))
    return weights @ values.values.reshape(len(radii), -1).mean(axis=1) * 2.0 * math.pi


def rigid(hit, time):
    """Return the tangential displacement U of the bodies in m."""
    unit = MU * hit.max_penetration / hit.pair.kappa
    return hit.solution.at(time / hit.scales.time).displacement[0] * unit


def slip_velocities(hit, time, points):
    fields = hit.fields(time, points=points)
    return np.stack([fields.slip_velocity_x, fields.slip_velocity_y], axis=-1)


def lag(hit, time, points):
    """Return rigid displacement less surface displacement: where facing points are, (n, 2)."""
    fields = hit.fields(time, points=points)
    return np.stack([rigid(hit, time) - fields.displacement_x, -fields.displacement_y], axis=-1)


@pytest.mark.slow
@examples
@given(psi=PSI, chi=CHI, place=PLACE)
def test_forces_and_elastic_energies_by_quadrature(psi, chi, place):
    """iint p = P_max d^(3/2), iint f = (3/2) mu P_max Q; (1/2) iint p u_z and f u_x are stored."""
    hit = impact_with(psi, chi)
    time = place * hit.duration
    now = hit.solution.at(place * hit.solution.duration)
    force = hit.max_force * now.penetration[0] ** 1.5
    assert over_contact(hit, time, lambda f: f.pressure) == pytest.approx(force, rel=1e-11)
    pushed = over_contact(hit, time, lambda f: f.traction_x)
    assert abs(pushed - 1.5 * MU * hit.max_force * now.force[0]) <= 1e-10 * MU * force
    energy = 0.4 * force * now.penetration[0] * hit.max_penetration
    actual = over_contact(hit, time, lambda f: 0.5 * f.pressure * f.displacement_z)
    assert actual == pytest.approx(energy, rel=1e-11)
    unit = hit.pair.tangential_mass * (MU * hit.normal_speed / hit.pair.kappa) ** 2
    actual = over_contact(hit, time, lambda f: 0.5 * f.traction_x * f.displacement_x)
    rounding = 1e-13 * max(1.0, psi**2) * unit  # of `stored`, relative to psi^2/2
    assert abs(actual - now.stored[0] * unit) <= 1e-10 * MU**2 * energy + rounding


@examples
@given(psi=PSI, chi=CHI, place=PLACE)
def test_bounds_and_zones(psi, chi, place):
    """abs(f) <= mu p, with equality where it slips; zones follow the radii; nothing outside."""
    hit = impact_with(psi, chi)
    fields = hit.fields(place * hit.duration)
    limit, unit = MU * fields.pressure.values, MU * hit.max_pressure
    traction, zone = fields.traction_x.values, fields.zone.values
    r = np.hypot(*np.meshgrid(fields.x, fields.y))
    assert np.all(np.abs(traction) <= limit + 1e-12 * unit)
    assert np.all(np.abs(np.abs(traction) - limit)[zone == 2] <= 1e-12 * unit)
    a, b = float(fields.stick_radius), float(fields.contact_radius)
    assert b == pytest.approx(math.sqrt(hit.pair.effective_radius * fields.penetration), rel=1e-14)
    assert np.array_equal(zone, np.where(r > b, 0, np.where(r < a, 1, 2)))
    for name in ("pressure", "traction_x", "slip_x", "slip_y"):
        assert np.all(fields[name].values[zone == 0] == 0.0)
    for name in ("slip_velocity_x", "slip_velocity_y"):
        assert np.all(fields[name].values[zone != 2] == 0.0)


@examples
@given(psi=PSI, chi=CHI, place=PLACE)
def test_mirror_images(psi, chi, place):
    """What is along x is even in x and y, what is along y odd; -psi_1 turns what is tangential."""
    hit, twin = impact_with(psi, chi), impact_with(-psi, chi)
    half = np.linspace(0.1, 1.2, 6) * hit.max_radius
    along = np.concatenate([-half[::-1], half])
    fields, other = (h.fields(place * hit.duration, along, along) for h in (hit, twin))
    for name in (name for name, item in fields.items() if item.dims):
        values = fields[name].values
        sign = -1.0 if name.endswith("_y") else 1.0
        near = {"rtol": 0.0, "atol": 1e-14 * np.abs(values).max()}
        assert np.allclose(values[::-1], sign * values, **near)
        assert np.allclose(values[:, ::-1], sign * values, **near)
        tangential = name.endswith(("_x", "_y"))
        assert np.array_equal(other[name].values, -values if tangential else values)


@examples
@given(psi=PSI, chi=CHI, first=PLACE, second=PLACE)
def test_stick_zone_moves_as_a_rigid_body(psi, chi, first, second):
    """Between two times of a phase the stick zone is displaced by the change of U, u_y by none."""
    hit = impact_with(psi, chi)
    for phase in (phase for phase in hit.phases if phase.kind != "gross slip"):
        times = [phase.start + part * (phase.end - phase.start) for part in (first, second)]
        now = [hit.solution.at(time / hit.scales.time) for time in times]
        stuck = min(h.stick_radius[0] for h in now) * hit.scales.radius
        points = polar(stuck * np.array([0.0, 0.3, 0.7, 0.95, 0.999]), ANGLES)
        before, after = (lag(hit, time, points) for time in times)
        unit = MU * hit.max_penetration / hit.pair.kappa
        assert np.all(np.abs(after - before) <= 1e-12 * unit * max(1.0, abs(psi)))


def edge_passes(hit, radius):
    """Return the time at which the edge of the growing contact reaches a radius."""
    s = (radius / hit.scales.radius) ** 2
    half = 0.5 * hit.solution.duration
    time = brentq(lambda t: hit.solution.at(t).penetration[0] - s, 0.0, half, xtol=1e-15)
    return time * hit.scales.time


@examples
@given(psi=PSI, chi=CHI, place=PLACE, part=st.floats(0.1, 0.98))
def test_slip_since_the_points_met(psi, chi, place, part):
    """Slip is the change of U - u_x and of -u_y since the edge passed the point."""
    hit = impact_with(psi, chi)
    time = place * hit.duration
    radius = part * hit.contact(time).radius
    points = polar([radius], ANGLES)
    fields = hit.fields(time, points=points)
    slid = np.stack([fields.slip_x, fields.slip_y], axis=-1)
    expected = lag(hit, time, points) - lag(hit, edge_passes(hit, radius), points)
    unit = MU * hit.max_penetration / hit.pair.kappa
    assert np.all(np.abs(slid - expected) <= 1e-11 * unit * max(1.0, abs(psi)))


def in_every_phase(hit, place):
    """Yield each phase, a time of it, and radii in its stick zone and its ring, if it is wide."""
    for phase in hit.phases:
        time = phase.start + place * (phase.end - phase.start)
        contact = hit.contact(time)
        a, b = contact.stick_radius * hit.scales.radius, contact.radius
        ring = a + (b - a) * np.array([0.1, 0.5, 0.9])
        radii = np.append([0.5 * a, 0.95 * a], ring)
        if a <= 0.98 * b or phase.kind == "stick":
            yield phase, time, radii[radii <= 0.998 * b]


@pytest.mark.slow
@examples
@given(psi=PSI, chi=CHI, place=PLACE)
def test_slip_velocity_is_the_rate_of_slip(psi, chi, place):
    """In every phase slip velocity is d(U - u_x)/dt and -d(u_y)/dt, by differences in time."""
    hit = impact_with(psi, chi)
    unit = MU * hit.normal_speed / hit.pair.kappa * max(1.0, abs(psi))
    for phase, time, radii in in_every_phase(hit, place):
        points = polar(radii, ANGLES)
        step = 2e-5 * min(time - phase.start, phase.end - time)
        early, late = (lag(hit, time + h, points) for h in (-step, step))
        rate = (late - early) / (2.0 * step)
        near = 1e-6 * unit + 1e-15 * unit * hit.scales.time / step  # what rounding adds
        assert np.all(np.abs(slip_velocities(hit, time, points) - rate) <= near)


@pytest.mark.slow
@examples
@given(psi=PSI, chi=CHI, place=PLACE)
def test_slip_velocity_and_power_in_closed_form(psi, chi, place):
    """With q' = psi at x < a, sigma v beyond, and cos(phi) = a/r, the slip velocity is
    (psi - sigma v)(2/pi)(phi - k cos 2 theta, -k sin 2 theta), k = lambda sin(phi) cos(phi):
    at most arcsin(lambda) off the x-axis. Its power is abs(psi - sigma v) int (d - x^2) dx.
    """
    hit = impact_with(psi, chi)
    speed = MU * hit.normal_speed / hit.pair.kappa
    for phase, time, radii in in_every_phase(hit, place):
        if phase.kind == "stick":
            continue
        now = hit.solution.at(time / hit.scales.time)
        a, b = now.stick_radius[0], now.contact_radius[0]
        radii = radii[radii >= a * hit.scales.radius]
        cos = np.repeat(a * hit.scales.radius / np.maximum(radii, 1e-300), ANGLES.size)
        theta, phi = np.tile(ANGLES, radii.size), np.arccos(cos)
        lateral = LATERAL * np.sin(phi) * cos
        shape = np.stack([phi - lateral * np.cos(2.0 * theta), -lateral * np.sin(2.0 * theta)])
        rate = now.psi[0] - phase.sign * now.speed[0]
        value = slip_velocities(hit, time, polar(radii, ANGLES)) / speed
        assert np.all(np.abs(value - rate * 2.0 / math.pi * shape.T) <= 1e-12 * max(1.0, abs(psi)))
        angle = np.arctan2(np.abs(value[:, 1]), phase.sign * value[:, 0])
        assert np.all(angle <= math.asin(LATERAL) + 1e-9)
        power = abs(rate) * ((b**3 - a**3) * 2.0 / 3.0 - a * (b * b - a * a))
        power *= 1.5 * MU * hit.max_force * speed
        work = over_contact(hit, time, lambda f: f.traction_x * f.slip_velocity_x)
        assert work == pytest.approx(power, rel=1e-9, abs=1e-12 * MU * hit.max_force * speed)


@examples
@given(psi=PSI, chi=CHI, place=PLACE)
def test_far_away_the_load_is_a_point_force(psi, chi, place):
    """2 pi G u_x = F_x ((1 - nu)/r + nu x^2/r^3) for each body (Johnson 1985, 3.2), and so on."""
    hit = impact_with(psi, chi)
    time = place * hit.duration
    points = polar([4e3 * hit.contact(time).radius], ANGLES)
    fields, (x, y) = hit.fields(time, points=points), points.T
    r, expected = np.hypot(x, y), np.zeros((3, len(x)))
    for body in (hit.pair.first, hit.pair.second):
        nu, unit = body.material.poisson, 2.0 * math.pi * body.material.shear_modulus * r
        expected[0] += float(fields.tangential_force) * (1.0 - nu + nu * x * x / r**2) / unit
        expected[1] += float(fields.tangential_force) * nu * x * y / r**2 / unit
        expected[2] += float(fields.normal_force) * (1.0 - nu) / unit
    scale = np.array([MU, MU, 1.0])[:, None] * expected[2]
    values = np.stack([fields[f"displacement_{axis}"] for axis in "xyz"])
    assert np.all(np.abs(values - expected) <= 1e-7 * scale)


def test_without_friction_it_slides_freely():
    """No traction, no tangential displacement; slip is V_x times the time since the points met."""
    frictionless = Pair(LIKE.first, LIKE.second, 0.0)
    hit = carom.impact(frictionless, normal_speed=1.3, tangential_speed=0.4)
    time = 0.4 * hit.duration
    radius = 0.6 * hit.contact(time).radius
    fields = hit.fields(time, points=polar([radius], ANGLES))
    for name in ("traction_x", "displacement_x", "displacement_y", "slip_y", "slip_velocity_y"):
        assert np.all(fields[name] == 0.0)
    assert np.all(fields.zone == 2)
    assert np.allclose(fields.slip_velocity_x, 0.4, rtol=1e-15, atol=0.0)
    assert np.allclose(fields.slip_x, 0.4 * (time - edge_passes(hit, radius)), rtol=1e-11, atol=0.0)
    assert np.isclose(fields.displacement, 0.4 * time, rtol=1e-12, atol=0.0)


@pytest.mark.parametrize("place", [0.0, 1.0])
def test_first_and_last_touch(place):
    """At the first and the last touch nothing presses and nothing is displaced."""
    hit = impact_with(0.5, 1.44)
    fields = hit.fields(place * hit.duration)
    for name in (name for name, item in fields.items() if item.dims):
        assert np.all(np.abs(fields[name]) <= 1e-12 * hit.max_pressure), name
        assert np.all(np.isfinite(fields[name])), name
