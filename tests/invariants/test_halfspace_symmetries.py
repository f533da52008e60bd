"""Impacts on a grid that mirror, turn or swap one another."""

from functools import cache

import numpy as np
import pytest

from carom.halfspace.compliance import Materials
from carom.halfspace.motion import NormalSpin, move
from carom.halfspace.quasistatic import Patch
from carom.halfspace.transforms import Mirrors

LIKE = Materials(2.0 * (1.0 - 0.3) / (2.0 - 0.3))
UNLIKE = Materials(0.8, 0.3, 0.5)


@cache
def impact(psi, materials=LIKE, elements=16, steps=75):
    """Return the instants of an impact."""
    patch = Patch.across(elements, materials)
    return list(move(patch, np.array(psi, dtype=float), 1.4412, steps))


def rebound(*args):
    """Return psi_2 as a vector, but for the factor kappa."""
    return impact(*args)[-1].velocity[:2]


@pytest.mark.first_case
@pytest.mark.parametrize(("materials", "elements", "steps"), [(LIKE, 16, 40), (UNLIKE, 8, 12)])
def test_odd_in_psi(materials, elements, steps):
    """Motion reversed is reversed throughout; for unlike materials as well."""
    there = rebound((0.7, 0.2), materials, elements, steps)
    back = rebound((-0.7, -0.2), materials, elements, steps)
    assert np.abs(there + back).max() <= 1e-6
    assert np.abs(there).min() > 1e-3


def test_bodies_swapped():
    """beta changes its sign: the same rebound, of the normal motion as well; without it another."""
    one, other, none = (
        impact((1.0, 0.0), Materials(0.8, beta, 0.5), 8, 12)[-1] for beta in (0.3, -0.3, 0.0)
    )
    assert np.abs(one.velocity - other.velocity).max() <= 1e-6
    assert one.approach == pytest.approx(other.approach, abs=1e-6)
    assert abs(one.velocity[0] - none.velocity[0]) > 1e-3
    assert abs(one.approach - none.approach) > 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("psi", [0.5, 1.5])
def test_no_direction_is_special(psi):
    """Motion at 45, 20 or 90 degrees to the grid: the same psi_2 within 5e-5, and none across."""
    along = rebound((psi, 0.0), LIKE, 16, 40)
    assert abs(along[1]) <= 1e-12
    for degrees, bound in ((45.0, 5e-5), (20.0, 5e-5), (90.0, 1e-9)):
        angle = np.radians(degrees)
        direction = np.array([np.cos(angle), np.sin(angle)])
        psi_out = rebound(tuple(psi * direction), LIKE, 16, 40)
        assert psi_out @ direction == pytest.approx(along[0], abs=bound)
        assert abs(psi_out @ [-direction[1], direction[0]]) <= bound
        if degrees == 45.0:
            assert psi_out[0] == pytest.approx(psi_out[1], abs=1e-9)


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("materials", "mirrors", "spin"),
    [
        (LIKE, Mirrors(True, True), 0.0),
        (LIKE, Mirrors(True, False), 0.8),
        (UNLIKE, Mirrors(False, True), 0.0),
    ],
)
def test_a_part_of_the_grid_tells_all(materials, mirrors, spin):
    """What is mirrored need not be solved: step by step as on the whole grid."""
    whole, part = (
        list(move(patch, np.array([0.9, 0.0]), 1.4412, 12, NormalSpin(spin, 0.3)))
        for patch in (Patch.across(8, materials), Patch.across(8, materials, mirrors))
    )
    grid = Patch.across(8, materials, mirrors).grid
    for one, other in zip(whole, part, strict=True):
        assert one.force == pytest.approx(other.force, abs=1e-6)
        assert one.velocity == pytest.approx(other.velocity, abs=1e-6)
        unfolded = grid.whole_vector(other.step.state.traction)
        assert np.abs(unfolded - one.step.state.traction).max() <= 1e-5
    assert part[0].step.state.pressure.size == whole[0].step.state.pressure.size / mirrors.copies


@pytest.mark.slow
def test_spin_reversed():
    """Spin about the normal the other way: the same psi_2; unlike bodies veer to the other side."""
    for materials, veers in ((LIKE, False), (UNLIKE, True)):
        patch = Patch.across(8, materials)
        one, other = (
            list(move(patch, np.array([0.9, 0.0]), 1.4412, 20, NormalSpin(spin, 0.3)))
            for spin in (0.8, -0.8)
        )
        assert one[-1].velocity == pytest.approx(other[-1].velocity * [1.0, -1.0, -1.0], abs=1e-6)
        assert (abs(one[-1].velocity[1]) > 1e-4) == veers


@pytest.mark.slow
def test_normal_motion_of_like_materials():
    """Friction does not enter: Hertz's impact, of duration 2.9433, depth 1, force 4/3."""
    actual, others = (impact((psi, 0.0)) for psi in (1.0, 3.0))
    assert actual[-1].time == pytest.approx(2.94327518, rel=1e-3)
    assert actual[-1].approach == pytest.approx(-1.0, abs=1e-3)
    assert max(now.step.state.depth for now in actual) == pytest.approx(1.0, abs=1e-3)
    assert max(now.force for now in actual) == pytest.approx(4.0 / 3.0, rel=1e-3)
    assert [now.force for now in others] == pytest.approx([now.force for now in actual], rel=1e-12)
