"""Fixed steps converge to the adaptive answer, at the order of what a code accumulates."""

import numpy as np
import pytest

import carom

CHI = 1.4412
PSI = np.array([0.3, 0.55, 0.8, 1.2, 1.6, 2.2, 3.0, 3.7])
STEPS = (2_000, 8_000, 32_000)
FORCE = "mindlin/force"
RESCALED = "mindlin_rescale/force"


def errors(law, psi=PSI):
    """Return the root mean square over the incidences for each number of steps."""
    exact = law.rebound(psi, CHI)
    return [np.sqrt(np.mean((law.rebound(psi, CHI, steps=n) - exact) ** 2)) for n in STEPS]


def order(law, psi=PSI):
    return -np.polyfit(np.log(STEPS), np.log(errors(law, psi)), 1)[0]


@pytest.mark.parametrize(
    "law",
    [carom.LinearSpring(), carom.HertzLinearHistory(), carom.LammpsMindlin("mindlin")],
    ids=str,
)
def test_stored_displacements_converge_in_second_order(law):
    assert order(law) > 1.7


@pytest.mark.parametrize(
    "law",
    [
        carom.LammpsMindlin(FORCE),
        carom.LammpsMindlin(RESCALED),
        carom.LammpsMindlin("mindlin_rescale"),
        carom.ThorntonLaw(),
        carom.LammpsMindlin(FORCE, restitution=0.8, tangential_damping=0.5),
    ],
    ids=str,
)
def test_what_is_accumulated_or_rescaled_converges_in_first_order(law):
    assert order(law) == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize(
    "law",
    [
        carom.LammpsMindlin("mindlin", restitution=0.8),
        carom.LiggghtsHertz(0.8),
        carom.LinearSpring(0.6, 0.8, 0.5),
        carom.StrongeLaw(restitution=0.7),
        carom.WaltonBraunLaw(),
        carom.WaltonBraunLaw(restitution=0.7),
    ],
    ids=str,
)
def test_other_laws_converge(law):
    found = errors(law)
    assert found[2] < 0.35 * found[1] < 0.35 * 0.35 * found[0]
    assert found[2] < 1e-4


def test_stored_displacement_with_damping_has_no_limit_where_it_slides_at_touch():
    """Its spring must balance a dashpot of d^(1/4) by k_t(a) U of d^(1/2): U = d^(-1/4) at touch.

    What is stored in the first step decides, hence the step itself.
    """
    law = carom.EdemHertzMindlin(0.9)
    few, many = (law.rebound(1.0, CHI, steps=n) for n in (1_000, 100_000))
    assert abs(few - many) > 0.05
    sticking = 0.6  # of psi_1 < sqrt(kappa) the damping stays below mu N
    few, many = (law.rebound(sticking, CHI, steps=n) for n in (1_000, 100_000))
    assert abs(few - many) < 1e-3
