"""Impacts of spheres that adhere: closed forms, limits, springs, and an integration in SI units."""

import re
from math import pi, sqrt
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import rgamma
from tests.checks import refused
from tests.oracles.adhesion import lost_by_maugis, march

import carom
from carom.classical import adhesive_impact
from carom.dimensionless.adhesion import solve_adhering
from carom.impacts import adhesive
from carom.impacts.findings import adhesion

BEAD = carom.Sphere(radius="30 um", material="pmma")
PAIR = carom.Pair(BEAD, carom.HalfSpace("soda-lime-glass"), friction=0.3)
BEADS = carom.Pair(BEAD, carom.Sphere(radius="50 um", material="pmma"), friction=0.3)
GAMMA = 0.1  # J/m^2
SLOWEST = adhesive_impact(PAIR, normal_speed=1.0, work_of_adhesion=GAMMA).sticking_speed


def jkr(a, modulus=1.0, radius=1.0, energy=GAMMA, lib=np):
    """Return approach and force at a contact radius (Johnson, Kendall & Roberts 1971)."""
    approach = a**2 / radius - lib.sqrt(2 * lib.pi * energy * a / modulus)
    force = 4 * modulus * a**3 / (3 * radius) - lib.sqrt(8 * lib.pi * energy * modulus * a**3)
    return approach, force


def test_pulling_off_takes_the_work_of_jkr():
    """From no approach, where spheres jump into contact, to the least approach; 30 digits."""
    with mp.workdps(30):
        first = mp.findroot(lambda a: jkr(a, lib=mp)[0], 0.85)
        last = mp.findroot(lambda a: mp.diff(lambda b: jkr(b, lib=mp)[0], a), 0.34)
        assert last / first == pytest.approx(16.0 ** (-1.0 / 3.0), rel=1e-15)
        pulled = mp.quad(
            lambda a: jkr(a, lib=mp)[1] * mp.diff(lambda b: jkr(b, lib=mp)[0], a), [last, first]
        )
        unit = mp.mpf(GAMMA) ** (mp.mpf(5) / 3)
        assert float(-pulled / unit) == pytest.approx(adhesive.PULL_OFF, rel=1e-14)
    assert pytest.approx(7.09, rel=5e-4) == adhesive.PULL_OFF  # Thornton & Ning (1998)
    closed = 0.1 * pi ** (5.0 / 3.0) * (1.0 + 6.0 * 4.0 ** (1.0 / 3.0))
    assert pytest.approx(closed, rel=1e-14) == adhesive.PULL_OFF


def test_most_is_lost_as_the_contact_jumps_in():
    """By the energies of springs and surfaces when it has jumped in, and before it jumps out."""
    a_0 = (2.0 * pi * GAMMA) ** (1.0 / 3.0)

    def energy(a):
        d = jkr(a)[0]
        return d**2 * a - 2.0 * d * a**3 / 3.0 + a**5 / 5.0 - GAMMA * pi * a**2

    won, kept = -energy(a_0), energy(a_0 / 16.0 ** (1.0 / 3.0))
    assert won + kept == pytest.approx(adhesive.PULL_OFF * GAMMA ** (5.0 / 3.0), rel=1e-12)
    assert won / (won + kept) == pytest.approx(0.905, abs=5e-4)


@pytest.mark.slow
def test_the_table_of_the_theory_holds():
    page = Path(__file__).parents[2] / "docs/theory/adhesion.md"
    text = page.read_text(encoding="utf-8").replace("\u2212", "-")
    rows = re.findall(r"(?m)^\| ([\d.]+|\$\\infty\$) \|(.*)\|$", text)
    assert len(rows) == 8
    for ratio, cells in rows:
        stickiness = 0.0 if "infty" in ratio else 1.0 / float(ratio)
        e, *values = map(float, cells.split("|"))
        assert e == pytest.approx(sqrt(1.0 - stickiness**2), abs=6e-4)
        for chi, value in zip((0.5, 0.8, 1.2, 1.44, 1.75), values, strict=True):
            assert value == pytest.approx(solve_adhering(1.0, chi, stickiness).psi_out, abs=6e-4)


def test_the_pull_off_force_is_that_of_jkr():
    a = np.linspace(0.05, 2.0, 400_001)
    hit = adhesive_impact(PAIR, normal_speed=1.0, work_of_adhesion=GAMMA)
    modulus, radius = PAIR.effective_modulus, PAIR.effective_radius
    rest = (6.0 * pi * GAMMA * radius**2 / modulus) ** (1.0 / 3.0)
    least = np.min(jkr(a * rest, modulus, radius)[1])
    assert hit.pull_off_force == pytest.approx(-least, rel=1e-9)


def test_the_sticking_speed_is_that_of_thornton_and_ning():
    """1.84 ((Gamma/R)^5/(rho^3 E*^2))^(1/6) for a sphere on a wall (Thornton & Ning 1998)."""
    density, radius = BEAD.material.density, BEAD.radius
    size = ((GAMMA / radius) ** 5 / (density**3 * PAIR.effective_modulus**2)) ** (1.0 / 6.0)
    assert SLOWEST / size == pytest.approx(1.84, abs=5e-4)
    for share, sticks in ((0.999, True), (1.0, True), (1.001, False)):
        hit = adhesive_impact(PAIR, normal_speed=share * SLOWEST, work_of_adhesion=GAMMA)
        assert hit.sticks == sticks
        assert (hit.normal_restitution == 0.0) == sticks
        assert np.isnan([hit.psi_out, hit.duration, hit.shear_release]).all() == sticks
        assert hit.max_penetration > 0.0


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.3, 0.5, 1.0, 1.44, 2.0, 4.0, 6.0])
def test_without_adhesion_the_contact_is_that_of_large_friction(chi):
    """2 E(0)^2 - 1 of the theory's (7.4), to which carom.rebound tends for small psi_1."""
    root = sqrt(1.0 + 240.0 * chi)
    turned = rgamma((11.0 + root) / 20.0) * rgamma((11.0 - root) / 20.0) / rgamma(0.6)
    turned *= sqrt(pi)
    bare = solve_adhering(1.0, chi, 0.0)
    assert bare.psi_out == pytest.approx(2.0 * turned**2 - 1.0, abs=1e-10)
    assert carom.rebound(1e-7, chi) / 1e-7 == pytest.approx(float(bare.psi_out), abs=2e-6)
    assert bare.duration == pytest.approx(2.94327518432470, rel=1e-11)
    ones = (bare.restitution, bare.max_penetration, bare.max_force, bare.max_radius)
    assert ones == pytest.approx((1.0,) * 4, rel=1e-14)
    errors = [abs(solve_adhering(1.0, chi, s).psi_out - bare.psi_out) for s in (1e-4, 1e-7, 1e-10)]
    assert errors[0] < 0.02
    assert errors[1] < 0.02 * errors[0]
    assert errors[2] < 0.02 * errors[1] + 1e-10


@pytest.mark.parametrize(("ratio", "chi"), [(0.05, 0.8), (0.3, 1.44), (0.7, 2.0), (0.95, 1.44)])
def test_springs_marched_in_time_come_to_the_same(ratio, chi):
    exact, coarse, fine = (
        solve_adhering(1.0, chi, ratio),
        march(ratio, chi, springs=400, steps=1000),
        march(ratio, chi, springs=1600, steps=4000),
    )
    for marched, most in ((coarse, 5e-3), (fine, 7e-4)):
        assert marched.ratio == pytest.approx(float(exact.psi_out), abs=most)
        assert marched.restitution == pytest.approx(float(exact.restitution), abs=most)
        assert marched.duration == pytest.approx(float(exact.duration), abs=2.0 * most)
        assert marched.released == pytest.approx(1.0 - float(exact.psi_out) ** 2, abs=2.0 * most)


def followed(pair, speed, sliding):
    """Integrate Newton's laws in SI units: return V_x', the duration, V_n' and the shear release.

    The latter is the energy of springs at the receding edge, G* q^2/(2 pi a), over Gamma.
    """
    modulus, radius, energy = pair.effective_modulus, pair.effective_radius, GAMMA
    first = (2.0 * pi * energy * radius**2 / modulus) ** (1.0 / 3.0)
    last = first / 16.0 ** (1.0 / 3.0)

    def edge(d):
        return brentq(lambda a: jkr(a, modulus, radius)[0] - d, last, 30.0 * first, xtol=1e-22)

    def pressed(_, state):
        d, v, u, w, carried = state  # carried: the integral of U over the radii met
        a = edge(d)
        widening = v / (2.0 * a / radius - sqrt(pi * energy / (2.0 * modulus * a)))
        held = 2.0 * pair.effective_shear_modulus * (a * u - carried)
        forces = -jkr(a, modulus, radius)[1] / pair.normal_mass, -held / pair.tangential_mass
        return [v, forces[0], w, forces[1], u * widening]

    def turned(_, state):
        return state[1]

    turned.terminal, turned.direction = True, -1.0
    scale = pair.scales(speed)
    accuracy = {"method": "DOP853", "rtol": 1e-10, "dense_output": True}
    small = scale.length * np.array([1.0, 1.0 / scale.time, 1.0, 1.0 / scale.time, first])
    start = [0.0, speed, 0.0, sliding, 0.0]
    end = 10.0 * scale.time
    loading = solve_ivp(pressed, (0.0, end), start, events=turned, atol=1e-12 * small, **accuracy)
    turn = loading.t_events[0][0]

    def lifted(time, state):
        d, _, u, _ = state
        a = edge(max(d, jkr(last, modulus, radius)[0]))
        met = loading.sol(2.0 * turn - time)[4] if time < 2.0 * turn else 0.0
        held = 2.0 * pair.effective_shear_modulus * (a * u - met)
        forces = -jkr(a, modulus, radius)[1] / pair.normal_mass, -held / pair.tangential_mass
        return [state[1], forces[0], state[3], forces[1]]

    def snapped(_, state):
        return state[0] - jkr(last, modulus, radius)[0]

    snapped.terminal = True
    begin = loading.sol(turn)[:4]
    whole = {"events": snapped, "atol": 1e-12 * small[:4], "max_step": turn / 50.0, **accuracy}
    middle = solve_ivp(lifted, (turn, 2.0 * turn), begin, **whole)
    ending = solve_ivp(lifted, (2.0 * turn, 2.0 * turn + end), middle.y[:, -1], **whole)
    times = np.linspace(turn, ending.t[-1], 2001)
    back = times < 2.0 * turn
    d, _, u, _ = np.where(back, middle.sol(times), ending.sol(times))
    bent = u - np.where(back, loading.sol(2.0 * turn - times)[2], 0.0)
    edges = np.array([edge(max(each, jkr(last, modulus, radius)[0])) for each in d])
    freed = pair.effective_shear_modulus * np.max(bent**2 / edges) / (2.0 * pi * energy)
    return ending.y[3, -1], ending.t[-1], -ending.y[1, -1], freed


@pytest.mark.first_case
@pytest.mark.parametrize(("pair", "share"), [(PAIR, 4.0), (PAIR, 1.2), (BEADS, 2.0)])
def test_newtons_laws_in_si_units_give_the_same(pair, share):
    still = adhesive_impact(pair, normal_speed=1.0, work_of_adhesion=GAMMA)
    speed = share * still.sticking_speed
    hit = adhesive_impact(
        pair, normal_speed=speed, tangential_speed=1e-3, spin=20.0, work_of_adhesion=GAMMA
    )
    velocity, duration, away, freed = followed(pair, speed, hit.contact_velocity)
    assert hit.contact_velocity_out == pytest.approx(velocity, rel=5e-8)
    assert hit.duration == pytest.approx(duration, rel=2e-11)
    assert hit.normal_speed_out == pytest.approx(away, rel=2e-9)
    assert hit.shear_release == pytest.approx(freed, rel=6e-4)


def test_velocities_and_spins_follow_from_one_impulse():
    speeds = np.array([[2.0], [5.0]]) * SLOWEST
    given = {"tangential_speed": [1e-3, -2e-3, 0.0], "spin": 30.0, "spin2": -10.0}
    hit = adhesive_impact(BEADS, normal_speed=speeds, work_of_adhesion=GAMMA, **given)
    assert hit.psi_out.shape == (2, 3)
    impulse = hit.tangential_impulse
    one, two = BEADS.moving
    turned = 0.4 * one.mass * one.radius * (30.0 - hit.spin_out)
    assert turned == pytest.approx(impulse, rel=1e-9)
    assert 0.4 * two.mass * two.radius * (-10.0 - hit.spin2_out) == pytest.approx(impulse, rel=1e-9)
    out = hit.tangential_speed_out + one.radius * hit.spin_out + two.radius * hit.spin2_out
    assert out == pytest.approx(hit.contact_velocity_out, rel=1e-9)
    before, after = hit.contact_velocity, hit.contact_velocity_out
    lost = 0.5 * BEADS.tangential_mass * (before**2 - after**2)
    assert hit.dissipated_energy == pytest.approx(lost, rel=1e-9)
    assert np.all(hit.dissipated_energy >= 0.0)
    single = adhesive_impact(
        BEADS,
        normal_speed=speeds[1, 0],
        work_of_adhesion=GAMMA,
        tangential_speed=-2e-3,
        spin=30.0,
        spin2=-10.0,
    )
    assert isinstance(single.psi_out, float)
    assert single.psi_out == pytest.approx(hit.psi_out[1, 1], rel=1e-9)


def test_normal_energy_is_lost_to_pull_off_alone():
    hit = adhesive_impact(PAIR, normal_speed=[2.0 * SLOWEST, 9.0], work_of_adhesion=GAMMA)
    work = adhesive.pull_off_work(PAIR, GAMMA)
    assert hit.lost_energy[0] == pytest.approx(work, rel=1e-12)
    assert work == pytest.approx(0.5 * PAIR.normal_mass * SLOWEST**2, rel=1e-14)


def test_the_surface_energy_of_the_materials_is_taken():
    stuff = carom.material("pmma", surface_energy="40 mJ/m^2")
    glass = carom.material("glass", surface_energy="90 mJ/m^2")
    pair = carom.Pair(carom.Sphere(radius="30 um", material=stuff), carom.HalfSpace(glass), 0.3)
    assert adhesive_impact(pair, normal_speed=1.0).work_of_adhesion == pytest.approx(0.12)
    assert adhesive.work_of_adhesion(PAIR, 0.9) == pytest.approx(2.0 * sqrt(0.0375 * 0.9))
    given = adhesive_impact(pair, normal_speed=1.0, work_of_adhesion="50 mJ/m^2")
    assert given.inputs()["work_of_adhesion"] == 0.05
    assert "@article{johnson1971," in given.cite()
    assert given.work_of_adhesion == 0.05


@pytest.mark.slow
def test_what_maugis_contact_loses_is_tabulated():
    """Nothing for stiff small bodies, nearly all of JKR's for soft large ones."""
    for number, share in zip(adhesive.TABOR, adhesive.LOST, strict=True):
        assert share == pytest.approx(lost_by_maugis(number), abs=6e-4)
        assert adhesive.lost_by_maugis(number) == pytest.approx(share, rel=1e-12)
    assert lost_by_maugis(0.1) < 1e-3
    assert adhesive.lost_by_maugis(0.1) == 0.0


def test_the_finding_quotes_what_is_left_of_the_speed():
    stuff = carom.material("pmma", surface_energy=0.05, loss_factor=0.0)
    wall = carom.HalfSpace(carom.material("pmma", surface_energy=0.05))
    pair = carom.Pair(carom.Sphere(radius="50 um", material=stuff), wall, 0.3)
    hit = adhesive_impact(pair, normal_speed=0.1)
    finding = adhesion(carom.impact(pair, normal_speed=0.1))
    assert finding.holds is False
    assert f"e is {hit.normal_restitution:.2g} by carom.classical" in finding.verdict
    assert finding.value == pytest.approx(1.0 - hit.normal_restitution**2, rel=1e-9)


def test_stiff_small_bodies_may_lose_less_than_jkr():
    """Tabor's number is 0.4: Maugis' contact loses a fiftieth of what that of JKR does."""
    stuff = carom.material("bearing steel", surface_energy=0.05)
    pair = carom.Pair(carom.Sphere(radius="2 um", material=stuff), carom.HalfSpace(stuff), 0.2)
    hit = adhesive_impact(pair, normal_speed=0.1)
    assert 0.3 < hit.tabor < 0.5
    finding = adhesion(carom.impact(pair, normal_speed=0.1))
    assert finding.holds is None
    assert f"Tabor's number is {hit.tabor:.2g}" in finding.verdict


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"normal_speed": -1.0}, "normal_speed: -1.0 .*must approach"),
        ({"normal_speed": [1.0, np.nan]}, "normal_speed: nan .*finite"),
        ({"normal_speed": [1.0, 2.0], "spin": [1.0, 2.0, 3.0]}, "shapes .*broadcast"),
        ({"spin2": 1.0}, "spin2: .*only a second sphere"),
        ({"work_of_adhesion": -0.1}, "work_of_adhesion: -0.1 .*zero or positive"),
        ({"work_of_adhesion": "1e5 J/m^2"}, "work_of_adhesion: .*as large as the bodies"),
        ({"work_of_adhesion": None}, "work_of_adhesion: missing; .*surface_energy"),
        ({"surface_energy": 0.05}, "surface_energy: .*work_of_adhesion, twice the surface energy"),
        ({"normal_speed": [1.0, 1e-200]}, "speed: 1e-200 m/s .*floating point"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(given, words):
    inputs = {"normal_speed": 1.0, "work_of_adhesion": GAMMA} | given
    refused(words, adhesive_impact, PAIR, **inputs)


def test_without_friction_no_contact_sticks():
    slippery = carom.Pair(BEAD, BEAD, friction=0.0)
    inputs = {"normal_speed": 1.0, "work_of_adhesion": GAMMA}
    refused("friction: 0.0 .*nothing sticks", adhesive_impact, slippery, spin=1.0, **inputs)
    assert adhesive_impact(slippery, **inputs).psi_out == 0.0
