"""What holds for every impact with losses: limits, energy, friction, contraction, refusals.

With the normal motion given, springs that Coulomb's limit cuts are a sweeping process: two impacts
that differ in psi_1 alone come no further apart, |psi_2 - psi_2'| <= |psi_1 - psi_1'|, as
(psi - psi')^2/2 + (15/8) chi integral of (q - q')^2 cannot grow (Moreau 1977).
"""

import time
from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import cumulative_simpson, simpson
from tests.oracles.march import march, motion

import carom
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.layout import NUMBERS, PSI_OUT
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.lossy.viscoelastic.impacts import TOLERANCE, Solid, outgoing
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.lossy.viscoelastic.record import new_record
from carom.dimensionless.lossy.viscoelastic.work import new_work
from carom.dimensionless.rebounds import LossyRebounds, lossy_rebounds
from carom.dimensionless.solution import solve_lossy

Array = NDArray[np.float64]

PROMISED = 1e-8  # of psi_2, in max(1, psi_1)
LAWS = tuple(Loss)
MANY = {
    "viscous": LossNumbers(Loss.VISCOUS, 0.3),
    "hardly viscous": LossNumbers(Loss.VISCOUS, 0.05),
    "yields late": LossNumbers(Loss.PLASTIC, 0.8),
    "yields early": LossNumbers(Loss.PLASTIC, 0.4),
    "metal": LossNumbers(Loss.METAL, 0.4, 0.005),
    "relaxes fast": LossNumbers(Loss.RELAXING, 0.1, 2.0),
    "relaxes slowly": LossNumbers(Loss.RELAXING, 3.0, 0.7),
}
CLOSE = {Loss.VISCOUS: PROMISED, Loss.PLASTIC: 1e-5, Loss.METAL: 1e-5, Loss.RELAXING: 1e-6}
EXTRA = {law: 0.005 if law is Loss.METAL else 1.0 for law in LAWS}


def impacts(seed: int, count: int) -> tuple[Array, Array, Array]:
    """Return psi, chi and alpha, of e from 0.5 to 1."""
    rng = np.random.default_rng(seed)
    psi, chi = rng.uniform(0.0, 8.0, count), rng.uniform(0.3, 3.0, count)
    return psi, chi, rng.uniform(0.0, 0.46, count)


def solved(psi: Array, chi: Array, parameter: Array) -> LossyRebounds:
    """Return impacts, all of which must be solved."""
    rebounds = lossy_rebounds(psi, chi, LossNumbers(Loss.VISCOUS, parameter))
    failed = np.flatnonzero(rebounds.status != Status.SOLVED)
    assert failed.size == 0, [(psi[i], chi[i], parameter[i]) for i in failed[:5]]
    return rebounds


def histories(seed: int, count: int) -> list[LossySolution]:
    return [
        solve_lossy(float(p), float(c), LossNumbers(Loss.VISCOUS, float(a)))
        for p, c, a in zip(*impacts(seed, count), strict=True)
    ]


def test_without_losses_it_is_the_elastic_solver() -> None:
    """Two solvers that share nothing but the problem, over all psi_1 and chi."""
    rng = np.random.default_rng(5)
    psi = np.append(rng.uniform(0.0, 8.0, 500), 10.0 ** rng.uniform(-6.0, 2.0, 200))
    chi = np.append(rng.uniform(0.3, 3.0, 500), 10.0 ** rng.uniform(-2.0, 1.7, 200))
    exact = carom.rebound(psi, chi)
    work, record, numbers = new_work(), new_record(False), np.zeros(NUMBERS)
    values = np.empty(700)
    for i in range(700):  # lossy_rebounds would hand them to the elastic solver
        solid = Solid(chi[i], 0.0, TOLERANCE)
        assert outgoing(psi[i], solid, work, record, numbers)[0] == Status.SOLVED
        values[i] = numbers[PSI_OUT]
    error = np.abs(values - exact) / np.maximum(1.0, psi)
    assert np.max(error) < PROMISED
    assert np.quantile(error, 0.95) < 1e-9


def test_vanishing_losses_give_the_elastic_impact() -> None:
    """The difference is at most 6 alpha, in proportion to it, down to what is promised."""
    psi, chi, _ = impacts(6, 150)
    exact = carom.rebound(psi, chi)
    for alpha in (1e-4, 1e-6, 1e-8, 1e-11):
        result = solved(psi, chi, np.full(150, alpha))
        error = np.abs(result.psi_out - exact) / np.maximum(1.0, psi)
        assert np.max(error) < 6.0 * alpha + PROMISED
        assert np.median(error) < 1.2 * alpha + 1e-11
        assert np.max(np.abs(1.0 - 1.891706 * alpha - result.restitution)) < 4.0 * alpha**2 + 1e-9


LOSSES = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99, 0.999, 0.9999)


def all_losses(count: int, seed: int) -> tuple[Array, Array, Array]:
    """Return psi, chi from 0.1 to 5, alpha, of e from 0.05 to 0.9999."""
    rng = np.random.default_rng(seed)
    e = rng.choice(LOSSES, count)
    alphas = {each: viscous_loss(each) for each in LOSSES}
    chi = 0.1 * 50.0 ** rng.uniform(0.0, 1.0, count)
    psi = rng.uniform(1e-3, 1.0, count) * (2.0 * chi * (1.0 + e) + 1.0)
    return psi, chi, np.array([alphas[each] for each in e])


def test_impacts_are_solved_to_what_is_promised() -> None:
    """1e-8 max(1, psi_1): smaller panels change them by less; 5e-10 was the largest of 4000."""
    psi, chi, alpha = all_losses(400, 1)
    rebounds, law = solved(psi, chi, alpha), LossNumbers(Loss.VISCOUS, alpha)
    finer = lossy_rebounds(psi, chi, law, tolerance=1e-10)
    assert np.all(finer.status == Status.SOLVED)
    assert np.max(np.abs(rebounds.psi_out - finer.psi_out) / np.maximum(1.0, psi)) < PROMISED


@pytest.mark.parametrize(
    ("psi", "chi"),
    [(1.545093648994644, 1.146545076114865), (0.518235231650099, 1.1852816945556663)],
)
def test_panels_that_end_with_the_loading(psi: float, chi: float) -> None:
    """To rounding, by chance."""
    beside = psi * (1.0 + 1e-9 * np.arange(-1.0, 2.0))
    rebounds = solved(beside, np.full(3, chi), np.full(3, viscous_loss(0.3)))
    assert np.ptp(rebounds.psi_out) < 1e-8


@pytest.mark.parametrize(
    ("psi", "chi", "e"),
    [
        (2.879973361496, 1.44, 0.9),  # slip stops just before the largest compression
        (9.747349253848784, 5.0, 0.99),  # and here just before the bodies part
        (9.747349253921556, 5.0, 0.99),
        (2.60465849294749, 5.0, 0.99),
        (1.0, 5.0, 0.05),  # where it neither begins nor does not, and losses are heavy
    ],
)
def test_events_beside_the_end_of_something(psi: float, chi: float, e: float) -> None:
    """Each once was missed, or told again and again; a smooth curve has no steps."""
    beside = psi * (1.0 + np.array([-2e-9, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 2e-9]))
    rebounds = solved(beside, np.full(7, chi), np.full(7, viscous_loss(e)))
    assert np.ptp(rebounds.psi_out) < 1e-7


@pytest.mark.parametrize("psi", [0.0, 5e-4, 0.01, 0.03, 0.1, 1.0])
@pytest.mark.parametrize("chi", [0.25, 0.5, 1.44])
def test_lawful_corners_are_solved(psi: float, chi: float) -> None:
    """Round numbers are where fronts, signs and ends meet; no loss is where they all do."""
    expected = carom.rebound(psi, chi)
    assert carom.rebound(psi, chi, losses=carom.KelvinVoigt(restitution=1.0)) == pytest.approx(
        expected, abs=PROMISED
    )
    tiny = solved(*(np.full(4, x) for x in (psi, chi)), np.logspace(-14, -8, 4))
    assert tiny.psi_out == pytest.approx(np.full(4, expected), abs=5e-8)


@pytest.mark.first_case
@pytest.mark.parametrize("law", MANY)
def test_opposite_approach_rebounds_oppositely(law: str) -> None:
    """To the last bit, and all else is the same: phases at the same times, slip the other way."""
    psi, chi, _ = impacts(7, 12)
    psi[:4] = 0.0, 1e-9, 1e-4, 1.0
    forth, back = (lossy_rebounds(p, chi, MANY[law]) for p in (psi, -psi))
    assert np.array_equal(forth.psi_out, -back.psi_out)
    for one, other in zip(forth[1:], back[1:], strict=True):
        assert np.array_equal(one, other)
    for start in (0.7, 2.0, 6.0):
        one, other = (solve_lossy(p, 1.44, MANY[law]) for p in (start, -start))
        assert {phase.sign for phase in one.phases} & {-1, 1}
        assert [p._replace(sign=-p.sign) for p in one.phases] == list(other.phases)
        h, mirrored = one.history(50), other.history(50)
        for name in ("psi", "displacement", "force"):
            assert np.array_equal(getattr(h, name), -getattr(mirrored, name))
        assert np.array_equal(h.dissipated, mirrored.dissipated)


@pytest.mark.first_case
@pytest.mark.parametrize("law", MANY)
def test_impacts_come_no_further_apart(law: str) -> None:
    """A jump in psi_1, wherever the structure changes, would break the contraction."""
    losses, few = MANY[law], MANY[law].loss is not Loss.VISCOUS
    for chi in (1.44,) if few else (1.44, 0.5, 2.8):
        for start, step, count in ((0.0, 0.1, 51), (0.95, 8e-4, 30), (2.0, 1e-5, 20)):
            psi = start + step * np.arange(count)[:: 2 if few else 1]
            rebounds = lossy_rebounds(psi, np.full(psi.size, chi), losses)
            assert np.all(rebounds.status == Status.SOLVED)
            apart = np.max(np.abs(np.diff(rebounds.psi_out)) - np.diff(psi))
            assert apart < 2.0 * CLOSE[losses.loss] * (1.0 + psi[-1])


def test_small_changes_of_chi_and_loss_change_little() -> None:
    psi, chi, parameter = impacts(8, 150)
    base = solved(psi, chi, parameter).psi_out
    for more in ((chi + 1e-7, parameter), (chi, parameter * (1.0 + 1e-7))):
        moved = solved(psi, more[0], more[1]).psi_out
        assert np.max(np.abs(moved - base) / np.maximum(1.0, psi)) < 20e-7 + PROMISED


def test_friction_bounds_the_impulse_and_energy_is_lost() -> None:
    """|psi_1 - psi_2| <= 2 chi (1 + e), and |psi_2| <= |psi_1|."""
    psi, chi, parameter = np.hstack((impacts(9, 200), all_losses(200, 3)))
    result = solved(psi, chi, parameter)
    assert np.all(np.abs(psi - result.psi_out) <= 2.0 * chi * (1.0 + result.restitution) + 1e-9)
    assert np.all(np.abs(result.psi_out) <= psi + 1e-9)


def test_ledgers_close_along_the_history() -> None:
    """v^2 + stored + lost = 1; no work is taken back; springs let go end with nothing stored."""
    for s in histories(10, 8):
        h = s.history(800)
        assert np.max(np.abs(h.speed**2 + h.normal_stored + h.normal_lost - 1.0)) < 1e-8
        assert np.min(np.diff(h.normal_lost)) > -1e-9
        assert abs(h.normal_stored[-1]) < 1e-8
        scale = 1e-5 * (1.0 + s.psi_in**2)
        assert np.min(np.diff(h.dissipated)) > -scale
        assert np.min(h.stored) > -scale
        assert np.min(np.diff(h.shear_lost)) > -scale
        assert s.shear_lost == pytest.approx(h.shear_lost[-1], abs=scale)
        lost = h.dissipated[-1] + h.shear_lost[-1]
        assert abs(s.psi_in**2 - s.psi_out**2 - 2.0 * lost) < scale


@pytest.mark.parametrize("decade", [-6.0, -3.0, -2.0, -1.0])
def test_ledgers_of_hardly_oblique_impacts(decade: float) -> None:
    """To 1e-4 of the energy, though slip is one thin ring, of which rounding blurs both ends.

    Chebyshev series of what friction took had wavered by up to 0.3 of it.
    """
    rng = np.random.default_rng(12)
    for _ in range(10):
        psi, chi = 10.0 ** (decade + rng.uniform()), 0.3 * 10.0 ** rng.uniform(0.0, 1.5)
        alpha = float(rng.uniform(0.005, 0.6))
        s = solve_lossy(psi, chi, LossNumbers(Loss.VISCOUS, alpha))
        h, close = s.history(150), 1e-4 * 0.5 * psi**2
        for taken in (h.dissipated, h.shear_lost):
            assert np.min(np.diff(taken)) > -close, (psi, chi, alpha)
        assert np.min(h.dissipated) > -close
        assert np.min(h.stored) > -close


@pytest.mark.parametrize(
    ("psi", "chi", "e"),
    [
        (1.0 + 1e-9, 3.0, 0.7),  # the edge goes back to where the front jumped
        *((1.005, 2.5, 0.7), (1.0106, 2.303, 0.532)),
        (0.0014292769783858395, 3.4387011985264313, 0.71981058207697),  # a ring closes twice
        *((0.02223, 2.0147, 0.7), (2.3834658655454422e-05, 2.920233082538344, 0.6319611009554595)),
    ],
)
def test_ledgers_where_rings_end(psi: float, chi: float, e: float) -> None:
    """Each once gave friction's work back, up to half of it."""
    h = carom.solve(psi, chi, losses=carom.KelvinVoigt(restitution=e)).history(1001)
    for taken in (h.dissipated, h.shear_lost):
        assert np.min(np.diff(taken)) > -1e-6 * 0.5 * psi**2
    assert h.shear_lost[-1] < 0.5 * psi**2


@pytest.mark.first_case
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("psi", [1.1e4, -1e8, 1e300])
def test_whatever_is_faster_slides(law: Loss, psi: float) -> None:
    """f = mu p all the time, which takes psi_1 - psi_2 = 2 chi (1 + e), and friction the energy."""
    for chi in (0.3, 1000.0):
        s = solve_lossy(psi, chi, LossNumbers(law, 0.3, EXTRA[law]))
        h, mirror = s.history(2001), np.sign(psi)
        sliding = 2.0 / 3.0 * h.normal_force
        assert [(phase.kind, phase.sign) for phase in s.phases] == [("gross slip", mirror)]
        assert mirror * h.force == pytest.approx(sliding, abs=1e-5)
        impulse = cumulative_simpson(sliding, x=h.time, initial=0.0)
        lost = 3.75 * chi * impulse
        rounding = 4e-16 * abs(psi)
        assert mirror * (psi - h.psi) == pytest.approx(lost, rel=1e-4, abs=1e-4 * chi + rounding)
        assert s.psi_out == pytest.approx(h.psi[-1], rel=0.0, abs=2e-4 * chi + rounding)
        way = mirror * cumulative_simpson(h.psi, x=h.time, initial=0.0)
        assert mirror * h.displacement == pytest.approx(way, rel=1e-6, abs=1e-6 * abs(psi))
        work = cumulative_simpson(sliding * mirror * h.psi, x=h.time, initial=0.0) * 3.75 * chi
        assert h.dissipated == pytest.approx(work, rel=1e-3, abs=1e-3 * chi * abs(psi))


def test_histories_agree_with_themselves() -> None:
    """|Q| <= (2/3) P, dU = psi dt, dd = v dt, both impulses; largest values are not exceeded."""
    for s in histories(11, 4):
        h = s.history(3001)
        assert np.max(np.abs(h.force) - 2.0 / 3.0 * h.normal_force) < 1e-6
        assert np.all(h.stick_radius <= h.contact_radius)
        assert h.time[-1] == s.duration
        ends = ((s.psi_out, h.psi[-1]), (-s.restitution, h.speed[-1]))
        assert all(one == pytest.approx(other, abs=1e-12) for one, other in ends)
        for rate, kept in ((h.psi, h.displacement), (h.speed, h.penetration)):
            assert cumulative_simpson(rate, x=h.time, initial=0.0) == pytest.approx(kept, abs=1e-7)
        impulse = simpson(h.force, x=h.time)
        assert s.psi_in - 3.75 * s.chi * impulse == pytest.approx(s.psi_out, abs=2e-5)
        for name in ("penetration", "contact_radius", "normal_force"):
            largest = np.max(getattr(h, name))
            answer = getattr(
                s,
                {"normal_force": "max_force", "contact_radius": "max_radius"}.get(
                    name, "max_penetration"
                ),
            )
            assert largest - 1e-9 <= answer <= largest + 3e-6, name


@pytest.mark.first_case
@pytest.mark.parametrize("impact", [(0.3, 2.0, 0.2), (3.0, 1.44, 0.1)])
def test_histories_are_those_of_the_marching_method(impact: tuple[float, float, float]) -> None:
    """psi, U, Q, the energy in the springs, what slip and what dashpots took, at all times.

    What is lost the marching method knows to first order only, the rest to second.
    """
    psi, chi, alpha = impact
    s = solve_lossy(psi, chi, LossNumbers(Loss.VISCOUS, alpha))
    ledger = np.zeros((4001, 7))
    march(psi, chi, alpha, 1000, ledger)
    ledger = ledger[20:-3:20]
    h = s.at(ledger[:, 0])
    for name, column, factor, close in (
        ("psi", 1, 1.0, 1e-5), ("displacement", 2, 1.0, 1e-5), ("force", 3, 1.0, 3e-5),
        ("stored", 4, 1.875 * chi, 5e-5), ("dissipated", 5, 3.75 * chi, 3e-4 * (1.0 + psi)),
        ("shear_lost", 6, 3.75 * chi, 3e-4 * (1.0 + psi)),
    ):  # fmt: skip
        assert getattr(h, name) == pytest.approx(factor * ledger[:, column], abs=close), name


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.5, 1.44, 2.7])
@pytest.mark.parametrize("alpha", [0.01, 0.1, 0.4])
def test_small_psi_is_the_impact_without_slip(chi: float, alpha: float) -> None:
    """psi_2/psi_1 as psi_1 -> 0: springs stick until they are let go, Q = integral of T - U(laid).

    Steps of the linear problem on the closed normal motion, T = U + alpha psi, extrapolated.
    """
    slopes = []
    for steps in (2000, 4000):
        _, t, b, *_ = motion(alpha, steps)
        peak = steps // 2
        psi, u, laid = 1.0, np.zeros(steps + 1), np.zeros(peak + 1)
        for i in range(steps):
            before = laid[i] if i <= peak else np.interp(b[i], b[: peak + 1], laid)
            kick = 1.875 * chi * (t[i + 1] - t[i])
            half = psi - kick * ((u[i] + alpha * psi) * b[i] - before)
            u[i + 1] = u[i] + half * (t[i + 1] - t[i])
            if i < peak:
                laid[i + 1] = laid[i] + 0.5 * (u[i] + u[i + 1]) * (b[i + 1] - b[i])
            after = laid[i + 1] if i < peak else np.interp(b[i + 1], b[: peak + 1], laid)
            psi = half - kick * (u[i + 1] * b[i + 1] - after)
            psi /= 1.0 + kick * alpha * b[i + 1]
        slopes.append(psi)
    limit = (4.0 * slopes[1] - slopes[0]) / 3.0
    for psi in (1e-12, 1e-7, 5e-5):
        value = solve_lossy(psi, chi, LossNumbers(Loss.VISCOUS, alpha)).psi_out / psi
        assert value == pytest.approx(limit, abs=2e-4)


def test_small_psi_where_twice_the_smallest_is_not_solved() -> None:
    """psi_2/psi_1 is then that of the smallest, which the history holds as well."""
    law = LossNumbers(Loss.VISCOUS, 0.10857)
    assert solve_lossy(2e-3, 42.604, law).status is Status.UNRESOLVED
    s = solve_lossy(1e-6, 42.604, law)
    assert s.psi_out == pytest.approx(s.at(s.duration).psi[0], rel=1e-12)


def test_bad_input_is_told_and_takes_no_time() -> None:
    """NaN comes with a status that says why; solved impacts are finite; nothing hangs."""
    wrong = {
        Status.PSI_NOT_FINITE: [(np.nan, 1.0, 0.1), (np.inf, 1.0, 0.1), (-np.inf, 1.0, 0.1)],
        Status.CHI_NOT_POSITIVE: [(1.0, x, 0.1) for x in (0.0, -1.0, np.nan, np.inf)],
    }
    extreme = [(p, 1.44, 0.2) for p in (1e-300, 1e-12, 1e3, 1e6, 1e300)]
    extreme += [(1.5, c, 0.2) for c in (1e-300, 0.01, 60.0, 1e6, 1e300)]
    extreme += [(1.5, 1.44, a) for a in (np.nan, np.inf, -0.1, 1e-300, 90.0, 1e6)]
    many = lossy_rebounds(np.ones(1), np.full(1, 1e4), LossNumbers(Loss.VISCOUS, 0.1))
    assert many.status[0] == Status.TOO_MANY_PHASES
    for status, cases in [*wrong.items(), (None, extreme)]:
        for (psi, chi, parameter), law in product(cases, LAWS):
            begun = time.process_time()
            losses = LossNumbers(law, parameter, EXTRA[law])
            rebounds = lossy_rebounds(*np.array([[psi], [chi]]), losses)
            assert time.process_time() - begun < 10.0
            assert status is None or rebounds.status[0] == status
            rest = np.array([column[0] for column in rebounds[:-1]])
            assert np.all(np.isfinite(rest) == (rebounds.status[0] == Status.SOLVED))


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.01, 0.2, 8.0, 30.0, 60.0])
def test_bodies_of_any_inertia_are_solved(chi: float) -> None:
    psi = np.append(np.linspace(0.01, 8.0, 9), [20.0, 100.0, 1000.0])
    for law in LAWS:
        rebounds = lossy_rebounds(psi, np.full(12, chi), LossNumbers(law, 0.2, EXTRA[law]))
        assert np.all(rebounds.status == Status.SOLVED)
        assert np.all(np.abs(rebounds.psi_out) < psi)


@pytest.mark.first_case
@pytest.mark.parametrize("law", LAWS)
def test_friction_takes_energy_however_slow_or_fast_the_slip(law: Loss) -> None:
    """psi_1 from 1e-30 to 1e6: what shear leaves of the tangential energy that is lost."""
    rng = np.random.default_rng(44)
    count = {Loss.VISCOUS: 300, Loss.PLASTIC: 90}.get(law, 30)
    psi = 10.0 ** rng.uniform(-30.0, 6.0, count)
    psi[::3] = 10.0 ** rng.uniform(-5.0, -3.0, psi[::3].size)
    chi = rng.choice([0.3, 0.5, 1.44, 4.0, 7.0], count)
    parameter, extra = 10.0 ** rng.uniform(-3.0, 1.0, count), np.zeros(count)
    if law in (Loss.PLASTIC, Loss.METAL):
        parameter = 1.0 - 10.0 ** rng.uniform(-4.9, 0.0, count)
        extra += EXTRA[law]
    if law is Loss.PLATE:
        parameter = rng.uniform(1e-3, 2.0, count)
    if law is Loss.RELAXING:
        extra = 10.0 ** rng.uniform(-1.0, 2.5, count)
    rebounds = lossy_rebounds(psi, chi, LossNumbers(law, parameter, extra))
    assert np.all(rebounds.status == Status.SOLVED)
    assert np.all(np.abs(rebounds.psi_out) <= psi)
    assert np.all(rebounds.shear_lost >= 0.0)
    lost = 0.5 * (psi - rebounds.psi_out) * (psi + rebounds.psi_out)
    assert np.min((lost - rebounds.shear_lost) / psi**2) > -1e-15


@pytest.mark.parametrize("law", LAWS)
def test_slow_slip_is_linear(law: Loss) -> None:
    """psi_2/psi_1 and the share that shear loses have limits."""
    psi = np.array([1e-100, 1e-30, 1e-9, 1e-7])
    for chi in (0.3, 1.44, 5.0):
        parameter = 0.4 if law is Loss.PLASTIC else 0.3
        losses = LossNumbers(law, parameter, 0.5 * EXTRA[law])
        rebounds = lossy_rebounds(psi, np.full(4, chi), losses)
        assert rebounds.psi_out / psi == pytest.approx(rebounds.psi_out[-1] / psi[-1], abs=2e-7)
        shares = rebounds.shear_lost / psi**2
        assert shares == pytest.approx(shares[-1], abs=3e-4)  # marched ones: energies to 1e-4
