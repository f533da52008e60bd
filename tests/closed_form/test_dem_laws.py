"""Contact laws against closed forms: arcs of sines, gross sliding, Tsuji's and exact dashpots."""

import numpy as np
import pytest
from tests.oracles.arcs import Arcs

from carom import dem

CHI = 1.4412
DURATION = 2.94327518432470  # of Hertz's contact, in d_max/V_1
VARIANTS = ("mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")
ELASTIC = [
    *(dem.LinearSpring(), dem.LinearSpring(2 / 7), dem.HertzLinearHistory()),
    *(dem.LammpsMindlin(name) for name in VARIANTS),
    *(dem.LiggghtsHertz(), dem.EdemHertzMindlin(), dem.StrongeLaw()),
    dem.ThorntonLaw(),
]


@pytest.mark.parametrize("restitution", [1.0, 0.8, 0.5])
@pytest.mark.parametrize(("chi", "rho"), [(CHI, 1.0), (0.4, 1.0), (1.75, 2.3), (3.0, 0.7)])
def test_bilinear_springs_are_arcs_of_sines(chi, rho, restitution):
    psi = np.array([0.05, 0.2, 0.45, 0.8, 1.1, 1.6, 2.2, 3.1, 4.0, 5.5]) * chi / CHI
    law = dem.StrongeLaw(rho * 4 * chi / 7, restitution)
    expected = [Arcs(chi, rho, restitution).rebound(each) for each in psi]
    assert np.allclose(law.rebound(psi, chi), expected, rtol=0.0, atol=2e-8)


def test_springs_of_two_sevenths_return_all_of_what_sticks():
    """Half a period of both springs: psi_2 = -psi_1 up to 2 chi, then gross sliding."""
    psi = np.linspace(0.0, 9.0, 40)
    expected = dem.HardSphere(1.0).rebound(psi, CHI)
    assert np.allclose(dem.LinearSpring(2 / 7).rebound(psi, CHI), expected, rtol=0.0, atol=1e-8)


@pytest.mark.parametrize("ratio", [0.2, 2 / 7, 0.8235, 1.0])
def test_linear_spring_at_grazing_of_the_normal(ratio):
    """It sticks all but to the end: cos(pi sqrt(2 chi rho)) is left, rho = k_t/(k_n kappa)."""
    kappa, psi = 0.8, 1e-4
    expected = np.cos(np.pi * np.sqrt(2 * CHI * ratio / kappa))
    value = dem.LinearSpring(ratio).rebound(psi, CHI, kappa=kappa) / psi
    assert value == pytest.approx(expected, abs=3e-4)


@pytest.mark.parametrize("stiffness", [0.5, 1.0, 1.7])
def test_constant_spring_beside_hertz_at_grazing_of_the_normal(stiffness):
    """U'' = -(15/4) chi s U over the whole contact."""
    psi = 1e-4
    expected = np.cos(DURATION * np.sqrt(3.75 * CHI * stiffness))
    value = dem.HertzLinearHistory(stiffness).rebound(psi, CHI) / psi
    assert value == pytest.approx(expected, abs=3e-3)


@pytest.mark.parametrize("law", ELASTIC, ids=str)
@pytest.mark.parametrize("chi", [0.4, CHI, 3.0])
def test_gross_sliding(law, chi):
    """Slip throughout takes the impulse mu P: psi_2 = psi_1 - 4 chi."""
    psi = 4 * chi * np.array([1.3, 2.0, 10.0]) + 4.0
    assert np.allclose(law.rebound(psi, chi), psi - 4 * chi, rtol=0.0, atol=1e-7 * (1 + chi))


@pytest.mark.parametrize("restitution", [0.9, 0.4])
def test_gross_sliding_of_bilinear_springs(restitution):
    psi = np.array([9.0, 20.0])
    out = dem.StrongeLaw(restitution=restitution).rebound(psi, CHI)
    assert np.allclose(out, psi - 2 * CHI * (1 + restitution), rtol=0.0, atol=1e-8)


def test_hard_spheres():
    """Foerster et al. (1994): psi_2 = -beta_0 psi_1, or sliding, 2 chi (1 + e); odd."""
    law, most = dem.HardSphere(0.4, restitution=0.9), 2 * CHI * 1.9
    psi = np.array([0.0, 0.5, most / 1.4 - 1e-9, most / 1.4 + 1e-9, 8.0])
    expected = np.array([0.0, -0.2, -0.4 * psi[2], psi[3] - most, 8.0 - most])
    assert np.allclose(law.rebound(psi, CHI), expected, rtol=0.0, atol=1e-14)
    assert np.array_equal(law.rebound(-psi, CHI), -law.rebound(psi, CHI))
    assert np.array_equal(dem.HardSphere().rebound([1.0, 7.0], CHI), [0.0, 7.0 - 4 * CHI])


def final_speed(law):
    """Return the normal speed at the end of contact, extrapolated from the last two rows."""
    history = law.history(0.0, CHI, steps=200_000)
    depth, speed = history["penetration"][-2:], history["normal_velocity"][-2:]
    return -(speed[1] + (speed[1] - speed[0]) * depth[1] / (depth[0] - depth[1]))


@pytest.mark.parametrize("restitution", [0.9, 0.7, 0.3])
def test_dashpots_leave_the_restitution_asked_for(restitution):
    """Linear: exp(-pi zeta/sqrt(1 - zeta^2)); Hertz with d^(1/4): Antypov & Elliott (2011).

    Thornton's is a fit.
    """
    for make in (dem.LinearSpring, dem.LammpsMindlin, dem.LiggghtsHertz):
        assert final_speed(make(restitution=restitution)) == pytest.approx(restitution, abs=2e-5)
    yade = dem.YadeMindlin(restitution=restitution)
    assert final_speed(yade) == pytest.approx(restitution, abs=1e-3)


@pytest.mark.parametrize("restitution", [0.9, 0.7, 0.4])
def test_tsuji_leaves_another_restitution(restitution):
    """zeta = alpha/sqrt 5, for alpha sqrt(m k_n d^(1/2)); 0.7777 where 0.7 is asked for."""
    powers = [1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218]
    zeta = np.polynomial.Polynomial(powers)(restitution) / np.sqrt(5)
    left = np.exp(-np.pi * zeta / np.sqrt(1 - zeta**2))
    law = dem.LammpsMindlin(restitution=restitution, damping="tsuji")
    assert final_speed(law) == pytest.approx(left, abs=2e-5)
    if restitution == 0.7:
        assert left == pytest.approx(0.7777, abs=5e-5)


def test_laws_that_are_one():
    """Stronge's at e = 1 is the linear spring, and without damping so are the three of Hertz."""
    psi = np.linspace(-6.0, 6.0, 41)
    assert np.array_equal(dem.StrongeLaw().rebound(psi, CHI), dem.LinearSpring().rebound(psi, CHI))
    mindlin = dem.LammpsMindlin("mindlin").rebound(psi, CHI)
    for law in (dem.LiggghtsHertz(), dem.EdemHertzMindlin()):
        assert np.array_equal(law.rebound(psi, CHI), mindlin)
    psi_out = dem.LinearSpring(0.8).rebound(psi, CHI, kappa=0.8)
    assert np.allclose(psi_out, dem.LinearSpring().rebound(psi, CHI), rtol=0.0, atol=1e-9)
