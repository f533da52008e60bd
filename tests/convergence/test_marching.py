"""The march of springs converges to the exact solution, and so does the plain march of the oracle.

Rebounds and sequences of phases of elastic bodies; plates; bodies that are struck off their centre.
"""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import beta
from tests.oracles import march as oracle

import carom
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.layout import PSI_OUT, RESTITUTION, SHEAR_LOST, TIME
from carom.dimensionless.lossy.springs import march, solids
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia, Solid, made_of
from carom.dimensionless.lossy.springs.springs import WEIGHT
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.numerics.kernels import plain
from carom.dimensionless.rebounds import lossy_rebounds
from carom.dimensionless.solution import solve_lossy

Array = NDArray[np.float64]

SPRINGS = (125, 250, 500, 1000)
CASES = [(0.5, 1.44), (1.5, 1.44), (3.5, 1.44), (0.5, 1.75), (0.9, 0.8), (5.5, 3.3), (0.2, 4.8)]
ROD = Inertia(chi=0.507527, eps=0.329802, zeta=1.086368)  # at 40 degrees, mu = 0.5, kappa = 0.8235


def random_impacts(seed: int, count: int) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    return rng.uniform(-6.0, 6.0, count), rng.uniform(0.1, 3.0, count)


def errors(psi: float, chi: float) -> Array:
    exact = carom.rebound(psi, chi)
    values = [march.marched(psi, Inertia(chi), ELASTIC, n)[PSI_OUT] for n in SPRINGS]
    return np.abs(np.array(values) - exact)


def numbers(psi: float, inertia: Inertia, solid: Solid = ELASTIC) -> Array:
    """Return what an impact comes to."""
    values = np.empty(march.NUMBERS)
    assert march.run(psi, 0.0, inertia, solid, march.new_work(), values)[0] == 0
    return values


@pytest.mark.parametrize(("psi", "chi"), CASES)
def test_error_of_each_impact_is_of_second_order(psi: float, chi: float) -> None:
    order = -np.polyfit(np.log(SPRINGS), np.log(errors(psi, chi)), 1)[0]
    assert order == pytest.approx(2.0, abs=0.15)


def test_error_of_solid_spheres_is_small() -> None:
    rng = np.random.default_rng(1976)
    chi = rng.uniform(1.1, 1.8, 100)
    psi = rng.uniform(0.0, 4.0 * chi - 1.1)  # up to the border of gross slip throughout
    values = np.array([errors(*impact) for impact in zip(psi, chi, strict=True)])
    scaled = values * np.square(SPRINGS)
    assert np.median(scaled) < 0.4
    assert np.max(scaled) < 1.0


def test_two_grids_give_1e_6_and_bound_the_error() -> None:
    psi, chi = random_impacts(38, 200)
    pairs = zip(psi, chi, strict=True)
    actual, answer = np.array([march.march_rebound(p, Inertia(c), ELASTIC) for p, c in pairs]).T
    wrong = np.abs(actual - carom.rebound(psi, chi)) / np.maximum(1.0, np.abs(psi))
    assert np.quantile(wrong, 0.97) < 1e-6
    assert np.max(wrong) < 3e-6
    assert np.median(wrong) < 2e-7
    assert np.max(wrong * np.maximum(1.0, np.abs(psi)) / answer) < 2.0


@pytest.mark.slow
def test_viscous_solids_are_those_of_the_exact_solution() -> None:
    """Kelvin & Voigt's: another algorithm, without springs, gives e, psi_2 and what shear loses."""
    psi, chi = random_impacts(1987, 60)
    for p, c, e in zip(psi, chi, np.random.default_rng(5).uniform(0.05, 0.999, 60), strict=True):
        exact = carom.solve(p, c, losses=carom.KelvinVoigt(restitution=e))
        values = numbers(p, Inertia(c), made_of(int(Loss.VISCOUS), viscous_loss(e), 0.0))
        assert values[RESTITUTION] == pytest.approx(e, abs=1e-7)
        assert values[PSI_OUT] == pytest.approx(exact.psi_out, abs=2e-6 * max(1.0, abs(p)))
        near = 1e-4 * max(1.0, 0.5 * p * p)
        assert values[SHEAR_LOST] == pytest.approx(exact.shear_lost, abs=near)


def test_plates_keep_their_speed_where_they_turn() -> None:
    """Sliding throughout: psi_1 - 2 chi (1 + e), wherever in a step the bodies turn."""
    for give in np.linspace(0.3, 0.9, 40):
        plate = numbers(15.0, Inertia(3.0), Solid(int(Loss.PLATE), give))
        slid = 15.0 - 6.0 * (1.0 + plate[RESTITUTION])
        assert plate[PSI_OUT] == pytest.approx(slid, abs=1e-7)


def test_the_oracle_agrees() -> None:
    for psi, chi in zip(*random_impacts(5, 4), strict=True):
        actual = oracle.extrapolated(psi, chi, springs=500)
        assert actual == pytest.approx(carom.rebound(psi, chi), abs=5e-6)


@pytest.mark.parametrize("psi", [4.0, 9.0])
def test_gross_slip_throughout(psi: float) -> None:
    """psi_1 - 4 chi, as the impulse is exact; so do plates, by 2 chi (1 + e)."""
    assert march.march_rebound(psi, Inertia(1.0), ELASTIC)[0] == pytest.approx(psi - 4.0, abs=1e-7)
    assert oracle.march(psi, 1.0, springs=100) == pytest.approx(psi - 4.0, abs=1e-9)
    plate = numbers(psi + 4.0, Inertia(1.0), Solid(int(Loss.PLATE), 0.3))
    slid = psi + 4.0 - 2.0 * (1.0 + plate[RESTITUTION])
    assert plate[PSI_OUT] == pytest.approx(slid, abs=1e-6 * (psi + 4.0))


@pytest.mark.parametrize(
    ("psi", "chi"), [(0.3, 0.5), (0.7, 0.5), (-0.99, 0.5), (1.0, 0.5), (0.1, 4.0), (0.39, 4.0)]
)
def test_load_that_retraces_its_path_reverses_the_velocity(psi: float, chi: float) -> None:
    assert march.march_rebound(psi, Inertia(chi), ELASTIC)[0] == pytest.approx(-psi, abs=1e-7)


def test_sequence_of_phases_is_the_exact_one() -> None:
    """Where no exact phase is so short, and no ring so thin, that springs cannot show it."""
    seen = 0
    for psi, chi in zip(*random_impacts(1882, 40), strict=True):
        exact = carom.solve(psi, chi).phases
        if min(p.end - p.start for p in exact) < 0.12:
            continue
        phases = solve_lossy(psi, chi, LossNumbers(Loss.PLATE, 0.0)).phases
        assert [p[:2] for p in phases] == [p[:2] for p in exact], (psi, chi)
        assert [p.start for p in phases] == pytest.approx([p.start for p in exact], abs=0.03)
        seen += 1
    assert seen > 15


@pytest.mark.parametrize(
    ("give", "e", "duration", "psi_out"),
    [
        (0.1, 0.83022, 3.0042, (0.04139, -0.09983, -0.87530, -1.29476, -0.77543)),
        (0.4, 0.48416, 3.2541, (0.0538, -0.1692, -0.8272, -0.9257, 0.2220)),
        (1.5, 0.04827, 5.889, (0.197, 0.085, -0.205, -0.022, 1.478)),
    ],
)
def test_plates(give: float, e: float, duration: float, psi_out: tuple[float, ...]) -> None:
    """Zener's plates, against 800 springs in 4000 steps of a march of its own; e for small lambda
    is exp(-(3/2) B(3/5, 3/2) lambda)."""
    solid = Solid(int(Loss.PLATE), give)
    close = 6e-6 if give == 0.1 else 6e-4 if give > 1.0 else 6e-5
    for psi, wanted in zip((0.5, 1.0, 2.0, 3.0, 4.5), psi_out, strict=True):
        values = numbers(psi, Inertia(1.4412), solid)
        assert values[PSI_OUT] == pytest.approx(wanted, abs=close)
        assert values[RESTITUTION] == pytest.approx(e, abs=6e-6)
        assert values[TIME] == pytest.approx(duration, abs=6e-4)
    little = numbers(1.0, Inertia(1.44), Solid(int(Loss.PLATE), 1e-4))[RESTITUTION]
    assert little == pytest.approx(np.exp(-1.5 * beta(0.6, 1.5) * 1e-4), abs=2e-8)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_sliding_throughout_off_the_centre(sign: float) -> None:
    """psi_1 - 2 (2 chi sigma + zeta)/(1 + sigma eps), elastic along the normal."""
    chi, eps, zeta, *_ = ROD
    psi = sign * 8.0
    values = numbers(psi, ROD)
    slid = psi - 2.0 * (2.0 * chi * sign + zeta) / (1.0 + sign * eps)
    assert values[PSI_OUT] == pytest.approx(slid, abs=1e-6)
    assert values[RESTITUTION] == pytest.approx(1.0, abs=1e-6)


def test_a_rod_struck_off_its_centre() -> None:
    """Without tangential velocity before; the material loses nothing, and yet e is 0.848."""
    values = numbers(0.0, ROD)
    assert values[PSI_OUT] == pytest.approx(-1.0565, abs=2.5e-3)  # of chi, eps, zeta in 3 digits
    assert values[RESTITUTION] == pytest.approx(0.8482, abs=5e-4)


@pytest.mark.parametrize(
    ("psi", "inertia", "solid"),
    [
        (1.5, Inertia(1.44), ELASTIC),
        (0.0, ROD, ELASTIC),
        (-2.0, ROD, ELASTIC),
        (1.0, Inertia(1.44), Solid(int(Loss.PLATE), 0.4)),
    ],
)
def test_friction_takes_what_the_motion_loses(psi: float, inertia: Inertia, solid: Solid) -> None:
    """Work of friction by springs, summed apart, against the kinetic energies.

    w^T diag(1, m) B^-1 w, m zeta = (3/2) eps, of the rates -(5/4) B (P, Q).
    """
    kept = march.new_work(2000, 240)
    steps = march.trace(psi, 0.0, inertia, solid, 200, march.new_work(), kept)
    springs, rows = kept.frames[: steps + 1], kept.rows[: steps + 1]
    weights = kept.springs[WEIGHT, :240]
    pull = 0.5 * (springs[1:, march.PULLED] + springs[:-1, march.PULLED])
    behind = springs[1:, march.LAGGING] - springs[:-1, march.LAGGING]
    touching = (springs[1:, 0] > 0.0) & (springs[:-1, 0] > 0.0)
    work = float(np.sum(weights * pull * behind * touching))
    at = numbers(psi, inertia, solid)
    assert work > 0.0
    assert rows[-1, 3] == pytest.approx(at[PSI_OUT], abs=1e-4)
    if inertia.eps == 0.0:
        lost = 0.5 * (psi**2 - at[PSI_OUT] ** 2)
        assert 3.75 * inertia.chi * work == pytest.approx(lost, rel=3e-3)
        return
    share = 1.5 * inertia.eps / inertia.zeta
    rates = np.array([[1.0, 1.5 * inertia.eps], [inertia.zeta, 3.0 * inertia.chi]])
    metric = np.diag([1.0, share]) @ np.linalg.inv(rates)
    assert metric[0, 1] == pytest.approx(metric[1, 0])
    before, after = np.array([1.0, psi]), np.array([-at[RESTITUTION], at[PSI_OUT]])
    lost = 0.5 * (before @ metric @ before - after @ metric @ after)
    assert 1.25 * share * work == pytest.approx(lost, rel=3e-3)


PARTS = ("press", "stored", "turn")


@pytest.mark.parametrize("loss", Loss, ids=lambda loss: loss.name)
def test_every_solid_is_a_file_with_branches_of_its_own(
    loss: Loss, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A member of Loss without a file, a place in SOLIDS or a branch fails here."""
    calls: list[tuple[str, str]] = []
    for module in solids.SOLIDS.values():
        for part in set(PARTS) & set(dir(module)):
            call = (module.__name__, part)
            monkeypatch.setattr(module, part, lambda *_, call=call: calls.append(call) or 1.0)
    work, solid = march.new_work(), Solid(int(loss), 0.5, 0.5)
    plain(solids.press)(solid, *work.motion, work.springs, 1)
    plain(solids.stored)(solid, work.motion[0], work.springs, 1)
    plain(solids.turn)(solid, work.motion[0], work.springs, 1, work.state, 1.0)
    own = solids.SOLIDS[loss]
    assert calls == [(own.__name__, part) for part in PARTS if hasattr(own, part)]
    assert {"press", "stored"} <= set(dir(own))


def test_every_file_is_a_solid_or_part_of_the_march() -> None:
    parts = {"__init__", "march", "motion", "off_centre", "solids", "solution", "springs"}
    files = {path.stem for path in Path(march.__file__).parent.glob("*.py")}
    assert files - parts == {solid.__name__.split(".")[-1] for solid in solids.SOLIDS.values()}


def test_a_loss_without_a_solid_is_refused() -> None:
    psi, code = np.ones(1), max(Loss) + 1
    with pytest.raises(carom.InputError, match=f"loss: {code} cannot be used; has no solid"):
        lossy_rebounds(psi, psi, LossNumbers(code, 0.5))
    values = np.empty(march.NUMBERS)
    status, _ = march.run(1.0, 0.0, Inertia(1.0), Solid(code, 0.5), march.new_work(), values)
    assert status == Status.UNRESOLVED
    assert np.all(np.isnan(values))
