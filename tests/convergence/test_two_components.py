"""Impacts whose direction turns, by springs of two components, against a plain march of its own."""

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.oracles import march_in_space as oracle

from carom.dimensionless.lossy.law import Loss
from carom.dimensionless.lossy.layout import PSI_OUT, RESTITUTION
from carom.dimensionless.lossy.springs import march
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia, Solid, made_of

Array = NDArray[np.float64]

ROD = Inertia(chi=0.507527, eps=0.329802, zeta=1.086368)  # in a plane of symmetry
BESIDE = 0.7  # chi of the rod across that plane
SOLIDS = {
    "elastic": ELASTIC,
    "plate": Solid(int(Loss.PLATE), 0.3),
    "yielding": Solid(int(Loss.PLASTIC), 0.4),
    "metal": Solid(int(Loss.METAL), 0.4, 0.0, 0.004),
    "relaxing": Solid(int(Loss.RELAXING), 0.3, 1.0),
    "viscous": made_of(int(Loss.VISCOUS), 0.3, 0.0),
}
OUT = [RESTITUTION, PSI_OUT, march.PSI_ACROSS]


def rod_at(angle: float) -> Inertia:
    """Return the inertia of the rod where its plane is at an angle to the direction of impact."""
    c, s = np.cos(angle), np.sin(angle)
    return Inertia(
        chi=ROD.chi * c * c + BESIDE * s * s,
        eps=ROD.eps * c,
        zeta=ROD.zeta * c,
        across=ROD.chi * s * s + BESIDE * c * c,
        mixed=(ROD.chi - BESIDE) * c * s,
        eps_across=ROD.eps * s,
        zeta_across=ROD.zeta * s,
    )


def rebound(psi: float, body: Inertia, solid: Solid = ELASTIC) -> Array:
    """Return e, psi_2 and psi_2 across."""
    numbers = np.empty(march.NUMBERS)
    assert march.run(psi, 0.0, body, solid, march.new_work(), numbers)[0] == 0
    return numbers[OUT]


@pytest.mark.first_case
@pytest.mark.parametrize("solid", SOLIDS.values(), ids=SOLIDS)
@pytest.mark.parametrize("psi", [-0.3, 0.8, 2.0, 9.0])
def test_an_impact_that_does_not_turn_is_that_of_one_component(psi: float, solid: Solid) -> None:
    flat, both = (rebound(psi, body, solid) for body in (Inertia(1.44), Inertia(1.44, across=1.44)))
    assert both == pytest.approx(flat, abs=1e-6)
    assert both[2] == 0.0


@pytest.mark.first_case
@pytest.mark.parametrize("solid", SOLIDS.values(), ids=SOLIDS)
def test_the_rebound_turns_with_the_body(solid: Solid) -> None:
    """Without tangential velocity before, what comes after lies in the rod's plane."""
    e, psi_2, _ = rebound(0.0, ROD, solid)
    for angle in (0.3, 1.0, 2.0, 4.0):
        turned = e, psi_2 * np.cos(angle), psi_2 * np.sin(angle)
        assert rebound(0.0, rod_at(angle), solid) == pytest.approx(turned, abs=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize(("psi", "angle"), [(0.5, 1.0), (1.5, 2.0), (4.0, 1.0), (-2.5, 0.4)])
def test_the_oracle_agrees(psi: float, angle: float) -> None:
    body = rod_at(angle)
    speed, along, across = oracle.extrapolated(psi, oracle.rates_of(body))
    assert rebound(psi, body) == pytest.approx([-speed, along, across], abs=5e-7)


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("psi", "body", "alpha"),
    [(0.8, ROD, 0.1), (0.5, rod_at(1.0), 0.3), (1.5, rod_at(2.0), 0.05), (4.0, rod_at(1.0), 0.9)],
)
def test_the_oracle_of_viscous_solids_agrees(psi: float, body: Inertia, alpha: float) -> None:
    """In the rod's plane and out of it; the oracle's own error, of order 3/2, is up to 3e-6."""
    speed, along, across = oracle.extrapolated(psi, oracle.rates_of(body), 350, alpha=alpha)
    solid = made_of(int(Loss.VISCOUS), alpha, 0.0)
    assert rebound(psi, body, solid) == pytest.approx([-speed, along, across], abs=4e-6)


@pytest.mark.first_case
@pytest.mark.parametrize("solid", SOLIDS.values(), ids=SOLIDS)
def test_the_error_is_of_second_order(solid: Solid) -> None:
    counts, wrong = (60, 120, 240), []
    for psi, angle in ((0.5, 1.0), (1.5, 2.0), (4.0, 1.0)):
        body = rod_at(angle)
        exact = rebound(psi, body, solid)
        values = [march.marched(psi, body, solid, count)[OUT] for count in counts]
        wrong.append([np.linalg.norm(value - exact) for value in values])
    order = -np.polyfit(np.log(counts), np.log(np.linalg.norm(wrong, axis=0)), 1)[0]
    assert order == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize("relaxation", [1e-6, 1e6])
def test_what_relaxes_at_once_or_never_is_elastic(relaxation: float) -> None:
    for psi, angle in ((0.5, 1.0), (4.0, 2.0)):
        solid, body = Solid(int(Loss.RELAXING), relaxation, 1.0), rod_at(angle)
        assert rebound(psi, body, solid) == pytest.approx(rebound(psi, body), abs=1e-5)


@pytest.mark.slow
def test_no_impact_gains_energy() -> None:
    rng = np.random.default_rng(1904)
    for psi, angle in zip(rng.uniform(-5.0, 5.0, 12), rng.uniform(0.0, 6.0, 12), strict=True):
        body = rod_at(angle)
        before = oracle.energy(body, np.array([1.0, psi, 0.0]))
        after = [oracle.energy(body, rebound(psi, body, s) * [-1, 1, 1]) for s in SOLIDS.values()]
        assert max(after) <= before + 1e-6
