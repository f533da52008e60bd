"""What impacts with losses come to depends on nothing but the impact: threads, whether a record is
kept, what was solved before. Compiled or not: see test_kernels."""

import numpy as np
import pytest

import carom
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.viscoelastic.panels import back_substitute, factorise
from carom.dimensionless.lossy.viscoelastic.work import INTEGRALS, NODES, RADIUS, Panel, new_work
from carom.dimensionless.numerics.kernels import plain
from carom.dimensionless.rebounds import LossyRebounds, lossy_rebounds
from carom.dimensionless.solution import solve_lossy

IMPACTS = (
    *((0.4, 1.44, (Loss.VISCOUS, 0.1, 0.0)), (3.5, 1.44, (Loss.VISCOUS, 0.4, 0.0))),
    *((-6.0, 1.0, (Loss.VISCOUS, 0.2, 0.0)), (1.0, 1.7, (Loss.PLASTIC, 0.3, 0.0))),
    *((-2.5, 0.8, (Loss.PLASTIC, 0.8, 0.0)), (1.3, 1.4, (Loss.RELAXING, 0.5, 2.0))),
    (1.0, 1.7, (Loss.METAL, 0.3, 0.004)),
)


@pytest.mark.parametrize("alpha", [0.0, 0.3])
@pytest.mark.parametrize("clock", range(len(INTEGRALS)))
def test_a_step_solves_the_linearised_equations(clock: int, alpha: float) -> None:
    """Less than a step would converge, too, but slowly: the system, against NumPy's solution."""
    work, rng, h = new_work(), np.random.default_rng(clock), 0.3
    work.values[RADIUS], work.rates[:] = rng.uniform(0.1, 1.0, NODES), rng.normal(size=(3, NODES))
    s, b, stuck, right = INTEGRALS[clock], work.values[RADIUS], work.rates[2], work.rates[0].copy()
    unit = np.eye(NODES)
    wanted = np.linalg.solve(unit - h * (s * stuck) @ (h * s * (2.0 * b) + alpha * unit), right)
    plain(factorise)(work, Panel(number=0, clock=clock, length=h, pieces=0), alpha)
    plain(back_substitute)(work)
    np.testing.assert_allclose(work.rates[0], wanted, rtol=1e-12)


def many(seed: int, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.uniform(-8, 8, count), rng.uniform(0.3, 3, count), rng.uniform(0.0, 0.46, count)


def same(first: LossyRebounds, second: LossyRebounds) -> bool:
    return all(np.array_equal(a, b, equal_nan=True) for a, b in zip(first, second, strict=True))


@pytest.mark.first_case
@pytest.mark.parametrize("loss", Loss)
def test_threads_leave_every_bit(loss: Loss) -> None:
    psi, chi, parameter = many(3, 333 if loss is Loss.VISCOUS else 18)
    losses = LossNumbers(loss, 0.05 + 2.0 * parameter, parameter)
    one = lossy_rebounds(psi, chi, losses, 1)
    for threads in (2, 5, None):
        assert same(one, lossy_rebounds(psi, chi, losses, threads))


def test_impacts_do_not_depend_on_those_before_them() -> None:
    """Arrays are used again: in another order, among others, the bits are the same."""
    psi, chi, alpha = many(4, 60)
    forth = lossy_rebounds(psi, chi, LossNumbers(Loss.VISCOUS, alpha), 1)
    back = lossy_rebounds(psi[::-1], chi[::-1], LossNumbers(Loss.VISCOUS, alpha[::-1]), 1)
    assert same(forth, LossyRebounds(*(column[::-1] for column in back)))
    psi[::2] = np.nan
    chi[1::4] = -1.0
    broken = lossy_rebounds(psi, chi, LossNumbers(Loss.VISCOUS, alpha), 1)
    assert same(LossyRebounds(*(c[3::4] for c in forth)), LossyRebounds(*(c[3::4] for c in broken)))


@pytest.mark.parametrize("impact", IMPACTS, ids=str)
def test_a_record_leaves_every_bit(impact: tuple[float, float, tuple[Loss, float, float]]) -> None:
    psi, chi, losses = impact
    kept = solve_lossy(psi, chi, LossNumbers(*losses))
    bare = lossy_rebounds(np.array([psi]), np.array([chi]), LossNumbers(*losses))
    for name in set(LossyRebounds._fields) - {"status"}:
        assert getattr(kept, name) == getattr(bare, name)[0], name


def test_rebound_solve_and_impact_are_one_solver(pair: carom.Pair) -> None:
    law = carom.KelvinVoigt(restitution=0.8)
    hit = carom.impact(pair, normal_speed=1.5, tangential_speed=1.0, losses=law)
    psi_out = carom.rebound(hit.psi_in, pair.chi, losses=law)
    assert psi_out == carom.solve(hit.psi_in, pair.chi, losses=law).psi_out
    assert hit.psi_out == psi_out
