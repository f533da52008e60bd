"""Impacts of yielding spheres against rings of traction, and against springs marched plainly.

Rings obey Coulomb's law at every point of the true contact, under Hertz's pressure cut at that of
yield and, while unloading, Hertz's of the radius R_p (Thornton 1997). Springs do not, quite: over
200 impacts up to V_1 = 10 V_y psi_2 differs by at most 0.047, near psi_1 = 1, mostly by less than
0.005.
"""

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import beta, betainc

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.twins import rings

Array = NDArray[np.float64]


def psi_out(psi: Array, chi: Array, y: Array) -> Array:
    """Return psi_2 of impacts, all of which must be solved."""
    found = lossy_rebounds(psi, chi, LossNumbers(Loss.PLASTIC, y))
    assert np.all(found.status == Status.SOLVED)
    return found.psi_out


def thornton(y: float, steps: int) -> tuple[Array, Array, Array, Array]:
    """Return time, penetration, edge, load of the sphere that yields at d = y^2, in closed form.

    Hertz's times are incomplete beta functions; P = peak sin(omega t + phase) while it yields.
    """
    whole, share = 0.4 * beta(0.4, 0.5), betainc(0.4, 0.5, y**5)
    b = np.sin(np.arcsin(y) * np.linspace(0.0, 1.0, steps))[:-1]
    loading = whole * betainc(0.4, 0.5, b**5), b**2, b, b**3
    peak, omega = np.sqrt(1.2 * y - 0.2 * y**6), np.sqrt(1.875 * y)
    angle = np.linspace(np.arcsin(y**3 / peak), 0.5 * np.pi, steps)
    load = peak * np.sin(angle)
    d = y**2 + (load - y**3) / (1.5 * y)
    yielding = whole * share + (angle - angle[0]) / omega, d, np.sqrt(d), load
    rho = d[-1] ** 1.5 / peak
    elastic, e = d[-1] / rho, np.sqrt(peak * d[-1] / rho)
    b = np.cos(0.5 * np.pi * np.linspace(0.0, 1.0, 2 * steps))[1:]
    b[-1] = 0.0
    left = whole * (1.0 - betainc(0.4, 0.5, b**5)) * elastic / e
    unloading = (
        yielding[0][-1] + left,
        d[-1] - elastic * (1.0 - b**2),
        np.sqrt(d[-1]) * b,
        peak * b**3,
    )
    columns = zip(loading, yielding, unloading, strict=True)
    time, depth, edge, load = (np.concatenate(parts) for parts in columns)
    return time, depth, edge, load


@pytest.mark.parametrize("y", [0.1, 0.4, 0.95])
def test_closed_motion_obeys_the_equations(y: float) -> None:
    """The impulse of the load is 1 + e, and d'' = -(5/4) P; time and e are the solver's."""
    time, depth, _, load = thornton(y, 2000)
    found = lossy_rebounds(np.ones(1), np.ones(1), LossNumbers(Loss.PLASTIC, y))
    speed = 1.0 - np.append(0.0, np.cumsum(0.625 * (load[1:] + load[:-1]) * np.diff(time)))
    assert -speed[-1] == pytest.approx(found.restitution[0], abs=1e-5)
    travelled = np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))
    assert travelled == pytest.approx(depth[1:], abs=2e-5)
    assert time[-1] == pytest.approx(found.duration[0], rel=1e-9)


def load_within(radii: Array, y: float, d: float, b: float, peak: tuple[float, ...]) -> Array:
    """Return the integral of the pressure inside radii: cut at (2/pi) y while loading."""
    square = np.minimum(radii**2, b * b)
    rest = np.sqrt(b * b - square)
    if not peak:
        flat = np.minimum(square, max(d - y * y, 0.0))
        return 2.0 * y * flat + 4.0 / 3.0 * (min(b, y) ** 3 - np.minimum(rest, y) ** 3)
    load, widest = peak
    return np.asarray(4.0 / 3.0 * load / widest**3 * (b**3 - rest**3))


def by_rings(psi: float, chi: float, y: float, count: int) -> float:
    time, depth, edge, load = thornton(y, count)
    turn = int(np.argmax(load))
    radii = np.linspace(0.0, edge[turn], count + 1)
    loads = [
        load_within(radii, y, d, b, (load[turn], edge[turn]) if i > turn else ())
        for i, (d, b) in enumerate(zip(depth, edge, strict=True))
    ]
    solid = rings.standard_linear_solid(0.0, 1.0)
    return rings.march_rings(psi, chi, time, radii, np.array(loads[1:]), solid)


def test_rings_bear_the_load() -> None:
    time, depth, edge, load = thornton(0.5, 50)
    turn = int(np.argmax(load))
    for i in range(time.size):
        peak = (load[turn], edge[turn]) if i > turn else ()
        whole = load_within(np.array([2.0]), 0.5, depth[i], edge[i], peak)
        assert whole[0] == pytest.approx(4.0 / 3.0 * load[i], abs=1e-12)


@pytest.mark.parametrize(
    ("psi", "chi", "ratio", "close"),
    [
        (1.0, 1.44, 1.05, 5e-4),
        (4.177, 1.085, 1.5, 2e-3),
        (3.493, 0.688, 4.9, 2e-3),
        (2.584, 1.674, 7.64, 0.015),
        (0.514, 0.974, 8.21, 0.015),
        (0.970, 1.415, 8.18, 0.05),  # the worst of 200
    ],
)
def test_rings_of_traction(psi: float, chi: float, ratio: float, close: float) -> None:
    y = ratio**-0.4
    wanted = rings.richardson(*(by_rings(psi, chi, y, count) for count in (20, 40, 80)))
    found = psi_out(np.array([psi]), np.array([chi]), np.array([y]))[0]
    assert found == pytest.approx(wanted, abs=close)
    if close == 0.05:
        assert abs(found - wanted) > 0.03


def by_springs(psi: float, chi: float, y: float, count: int) -> float:
    """Even springs, each cut to its limit after each step: first order in both.

    The limit is Abel's transform of the pressure, by quadrature of the cut pressure while loading.
    """
    time, depth, edge, load = thornton(y, 4 * count)
    turn = int(np.argmax(load))
    x = (np.arange(count) + 0.5) * edge[turn] / count
    u, force = np.zeros(count), 0.0
    for i, (before, after) in enumerate(pairwise(time), 1):
        dt = after - before
        psi -= 0.5 * dt * 3.75 * chi * force
        limit = (edge[i] ** 2 - x**2) * load[turn] / edge[turn] ** 3
        if i <= turn:
            limit = transformed(np.maximum(depth[i] - x**2, 0.0), y)
        most = np.maximum(limit, 0.0)
        u = np.where(x < edge[i], np.clip(u + psi * dt, -most, most), 0.0)
        force = float(u.sum()) * edge[turn] / count
        psi -= 0.5 * dt * 3.75 * chi * force
    return psi


ANGLES = (np.arange(400) + 0.5) * 0.5 * np.pi / 400


def transformed(w: Array, y: float) -> Array:
    """Return Abel's transform of the cut pressure, the integral of r p/sqrt(r^2 - x^2) dr.

    With sqrt(r^2 - x^2) = sqrt(w) sin(t) Hertz's part of p is (2/pi) sqrt(w) cos(t), cut at y.
    """
    rest = np.sqrt(w)[:, None] * np.cos(ANGLES)
    return np.asarray(np.mean(np.minimum(rest, y) * rest, axis=1) * 2.0)


def test_springs_marched_plainly() -> None:
    rng = np.random.default_rng(1997)
    psi, chi, y = rng.uniform(0, 5, 4), rng.uniform(0.4, 2.5, 4), rng.uniform(0.4, 0.95, 4)
    for given, found in zip(zip(psi, chi, y, strict=True), psi_out(psi, chi, y), strict=True):
        coarse, fine = (by_springs(*given, count) for count in (150, 300))
        assert found == pytest.approx(2.0 * fine - coarse, abs=1e-3), given


def test_error_is_of_second_order_and_what_is_promised() -> None:
    """psi in [0, 8], chi in [0.3, 3], V_1 up to 10 V_y: 1e-5 max(1, psi_1)."""
    from carom.dimensionless.lossy.springs.march import march
    from carom.dimensionless.lossy.springs.work import new_work

    rng = np.random.default_rng(7)
    psi, chi, y = rng.uniform(0, 8, 25), rng.uniform(0.3, 3, 25), rng.uniform(0.4, 0.999, 25)
    work, numbers, rows = new_work(), np.zeros(9), np.zeros((0, 0))
    found = np.empty((25, 4))
    for i, (p, c, parameter) in enumerate(zip(psi, chi, y, strict=True)):
        for j, count in enumerate((100, 200, 400, 800)):
            march(p, c, LossNumbers(Loss.PLASTIC, parameter, 0.0), count, work, rows, numbers)
            found[i, j] = numbers[0]
    fine = (4.0 * found[:, 3] - found[:, 2]) / 3.0
    errors = np.abs(found[:, :3] - fine[:, None])
    assert np.median(np.log2(errors[:, 0] / errors[:, 2]) / 2.0) == pytest.approx(2.0, abs=0.1)
    assert np.max(np.abs(psi_out(psi, chi, y) - fine) / np.maximum(1.0, psi)) < 1e-5
