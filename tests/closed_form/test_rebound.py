"""Rebounds that are known in closed form, and how arrays of them are handled."""

import numpy as np
import pytest

import carom
from carom.status import Status

CHIS = [0.05, 0.3, 0.5, 0.7, 1.0, 1.44, 1.75, 2.5, 4.0, 7.0, 10.0, 60.0]


@pytest.mark.parametrize("chi", CHIS)
def test_gross_slip_throughout(chi):
    """psi_2 = psi_1 - 4 chi from psi_1 = 4 chi - 1 on (1 for chi <= 1/2), grazing included."""
    border = max(1.0, 4.0 * chi - 1.0)
    psi = np.array([border * (1 + 1e-13), border + 1e-3, border + 5.0, 1e6])
    out = carom.rebound(psi, chi)
    assert np.all(np.abs(out - (psi - 4.0 * chi)) <= 4e-16 * psi)
    assert all(len(carom.solve(p, chi).phases) == 1 for p in psi[1:])


@pytest.mark.parametrize(("n", "limit"), [(0, 1.0), (1, 0.4), (2, 0.256), (3, 0.18), (4, 0.14)])
def test_stick_throughout_returns_the_motion(n, limit):
    """Where F is a polynomial, chi = ((11 + 20 n)^2 - 1)/240, small psi_1 gives -psi_1 back."""
    chi = ((11 + 20 * n) ** 2 - 1) / 240
    psi = np.array([1e-9, 1e-3, 0.5, 0.99]) * limit
    assert np.array_equal(carom.rebound(psi, chi), -psi)
    solution = carom.solve(0.99 * limit, chi)
    assert [phase.kind for phase in solution.phases] == ["stick"]
    assert solution.phases[0].end == solution.duration


@pytest.mark.parametrize("chi", CHIS)
def test_no_tangential_velocity(chi):
    assert carom.rebound(0.0, chi) == 0.0
    assert [phase.kind for phase in carom.solve(0.0, chi).phases] == ["stick"]


def test_odd_to_the_bit():
    rng = np.random.default_rng(1)
    psi = np.concatenate([rng.uniform(0, 8, 500), 10.0 ** rng.uniform(-300, 6, 200), [0.0, 1.0]])
    chi = rng.uniform(0.05, 10.0, psi.size)
    out, mirrored = carom.rebound(psi, chi), carom.rebound(-psi, chi)
    assert np.array_equal(out.view(np.int64), (-mirrored).view(np.int64))


@pytest.mark.parametrize("chi", [0.3, 1.44, 1.75, 3.0, 8.0, 40.0])
def test_small_psi_is_a_linear_problem(chi):
    """psi_2/psi_1 has a limit: it changes in proportion to psi_1, and not at all below 1e-6."""
    ratio = {psi: carom.rebound(psi, chi) / psi for psi in (1e-300, 1e-9, 1e-6, 1e-4, 2e-4)}
    assert ratio[1e-300] == pytest.approx(ratio[1e-6], rel=1e-14)
    assert ratio[1e-9] == pytest.approx(ratio[1e-6], rel=1e-14)
    slope = (ratio[2e-4] - ratio[1e-4]) / 1e-4
    assert ratio[1e-4] - 1e-4 * slope == pytest.approx(ratio[1e-6], abs=2e-6 * (1 + abs(slope)))


def test_broadcasting_and_kinds_of_result():
    assert isinstance(carom.rebound(0.5, 1.44), float)
    grid = carom.rebound(np.linspace(0, 5, 7)[:, None], [1.2, 1.44, 1.6])
    assert grid.shape == (7, 3)
    assert grid[3, 1] == carom.rebound(2.5, 1.44)
    assert carom.rebound([], 1.0).shape == (0,)


def test_results_do_not_depend_on_threads():
    rng = np.random.default_rng(2)
    psi, chi = rng.uniform(-6, 6, 3000), rng.uniform(0.1, 5, 3000)
    alone = carom.rebound(psi, chi, threads=1)
    for threads in (2, 3, None):
        assert np.array_equal(alone, carom.rebound(psi, chi, threads=threads))


def test_every_point_has_a_status():
    psi = [0.5, np.nan, 0.5, np.inf, 0.5]
    chi = [1.44, 1.44, -1.0, 1.44, 0.0]
    out, status = carom.rebound(psi, chi, return_status=True)
    assert status.tolist() == [
        *(Status.SOLVED, Status.PSI_NOT_FINITE, Status.CHI_NOT_POSITIVE, Status.PSI_NOT_FINITE),
        Status.CHI_NOT_POSITIVE,
    ]
    assert np.isfinite(out).tolist() == [True, False, False, False, False]
    with pytest.warns(RuntimeWarning, match=r"4 of 5 .* index \(1,\): psi_1 must be a finite"):
        carom.rebound(psi, chi)


def test_too_many_phases_is_a_status():
    out, status = carom.rebound([0.5], [1e7], return_status=True)
    assert np.isnan(out[0])
    assert Status(int(status[0])).message.startswith("not solved")
    solution = carom.solve(0.5, 1e7)
    assert solution.status is Status(int(status[0]))
    assert np.isnan(solution.psi_out)
    assert solution.phases[0].kind == "stick"
    with pytest.raises(ValueError, match="not solved"):
        solution.history()


@pytest.mark.parametrize(("psi", "chi"), [(1000.0, 2000.0), (3000.0, 8000.0), (0.5, 2e4)])
def test_long_impacts_are_recorded_whole(psi, chi):
    """Thousands of steps; the dense solution ends where the rebound does."""
    solution = carom.solve(psi, chi)
    assert solution.status is Status.SOLVED
    assert solution.history(3).psi[-1] == solution.psi_out


@pytest.mark.parametrize(
    ("psi", "chi", "name"),
    [
        *[((1j,), (1.0,), "psi_1"), (("a",), (1.0,), "psi_1"), ((0.5,), ("1",), "chi")],
        *[({}, 1.0, "psi_1"), ([[1.0], [2.0, 3.0]], 1.0, "psi_1"), (0.5, [1.44, None, "x"], "chi")],
    ],
)
def test_refuses_what_is_not_a_number(psi, chi, name):
    with pytest.raises(ValueError, match=f"^{name}: .* cannot be used; give real numbers"):
        carom.rebound(psi, chi)


def test_refuses_shapes_that_do_not_fit():
    message = r"^psi_1, chi: the shapes \(3,\) and \(2,\) do not fit each other; give numbers"
    with pytest.raises(ValueError, match=message):
        carom.rebound([1.0, 2.0, 3.0], [1.0, 2.0])


@pytest.mark.parametrize("threads", [0, -3, 2.5])
def test_refuses_a_number_of_threads_that_is_none(threads):
    with pytest.raises(ValueError, match=r"^threads: .*at least 1"):
        carom.rebound(0.5, 1.44, threads=threads)


@pytest.mark.parametrize(("psi", "chi", "name"), [(np.nan, 1.0, "psi_1"), (0.5, -2.0, "chi")])
def test_solve_refuses_what_is_out_of_range(psi, chi, name):
    with pytest.raises(ValueError, match=f"^{name}: .*not allowed"):
        carom.solve(psi, chi)


@pytest.mark.parametrize(
    ("psi", "chi", "name"),
    [
        *[([1, 2], 1.44, "psi_1"), ("a", 1.44, "psi_1"), (np.zeros((3, 40)), 1.44, "psi_1")],
        *[(0.5, None, "chi"), (0.5, [1.0, 2.0], "chi")],
    ],
)
def test_solve_refuses_what_is_not_one_number(psi, chi, name):
    with pytest.raises(ValueError, match=f"^{name}: .*give one number; carom.rebound") as refused:
        carom.solve(psi, chi)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 150
