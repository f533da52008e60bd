"""Stiffnesses and dampings for the codes, against elastic constants by hand and equations of motion
integrated by scipy."""

import re
from dataclasses import dataclass, replace
from math import gamma, log, pi, sqrt

import numpy as np
import pytest
from tests.oracles.springs import damped_rebound

import carom
from carom.verify import (
    damping_from_restitution,
    poisson_from_kappa,
    recipes,
    restitution_from_damping,
    stiffnesses,
)
from carom.verify.conversions import CONVENTIONS, MINDLIN
from carom.verify.engines.experiments import Experiment, psi_out
from carom.verify.engines.lammps import INPUT, Lammps
from carom.verify.engines.running import run

STEEL = carom.Material(young=210e9, poisson=0.3, density=7850)
GLASS = carom.Material(young=70e9, poisson=0.2, density=2500)
BALL, BEAD = carom.Sphere(radius=5e-3, material=STEEL), carom.Sphere(radius=3e-3, material=GLASS)
PAIRS = {
    "steel on steel": carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2),
    "glass on steel": carom.Pair(BEAD, BALL, friction=0.4),
}
CHI = 1.4412
SPEED = 0.7


def by_hand(name):
    """Return E*, G*, R*, m* of a pair."""
    (e1, nu1), (e2, nu2) = ((210e9, 0.3), (210e9, 0.3))
    radius, mass = 5e-3, 4 / 3 * pi * 5e-3**3 * 7850
    if name == "glass on steel":
        (e1, nu1), bead = (70e9, 0.2), 4 / 3 * pi * 3e-3**3 * 2500
        radius, mass = 1 / (1 / 3e-3 + 1 / 5e-3), 1 / (1 / bead + 1 / mass)
    modulus = 1 / ((1 - nu1**2) / e1 + (1 - nu2**2) / e2)
    shear = 1 / ((2 - nu1) * (1 + nu1) / (2 * e1) + (2 - nu2) * (1 + nu2) / (2 * e2))
    return modulus, shear, radius, mass


@pytest.fixture(params=PAIRS)
def contact(request):
    """Return stiffnesses at 0.7 m/s, and E*, G*, R*, m*, d_max of the same contact by hand."""
    modulus, shear, radius, mass = by_hand(request.param)
    deepest = (15 * mass * SPEED**2 / (16 * modulus * sqrt(radius))) ** 0.4
    values = stiffnesses(PAIRS[request.param], SPEED)
    return values, (modulus, shear, radius, mass, deepest)


def test_energy_presses_the_spring_to_the_depth_of_hertz(contact):
    """k_n d_max^2/2 = m V_1^2/2; k_t/k_n = kappa = G*/E*."""
    actual, (modulus, shear, _, mass, deepest) = contact
    assert actual.normal * deepest**2 == pytest.approx(mass * SPEED**2, rel=1e-12)
    assert actual.ratio == pytest.approx(shear / modulus, rel=1e-12)
    assert actual.tangential / actual.normal == pytest.approx(shear / modulus, rel=1e-12)


def test_spring_that_lasts_as_long_as_hertz(contact):
    """pi sqrt(m/k) = (4/5) sqrt(pi) Gamma(2/5)/Gamma(9/10) d_max/V_1."""
    actual, (_, _, _, mass, deepest) = contact
    duration = 0.8 * sqrt(pi) * gamma(0.4) / gamma(0.9) * deepest / SPEED
    assert pi * sqrt(mass / actual.normal_by_duration) == pytest.approx(duration, rel=1e-11)
    assert 1.05 < actual.normal_by_duration / actual.normal < 1.2


def test_coefficients_of_hertz_and_mindlin(contact):
    """F_n = k sqrt(R*) d^(3/2), its steepest slope at d_max; k_t a with 1/G_eff = sum (2-nu)/G."""
    actual, (modulus, shear, radius, _, deepest) = contact
    depth = deepest * np.array([1 - 1e-5, 1 + 1e-5])
    load = actual.hertz * sqrt(radius) * depth**1.5
    assert actual.hertz == pytest.approx(4 / 3 * modulus, rel=1e-12)
    assert actual.steepest == pytest.approx(np.diff(load)[0] / (2e-5 * deepest), rel=1e-8)
    effective = shear / 4
    assert actual.mindlin == pytest.approx(8 * effective, rel=1e-12)


def test_poisson_from_kappa_is_the_inverse():
    """kappa = 2 (1 - nu)/(2 - nu), which pairs of one material have, too."""
    nu = np.linspace(-0.99, 0.5, 60)
    kappa = 2 * (1 - nu) / (2 - nu)
    values = [poisson_from_kappa(k) for k in kappa]
    assert values == pytest.approx(nu, abs=1e-12)
    for value in (0.0, 0.3, 0.5):
        stuff = carom.Material(young=1e9, poisson=value, density=1000)
        ball = carom.Sphere(radius=1e-3, material=stuff)
        pair = carom.Pair(ball, carom.HalfSpace(material=stuff), friction=0.1)
        assert poisson_from_kappa(pair.kappa) == pytest.approx(value, abs=1e-12)


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_damping_and_restitution_are_inverse(convention):
    wanted = np.concatenate([np.geomspace(0.0101, 0.999, 40), [1.0]])
    values = [damping_from_restitution(e, convention) for e in wanted]
    assert (np.diff(values) < 0.0).all()
    actual = [restitution_from_damping(v, convention) for v in values]
    assert actual == pytest.approx(wanted, abs=1e-10)
    assert np.copysign(1.0, values[-1]) == 1.0


@pytest.mark.parametrize("e", [0.05, 0.3, 0.7, 0.95])
def test_damping_leaves_what_was_wanted(e):
    """Equations of motion in units k = m = 1, S = (3/2) sqrt(d) the tangent stiffness of Hertz.

    critical: c = 2 zeta sqrt(k m), and 2 zeta sqrt(5/6) sqrt(S m) where S is 2 E* a; to the last
    digit. Thornton's is a fit, to 4e-4, of the contact that does not pull.
    """
    zeta = damping_from_restitution(e)
    assert zeta == pytest.approx(-log(e) / sqrt(pi**2 + log(e) ** 2), rel=1e-14)
    assert damped_rebound(lambda d: 2.0 * zeta, 1.0) == pytest.approx(e, abs=1e-7)
    hertz = damped_rebound(lambda d: 2.0 * zeta * sqrt(5.0 / 6.0 * 1.5 * sqrt(d)), 1.5)
    assert hertz == pytest.approx(e, abs=1e-5)
    beta = damping_from_restitution(e, "thornton")
    left = damped_rebound(lambda d: 2.0 * beta * sqrt(1.5 * sqrt(d)), 1.5, pulls=False)
    assert left == pytest.approx(e, abs=4e-4 if e < 0.9 else 4e-3)


def test_tsuji_leaves_more_than_was_asked_for():
    """c = alpha sqrt(m F_n/d): LAMMPS leaves 0.7777 where 0.7 is asked for, as measured there."""
    alpha = damping_from_restitution(0.7, "lammps tsuji")
    left = damped_rebound(lambda d: alpha * sqrt(sqrt(d)), 1.5)
    assert left == pytest.approx(0.7777, abs=2e-4)


@pytest.mark.parametrize("e", [0.6, 1.0])
@pytest.mark.parametrize("name", PAIRS)
def test_recipes_hold_the_stiffnesses(name, e):
    """Every number in the lines for the codes, by its place, to the digits that are printed."""
    pair = PAIRS[name]
    modulus, shear, _, mass = by_hand(name)
    k = stiffnesses(pair, SPEED)
    dashpot = 2 * damping_from_restitution(e) * sqrt(k.normal * mass)
    beta, hertz = damping_from_restitution(e, "thornton"), (4 / 3 * modulus, 0.0 if e == 1.0 else e)
    kn, kt, mu = k.normal, k.tangential, pair.friction
    losses = [] if e == 1.0 else [e, SPEED]
    stuff = pair.first.material, pair.second.material
    one, two = ([each.young, each.poisson, mu, *losses] for each in stuff)
    plane = len(pair.moving) == 1
    expected = {
        "LAMMPS, exact law": [1, 1, *one, *(two if plane else [2, 2, *two] if one != two else [])],
        "LAMMPS Hertz": [*hertz, 2 * shear, 0.0, mu],
        "LAMMPS Hooke": [kn, dashpot, kt, 0.0, mu],
        "LIGGGHTS hooke/stiffness": [kn, kt, dashpot / mass, 0.0],
        "LIGGGHTS hertz, EDEM": [e],
        "YADE CundallStrack": [kn, kt],
        "YADE Mindlin": [beta, 0.0],
        "Kratos": [beta],
        "MercuryDPM linear": [kn, dashpot, kt],
        "MFiX linear": [kn, kt / kn, e],
    }
    by_name = recipes(pair, SPEED, e)
    assert by_name.keys() == expected.keys()
    for code, text in by_name.items():
        numbers = re.findall(r"(?<![\w/])-?\d[\d.]*(?:e[+-]\d+)?", text)
        printed = [float(n) for n in numbers]
        assert printed == pytest.approx(expected[code], rel=1e-4, abs=1e-5), code
        assert not any(n.startswith("-") for n in numbers), code
    assert ("coeff_restitution" in by_name["LAMMPS Hertz"]) == (e != 1.0)
    assert ("has no damping" in by_name["YADE CundallStrack"]) == (e != 1.0)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: stiffnesses(BALL, 1.0), "pair: .*carom.Pair"),
        (lambda: stiffnesses(PAIRS["steel on steel"], 0.0), "normal_speed: 0.0 .*positive"),
        (lambda: poisson_from_kappa(2.0), "kappa: 2.0 .*below 2"),
        (lambda: poisson_from_kappa(-0.1), "kappa: -0.1 .*positive"),
        (lambda: damping_from_restitution(0.0), "restitution: 0.0 .*from 1e-06 to 1"),
        (lambda: damping_from_restitution(1.01), "restitution: 1.01 .*from 1e-06 to 1"),
        (lambda: damping_from_restitution("bouncy"), "restitution: 'bouncy'"),
        (
            lambda: damping_from_restitution(0.5, "kuwabara"),
            "convention: 'kuwabara' .*critical, lammps tsuji",
        ),
        (lambda: restitution_from_damping(-0.1), "damping: -0.1 .*zero or positive"),
        (lambda: restitution_from_damping(1.3, "lammps tsuji"), "damping: 1.3 .*at most 1.273"),
        (lambda: restitution_from_damping(1.0), "damping: 1.0 .*at most 0.97"),
        (lambda: recipes(PAIRS["steel on steel"], 1.0, 1.5), "restitution: 1.5"),
    ],
)
def test_refused(call, message):
    with pytest.raises(carom.InputError, match=message):
        call()


@dataclass(frozen=True)
class ByRecipe(Lammps):
    """LAMMPS with a line of `recipes` in the place of its own coefficients."""

    line: str = ""

    def files(self, experiment):
        files = super().files(experiment)
        script, count = re.subn(r"granular .* zplane", f"granular {self.line} zplane", files[INPUT])
        assert count == 1
        return files | {INPUT: script}


@pytest.mark.first_case
@pytest.mark.engine
@pytest.mark.skipif(Lammps().executable() is None, reason="no LAMMPS is installed")
@pytest.mark.parametrize("e", [1.0, 0.8])
@pytest.mark.parametrize(
    ("code", "law"),
    [
        ("LAMMPS Hertz", carom.dem.LammpsMindlin("mindlin_rescale/force")),
        ("LAMMPS Hertz", carom.dem.LammpsMindlin("mindlin_rescale/force", tangential_damping=1.0)),
        ("LAMMPS Hooke", carom.dem.LinearSpring()),
    ],
)
def test_lammps_takes_the_recipe(code, law, e):
    """With the line as it is printed LAMMPS computes our law, to the five digits of the line."""
    pair, psi, slow = PAIRS["steel on steel"], np.array([0.25, 0.75, 1.5, 3.0]), 1e-3
    law = replace(law, restitution=e)
    speeds = tuple(psi * pair.scales(slow).tangential_speed)
    wanted = Experiment(pair=pair, law=law, normal_speed=slow, tangential_speed=speeds, steps=2000)
    mindlin = law if isinstance(law, carom.dem.LammpsMindlin) else MINDLIN
    outcomes = run(ByRecipe(line=recipes(pair, slow, e, mindlin=mindlin)[code]), wanted).outcomes
    expected = law.rebound(psi, pair.chi, kappa=pair.kappa, steps=2000)
    assert psi_out(wanted, outcomes) == pytest.approx(expected, abs=2e-4)
    assert outcomes.normal_speed / slow == pytest.approx(np.full(4, e), abs=3e-4)
