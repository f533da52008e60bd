"""Load paths that turn, against boundary elements, and against themselves.

Boundary elements know nothing of springs: they solve for the traction of every element. Their force
has an error of first order in the angle of a step, so that it is extrapolated from two.
"""

import numpy as np
import pytest

from carom.dem import lattice
from carom.dimensionless.load_paths import paths, turning
from carom.halfspace.compliance import Materials
from carom.halfspace.quasistatic import Patch

NU_03 = Materials(kappa=14 / 17)
CORNERS = np.array([(0.3, 0.5, -0.1), (0.8, 0.9, 0.3), (1.0, 0.4, 0.9), (0.6, -0.2, 0.5)])


def circle(radius, per_turn, turns=1.0):
    """Depths and displacements: out along x, then round."""
    turn = np.arange(round(turns * per_turn) + 1) * 2 * np.pi / per_turn
    moved = radius * np.column_stack([np.cos(turn), np.sin(turn)])
    moved = np.vstack([np.outer([0.0, 0.5], moved[0]), moved])
    return np.ones(len(moved)), moved


def spiral(n):
    """Depths and displacements: pressed, turned and let go, as in an impact that is kicked."""
    t = (np.arange(n) + 1.0) / (n + 1.0)
    moved = np.column_stack([1.2 * np.sin(4.0 * t), 0.9 * (1.0 - np.cos(5.0 * t * t))])
    return np.sin(np.pi * t) ** 1.2, moved


def parted(depths, moved, parts):
    """The same path with every step cut into equal parts."""
    at = np.arange(1, parts * depths.size + 1) / parts
    lines = [np.append(0.0, line) for line in (depths, *moved.T)]
    depths, *moved = (np.interp(at, np.arange(line.size), line) for line in lines)
    return depths, np.column_stack(moved)


def by_elements(depths, moved, elements=24):
    patch = Patch.across(elements, NU_03)

    def forces(parts):
        state, entries = patch.untouched(), []
        for d, u in zip(*parted(depths, moved, parts), strict=True):
            state = patch.advance(state, float(d), np.append(u, 0.0) / NU_03.kappa).state
            entries.append(state.traction.sum(axis=(1, 2)) / state.pressure.sum())
        return np.array(entries)[parts - 1 :: parts]

    return 2.0 * forces(2) - forces(1)


def follow(depths, moved, by_force=False):
    values = depths, moved, np.full(depths.size, by_force)
    actual, refused = turning.follow_turning(*values, lambda _: None)
    assert refused == paths.INSIDE
    return actual


def pull(actual):
    return actual[:, turning.Q_X : turning.Q_Y + 1]


def away(actual, expected, depths):
    """Return the largest difference of forces, over mu P at its largest."""
    return (np.hypot(*(actual - expected).T) / (2 / 3 * depths.max() ** 1.5)).max()


@pytest.mark.slow
@pytest.mark.parametrize(
    "path",
    [
        pytest.param(circle(0.3, 40), marks=pytest.mark.slow),
        pytest.param(circle(0.9, 80, 0.5), marks=pytest.mark.slow),
        spiral(40),
    ],
)
def test_boundary_elements_agree(path):
    """Within 0.002 of mu P on this grid."""
    depths, _ = path
    limit = (2 / 3 * depths**1.5)[:, None]
    assert away(pull(follow(*path)), limit * by_elements(*path), depths) < 0.002


def test_springs_one_by_one_are_another_law():
    """What the manual says of contact laws: off by 0.15 of mu P on the circle of 0.9."""
    path = circle(0.9, 40)
    memory, load, forces, before = np.zeros(lattice.places(32)), np.zeros(3), [], np.zeros(3)
    for now in np.column_stack(parted(*path, 10)):
        lattice.step(memory, 32, now[0], now - before, 1.0, 0.0, 0.0, 1.4, load)
        forces.append(load[1:] / 1.5)
        before = now
    assert 0.12 < away(np.array(forces)[9::10], pull(follow(*path)), path[0]) < 0.17


def test_on_a_line_springs_find_the_annuli_again():
    """Paths on one line by springs, against the exact ones: 1e-4 of the force, 1e-3 of the work."""
    rng = np.random.default_rng(4)
    depths, along = rng.uniform(0.05, 1.0, 25), rng.uniform(-1.2, 1.2, 25)
    depths[rng.uniform(size=25) < 0.2] = -0.1
    e = np.array([np.cos(0.7), np.sin(0.7)])
    exact = paths.follow_path(depths, along, np.zeros(25, bool)).results
    path = follow(depths, np.outer(along, e))
    assert away(pull(path), np.outer(exact[:, paths.TRACTION], e), depths) < 2e-4
    np.testing.assert_allclose(path[:, turning.STICK], exact[:, paths.STICK], atol=0.01)
    np.testing.assert_allclose(path[:, turning.STORED], exact[:, paths.STORED], atol=1e-4)
    work = exact[:, paths.WORK]
    np.testing.assert_allclose(path[:, turning.WORK], work, atol=4e-3 * work[-1])


def test_what_was_stored_and_lost_is_the_work_of_the_force():
    """int F dU by the trapezoid rule of fine steps: the ledger knows it spring by spring."""
    depths, moved = parted(*spiral(40), 6)
    path = follow(depths, moved)
    mean = 0.5 * (pull(path)[1:] + pull(path)[:-1])
    work = np.sum(mean * np.diff(moved, axis=0)) + 0.5 * pull(path)[0] @ moved[0]
    books = path[-1, turning.STORED] + path[-1, turning.WORK]
    assert books == pytest.approx(work, rel=3e-3)
    assert np.all(np.diff(path[:, turning.WORK]) > -1e-4 * work)


def test_steps_are_straight_however_they_are_cut():
    """Few long steps end where the same way in short ones does."""
    whole = follow(CORNERS[:, 0], CORNERS[:, 1:])
    parts = follow(*parted(CORNERS[:, 0], CORNERS[:, 1:], 40))[39::40]
    assert away(pull(whole), pull(parts), CORNERS[:, 0]) < 3e-4
    np.testing.assert_allclose(whole[:, turning.WORK], parts[:, turning.WORK], atol=2e-3)


@pytest.mark.slow
def test_the_axes_do_not_matter():
    """A path turned or mirrored has its force turned or mirrored."""
    depths, moved = spiral(4)
    plain = pull(follow(depths, moved))
    for matrix in (np.array([[0.6, -0.8], [0.8, 0.6]]), np.diag([1.0, -1.0])):
        assert away(pull(follow(depths, moved @ matrix)), plain @ matrix, depths) < 1e-8


@pytest.mark.slow
def test_forces_lead_back_to_their_displacements():
    """The forces of a path by displacements, wanted, move the bodies as before."""
    depths, moved = circle(0.5, 12)
    path = follow(depths, moved)
    again = follow(depths, pull(path), by_force=True)
    np.testing.assert_allclose(again[:, :2], moved, atol=1e-5)
    np.testing.assert_allclose(again[:, turning.WORK], path[:, turning.WORK], atol=1e-5)
    some = CORNERS[:3, 0], 0.4 * CORNERS[:3, 1:]
    again = follow(some[0], pull(follow(*some)), by_force=True)
    np.testing.assert_allclose(again[:, :2], some[1], atol=1e-4)


def test_coulombs_law_holds():
    """|F| <= mu P, and in gross slip it is reached: behind the bodies, wherever they came from."""
    rng = np.random.default_rng(9)
    depths, moved = rng.uniform(-0.1, 1.0, 9), rng.uniform(-2.0, 2.0, (9, 2))
    force = np.hypot(*pull(follow(depths, moved)).T)
    assert np.all(force <= 2 / 3 * np.maximum(depths, 0.0) ** 1.5 * (1.0 + 1e-12))
    far = follow(np.ones(2), np.array([[3.0, 0.0], [3.0, 60.0]]))
    np.testing.assert_allclose(pull(far)[1], [0.0, 2 / 3], atol=1e-6)
