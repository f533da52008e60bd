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
from tests.oracles import rings

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.layout import PSI_OUT
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.lossy.springs.rebounds import marched

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
    """Even springs, each cut to its limit after each step: first order in both."""
    time, depth, edge, load = thornton(y, count)
    turn = int(np.argmax(load))
    x = (np.arange(count) + 0.5) * edge[turn] / count
    u, force = np.zeros(count), 0.0
    for i, (before, after) in enumerate(pairwise(time), 1):
        dt = after - before
        psi -= 0.5 * dt * 3.75 * chi * force
        inside = int(np.searchsorted(x, edge[i]))
        most = (edge[i] ** 2 - x[:inside] ** 2) * load[turn] / edge[turn] ** 3
        if i <= turn:
            most = borne(depth[i] - x[:inside] ** 2, y)
        u[:inside] = np.clip(u[:inside] + psi * dt, -most, most)
        force = float(u[:inside].sum()) * edge[turn] / count
        psi -= 0.5 * dt * 3.75 * chi * force
    return psi


def borne(w: Array, y: float) -> Array:
    """Return the integral of (2/pi) min(sqrt(w - t^2), y) from -sqrt(w) to sqrt(w)."""
    part = np.minimum(y / np.sqrt(w), 1.0)
    root = np.sqrt(np.maximum(w - y * y, 0.0))
    return np.asarray(2.0 / np.pi * (y * root + w * np.arcsin(part)))


def test_springs_bear_the_transform_of_the_pressure() -> None:
    for y, w in ((0.3, 0.05), (0.3, 0.4), (0.9, 1.5)):
        line = np.sqrt(w) * np.cos((np.arange(20000) + 0.5) * np.pi / 20000)  # sqrt(r^2 - x^2)
        weights = np.sqrt(w - line**2) * np.pi / 20000
        whole = 2.0 / np.pi * np.sum(np.minimum(np.sqrt(w - line**2), y) * weights)
        assert borne(np.array([w]), y)[0] == pytest.approx(whole, rel=1e-7)


def by_fine_springs(psi: float, chi: float, y: float, count: int) -> float:
    """Return psi_2 of even springs, free of the errors of first and second order."""
    found = [by_springs(psi, chi, y, times * count) for times in (1, 2, 4)]
    first = [2.0 * fine - coarse for coarse, fine in pairwise(found)]
    return (4.0 * first[1] - first[0]) / 3.0


@pytest.mark.parametrize(
    ("psi", "chi", "ratio", "count", "close"),
    [
        (0.9, 1.4411764, 10.0, 2000, 3e-6),  # springs converge to 0.3230771
        (1.17, 1.70, 8.5, 1000, 5e-6),
        (1.53, 2.65, 2.1, 1000, 1e-5),
        (1.39, 7.06, 48.1, 1000, 3e-5),
        (1.63, 4.88, 1.02, 1000, 3e-5),
    ],
)
def test_springs_marched_plainly(
    psi: float, chi: float, ratio: float, count: int, close: float
) -> None:
    """Springs and times of their own, extrapolated."""
    y = ratio**-0.4
    found = psi_out(np.array([psi]), np.array([chi]), np.array([y]))[0]
    wanted = by_fine_springs(psi, chi, y, count)
    assert found == pytest.approx(wanted, abs=close * max(1.0, psi))


def test_error_is_of_second_order_and_what_is_promised() -> None:
    """chi in [0.3, 8], V_1 up to 100 V_y, up to gross slip: 3e-5 max(1, psi_1)."""
    rng = np.random.default_rng(7)
    chi, y = rng.uniform(0.3, 8, 40), 100.0 ** (-0.4 * rng.random(40))
    psi = rng.random(40) * (4.0 * chi + 0.5)
    found = np.empty((40, 4))
    for i, (p, c, parameter) in enumerate(zip(psi, chi, y, strict=True)):
        for j, count in enumerate((100, 200, 400, 800)):
            solid = Solid(int(Loss.PLASTIC), parameter)
            found[i, j] = marched(p, Inertia(c), solid, count)[PSI_OUT]
    fine = (4.0 * found[:, 3] - found[:, 2]) / 3.0
    errors = np.abs(found[:, :3] - fine[:, None])
    assert np.median(np.log2(errors[:, 0] / errors[:, 2]) / 2.0) == pytest.approx(2.0, abs=0.1)
    assert np.max(np.abs(psi_out(psi, chi, y) - fine) / np.maximum(1.0, psi)) < 3e-5
