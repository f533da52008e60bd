"""The elements' normal contact converges to Hertz's: a^2 = d, P = (4/3) d^1.5, p_0 = (2/pi) sqrt d.

Pressure in E* d_max/a_max, lengths in a_max, depth in d_max (Johnson 1985, section 4.2).
"""

import numpy as np
import pytest

from carom.halfspace.compliance import Materials
from carom.halfspace.quasistatic import Patch

GRIDS = np.array([8, 12, 16, 24, 32, 48])
DEPTHS = (1.0, 0.7)


def pressed(elements, depth):
    """Return the patch, radii and pressure of bodies that approach without tangential motion."""
    patch = Patch.across(elements, Materials(1.0))
    state = patch.advance(patch.untouched(), depth, np.zeros(3)).state
    return patch, np.hypot(patch.grid.line[:, None], patch.grid.line), state.pressure


@pytest.fixture(scope="module")
def measured():
    """Errors of every grid, the root mean square of both depths."""
    errors = {"force": [], "inside": [], "mean": [], "worst": [], "centre": []}
    for elements in GRIDS:
        several = {name: [] for name in errors}
        for depth in DEPTHS:
            patch, radii, pressure = pressed(elements, depth)
            exact = 2.0 / np.pi * np.sqrt(np.maximum(depth - radii**2, 0.0))
            off = np.abs(pressure - exact)
            force = patch.grid.element * pressure.sum()
            several["force"].append(force / (4.0 / 3.0 * depth**1.5) - 1.0)
            several["inside"].append(off[radii <= 0.75 * np.sqrt(depth)].max())
            several["mean"].append(np.sqrt(patch.grid.element * np.sum(off**2)))
            several["worst"].append(off.max())
            several["centre"].append(off[radii < patch.compliance.spacing].max())
        for name, values in several.items():
            errors[name].append(np.sqrt(np.mean(np.square(values))))
    return {name: np.array(values) for name, values in errors.items()}


@pytest.mark.parametrize(
    ("name", "least", "most", "finest"),
    [
        ("force", 1.7, 2.8, 3e-4),  # relative
        ("inside", 1.8, 2.8, 4e-4),  # away from the edge
        ("centre", 1.8, 2.3, 4e-4),
        ("mean", 0.85, 1.3, 6e-3),  # in the ring of the edge errors of h^0.5 on an area h
        ("worst", 0.2, 0.8, 0.03),  # of the square root at the edge: h^0.5
    ],
)
def test_order(measured, name, least, most, finest):
    errors = measured[name]
    assert least <= -np.polyfit(np.log(GRIDS), np.log(errors), 1)[0] <= most, errors
    assert errors[-1] <= finest
    assert errors[-1] < errors[len(errors) // 2] < errors[0]


@pytest.mark.parametrize("depth", [1.0, 0.7, 0.25])
def test_radius(depth):
    """The touching elements cover pi a^2 to a thin ring: the radius to a fifth of an element."""
    for elements in (16, 32, 48):
        patch, radii, pressure = pressed(elements, depth)
        spacing = patch.compliance.spacing
        by_area = np.sqrt(patch.grid.element * np.count_nonzero(pressure) / np.pi)
        assert abs(by_area - np.sqrt(depth)) <= 0.21 * spacing
        furthest, nearest = radii[pressure > 0.0].max(), radii[pressure == 0.0].min()
        assert abs(furthest - np.sqrt(depth)) <= 0.75 * spacing
        assert abs(nearest - np.sqrt(depth)) <= 0.75 * spacing


def test_no_memory():
    """Pressed further and back again, the pressure is that of the first time."""
    patch = Patch.across(16, Materials(0.9))
    start, still = patch.untouched(), np.zeros(3)
    first = patch.advance(start, 0.5, still)
    back = patch.advance(patch.advance(first.state, 1.0, still).state, 0.5, still)
    off = np.abs(back.state.pressure - first.state.pressure).max()
    assert off <= 3e-6 * first.state.pressure.max()
    assert not back.state.traction.any()
