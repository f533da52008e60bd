"""Spheres pressed together and turned about the normal, against Reissner & Sagoci and Lubkin.

Moment M over friction in E* d_max a_max, turn theta in friction d_max/a_max; at depth 1, a = 1, P =
4/3 and p = (2/pi) sqrt(1 - r^2). In polar coordinates the kernel of circular tractions q(r) is
cos(phi)/R + m r s sin^2(phi)/R^3, s the radius of the load; by parts its second term is m times the
first. So 1 + m, 1/(1 - nu) for like materials, multiplies all displacements and is all that nu does
here; turns below are over 1 + m.

A disc of radius s that sticks: q = (2 theta/pi) r/sqrt(s^2 - r^2), M = (8/3) theta s^3; on one
half-space under a rigid disc (16/3) G theta s^3 (Reissner & Sagoci 1944, J. Appl. Phys. 15:652).

Partial slip is such discs laid over each other, from s = c, the stick radius, to 1: within c each
turns as a rigid body. Of density g(s), as the integral of g(s) r/sqrt(s^2 - r^2) over s, their
tractions add to p(r) beyond c if, by Abel's inversion, g = (4/pi^2) E(s')/s, s'^2 = 1 - s^2. Each
turns by (pi/2) g and bears (4 pi/3) g s^3:

    theta = (2/pi) (K(c') - E(c')),   M = (16/(3 pi)) times the integral of s^2 E(s') from c to 1,

K, E the complete elliptic integrals of modulus c' or s' (Lubkin 1951, J. Appl. Mech. 18:183).
Unloading is the same at twice the scale, as slip starts anew from the edge, back to p from -p
(Deresiewicz 1954, J. Appl. Mech. 21:52).
"""

from math import pi, sqrt

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipe, ellipk
from tests.oracles.punches import moment, moment_of, traction_of, turn_of

from carom.halfspace.compliance import Materials
from carom.halfspace.quasistatic import Patch

RADII = np.array([0.95, 0.85, 0.6, 0.3])  # of stick, one after the other
GRIDS = (12, 24, 48)
NUS = (0.0, 0.4)
GROSS = pi / 4.0  # M where all slips: (3 pi/16) P


def driven(elements, nu, path, punch=False):
    """Return the patch and a step for each depth and turn over 1 + m."""
    kappa = 2.0 * (1.0 - nu) / (2.0 - nu)
    patch, steps = Patch.across(elements, Materials(kappa)), []
    if punch:
        patch.grid.apart = np.where(2.0 * patch.grid.apart < 1.0, 0.0, 99.0)
    state = patch.untouched()
    for depth, turn in path:
        steps.append(patch.advance(state, depth, np.array([0.0, 0.0, (2.0 / kappa - 1.0) * turn])))
        state = steps[-1].state
    return patch, steps


def turned(elements, nu, *turns):
    """Return the patch and a step for each turn, at depth 1."""
    patch, steps = driven(elements, nu, [(1.0, 0.0), *((1.0, turn) for turn in turns)])
    return patch, steps[1:]


def moments(patch, steps):
    return np.array([patch.grid.drag(step.state.traction)[2] for step in steps])


def polar(patch, field):
    """Return the radii of the elements, what of a field is radial, and what is around."""
    x, y = patch.grid.line[:, None], patch.grid.line
    radii = np.hypot(x, y)
    return radii, (x * field[0] + y * field[1]) / radii, (x * field[1] - y * field[0]) / radii


@pytest.fixture(scope="module")
def runs():
    return {(n, nu): turned(n, nu, *turn_of(RADII)) for n in GRIDS for nu in NUS}


def test_formulas():
    """Lubkin's slip bears p, his stick turns rigidly, and his ends are a disc and gross slip."""
    c = 0.6

    def turned_at(r):
        def ring(s):  # the integral of cos(phi)/R over a ring of loads
            m = 4.0 * r * s / (r + s) ** 2
            loop = ((2.0 / m - 1.0) * ellipk(m) - 2.0 / m * ellipe(m)) * 4.0 / (r + s)
            return traction_of(s, c) * s * loop / (pi * r)

        return sum(quad(ring, *ends, limit=200)[0] for ends in ((1e-9, r), (r, c), (c, 1.0)))

    assert traction_of(0.8, c) == pytest.approx(2.0 / pi * 0.6, rel=1e-12)
    assert [turned_at(0.2), turned_at(0.5)] == pytest.approx([turn_of(c)] * 2, rel=1e-8)
    slips = quad(lambda r: 4.0 * r * r * sqrt(1.0 - r * r), c, 1.0)[0]
    sticks = quad(lambda r: 2.0 * pi * r * r * traction_of(r, c), 0.0, c)[0]
    assert moment_of(c) == pytest.approx(slips + sticks, rel=1e-9)
    assert moment_of(0.0) == pytest.approx(GROSS, rel=1e-12)
    assert moment(1e-5) == pytest.approx(8.0 / 3.0 * 1e-5, rel=3e-5)


@pytest.mark.parametrize(("nu", "most"), [(0.0, [3e-3, 4e-4, 6e-5]), (0.4, [0.02, 0.01, 5e-3])])
def test_disc_that_sticks(nu, most):
    """Under a flat punch of radius a, P = 2 a, a turn without slip bears M = (8/3) theta a^3."""
    errors, turn = [], 0.2
    for elements in GRIDS:
        patch, (_, step) = driven(elements, nu, [(1.0, 0.0), (1.0, turn)], punch=True)
        a = patch.grid.force(step.state.pressure) / 2.0
        errors.append(moments(patch, [step])[0] / (8.0 / 3.0 * turn * a**3) - 1.0)
        assert not np.any(step.slips)
    assert np.all(np.abs(errors) <= most)
    assert abs(2.0 * errors[2] - errors[1]) <= 6e-4  # of the first order, where nu > 0
    radii, radial, around = polar(patch, step.state.traction)
    inside = radii < 0.7
    exact = 2.0 * turn / pi * radii / np.sqrt(np.maximum(a * a - radii**2, 0.1))
    assert np.hypot(around - exact, radial)[inside].max() <= 0.01 * exact[inside].max()


def test_moment_of_a_turn(runs):
    """In partial slip M converges to Lubkin's, about as the square of the spacing, for any nu."""
    exact = np.array([moment_of(c) for c in RADII])
    values = np.array([[moments(*runs[n, nu]) for nu in NUS] for n in GRIDS])
    means = np.sqrt(np.mean((values - exact) ** 2, axis=2)).T / GROSS
    assert np.all(means <= [8e-3, 1.7e-3, 3.5e-4])
    assert np.all(np.abs(np.log2(means[:, :-1] / means[:, 1:]) - 2.3) <= 0.5)
    apart = np.abs(values[:, 1] - values[:, 0]).max(axis=1) / GROSS
    assert np.all(apart <= [3e-3, 4e-4, 2e-5])


@pytest.mark.parametrize(("nu", "across"), [(0.0, 1.5e-3), (0.4, 6e-3)])
def test_stick_and_traction(runs, nu, across):
    """What sticks is within Lubkin's radius, to a quarter of an element; q is his, in circles."""
    patch, steps = runs[48, nu]
    near, line = 0.25 * patch.compliance.spacing, np.linspace(1e-6, 1.0, 401)
    for c, step in zip(RADII, steps, strict=True):
        radii, radial, around = polar(patch, step.state.traction)
        held = step.touching & ~step.slips
        assert radii[held].max() <= c + near
        assert radii[step.slips].min() >= c - near
        assert abs(np.sqrt(patch.grid.element * np.count_nonzero(held) / pi) - c) <= near
        exact = np.interp(radii, line, [traction_of(r, c) for r in line])
        assert np.abs(around - exact)[radii < c - 0.1].max() <= 1e-3
        assert np.abs(radial).max() <= across


@pytest.mark.parametrize("nu", NUS)
def test_little_and_far(nu):
    """Turned little, spheres are a disc that sticks; far, all slips in circles, M = (3 pi/16) P."""
    assert moments(*turned(48, nu, 1e-3)) == pytest.approx(8.0 / 3.0 * 1e-3, rel=8e-3)
    patch, (step,) = turned(24, nu, 50.0)
    assert np.array_equal(step.slips, step.touching)
    drag, pressure = patch.grid.drag(step.state.traction), step.state.pressure
    assert drag[2] == pytest.approx(3.0 * pi / 16.0 * patch.grid.force(pressure), rel=4e-4)
    assert np.abs(drag[:2]).max() <= 1e-10
    assert np.abs(polar(patch, step.state.traction)[1]).max() <= 2e-4


@pytest.mark.first_case
@pytest.mark.parametrize("nu", NUS)
@pytest.mark.parametrize("c", [0.7, 0.3])
def test_unloading_doubles_loading(nu, c):
    """Masing's rule: unloading by a turn changes M by twice what half of it did at first.

    On the grid as exactly as it is solved, in Lubkin's numbers to its error; the loop closes, and
    the work of slip in it is the area between those curves.
    """
    top = turn_of(c)
    down = np.linspace(top, -top, 9)[1:]
    patch, steps = turned(24, nu, top, *down, *-down)
    actual, again = moments(patch, steps), moments(*turned(24, nu, *(top - down) / 2.0))
    assert np.abs(actual[1:9] - actual[0] + 2.0 * again).max() <= 2e-5
    assert np.abs(actual[9:] + actual[1:9]).max() <= 2e-5
    exact = moment(top) - 2.0 * np.array([moment((top - turn) / 2.0) for turn in down])
    assert np.abs(actual[1:9] - exact).max() <= 4e-3 * GROSS
    area = 8.0 * quad(moment, 0.0, top)[0] - 4.0 * moment(top) * top
    work = [patch.grid.element * np.sum(step.state.traction * step.moved) for step in steps[1:]]
    assert min(work) > 0.0
    assert sum(work) * (1.0 - nu) == pytest.approx(area, rel=8e-3)


@pytest.mark.first_case
@pytest.mark.parametrize("nu", NUS)
@pytest.mark.parametrize("rate", [0.5, 0.95])
def test_turned_while_pressed(nu, rate):
    """Pressed and turned in a constant ratio, all sticks: q = 2 (theta/d) r p, M = (16/15) theta.

    Each step turns the disc of then as a rigid body; discs of d theta = 2 (theta/d) s ds, from s =
    r to a, add to that q, below p while 2 a theta/d < 1. Lifting takes them off again.
    """
    errors, means = [], []
    for elements in (16, 32):
        line = np.linspace(0.0, 1.0, 3 * elements // 4 + 1)
        path = [(a * a, rate / 2.0 * a * a) for a in (*line[1:], *line[-2:0:-1])]
        patch, steps = driven(elements, nu, path)
        values, full = moments(patch, steps), steps[len(line) - 2]
        assert np.abs(values - values[::-1]).max() <= 1e-6
        errors.append(abs(values.max() / (8.0 / 15.0 * rate) - 1.0))
        radii, radial, around = polar(patch, full.state.traction)
        off = np.hypot(around - rate * radii * full.state.pressure, radial)
        means.append(np.sqrt(patch.grid.element * np.sum(off**2) / pi))
    assert np.all(np.array([errors, means]) <= [[0.025, 8e-3], [8e-3, 5e-3]])
    assert np.all(np.array([errors[1], means[1]]) <= [errors[0] / 3.0, 0.65 * means[0]])
    assert np.count_nonzero(full.slips) <= 0.01 * np.count_nonzero(full.touching)
