"""Fixed steps converge to the adaptive answer, at the order of what a code accumulates."""

import numpy as np
import pytest
from scipy.integrate import RK45

import carom
from carom.dem.adaptive import ERROR, NODES

CHI = 1.4412
PSI = np.array([0.3, 0.55, 0.8, 1.2, 1.6, 2.2, 3.0, 3.7])
STEPS = (2_000, 8_000, 32_000)
FORCE = "mindlin/force"
RESCALED = "mindlin_rescale/force"


def test_adaptive_steps_are_those_of_dormand_and_prince():
    """Their order 5(4), and the error that chooses the step (1980, J. Comput. Appl. Math. 6:19)."""
    np.testing.assert_allclose(NODES[:5, :5], RK45.A[1:], rtol=1e-15)
    np.testing.assert_allclose(NODES[5], RK45.B, rtol=1e-15)
    np.testing.assert_allclose(ERROR, -RK45.E, rtol=1e-14)


def errors(law, psi=PSI):
    """Return the root mean square over the incidences for each number of steps."""
    exact = law.rebound(psi, CHI)
    return [np.sqrt(np.mean((law.rebound(psi, CHI, steps=n) - exact) ** 2)) for n in STEPS]


def order(law, psi=PSI):
    return -np.polyfit(np.log(STEPS), np.log(errors(law, psi)), 1)[0]


@pytest.mark.parametrize(
    "law",
    [
        carom.dem.LinearSpring(),
        carom.dem.HertzLinearHistory(),
        carom.dem.LammpsMindlin("mindlin"),
        carom.dem.StrongeLaw(restitution=0.7),
    ],
    ids=str,
)
def test_stored_displacements_converge_in_second_order(law):
    assert order(law) > 1.7


@pytest.mark.parametrize(
    "law",
    [
        *(carom.dem.LammpsMindlin(FORCE), carom.dem.LammpsMindlin(RESCALED)),
        *(carom.dem.LammpsMindlin("mindlin_rescale"), carom.dem.ThorntonLaw()),
        *(carom.dem.WaltonBraunLaw(), carom.dem.WaltonBraunLaw(restitution=0.7)),
    ],
    ids=str,
)
def test_what_is_accumulated_or_rescaled_converges_in_first_order(law):
    assert order(law) == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize(
    "law",
    [
        carom.dem.LammpsMindlin("mindlin", restitution=0.8),
        carom.dem.LammpsMindlin("mindlin", restitution=0.8, damping="tsuji"),
        carom.dem.LammpsMindlin("mindlin_rescale", restitution=0.8),
        carom.dem.LammpsMindlin(FORCE, restitution=0.8, tangential_damping=0.5),
        carom.dem.LammpsMindlin(RESCALED, restitution=0.8, tangential_damping=0.5),
        carom.dem.HertzLinearHistory(1.2, 0.8, 0.5),
        carom.dem.LinearSpring(0.6, 0.8, 0.5),
        carom.dem.LiggghtsHertz(0.8),
    ],
    ids=str,
)
def test_velocities_of_the_half_step_make_damping_first_order(law):
    """Sixteen times the steps, a sixteenth of the error; where dashpots jump, about that."""
    coarse, _, fine = errors(law)
    assert 1 / 80 < fine / coarse < 1 / 8
    assert fine < 5e-5


@pytest.mark.parametrize(
    "law",
    [
        carom.dem.EdemHertzMindlin(0.9),
        carom.dem.LammpsMindlin("mindlin", restitution=0.9, tangential_damping=1.0),
        carom.dem.LammpsMindlin("mindlin_rescale", restitution=0.9, tangential_damping=1.0),
    ],
    ids=str,
)
def test_stored_displacement_with_a_dashpot_hardly_converges_where_it_slides_at_touch(law):
    """Against a dashpot of d^(1/4) it must store U = d^(-1/4) at touch, at a depth the step sets.

    No practical number of steps gives the law as it is meant; a million gets there.
    """
    psi = 1.2  # above sqrt(kappa), or kappa/x_gamma: more damping than mu N at touch
    meant = law.rebound(psi, CHI)
    assert abs(law.rebound(psi, CHI, steps=10_000) - meant) > 0.1
    assert law.rebound(psi, CHI, steps=2_000_000) == pytest.approx(meant, abs=1e-4)
    assert law.rebound(0.6, CHI, steps=10_000) == pytest.approx(law.rebound(0.6, CHI), abs=1e-4)
