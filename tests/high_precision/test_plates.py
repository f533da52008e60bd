"""Impacts on plates: series of many digits, slow slip as a linear problem, springs, energies."""

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.oracles import plates as oracle

import carom
from carom.dimensionless.elastic.phases import Status, new_work
from carom.dimensionless.elastic.plates import normal_motion
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.springs import march
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.lossy.springs.solution import solve_by_marching
from carom.dimensionless.rebounds import STEP_TOLERANCE, lossy_rebounds, rebound
from carom.dimensionless.solution import Solution, solve_with

Array = NDArray[np.float64]

IMPACTS = [(0.5, 1.44, 0.1), (2.0, 1.44, 0.4), (1.0, 1.2, 1.5), (-0.7, 3.0, 0.4), (9.0, 1.44, 0.4)]


def rebounds(psi: Array, chi: float | Array, give: float | Array) -> Array:
    psi, chi, give = np.broadcast_arrays(psi, chi, give)
    values = lossy_rebounds(psi, chi, LossNumbers(Loss.PLATE, give))
    assert not values.status.any()
    return values.psi_out


def solution(psi: float, chi: float, give: float) -> Solution:
    solved = solve_with(psi, chi, LossNumbers(Loss.PLATE, give))
    assert isinstance(solved, Solution)
    return solved


@pytest.mark.first_case
@pytest.mark.parametrize("give", [1e-4, 0.1, 0.4, 1.0, 1.5, 2.0])
def test_normal_motion_is_that_of_many_digits(give: float) -> None:
    actual = normal_motion(give, STEP_TOLERANCE, new_work())[:2]
    assert actual == pytest.approx(oracle.restitution_and_duration(give), abs=1e-10)


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.3, 0.9, 1.44, 3.0])
@pytest.mark.parametrize("give", [0.01, 0.5, 1.9])
def test_sliding_throughout(chi: float, give: float) -> None:
    """psi_1 - 2 chi (1 + e), from max(1, 2 chi (1 + e) - e) on, and not below."""
    e = oracle.restitution_and_duration(give)[0]
    border = max(1.0, 2.0 * chi * (1.0 + e) - e)
    above = border + np.array([1e-6, 0.1, 3.0, 1e5])
    slid = above - 2.0 * chi * (1.0 + e)
    assert rebounds(above, chi, give) == pytest.approx(slid, rel=1e-9, abs=1e-9)
    below = solution(border - 1e-3, chi, give).phases
    assert [phase.kind for phase in below] != ["gross slip"]


@pytest.mark.parametrize(
    ("chi", "give"), [(1.44, 0.1), (1.44, 0.4), (0.3, 0.4), (3.0, 1.0), (1.2, 1.8), (1.44, 1e-9)]
)
def test_slow_slip_is_a_linear_problem(chi: float, give: float) -> None:
    small, larger = 1e-6, 1e-5
    one, other = (rebounds(np.array([psi]), chi, give)[0] / psi for psi in (small, larger))
    limit = one - (other - one) * small / (larger - small)
    assert limit == pytest.approx(oracle.slow_rebound(chi, give), abs=3e-9)


def test_plates_agree_with_springs() -> None:
    rng = np.random.default_rng(1941)
    chi, give = np.exp(rng.uniform(np.log(0.3), np.log(3.0), 200)), rng.uniform(0.0, 2.0, 200)
    psi = rng.uniform(0.0, 1.2, 200) * np.maximum(1.0, 4.0 * chi - 1.0)
    exact, work = rebounds(psi, chi, give), march.new_work()
    numbers, by_springs = np.empty(march.NUMBERS), np.empty(200)
    for i in range(200):
        march.run(psi[i], 0.0, Inertia(chi[i]), Solid(int(Loss.PLATE), give[i]), work, numbers)
        by_springs[i] = numbers[0]
    wrong = np.abs(by_springs - exact) / np.maximum(1.0, psi)
    assert np.median(wrong) < 1e-7
    assert np.quantile(wrong, 0.95) < 2e-6
    assert np.max(wrong) < 6e-6


def test_a_thick_wall_is_the_limit() -> None:
    psi, chi = np.linspace(-6.0, 6.0, 41), 1.44
    thick = rebound(psi, chi)
    assert rebounds(psi, chi, 0.0).tobytes() == np.asarray(thick).tobytes()
    near, nearer = (rebounds(psi, chi, give) - thick for give in (2e-7, 1e-7))
    assert np.abs(near - 2.0 * nearer).max() < 1e-9
    assert np.abs(nearer).max() < 1e-6


@pytest.mark.first_case
@pytest.mark.parametrize(("psi", "chi", "give"), IMPACTS)
def test_states_are_those_of_springs(psi: float, chi: float, give: float) -> None:
    plate = solution(psi, chi, give)
    springs = solve_by_marching(psi, chi, LossNumbers(Loss.PLATE, give))
    times = np.linspace(0.0, min(plate.duration, springs.duration), 60)
    actual, wanted = plate.at(times), springs.at(times)
    for name in ("penetration", "speed", "psi", "displacement", "force", "stored", "dissipated"):
        close = 5e-5 * max(1.0, abs(psi))
        assert getattr(actual, name) == pytest.approx(getattr(wanted, name), abs=close), name
    assert [p[:2] for p in plate.phases] == [p[:2] for p in springs.phases]
    assert [p.end for p in plate.phases] == pytest.approx([p.end for p in springs.phases], abs=6e-3)
    radii = np.linspace(0.0, 0.95 * plate.max_radius, 6)
    slid = springs.contact_at(1.3).slid(radii)
    assert plate.slid(1.3, radii) == pytest.approx(slid, abs=1e-4 * max(1.0, abs(psi)))
    assert plate.touched(radii) == pytest.approx(springs.touched(radii), abs=1e-4)
    work = springs.friction_work(radii)
    assert plate.friction_work(radii) == pytest.approx(work, abs=2e-3 * max(1.0, abs(psi)))


@pytest.mark.parametrize(("psi", "chi", "give"), IMPACTS)
def test_no_energy_is_lost_but_to_waves_and_friction(psi: float, chi: float, give: float) -> None:
    plate = solution(psi, chi, give)
    end = plate.at([plate.duration])
    assert end.dissipated[0] == pytest.approx(0.5 * (psi**2 - plate.psi_out**2), abs=1e-10)
    assert end.stored[0] == pytest.approx(0.0, abs=1e-10)
    nodes, weights = np.polynomial.legendre.leggauss(400)
    force = plate.at(0.5 * plate.duration * (1.0 + nodes)).normal_force
    waves = 3.125 * give * 0.5 * plate.duration * weights @ force**2
    assert waves == pytest.approx(1.0 - plate.restitution**2, abs=1e-8)
    assert end.normal_lost[0] == pytest.approx(waves, abs=1e-8)


def test_the_work_over_the_contact_is_that_of_the_ledger() -> None:
    ball, wall = (
        carom.Sphere(radius="5 mm", material="steel"),
        carom.HalfSpace("steel", thickness="3 mm"),
    )
    for angle in ("10 deg", "30 deg", "70 deg"):
        worn = carom.impact(carom.Pair(ball, wall, 0.2), speed=0.5, angle=angle).wear(21)
        assert abs(float(worn.work_error)) < 1e-9


def test_foils_have_a_status() -> None:
    values = lossy_rebounds(np.ones(2), np.ones(2), LossNumbers(Loss.PLATE, np.array([1.0, 2.1])))
    assert values.status.tolist() == [Status.SOLVED, Status.PLATE_GIVES_WAY]
    assert np.isnan(values.psi_out[1])
    assert solve_with(1.0, 1.0, LossNumbers(Loss.PLATE, 2.1)).status is Status.PLATE_GIVES_WAY
