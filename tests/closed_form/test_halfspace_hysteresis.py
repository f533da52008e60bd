"""Loops and oblique loading of the elements against Mindlin & Deresiewicz (1953) at nu = 0.

J. Appl. Mech. 20:327; kappa = 1. Displacements in friction d_max, forces over friction; at depth 1
P = 4/3, and f = F/P follows u = U: f = 1 - (1 - u)^1.5 at first, after each reversal twice that of
half the change of u.
"""

import numpy as np
import pytest
from tests.convergence.test_halfspace_mindlin import share, shifted

from carom.halfspace.compliance import Materials
from carom.halfspace.quasistatic import Patch

ELEMENTS = 24
ERROR = 1.5e-3  # of f, as found for the first loading on this grid
LIMIT = 4.0 / 3.0


def first(u):
    return 1.0 - (1.0 - np.abs(u)) ** 1.5


def driven(shifts):
    """Return the patch and its steps at depth 1."""
    return shifted(ELEMENTS, Materials(1.0), *shifts)


@pytest.mark.parametrize("top", [0.3, 0.7])
def test_down_and_up_again(top):
    """Loaded, unloaded to the opposite and loaded anew: the loop closes where it began."""
    down, up = np.linspace(top, -top, 9)[1:], np.linspace(-top, top, 9)[1:]
    _, steps = driven([top, *down, *up])
    values = np.array([share(step) for step in steps])
    peak = first(top)
    assert values[0] == pytest.approx(peak, abs=ERROR)
    unloading = peak - 2.0 * first((top - down) / 2.0)
    assert np.abs(values[1:9] - unloading).max() <= 2.0 * ERROR
    assert values[8] == pytest.approx(-values[0], abs=1e-5)
    assert np.abs(values[9:] + unloading).max() <= 2.0 * ERROR
    assert values[16] == pytest.approx(values[0], abs=1e-5)
    assert np.abs(steps[16].state.traction - steps[0].state.traction).max() <= 1e-5


def test_traction_of_unloading():
    """q = p(r) - 2 c' p(r/c') + c p(r/c) with changed sign: a ring of its own slips backwards."""
    top, bottom = 0.7, 0.3
    patch, steps = driven([top, bottom])
    radii = np.hypot(patch.grid.line[:, None], patch.grid.line)

    def circle(square):
        return 2.0 / np.pi * np.sqrt(np.maximum(square - radii**2, 0.0))

    c, back = 1.0 - top, 1.0 - (top - bottom) / 2.0  # squares of the stick radii
    exact = circle(1.0) - circle(c) - 2.0 * (circle(1.0) - circle(back))
    away = np.min([np.abs(radii - np.sqrt(edge)) for edge in (c, back, 1.0)], axis=0) > 0.12
    off = np.abs(steps[1].state.traction[0] - exact)
    assert np.count_nonzero(away & (radii < 1.0)) >= 120
    assert off[away].max() <= 0.01
    assert off.max() <= 0.06
    assert steps[1].state.traction[0][np.abs(radii - 0.95) < 0.04].max() < 0.0
    assert steps[1].state.traction[0][radii < 0.5].min() > 0.0


@pytest.mark.first_case
@pytest.mark.parametrize("force", [0.5, 0.9])
def test_energy_lost_in_a_loop(force):
    """W = (18/5)(mu P)^2/(a G*) (1 - y)^3 (1 + 3 y + y^2)/6, y^3 = 1 - F/(mu P) (Johnson 7.4).

    As the area of the loop, of order 1.5 in its steps (the compliance jumps at reversals), and as
    the work of tractions on slip at every element, which steps do not matter to at nu = 0.
    """
    y = (1.0 - force) ** (1.0 / 3.0)
    exact = 3.6 * LIMIT**2 * (1.0 - y) ** 3 * (1.0 + 3.0 * y + y**2) / 6.0
    top, areas, slips = 1.0 - (1.0 - force) ** (2.0 / 3.0), [], []
    for count in (10, 20):
        down, up = np.linspace(top, -top, count + 1), np.linspace(-top, top, count + 1)
        shifts = np.array([*down, *up[1:]])
        patch, steps = driven(shifts)
        drag = np.array([patch.grid.element * step.state.traction[0].sum() for step in steps])
        areas.append(float(np.trapezoid(drag, shifts)))
        work = [patch.grid.element * np.sum(step.state.traction * step.moved) for step in steps[1:]]
        assert min(work) >= -1e-7
        slips.append(sum(work))
    extrapolated = areas[1] + (areas[1] - areas[0]) / (2.0**1.5 - 1.0)
    assert abs(areas[1] - exact) < abs(areas[0] - exact)
    assert extrapolated == pytest.approx(exact, rel=0.01)
    assert slips == pytest.approx([exact, exact], rel=6e-3)


@pytest.mark.first_case
@pytest.mark.parametrize("share_of_critical", [0.4, 0.97])
def test_steep_loads_stick(share_of_critical):
    """Motion of constant direction from first touch, kappa U/d below 1: q = (U/d) p, no slip.

    Unloading along the same line retraces it. At every element, in steps of any length: elements
    that come to touch within a step stick from their touch on.
    """
    for count in (2, 6, 24):
        patch = Patch.across(ELEMENTS, Materials(1.0))
        state = patch.untouched()
        line = np.linspace(0.0, 1.0, count + 1)[1:]
        for depth in (*line, *line[-2::-1]):
            step = patch.advance(state, depth, np.array([share_of_critical * depth, 0.0, 0.0]))
            state = step.state
            off = np.abs(state.traction[0] - share_of_critical * state.pressure).max()
            assert off <= 1e-5 * LIMIT


def test_flat_loads_slide():
    """At twice the critical direction everything slips, pressing and lifting: q = p."""
    patch = Patch.across(ELEMENTS, Materials(1.0))
    state = patch.untouched()
    for depth, shift in ((0.2, 0.4), (0.6, 1.2), (1.0, 2.0), (0.7, 2.1), (0.2, 2.3)):
        state = patch.advance(state, depth, np.array([shift, 0.0, 0.0])).state
        assert np.abs(state.traction[0] - state.pressure).max() <= 1e-6
