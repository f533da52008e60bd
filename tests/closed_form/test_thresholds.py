"""Both sides of every threshold of a verdict: a thousandth below it, and a thousandth above.

The thresholds are those of the manual, written out here: another one in the code fails.
"""

from functools import partial
from math import pi, sqrt

import numpy as np
import pytest
from scipy.optimize import brentq

import carom
from carom.bodies.losses import yield_velocity
from carom.bodies.plausibility import doubts
from carom.dimensionless import neglected
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.impacts import findings, peaks, plate_findings, validity
from carom.impacts.adhesive import lost_by_maugis, pull_off_work, tabor, work_of_adhesion

NEAR = 1e-3
STEEL = carom.material("bearing steel")
BALL = carom.Sphere(radius="5 mm", material=STEEL)
STRONG = carom.material("bearing steel", yield_strength="100 GPa", surface_energy=0.0)


def hit_wall(speed, ball=BALL, wall=STEEL, friction=0.0, *, roughness=None, **plate):
    pair = carom.Pair(ball, carom.HalfSpace(wall, **plate), friction, roughness=roughness)
    return carom.impact(pair, normal_speed=speed)


def made(least, most, value, limit):
    """Return two arguments, at which a value is just below a limit, and just above it."""

    def argument(level, low, high):
        def off(x):
            return np.log(value(np.exp(x)) / level)

        return float(np.exp(brentq(off, np.log(low), np.log(high), xtol=2e-5)))

    below = argument(limit * (1.0 - NEAR), least, most)
    near = 1.05 if most > least else 1.0 / 1.05
    return below, argument(limit * (1.0 + NEAR), below / near, below * near)


def sides(make, judge, limit, least, most):
    """Return whether a finding holds just below the limit of its value, and just above it."""
    ends = made(least, most, lambda x: judge(make(x)).value, limit)
    return tuple(judge(make(x)).holds for x in ends)


def named(name, assumptions=()):
    """Return a way to find one finding of an impact by its name."""

    def judge(hit):
        return next(f for f in validity.judge(hit, assumptions).findings if f.name == name)

    return judge


def on_plate(index):
    """Return one of the assumptions on plates."""
    return plate_findings.OF_PLATES[index]


def on_thickness(speed, thickness):
    return hit_wall(speed, thickness=thickness)


SOFT = carom.Material(young="10 MPa", poisson=0.45, density=1000, surface_energy=0.0)
LIGHT = carom.Material(young="3 GPa", poisson=0.35, density=1000)
THIN = carom.material("bearing steel")
CASES = {  # what is varied, how it is judged, its limit, the range, holds below and above
    "size": (
        partial(hit_wall, wall=SOFT, ball=carom.Sphere(radius=0.01, material=SOFT)),
        *(named("a_max/R*"), 0.1, 0.01, 50.0, True, False),
    ),
    "wave transit": (hit_wall, validity._slow_contact, 3.0, 1.0, 1e4, False, True),
    "waves in the wall": (hit_wall, findings.waves, 0.02, 0.1, 100.0, True, False),
    "roughness": (
        lambda height: hit_wall(0.1, roughness=height),
        *(findings.roughness, 0.05, 1e-9, 1e-5, True, False),
    ),
    "adhesion of known energy": (
        lambda energy: hit_wall(
            0.01, carom.Sphere(radius=5e-5, material=replace_energy(energy)), replace_energy(energy)
        ),
        *(findings.adhesion, 0.02, 1e-3, 5.0, True, None),
    ),
    "loss factor": (
        lambda eta: hit_wall(0.1, *with_loss(eta)),
        *(findings.damping, 0.02, 1e-4, 0.1, True, False),
    ),
    "bending wave": (partial(on_thickness, 0.5), on_plate(0), 6.0, 0.05, 0.005, None, True),
    "shear of a plate": (partial(on_thickness, 0.5), on_plate(1), 0.01, 0.02, 0.003, True, None),
    "contact on a plate": (partial(on_thickness, 2.0), on_plate(2), 0.1, 0.01, 0.0025, True, False),
    "deflection": (
        lambda speed: hit_wall(speed, carom.Sphere(radius=0.05, material=LIGHT), thickness=0.01),
        *(on_plate(3), 0.2, 1.0, 60.0, True, False),
    ),
    "shell, stiff": (
        lambda wall: hit_wall(
            0.1, carom.Sphere(radius=0.02, material=STEEL, inner_radius=0.02 - wall)
        ),
        *(validity._shell, 0.01, 0.019, 0.004, True, None),
    ),
    "shell, soft": (
        lambda wall: hit_wall(
            0.1, carom.Sphere(radius=0.02, material=STEEL, inner_radius=0.02 - wall)
        ),
        *(validity._shell, 0.1, 0.019, 0.001, None, False),
    ),
    "pressure": (
        hit_wall,
        lambda hit: peaks.judge_pressure(hit.pair, hit.scales.pressure, yields=False),
        *(1.6, 0.01, 10.0, True, False),
    ),
    "yield": (hit_wall, named("von Mises stress/Y"), 1.0, 0.1, 5.0, True, None),
    "yield for sure": (hit_wall, named("von Mises stress/Y"), 1.09, 0.1, 5.0, None, False),
}


def replace_energy(energy):
    return carom.material("bearing steel", surface_energy=energy)


def with_loss(eta):
    stuff = carom.material("bearing steel", loss_factor=eta)
    return carom.Sphere(radius="5 mm", material=stuff), stuff


@pytest.mark.parametrize("case", CASES)
def test_either_side_of_a_limit(case):
    make, judge, limit, least, most, below, above = CASES[case]
    assert sides(make, judge, limit, least, most) == (below, above)


def test_unknown_roughness_is_that_of_lapped_and_of_ground_surfaces():
    """The penetration is 20 times 0.02 um, and 20 times 0.4 um."""
    judged = []
    for height in (0.02e-6, 0.4e-6):
        ends = made(1e-4, 10.0, lambda v: hit_wall(v).max_penetration, 20.0 * height)
        judged += [findings.roughness(hit_wall(speed)) for speed in ends]
    assert [each.holds for each in judged] == [False, None, None, True]
    assert [bool(each.missing) for each in judged] == [False, True, True, False]
    assert "Pair(roughness=...)" in judged[1].verdict
    known = findings.roughness(hit_wall(0.1, roughness="1 nm"))
    assert (known.holds, "if" in known.verdict) == (True, False)


def sticking(hit):
    """Return the least that adhesion takes, of the energy: that of Maugis & Dugdale's contact."""
    number = tabor(hit.pair, work_of_adhesion(hit.pair, 0.05))
    return findings.adhesion(hit).value * lost_by_maugis(number)


def rubbery(speed, **values):
    """Return an impact of bodies so soft that Tabor's number is large."""
    stuff = carom.Material(young="1 MPa", poisson=0.5, density=1000, **values)
    return hit_wall(speed, carom.Sphere(radius=1e-3, material=stuff), stuff)


def test_unknown_energies_are_those_of_clean_and_of_sticky_surfaces():
    """Pulling apart takes 7.0922 (Gamma^5 R^4/E^2)^(1/3), Gamma twice 0.05 and twice 0.5 J/m^2."""

    def share(energy, speed):
        pair = rubbery(speed).pair
        size = (2.0 * energy) ** 5 * pair.effective_radius**4 / pair.effective_modulus**2
        return 7.092196 * size ** (1.0 / 3.0) / (0.5 * pair.normal_mass * speed**2)

    sticky = made(1e-4, 1e3, partial(share, 0.5), 0.02)
    assert [findings.adhesion(rubbery(speed)).holds for speed in sticky] == [True, None]
    less = lost_by_maugis(tabor(rubbery(1.0).pair, 0.1))
    clean = made(1e-4, 1e3, partial(share, 0.05), 0.02 / less)
    assert [findings.adhesion(rubbery(speed)).holds for speed in clean] == [None, False]


def test_adhesion_of_known_energy_fails_where_the_least_is_too_much():
    ends = made(1e-3, 5.0, lambda energy: sticking(rubbery(1.0, surface_energy=energy)), 0.02)
    judged = [findings.adhesion(rubbery(1.0, surface_energy=energy)).holds for energy in ends]
    assert judged == [None, False]


def test_with_losses_adhesion_may_take_all_but_the_bodies_must_part():
    def hit(energy):
        stuff = carom.Material(young="1 MPa", poisson=0.5, density=1000, surface_energy=energy)
        pair = carom.Pair(carom.Sphere(radius=1e-3, material=stuff), carom.HalfSpace(stuff), 0.0)
        return carom.impact(pair, normal_speed=0.1, losses=carom.KelvinVoigt(restitution=0.8))

    most = made(1e-4, 10.0, lambda energy: findings.adhesion(hit(energy)).value, 1.0)
    assert [findings.adhesion(hit(energy)).holds for energy in most] == [True, None]
    least = made(1e-4, 10.0, lambda energy: sticking(hit(energy)), 1.0)
    assert [findings.adhesion(hit(energy)).holds for energy in least] == [None, False]


def test_losses_are_added_up():
    """Each is below 0.02; waves and the material together are just below it, and just above."""

    def judged(eta):
        return hit_wall(4.0, *with_loss(eta))

    def total(eta):
        hit = judged(eta)
        return sum(
            each(hit).value for each in (findings.waves, findings.damping, findings.adhesion)
        )

    below, above = (findings.together(judged(eta)) for eta in made(1e-4, 8e-3, total, 0.02))
    assert below is None
    assert (above.holds, above.limit) == (None, 0.02)


def test_weight_is_told_from_a_fiftieth_of_the_speed_on():
    def hit(speed):
        pair = carom.Pair(BALL, carom.HalfSpace(STEEL), 0.1)
        return carom.impact(pair, normal_speed=speed, tangential_speed=speed)

    ends = made(1e-4, 10.0, lambda v: 9.80665 * hit(v).duration / v, 0.02)
    below, above = (validity._weight(hit(speed)) for speed in ends)
    assert below is None
    assert (above.holds, above.limit) == (None, 0.02)


@pytest.mark.parametrize(("excess", "solid"), [(1e-10, True), (1e-8, False)])
def test_a_ball_with_a_larger_radius_of_gyration_is_not_solid(excess, solid):
    ball = carom.Sphere(
        radius=0.01, material=STEEL, gyration_radius=0.01 * sqrt(0.4 * (1.0 + excess))
    )
    assert (validity._shell(hit_wall(0.1, ball)) is None) == solid


@pytest.mark.parametrize(("ratio", "told"), [(2.999, False), (3.001, True)])
def test_slender_bodies(ratio, told):
    rod = carom.Body(
        mass=0.01,
        inertia=0.01 * (3e-3 * ratio) ** 2,
        contact=(0.0, -0.003),
        curvature_radius="3 mm",
        material=STEEL,
    )
    hit = carom.impact(carom.Pair(rod, carom.HalfSpace(STEEL), 0.0), normal_speed=0.1)
    assert rod.slenderness == pytest.approx(ratio)
    assert (validity._slender(hit) is not None) == told


@pytest.mark.slow
def test_turning_forces_in_slim_ellipses():
    """In space the axes of the contact decide: round, up to 8.3, beyond."""

    def judged(curvature):
        body = carom.Body(
            mass=0.01,
            inertia=np.diag([1e-6, 1e-6, 1e-6]),
            contact=(0.0, 0.0, -0.01),
            curvatures=(100.0, 100.0 * curvature),
            material=STEEL,
        )
        pair = carom.Pair(body, carom.HalfSpace(STEEL), 0.2)
        hit = carom.impact(pair, normal_speed=0.1, tangential_speed=(0.1, 0.05))
        return validity._turns(hit)

    below, above = made(2.0, 500.0, lambda x: judged(x).value, 8.3)
    assert [judged(x).holds for x in (below, above)] == [True, None]
    assert judged(1.0) is None
    assert judged(1.0 + 1e-5) is not None


@pytest.mark.parametrize(
    ("chi", "e", "studied"),
    [
        *((0.2997, 0.9, False), (0.3003, 0.9, True), (4.995, 0.9, True), (5.005, 0.9, False)),
        *((1.44, 0.4995, False), (1.44, 0.5005, True)),
    ],
)
def test_where_other_solids_were_compared(chi, e, studied):
    words = validity.judge_losses(LossNumbers(Loss.VISCOUS, 0.1), e, chi).verdict
    assert ("differs by up to" in words) == studied
    assert ("was not studied here" in words) != studied


@pytest.mark.parametrize(("loss", "times"), [(Loss.VISCOUS, 1.0), (Loss.RELAXING, 2.0)])
@pytest.mark.parametrize(("chi", "slope"), [(1.0, 1.2), (3.0, 5.5)])
def test_how_far_other_solids_are(loss, times, chi, slope):
    words = validity.judge_losses(LossNumbers(loss, 0.1, 0.5), 0.9, chi).verdict
    assert words.endswith(f"differs by up to {0.1 * slope * times:.2g}")


@pytest.mark.parametrize(
    ("loss", "most", "off"), [(Loss.PLASTIC, 10.0, "0.05"), (Loss.METAL, 300.0, "0.07")]
)
def test_up_to_which_speed_yielding_was_studied(loss, most, off):
    for ratio, studied in ((most * (1.0 - NEAR), True), (most * (1.0 + NEAR), False)):
        finding = validity.judge_losses(LossNumbers(loss, ratio**-0.4, 0.01), 0.5, 1.44)
        assert finding.value == pytest.approx(ratio)
        assert finding.limit == most
        assert (f"off by up to {off}" in finding.verdict) == studied
        assert ("was not studied" in finding.verdict) != studied


def oblique(psi, friction=0.2, wall=STEEL, ball=BALL, speed=0.01, **spin):
    pair = carom.Pair(ball, carom.HalfSpace(wall), friction)
    sliding = psi * friction * speed / pair.kappa
    return carom.impact(pair, normal_speed=speed, tangential_speed=sliding, **spin)


def test_the_bound_on_the_rebound():
    """A hundredth of psi_2: the less friction, the more unlike materials count."""
    bodies = coupled(0.05)

    def judged(mu):
        return validity._rebound(oblique(1.2, mu, bodies.second.material, bodies.first))

    below, above = (1.0 / x for x in made(1.5, 40.0, lambda x: judged(1.0 / x).value, 0.01))
    assert [judged(mu).holds for mu in (below, above)] == [True, None]


def test_only_like_bodies_that_meet_head_on_do_not_slip():
    words = "like bodies that meet head-on do not slip"
    unlike = coupled(0.05)
    for material, ball, told in (
        (STEEL, BALL, True),
        (unlike.second.material, unlike.first, False),
    ):
        finding = validity._rebound(oblique(0.0, wall=material, ball=ball))
        assert (finding.verdict == words) == told


@pytest.mark.parametrize("waves_are_more", [True, False])
def test_what_is_more_is_told_of_the_bound(waves_are_more):
    """Waves of the wall at 30 m/s; unlike materials at 0.01 m/s."""
    unlike = coupled(0.3)
    hit = (
        oblique(1.2, speed=30.0)
        if waves_are_more
        else oblique(1.2, wall=unlike.second.material, ball=unlike.first)
    )
    words = validity._rebound(hit).verdict
    assert ("to which waves add" in words) == waves_are_more
    assert ("as the materials are unlike" in words) != waves_are_more


def test_the_bound_on_a_plate_that_is_neither_thin_nor_thick():
    """Waves of twice the contact time are six times as long as the plate is thick."""

    def hit(thickness):
        pair = carom.Pair(BALL, carom.HalfSpace(STEEL, thickness=thickness), 0.2)
        return carom.impact(pair, normal_speed=0.5, tangential_speed=0.1)

    def ratio(thickness):
        impact = hit(thickness)
        return plate_findings.wave_ratio(impact, impact.pair.second)

    thick, thin = made(0.03, 0.002, ratio, 6.0)
    assert np.isnan(validity._rebound(hit(thick)).value)
    assert "neither thin nor a thick wall" in validity._rebound(hit(thick)).verdict
    assert np.isfinite(validity._rebound(hit(thin)).value)


@pytest.mark.parametrize(
    ("friction", "aside", "studied"), [(0.2, 0.0, True), (0.2, 1e-3, False), (0.0, 1e-3, True)]
)
def test_other_solids_were_compared_in_central_impacts(friction, aside, studied):
    body = carom.Body(
        mass=0.01, inertia=1e-6, contact=(aside, -0.005), curvature_radius="5 mm", material=STEEL
    )
    pair = carom.Pair(body, carom.HalfSpace(STEEL), friction)
    losses = carom.KelvinVoigt(restitution=0.9)
    hit = carom.impact(pair, normal_speed=0.1, tangential_speed=0.05, losses=losses)
    assert ("off their centre" in validity._solid(hit).verdict) != studied


def test_the_bound_on_spin_about_the_normal():
    def judged(spin):
        return validity._spin(oblique(1.2, normal_spin=spin))

    ends = made(1e-4, 100.0, lambda spin: judged(spin).value, 0.01)
    assert [judged(spin).holds for spin in ends] == [True, None]
    radius = oblique(1.2).scales.radius
    unit = 0.2 * 0.01 / radius  # mu V_1/a_max
    known = [np.isfinite(judged(20.0 * unit * factor).value) for factor in (0.999, 1.001)]
    assert known == [True, False]


@pytest.mark.parametrize(("error", "holds"), [(0.00999, True), (0.01001, False)])
def test_errors_of_grids(error, holds):
    assert [each.holds for each in validity.judge_errors(error, 0.0)] == [holds, True]
    assert [each.holds for each in validity.judge_errors(0.0, error)] == [True, holds]


def coupled(beta):
    """Return two bodies of this Dundurs' beta, of one shear modulus."""
    poisson = brentq(lambda nu: abs(pair_of(nu).dundurs_beta) - beta, -0.6, 0.3)
    return pair_of(poisson)


def pair_of(poisson):
    shear = 80e9
    first, second = (
        carom.Material(
            young=2.0 * shear * (1.0 + nu),
            poisson=nu,
            density=7800,
            yield_strength="2 GPa",
            loss_factor=1e-4,
        )
        for nu in (0.3, poisson)
    )
    return carom.Pair(carom.Sphere(radius=0.005, material=first), carom.HalfSpace(second), 0.3)


@pytest.mark.parametrize(("beta", "told"), [(0.00999, False), (0.01001, True)])
def test_stresses_of_unlike_materials_are_told_from_a_hundredth_of_beta_on(beta, told):
    pair = coupled(beta)
    assert abs(pair.dundurs_beta) == pytest.approx(beta)
    hit = carom.impact(pair, normal_speed=0.1, tangential_speed=0.1)
    assert ("radial tractions" in hit.peaks().attrs["notes"]) == told
    speeds = carom.bearable_speeds(pair, angle=[0.0], friction=[0.3])
    assert ("radial tractions" in speeds.attrs["notes"]) == told
    coarse = carom.BoundaryElements(elements=8, steps=20)
    full = carom.impact(pair, normal_speed=0.1, tangential_speed=0.1, method=coarse)
    assert any("stresses are those of the theory" in f.verdict for f in full._strength) == told


BRITTLE = {"young": "70 GPa", "poisson": 0.2, "density": 2500}


def brittle(**values):
    stuff = carom.Material(**BRITTLE, **values)
    ball = carom.Sphere(radius="5 mm", material=STRONG)
    return lambda speed: hit_wall(speed, ball, stuff)


@pytest.mark.parametrize(
    ("values", "name", "limit", "below", "above"),
    [
        ({"hardness": "5 GPa"}, "von Mises stress/Y", 1.0, True, None),
        ({"hardness": "5 GPa"}, "von Mises stress/Y", 3.0, None, False),
        ({"tensile_strength": "100 MPa"}, "tension/strength", 1.0, True, None),
        ({"fracture_toughness": 7e5, "flaw_size": "20 um"}, "K/K_c", 1.0, True, False),
        ({"fracture_toughness": 7e5}, "K/K_c", 1.0, True, None),
    ],
)
def test_strengths_of_brittle_bodies(values, name, limit, below, above):
    assert sides(brittle(**values), named(name), limit, 1e-3, 300.0) == (below, above)


@pytest.mark.parametrize(
    ("name", "at"),
    [
        *(("chi", 0.3), ("chi", 8.0), ("kappa", 2.0 / 3.0), ("kappa", 1.2), ("beta", -0.5)),
        *(("beta", 0.5), ("friction", 0.02), ("friction", 1.0), ("ratio", 10.0)),
    ],
)
def test_the_study_of_the_bounds_ends(name, at):
    known = {"kappa": 0.85, "beta": 0.1, "friction": 0.2, "chi": 1.44}
    outside = []
    for value in (at * (1.0 - NEAR), at * (1.0 + NEAR)):
        point = {"beta": 0.5, "friction": 0.5 / value} if name == "ratio" else {name: value}
        if name == "beta":
            point["friction"] = 0.5
        outside.append(bool(neglected.not_studied(**known | point)))
    inward = at in (0.3, 2.0 / 3.0, 0.02, -0.5)
    assert outside == ([True, False] if inward and name != "beta" else [False, True])


def test_what_waves_add_to_the_bound():
    plate = neglected.plate_error(1.44, [0.25, -0.5, 4.0], 0.02, 0.003)
    whole = 0.25 * 0.02 + 2.4 * 1.44 * 0.003
    np.testing.assert_allclose(plate, [0.5 * whole, whole, whole], rtol=1e-12)
    wall = neglected.wave_error(1.44, [0.625, -1.25, 4.0], 0.004)
    most = 1.05 * 1.44 * 0.004
    np.testing.assert_allclose(wall, [0.5 * most, most, most], rtol=1e-12)


@pytest.mark.parametrize(("thick", "width"), [(False, 1.3), (True, 1.0)])
def test_the_rim_of_a_plate_and_of_a_thick_wall(thick, width):
    """1.3 times the way of bending waves of the period of the contact, or of compressional ones."""
    thickness = 0.3 if thick else 3e-3
    hit = hit_wall(0.5, thickness=thickness)
    nu, fast = STEEL.poisson, STEEL.compressional_speed
    bending = STEEL.young * thickness**2 / (12.0 * (1.0 - nu**2) * STEEL.density)
    group = 2.0 * sqrt(2.0 * pi / hit.duration) * bending**0.25
    needed = fast * hit.duration if thick else width * group * hit.duration
    holds = [
        on_plate(4)(hit_wall(0.5, thickness=thickness, width=needed * factor)).holds
        for factor in (1.0 - NEAR, 1.0 + NEAR)
    ]
    assert holds == [False, True]
    assert (on_plate(4)(hit) is None) == thick


def test_a_wall_is_thick_where_no_echo_is_back():
    """The compressional wave runs to the other face and back, 2 h, while the contact lasts."""
    wall = hit_wall(0.5)
    thickness = 0.5 * wall.duration * STEEL.compressional_speed
    for factor, bends in ((1.0 - NEAR, True), (1.0 + NEAR, False)):
        hit = hit_wall(0.5, thickness=thickness * factor)
        assert hit.pair.gives_way(hit.scales) is bends
        assert (hit.normal_restitution < 1.0) == bends
        assert (findings.waves(hit) is None) == bends


def test_first_yield_is_where_the_metal_yields():
    """The limits of both verdicts on yield are at one speed, for nu = 0.3: 1.60 and 1."""
    stuff = carom.Material(young="200 GPa", poisson=0.3, density=7800, yield_strength="1 GPa")
    ball = carom.Sphere(radius="5 mm", material=stuff)
    hit = hit_wall(yield_velocity(hit_wall(0.1, ball, stuff).pair), ball, stuff)
    stress = named("von Mises stress/Y")(hit).value
    assert stress == pytest.approx(1.0, abs=0.01)


LIKELY = {  # of steel, what is changed, and between which values it usually lies
    "radius": (None, 1.0),
    "friction": (None, 5.0),
    "roughness": (None, 1e-3),
    "young": (1e3, 5e12),
    "density": (10.0, 3e4),
    "yield_strength": (1e3, 1e12),
    "tensile_strength": (1e3, 1e12),
    "fracture_toughness": (1e3, 1e10),
    "flaw_size": (None, 0.01),
    "hardness": (1e3, 1e12),
    "surface_energy": (None, 10.0),
    "loss_factor": (None, 3.0),
}


@pytest.mark.parametrize("name", LIKELY)
def test_values_that_are_hardly_meant(name):
    least, most = LIKELY[name]
    doubted = []
    for limit in filter(None, (least, most)):
        for factor in (1.0 - NEAR, 1.0 + NEAR):
            value = limit * factor
            body = {"radius": value} if name == "radius" else {"radius": 0.01}
            both = {name: value} if name in ("friction", "roughness") else {}
            stuff = {"young": 2e11, "poisson": 0.3, "density": 7800.0}
            stuff |= {name: value} if name not in ("radius", "friction", "roughness") else {}
            ball = carom.Sphere(material=carom.Material(**stuff), **body)
            pair = carom.Pair(ball, carom.HalfSpace("steel"), **{"friction": 0.2, **both})
            doubted.append(bool(doubts(pair)))
    assert doubted == ([True, False] if least else []) + [False, True]


def test_tabors_number_below_which_adhesion_takes_less():
    """From 5 on the contact is that of Johnson, Kendall & Roberts; below, that is the most."""

    def bead(radius):
        stuff = carom.material("bearing steel", surface_energy=1.0)
        return hit_wall(1e-5, carom.Sphere(radius=radius, material=stuff), stuff)

    ends = made(1e-9, 1e2, lambda radius: tabor(bead(radius).pair, 2.0), 5.0)
    told = ["it is the most" in findings.adhesion(bead(radius)).verdict for radius in ends]
    assert told == [True, False]


def test_a_finding_on_adhesion_has_the_number_that_decides():
    """Where it holds, what sticky surfaces take; where it fails, what clean ones take."""
    for speed, energy, holds in ((30.0, 0.5, True), (1e-3, 0.05, False)):
        hit = rubbery(speed)
        finding = findings.adhesion(hit)
        taken = pull_off_work(hit.pair, 2.0 * energy) / hit.scales.energy
        assert (finding.holds, finding.value) == (holds, pytest.approx(taken))


def test_a_loss_factor_that_is_not_known_is_asked_for_unless_the_other_is_too_large():
    for eta, holds, missing in ((1e-3, None, "loss_factor of bare"), (0.5, False, "")):
        bare = carom.Material(young=2e11, poisson=0.3, density=7800, name="bare")
        finding = findings.damping(hit_wall(0.1, with_loss(eta)[0], bare))
        assert (finding.holds, finding.missing) == (holds, missing)


def test_a_plate_that_shears_takes_seven_over_the_square_of_its_waves():
    hit = on_thickness(0.5, 5e-3)
    ratio = on_plate(0)(hit).value
    loss = 1.0 - hit.normal_restitution
    assert on_plate(1)(hit).value == pytest.approx(7.0 * loss / ratio**2)
    assert on_plate(1)(hit).limit == 0.01
