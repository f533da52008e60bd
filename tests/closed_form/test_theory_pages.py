"""The theory pages of the manual: what they name exists, what they state holds.

Formulas are written here as the pages print them, by their numbers, independently of the library.
"""

import pkgutil
import re
from math import asin, pi, sqrt
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import beta, gamma, hyp2f1, rgamma
from tests.oracles.stick import Stick

import carom
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import flat, stacked
from carom.dimensionless.fields.subsurface import stresses
from carom.dimensionless.load_paths import paths
from carom.dimensionless.lossy.springs import metal, motion as at
from carom.dimensionless.lossy.springs.springs import NEXT, SPRING_COLUMNS, S, step_of, stretched
from carom.dimensionless.lossy.springs.thornton import bear, capped
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.numerics import hertz
from carom.halfspace.compliance import Materials

DOCS = Path(__file__).parents[2] / "docs"
PAGES = [DOCS / "theory.md", *sorted((DOCS / "theory").glob("*.md"))]
STEEL, GLASS = (carom.material(name) for name in ("steel", "soda-lime-glass"))
SPHERES = carom.Pair(
    carom.Sphere(radius=0.004, material=STEEL),
    carom.Sphere(radius=0.007, material=GLASS, inner_radius=0.005),
    friction=0.15,
)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_everything_that_a_page_names_exists(page):
    text = page.read_text(encoding="utf-8")
    for name in re.findall(r"`((?:carom|tests\.oracles)(?:\.\w+)+)`", text):
        pkgutil.resolve_name(name)
    for target in re.findall(r"\]\(([^)#:]+)\)", text):
        assert (page.parent / target).is_file(), target
    tests = "".join(path.read_text() for path in DOCS.parent.glob("tests/*/test_*.py"))
    for name in re.findall(r"`(test_\w+)`", text):
        assert f"def {name}(" in tests, name


def test_references_lead_to_an_equation_that_is_numbered_once():
    texts = {page.name: page.read_text(encoding="utf-8") for page in PAGES}
    numbers = re.findall(r"\\tag\{([\dE]+\.\d+)\}", "".join(texts.values()))
    assert len(numbers) == len(set(numbers)) > 80
    for name, text in texts.items():
        for number in re.findall(r"(?<!Johnson 1985, )\((\d+\.\d+)\)", text):
            assert number in numbers, (name, number)


def exponents(chi):
    """(4.3)."""
    return tuple((11.0 + sign * np.sqrt(240.0 * chi + 1.0)) / 20.0 for sign in (1, -1))


def turning(chi):
    """E(0) of (4.10)."""
    return gamma(0.6) * gamma(0.5) * np.prod(rgamma(exponents(chi)))


def closing(psi, chi):
    return sum(phase.cause == "slip ring closes" for phase in carom.solve(psi, chi).phases)


def test_1_scales_make_the_motion_of_two_spheres_dimensionless():
    pair, unit = SPHERES, SPHERES.scales(1.3)
    assert pair.normal_mass * 1.3**2 * 1.25 == pytest.approx(unit.force * unit.length)
    rate = unit.tangential_force / pair.tangential_mass  # of V_x at Q = 1, SI
    assert rate * unit.time / unit.tangential_speed == pytest.approx(3.75 * pair.chi)
    assert unit.tangential_length / unit.time == pytest.approx(unit.tangential_speed)
    moduli = sum((1 - m.poisson**2) / m.young for m in (STEEL, GLASS))
    shear = sum((2 - m.poisson) * (1 + m.poisson) / (2 * m.young) for m in (STEEL, GLASS))
    assert pair.kappa == pytest.approx(moduli / shear)


def test_1_friction_touches_the_energy_of_the_contact_point_alone():
    hit = carom.impact(SPHERES, normal_speed=1.0, tangential_speed=0.4, spin=90.0, spin2=-70.0)
    inertias = [body.mass * body.gyration_ratio * body.radius**2 for body in SPHERES.moving]
    m_n = SPHERES.normal_mass

    def energy(v, *spins):
        return 0.5 * m_n * v**2 + sum(0.5 * i * w**2 for i, w in zip(inertias, spins, strict=True))

    lost = energy(0.4, 90.0, -70.0) - energy(hit.tangential_speed_out, hit.spin_out, hit.spin2_out)
    before, after = hit.contact_velocity, hit.contact_velocity_out
    assert before == pytest.approx(0.4 + 0.004 * 90.0 - 0.007 * 70.0)
    assert lost == pytest.approx(0.5 * SPHERES.tangential_mass * (before**2 - after**2), rel=1e-12)


@pytest.mark.parametrize("share", [0.4, 0.8])
def test_equations_in_the_notation_of_the_paper_are_ours(share):
    """(4) to (14) and (31) as the pages print them, in SI, beside a whole impact that sticks."""
    R, V_1, mu, psi_1 = 0.005, 1.3, 0.2, 0.6
    ball = carom.Sphere(radius=R, material=STEEL)
    pair = carom.Pair(ball, carom.HalfSpace(STEEL), mu)
    unit = pair.scales(V_1)
    nu, G, M, K2 = STEEL.poisson, STEEL.shear_modulus, ball.mass, 0.4 * R**2
    chi = (1 - nu) / (2 - nu) * (1 + R**2 / K2)  # (16)
    c = 16 * G / (15 * M * R**2 * V_1**2 * (1 - nu))  # (5)
    assert [chi, c] == pytest.approx([pair.chi, (R * unit.length) ** -2.5], rel=1e-12)
    contact = carom.solve(psi_1, chi)
    t = share * contact.phases[0].end
    now = contact.at(t)
    b, rest = float(now.contact_radius[0]) * unit.radius, 1 - float(now.contact_radius[0]) ** 5
    root, level = sqrt(240 * chi + 1), 2 * G * mu / (pi * R * (1 - nu))

    def g(b):
        return psi_1 * hyp2f1((11 + root) / 20, (11 - root) / 20, 0.6, c * b**5)  # (17), (18), (27)

    def traction(r):
        return level * quad(lambda y: g(sqrt(r * r + y * y)), 0, sqrt(b * b - r * r))[0]  # (6)

    V_z = V_1 * sqrt(1 - c * b**5)  # (4)
    grows = R * V_1 / (2 * b) * sqrt(1 - c * b**5)  # (9)
    V_x = (2 - nu) * mu * b * g(b) / (R * (1 - nu)) * grows  # (8)
    assert V_z == pytest.approx(V_1 * now.speed[0], rel=1e-9)
    assert V_x == pytest.approx(mu * V_1 / pair.kappa * now.psi[0], rel=1e-8)
    ends = mu * (2 - nu) / (R * (1 - nu)) * b * grows  # (31)
    assert ends == pytest.approx(mu * V_z / pair.kappa)
    later = contact.memory(t * 1.00001).profile()
    before, r = contact.memory(t).profile(), 0.5 * b
    rise = [surface.traction(one, r / unit.radius) for one in (before, later)]
    assert traction(r) == pytest.approx(mu * unit.pressure * rise[0], rel=1e-7)
    steep = mu * unit.pressure * (rise[1] - rise[0]) / (1e-5 * t * unit.time)
    assert level * b * g(b) / sqrt(b * b - r * r) * grows == pytest.approx(steep, rel=1e-3)  # (7)
    force = quad(lambda r: 2 * pi * r * traction(r), 0, b)[0]  # (11)
    assert force == pytest.approx(unit.tangential_force * now.force[0], rel=1e-7)
    slope = (g(b * 1.00001) - g(b * 0.99999)) / (2e-5 * b)
    bracket = 2.5 * c * b**4 * g(b) - rest * slope
    motion = (2 - nu) * R * V_1**2 * mu / (4 * (1 - nu) * b) * bracket  # (14)
    assert force / M * (1 + R**2 / K2) == pytest.approx(motion, rel=1e-6)


def test_2_hertz():
    assert quad(lambda y: y * np.arccos(y), 0, 1)[0] == pytest.approx(pi / 8)  # (2.2)
    assert 0.8 * beta(0.4, 0.5) == pytest.approx(hertz.DURATION, rel=1e-15)  # (2.9)
    for d in (0.1, 0.6):
        t = float(0.4 * mp.betainc(0.4, 0.5, 0, d**2.5))  # (2.7)
        assert hertz.time(d, sqrt(1 - d**2.5)) == pytest.approx(t, rel=1e-13)


@pytest.mark.parametrize("r", [0.4, 1.0001, 1.7])
def test_3_chords_give_a_punch_inside_and_outside(r):
    nu, theta = 0.35, 0.7  # one body, A = 1, a = 1: each chord is worth pi
    reach = pi / 2 if r < 1 else asin(1 / r)
    lateral, unit = nu / (2 - nu), pi * (1 - nu / 2)  # of a displacement that is 1 inside
    u_x = quad(lambda p: (1 - nu + nu * np.cos(p + theta) ** 2) / unit, -reach, reach)[0]
    u_y = quad(lambda p: nu * np.sin(p + theta) * np.cos(p + theta) / unit, -reach, reach)[0]
    w_0, w_2 = surface.slip_shape(1.0, r)
    assert u_x == pytest.approx(1 - w_0 + lateral * w_2 * np.cos(2 * theta), abs=1e-12)
    assert u_y == pytest.approx(lateral * w_2 * np.sin(2 * theta), abs=1e-12)


@pytest.mark.slow
def test_3_memory_and_traction_determine_each_other():
    memory = carom.solve(0.8, 1.4412).memory(1.2)
    profile, b = memory.profile(), sqrt(memory.penetration)

    def moment(w, x):  # r f dr/sqrt(r^2 - x^2), r^2 = x^2 + w^2
        return surface.traction(profile, min(sqrt(x * x + w * w), b))

    for x in (0.1, 0.6):
        value = 4 / pi * quad(moment, 0, sqrt(b * b - x * x), args=(x,), epsabs=1e-10)[0]
        assert value == pytest.approx(float(memory.q(x * x)), abs=1e-8)
    for r in (0.3, 0.9, 2.0):  # (9.4)
        mean = quad(lambda y: surface.displacement(profile, y)[0] * y, 0, r, points=[b], limit=200)
        u_0, u_2 = surface.displacement(profile, r)
        assert u_2 == pytest.approx(2 / r**2 * mean[0] - u_0, abs=1e-7)


@pytest.mark.parametrize("chi", [0.3, 0.8, 1.4412, 3.0, 9.0, 20.0])
def test_4_gauss_and_gegenbauer_are_one_solution(chi):
    n, (a, b) = (sqrt(240 * chi + 1) - 1) / 10, exponents(chi)
    stick = Stick.from_touch(0.01, chi)
    for v in (0.95, 0.6, 0.2):
        gegenbauer = float(mp.hyp2f1(-n, n + 0.2, 0.6, (1 - v) / 2))  # (4.9)
        gauss = float(mp.hyp2f1(a, b, 0.6, 1 - v * v))  # (4.5)
        assert_allclose(v * gauss, gegenbauer, rtol=1e-9, atol=1e-11)
        assert_allclose(stick.psi(v), 0.01 * gegenbauer, rtol=1e-9, atol=1e-13)
    assert stick.psi(0.0) == pytest.approx(0.01 * turning(chi), rel=1e-9)


def test_corrected_14_gives_15():
    c, chi = mp.mpf(1), mp.mpf("1.44")
    root = mp.sqrt(240 * chi + 1)

    def g(b):
        return mp.hyp2f1((11 + root) / 20, (11 - root) / 20, 0.6, c * b**5)

    b, x = mp.mpf("0.8"), mp.mpf("0.8") ** 5
    fifteen = (1 - x) * b**2 * mp.diff(g, b, 2) - (1 + 6.5 * x) * b * mp.diff(g, b)
    assert abs(fifteen + 7.5 * x * (2 * chi - 1) * g(b)) < 1e-8
    force = 15 * c * chi * b * mp.quad(lambda s: s * s * g(s), [0, b])
    brackets = [2.5 * b**4 * g(b) - (1 - x) ** power * mp.diff(g, b) for power in (1, 0.5)]
    assert abs(brackets[0] - force) < 1e-8
    assert float(brackets[1] / force) == pytest.approx(1.16, abs=0.01)


def test_retracing_and_the_second_solution():
    x = np.linspace(0, 1, 100_001)
    for k, limit in enumerate((1.0, 0.4, 0.256, 0.19017)):  # (4.11), (4.12)
        chi = ((11 + 20 * k) ** 2 - 1) / 240
        a, b = exponents(chi)
        assert 1 / np.abs(hyp2f1(a, round(b), 0.6, x)).max() == pytest.approx(limit, rel=1e-4)
        assert carom.rebound(0.99 * limit, chi) == pytest.approx(-0.99 * limit, rel=1e-9)
        below, beyond = (carom.solve(share * limit, chi).phases for share in (0.99, 1.02))
        assert [phase.kind for phase in below] == ["stick"] != [phase.kind for phase in beyond]
    x = x[1:]
    h, slope, bend = x**0.4, 0.4 * x**-0.6, -0.24 * x**-1.6  # (19) at chi = 3/2
    assert_allclose(10 * x * (1 - x) * bend + 3 * (2 - 7 * x) * slope + 6 * h, 0, atol=1e-9)


@pytest.mark.parametrize(("psi", "chi"), [(2.0, 1.44), (1.2, 0.7), (5.0, 4.3)])
def test_5_stick_after_gross_slip(psi, chi):
    v = (psi - 2 * chi) / (1 - 2 * chi)
    stick = Stick.after_gross_slip(psi, chi)
    h = 1e-5
    slope = (stick.g(v - 2 * h) - 4 * stick.g(v - h) + 3 * stick.g(v)) / (2 * h)
    assert slope == pytest.approx((2 * chi - 1) / v, rel=1e-5)  # (5.6)
    assert stick.force(v) == pytest.approx(2 / 3 * (1 - v * v) ** 0.6)
    own = Stick.from_touch(1e-3, chi)
    areas = [own.psi(u) * stick.force(u) - own.force(u) * stick.psi(u) for u in (v, v / 2, 0.0)]
    assert_allclose(areas, areas[0], rtol=1e-9)


@pytest.mark.parametrize(("psi", "chi"), [(0.6, 1.44), (0.5, 1.75), (0.5, 0.3)])
def test_6_front_and_force_of_a_slip_ring(psi, chi):
    contact = carom.solve(psi, chi)
    ring = next(phase for phase in contact.phases if phase.kind == "slip")
    h = 1e-4 * (ring.end - ring.start)
    for share in (0.3, 0.6):
        t = ring.start + share * (ring.end - ring.start)
        before, now, after = (contact.at(t + step) for step in (-h, 0, h))
        front, edge, v = (float(x[0]) for x in (now.stick_radius, now.contact_radius, now.speed))
        excess = ring.sign * float(now.psi[0]) - v
        g = float(contact.memory(t).g(front**2 * (1 - 1e-12)))
        rate = float(after.stick_radius[0] ** 2 - before.stick_radius[0] ** 2) / (2 * h)
        assert rate == pytest.approx(-excess / (1 - ring.sign * g), rel=1e-5)  # (6.1)
        rise = float(after.force[0] - before.force[0]) / (2 * h)
        expected = float(now.psi[0]) * front + ring.sign * v * (edge - front)
        assert rise == pytest.approx(expected, rel=1e-5, abs=1e-7)  # (6.3)
    begin = contact.at([ring.start, ring.start + 1e-6])
    edge = float(np.diff(begin.contact_radius)[0])
    assert float(begin.stick_radius[1] - begin.contact_radius[0]) == pytest.approx(-edge, rel=1e-3)


@pytest.mark.parametrize("chi", [0.3, 0.8, 1.2, 1.4412, 1.75, 2.0, 3.0, 9.0, 20.0])
def test_7_rebound_of_small_psi_in_closed_form(chi):
    assert carom.rebound(1e-6, chi) / 1e-6 == pytest.approx(2 * turning(chi) ** 2 - 1, abs=2e-6)


def test_7_rings_begin_to_close_where_the_second_solution_is_a_polynomial():
    for k in range(3):
        chi = ((19 + 20 * k) ** 2 - 1) / 240  # (7.5)
        assert closing(1e-5, chi * 0.998) == k
        assert closing(1e-5, chi * 1.002) == k + 1


def test_8_work_of_slip_is_pressure_times_slip():
    for a, b in ((0.0, 1.0), (0.3, 0.8)):
        power = quad(lambda r, a, b: r * sqrt(b * b - r * r) * np.arccos(a / r), a, b, (a, b))[0]
        assert 4 / pi * power == pytest.approx((b - a) ** 2 * (2 * b + a) / 3)  # (8.3), (8.6)
    history = carom.solve(2.0, 1.44).history(50)
    total = history.psi**2 / 2 + history.stored + history.dissipated
    assert_allclose(total, 2.0, rtol=1e-12)


def test_10_a_disc_is_a_row_of_points_at_imaginary_depths():
    r, z = 0.6, 0.5

    def ring(p):
        far = (r + p) ** 2 + z * z
        return 4 * p / sqrt(1 - p * p) * float(mp.ellipk(4 * r * p / far)) / sqrt(far)

    row = mp.quad(lambda t: 1 / mp.sqrt(r * r + (z + 1j * t) ** 2), [-1, 0, 1])
    assert quad(ring, 0, 1, limit=200)[0] == pytest.approx(float(mp.re(pi * row)), rel=1e-7)
    profile, nu = stacked([1.0], [flat(0.0, 1.0, 1.0, 0.0)]), 0.3
    for z in (0.2, 1.0, 3.0):
        xx, _, zz, *_ = stresses([[0, 0, z]], profile, friction=0.0, poisson=nu)[0]
        assert zz == pytest.approx(-1 / (1 + z * z))
        assert xx == pytest.approx(-(1 + nu) * (1 - z * np.arctan(1 / z)) + 0.5 / (1 + z * z))


def test_11_losses():
    slope = 1.5 * beta(0.6, 1.5)
    assert viscous_loss(1 - 1e-6) * slope == pytest.approx(1e-6, rel=1e-4)  # (11.3)
    law, border = carom.KelvinVoigt(restitution=0.7), 2.0 * 1.7 - 0.7
    slides = border + np.array([0.0, 1.0])
    assert_allclose(carom.rebound(slides, 1.0, losses=law), slides - 3.4, atol=1e-12)  # (11.7)
    assert carom.rebound(border - 0.01, 1.0, losses=law) > border - 0.01 - 3.4 + 1e-6
    assert carom.solve(5.0, 1.0, losses=law).shear_lost == pytest.approx(1.0 - 0.7**2)  # (11.8)
    y = 1e-3**0.4
    turn = brentq(lambda f: y**5 + 2.5 * (y**3 * f + 0.75 * y * f * f) - 1, 0, 99)  # (11.13)
    e = (y**3 + 1.5 * y * turn) / (turn + y * y) ** 0.25  # (11.12)
    pair = carom.Pair(carom.Sphere(radius=0.005, material=STEEL), SPHERES.first, friction=0.2)
    hit = carom.impact(pair, normal_speed=1.0, losses=carom.ElasticPlastic(yield_velocity=1e-3))
    assert hit.normal_restitution == pytest.approx(e, rel=1e-10)
    assert e == pytest.approx(1.185 * 1e-3**0.25, rel=1e-3)
    y, d = 0.6, 0.9  # the springs that yield bear the load (11.11)
    springs, motion = np.zeros((SPRING_COLUMNS, 2001)), np.zeros(at.MOTION)
    springs[S] = np.linspace(0.0, np.sqrt(d), 2001) ** 2
    motion[at.DEPTH] = d
    bear(y, motion, motion, 0.0, springs, 2001)
    load = 1.5 * np.trapezoid(springs[NEXT], np.sqrt(springs[S]))
    assert load == pytest.approx(y**3 + 1.5 * y * (d - y * y), abs=1e-6)  # (11.14)


def test_11_metals_whose_pressure_rises():
    """The energy of springs under Hertz's, a cut and a uniform pressure; fully plastic contacts."""
    b, load = 0.7, 0.2
    c = metal.level(load, b)
    assert 1.5 * c * b * b - 0.5 * c**3 == pytest.approx(load, rel=1e-14)  # (11.16)
    below = quad(lambda x: capped(c, b * b - x * x)[0], 0, b, points=[sqrt(b * b - c * c)])[0]
    assert 1.5 * below == pytest.approx(load, rel=1e-9)
    hertz = 15 / 8 * quad(lambda x: (load / b**3 * (b * b - x * x)) ** 2, 0, b)[0]
    assert hertz == pytest.approx(load * load / b)  # (11.17), (11.12)
    flat = 15 / 8 * quad(lambda x: (8 * load / (3 * pi * b * b)) ** 2 * (b * b - x * x), 0, b)[0]
    assert flat / hertz == pytest.approx(80 / (9 * pi**2))
    for hard, share, printed in ((2.84, flat / hertz, 2.09), (3.0, 1.0, 2.28)):
        g = hard / 1.6
        depth = brentq(lambda d, g=g: 2.5 * quad(lambda u: 3 * g * u, 0, d)[0] - 1, 0, 9)
        e = sqrt(share * (3 * g * depth) ** 2 / sqrt(2 * depth))  # (11.18)
        assert e == pytest.approx(printed, abs=5e-3)


def test_11_slip_of_a_solid_that_relaxes():
    """(11.10) and f = sigma N, integrated in small steps, for a limit that grows evenly."""
    g, theta, limit, rate, m = 1.7, 0.4, 0.2, 0.3, 0.05
    step = step_of(g, theta, 0.5, 2.0, 2.0, 0.0)
    u, relaxed = stretched(limit - g * m, m, limit, limit + 0.5 * rate, rate, step)
    n = 20_000
    for _ in range(n):
        m += 0.5 / n * (rate - m / theta) / (1 + g)
    assert relaxed == pytest.approx(m, abs=1e-5)
    assert u + g * relaxed == pytest.approx(limit + 0.5 * rate, abs=1e-12)  # (11.9)


def test_12_cattaneo_masing_and_the_loop():
    d, top = 0.64, 0.3
    b = sqrt(d)
    y = (1 - 1.5 * top / b**3) ** (1 / 3)
    forces, by_force = np.array([0.0, top, -top, top]), np.full(4, True)
    path = paths.follow_path(np.full(4, d), forces, by_force).results
    u, work = path[:, paths.DISPLACEMENT], path[:, paths.WORK]
    assert u[1] == pytest.approx(d * (1 - y * y))  # (12.4)
    assert path[1, paths.STICK] == pytest.approx(b * y)
    assert u[1] - u[2] == pytest.approx(2 * (d - np.cbrt(b**3 - 1.5 * top) ** 2))  # (12.5)
    loop = 8 / 15 * b**5 * (1 - y) ** 3 * (1 + 3 * y + y * y)
    assert work[3] - work[1] == pytest.approx(loop)  # (12.6)


def test_13_impulses_in_the_plane_and_in_space():
    hit = carom.impact(SPHERES, normal_speed=1.0, tangential_speed=0.4)
    ratio = hit.tangential_impulse / (0.15 * SPHERES.normal_mass * 2.0)
    assert ratio == pytest.approx((hit.psi_in - hit.psi_out) / (4 * SPHERES.chi))  # (13.2)
    n, v1 = np.array([0.0, 0.6, 0.8]), np.array([0.4, 0.6, 0.8])  # V_n = 1, V_t = 0.4 x
    after = carom.collide(SPHERES, velocity1=v1, normal=n)
    one_plus = 1 - hit.psi_out / hit.psi_in
    impulse = 2 * SPHERES.normal_mass * n + one_plus * SPHERES.tangential_mass * (v1 - n)
    assert_allclose(after.velocity1, v1 - impulse / SPHERES.first.mass, atol=1e-8)
    assert_allclose(after.velocity2, impulse / SPHERES.second.mass, atol=1e-8)
    for spin, body in ((after.spin1, SPHERES.first), (after.spin2, SPHERES.second)):
        lever = body.radius / (body.mass * body.gyration_ratio * body.radius**2)
        assert_allclose(spin, -lever * np.cross(n, impulse), atol=1e-5)


def test_14_kernels_of_like_and_unlike_materials():
    m, nu = Materials(SPHERES.kappa).lateral, STEEL.poisson
    assert SPHERES.lateral_ratio == pytest.approx(m / (2 + m))
    like = carom.Pair(SPHERES.first, carom.HalfSpace(material=STEEL), friction=0.1)
    assert Materials(like.kappa).lateral == pytest.approx(nu / (1 - nu))
    assert like.lateral_ratio == pytest.approx(nu / (2 - nu))


def test_16_a_body_that_slides_throughout_and_the_share_of_an_ellipse():
    """(16.1) to (16.3) both ways, from the border on, beside which e differs; (16.4)."""
    mass, turning, x, z, mu = 0.02, 7e-6, -0.01, -0.02, 0.3
    size = {"mass": mass, "inertia": turning, "contact": (x, z), "curvature_radius": 0.003}
    pair = carom.Pair(carom.Body(**size, material=STEEL), carom.HalfSpace(STEEL), mu)
    normal, along, mixed = 1 / mass + x**2 / turning, 1 / mass + z**2 / turning, x * z / turning
    chi, eps = pair.kappa / 2 * along / normal, mu * mixed / normal
    zeta = pair.kappa / mu * mixed / normal
    for sigma in (-1, 1):
        r = (2 * chi + sigma * zeta) / (1 + sigma * eps)
        for far in (1.0, 1.5):
            psi = sigma * far * max(1, 2 * r - 1)
            speeds = {"normal_speed": 1.0, "tangential_speed": mu * psi / pair.kappa}
            hit = carom.impact(pair, **speeds)
            closed = psi - 2 * (2 * chi * sigma + zeta) / (1 + sigma * eps)
            assert_allclose([hit.psi_out, hit.normal_restitution], [closed, 1], rtol=2e-5)
        speeds["tangential_speed"] *= 0.9 / far
        assert abs(carom.impact(pair, **speeds).normal_restitution - 1) > 1e-4
    wall = carom.Body(curvatures=(20, 300), material=GLASS)
    touching = carom.Pair(carom.Sphere(radius=0.01, material=STEEL), wall, mu)
    a, b = touching._ellipse[1:3]
    slow = [
        quad(lambda t, n=n: np.cos(t) ** n / np.hypot(np.cos(t) / a, np.sin(t) / b), 0, pi)[0]
        for n in (2, 0)
    ]
    share = slow[0] / slow[1]
    assert_allclose(share, a**2 * touching.effective_radius * 120 / 2, rtol=1e-12)  # d = 1
    for other, kappa in zip((1 - share, share), touching.kappas, strict=True):
        soft = sum((1 - m.poisson * other) / (2 * m.shear_modulus) for m in (STEEL, GLASS))
        assert_allclose(kappa, 1 / soft / touching.effective_modulus, rtol=1e-12)
