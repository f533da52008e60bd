"""Load paths: springs one by one, energy, symmetry, and that nothing depends on how it is asked."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import quad
from tests.checks import BALL, FLOOR
from tests.oracles.springs import along_a_path

import carom
from carom.dimensionless.load_paths import paths
from carom.dimensionless.load_paths.memory import RADIUS, RIM, SLOPE, profile_of
from carom.dimensionless.numerics.chebyshev import evaluate
from carom.impacts.contacts.load_paths import load_path
from carom.quantities.refusals import InputError

PAIR = carom.Pair(BALL, FLOOR, friction=0.3)
EXAMPLES = settings(max_examples=60, derandomize=True, deadline=None)
number = {"allow_nan": False, "allow_subnormal": False}
places = st.tuples(st.floats(-0.15, 1.0, **number), st.floats(-0.7, 0.7, **number))
walks = st.lists(places, min_size=1, max_size=25).map(lambda rows: np.array(rows).T)
COLUMNS = [paths.DISPLACEMENT, paths.TRACTION, paths.STORED, paths.WORK]
seeds = st.integers(0, 10**6)


def moved(d, u):
    return paths.follow_path(d, u, np.zeros(d.size, dtype=bool))


def forced(d, q):
    return paths.follow_path(d, q, np.ones(d.size, dtype=bool))


def deflections(stack, s):
    """q(s) of a memory, from the rim inwards."""
    q = np.zeros(s.size)
    for inner, outer in pairwise(stack):
        q += outer[SLOPE] * (outer[RIM] - np.clip(s, inner[RIM], outer[RIM]))
    return q


@EXAMPLES
@given(walks)
def test_same_as_springs_one_by_one(walk):
    s = ((np.arange(101) + 0.5) / 101) ** 2
    actual = deflections(moved(*walk).stack, s)
    assert_allclose(actual, along_a_path(*walk, s, 3), rtol=0, atol=3e-15)


@EXAMPLES
@given(walks)
def test_force_energy_and_profile_are_those_of_the_memory(walk):
    path = moved(*walk)
    nodes, weights = np.polynomial.legendre.leggauss(3)
    edges, coefficients, *_ = profile_of(path.stack)
    sums = np.zeros(2)
    for low, high, row in zip(edges[:-1], edges[1:], coefficients, strict=True):
        x = 0.5 * (low + high) + 0.5 * (high - low) * nodes
        q = np.array([evaluate(row, low, high, at) for at in x])
        assert_allclose(q, deflections(path.stack, x * x), rtol=0, atol=1e-15)
        sums += 0.5 * (high - low) * np.array([weights @ q, weights @ (0.5 * q * q)])
    assert_allclose(sums, path.results[-1, [paths.TRACTION, paths.STORED]], rtol=0, atol=1e-14)


@EXAMPLES
@given(walks)
def test_coulombs_law(walk):
    path = moved(*walk)
    depth = np.maximum(walk[0], 0.0)
    bound = 2 / 3 * depth**1.5 * (1 + 1e-15) + 1e-300
    assert np.all(np.abs(path.results[:, paths.TRACTION]) <= bound)
    assert np.all(path.results[:, paths.STICK] <= np.sqrt(depth))
    assert np.all(np.abs(path.stack[1:, SLOPE]) <= 1.0)
    assert np.all(np.diff(path.stack[:, RIM]) > 0.0)
    assert path.stack[-1, RADIUS] == np.sqrt(depth[-1])
    assert len(path.stack) <= len(depth) + 1
    assert np.all(np.diff(path.results[:, paths.WORK], prepend=0.0) >= -1e-16)


@settings(max_examples=25, derandomize=True, deadline=None)
@given(walks)
def test_work_input_is_stored_or_dissipated(walk):
    """The work of Q over the last step, by adaptive quadrature, is what both energies gain."""
    d, u = (np.append(0.0, values) for values in walk)
    path = moved(*walk).results
    before = path[-2, [paths.STORED, paths.WORK]] if len(path) > 1 else np.zeros(2)

    def force(t):
        end = [values[-2] + t * (values[-1] - values[-2]) for values in (d, u)]
        return moved(np.append(d[1:-1], end[0]), np.append(u[1:-1], end[1])).results[
            -1, paths.TRACTION
        ]

    parts = np.linspace(0.0, 1.0, 41)[1:-1]  # kinks deceive the extrapolation of a single one
    work, _ = quad(force, 0.0, 1.0, epsabs=1e-12, epsrel=0.0, limit=400, points=parts)
    gained = np.sum(path[-1, [paths.STORED, paths.WORK]] - before)
    assert gained == pytest.approx(work * (u[-1] - u[-2]), rel=0, abs=1e-10)


@EXAMPLES
@given(walks, st.lists(st.floats(0.0, 1.0, **number), min_size=1, max_size=4))
def test_a_step_may_be_split(walk, cuts):
    shares = np.append(np.sort(cuts), 1.0)
    ends = np.hstack((np.zeros((2, 1)), walk))
    parts = ends[:, :-1, np.newaxis] + shares * np.diff(ends)[:, :, np.newaxis]
    parts[:, :, -1] = walk
    whole, split = moved(*walk), moved(*parts.reshape(2, -1))
    last = split.results[shares.size - 1 :: shares.size]
    assert_allclose(last[:, COLUMNS], whole.results[:, COLUMNS], rtol=0, atol=1e-13)
    s = np.linspace(0.0, 1.0, 50)
    actual, expected = (deflections(path.stack, s) for path in (split, whole))
    assert_allclose(actual, expected, rtol=0, atol=1e-14)


@EXAMPLES
@given(walks)
def test_mirror(walk):
    one, other = moved(*walk), moved(walk[0], -walk[1])
    mirrored = one.results * np.array([-1.0, -1.0, 1.0, 1.0, 1.0])
    assert_array_equal(mirrored[:, : paths.WORK], other.results[:, : paths.WORK])
    assert_allclose(mirrored[:, paths.WORK], other.results[:, paths.WORK], rtol=0, atol=1e-15)


@EXAMPLES
@given(st.lists(st.tuples(st.floats(0.05, 1), st.floats(-0.95, 0.95)), min_size=1, max_size=25))
def test_control_by_force_and_by_displacement_agree(rows):
    depth, share = np.array(rows).T
    wanted = share * 2 / 3 * depth**1.5
    one = forced(depth, wanted)
    assert one.refused == paths.INSIDE
    assert_allclose(one.results[:, paths.TRACTION], wanted, rtol=0, atol=1e-14)
    other = moved(depth, one.results[:, paths.DISPLACEMENT])
    assert_allclose(other.results[:, COLUMNS], one.results[:, COLUMNS], rtol=0, atol=1e-13)
    again = forced(depth, other.results[:, paths.TRACTION])
    assert_allclose(again.results[:, COLUMNS], one.results[:, COLUMNS], rtol=0, atol=1e-10)


@EXAMPLES
@given(walks, seeds)
def test_controls_may_alternate(walk, seed):
    """Any step may be led by the force that the displacement causes, unless all slides there."""
    one = moved(*walk)
    cone = 2 / 3 * np.maximum(walk[0], 0.0) ** 1.5
    holds = (cone > 1e-4) & (np.abs(one.results[:, paths.TRACTION]) < 0.999 * cone)
    by_force = holds & np.random.default_rng(seed).integers(0, 2, holds.size).astype(bool)
    targets = np.where(by_force, one.results[:, paths.TRACTION], walk[1])
    other = paths.follow_path(walk[0], targets, by_force)
    assert other.refused == paths.INSIDE
    assert_allclose(other.results[:, COLUMNS], one.results[:, COLUMNS], rtol=0, atol=1e-10)


def test_small_steps_do_not_drift():
    """A million steps, many of them below rounding, end where one step or a closed form does."""
    n = 10**6
    u = np.linspace(0.0, 1e-9, n)
    one = moved(np.ones(2), np.array([0.0, 1e-9]))
    many = moved(np.ones(n), u)
    assert many.results[-1, paths.TRACTION] == pytest.approx(
        one.results[-1, paths.TRACTION], abs=5e-15
    )
    share = np.linspace(0.0, 0.9, n)
    cattaneo = forced(np.ones(n), 2 / 3 * share).results[:, paths.DISPLACEMENT]
    assert_allclose(cattaneo, 1 - (1 - share) ** (2 / 3), rtol=0, atol=1e-13)
    cycle = np.tile([0.5, -0.5, 0.2, -0.3], n // 4)
    loop = forced(np.ones(n), cycle)
    assert np.ptp(loop.results[4::4, paths.DISPLACEMENT]) <= 1e-14
    assert len(loop.stack) < 8


def resting_walk(rng, steps):
    """Depths that rest, exactly or to rounding, or change at a rate from 1e-30 on; U likewise."""
    d, u = np.ones(steps), np.zeros(steps)
    for i in range(1, steps):
        rate = rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-30.0, -1.0)
        ulps = 1.0 + rng.integers(-4, 5) * np.finfo(float).eps
        d[i] = rng.choice([d[i - 1], d[i - 1] * ulps, d[i - 1] * (1.0 + rate), rng.uniform(0.2, 1)])
        rate = rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-30.0, 0.0)
        u[i] = rng.choice([u[i - 1], u[i - 1] + rate, u[i - 1] + 0.3, rng.uniform(-2.0, 2.0)])
    return d, u


def test_paths_that_rest_to_rounding():
    """Friction takes energy, within Coulomb's law; depths that are equal to rounding are equal."""
    rng = np.random.default_rng(10)
    for _ in range(400):
        d, u = resting_walk(rng, 30)
        path, even = moved(d, u), d.copy()
        for i in range(1, d.size):
            even[i] = even[i - 1] if abs(d[i] / even[i - 1] - 1.0) < 1e-13 else d[i]
        results = path.results[:, COLUMNS]
        assert np.min(np.diff(results[:, 3], prepend=0.0)) >= -1e-14
        assert np.all(np.abs(results[:, 1]) <= 2.0 / 3.0 * d**1.5 * (1.0 + 1e-15) + 1e-16)
        assert_allclose(results, moved(even, u).results[:, COLUMNS], rtol=0, atol=1e-11)


@pytest.mark.parametrize("g", [0.0, 0.5, -1.0])
def test_contact_laid_along_a_line_is_one_annulus(g):
    """And at the limit all along if abs(g) = 1: none of it is inside its limits."""
    depth = np.arange(1, 65) / 64
    path = moved(depth, g * depth)
    assert len(path.stack) == 2
    assert_array_equal(path.results[:, paths.STICK], 0.0 if abs(g) == 1 else np.sqrt(depth))


def test_slip_is_that_of_an_impact_with_the_same_motion():
    """The impact integrates its slip rate; here it is displacement less that of the surfaces."""
    solution = carom.solve(1.2, 1.44)
    radii = np.linspace(0.0, 1.0, 9)
    for end in (0.9, 1.6, 2.2):
        history = solution.at(np.linspace(0.0, end, 20001)[1:])
        actual = paths.slid(history.penetration, history.displacement, radii)
        assert_allclose(actual, solution.slid(end, radii), rtol=0, atol=2e-6)
        path = moved(history.penetration, history.displacement).results
        assert_allclose(path[:, paths.TRACTION], history.force, rtol=0, atol=1e-7)
        assert_allclose(path[-1, paths.STORED], history.stored[-1] / 3.75 / 1.44, rtol=0, atol=1e-7)


def test_fields_after_a_step():
    """Force by quadrature, and the stick zone as moved: uniform, without slip since the start."""
    path = load_path(PAIR, normal_force="20 N", tangential_force=[0.0, 4.0, -2.0])
    for k in (1, 2):
        contact, radius = path.contact(k), path.contact_radius[k]
        t, w = np.polynomial.legendre.leggauss(40)
        rims, force = sorted({0.0, *path.stick_radius[1:], radius}), 0.0
        for low, high in pairwise(rims):
            angle = 0.25 * np.pi * (t + 1)  # takes the roots at both rims away
            x = np.sqrt(low**2 + (high**2 - low**2) * np.sin(angle) ** 2)
            points = np.column_stack((x, np.zeros(x.size)))
            traction = path.fields(k, points=points).traction_x.values
            jacobian = (high**2 - low**2) * np.sin(angle) * np.cos(angle)
            force += np.sum(2 * np.pi * traction * jacobian * w * 0.25 * np.pi)
        assert force == pytest.approx(path.tangential_force[k], rel=1e-9)
        inner = np.linspace(0.0, 0.99 * path.stick_radius[1], 7)
        patch = path.fields(k, points=np.column_stack((inner, 0.0 * inner)))
        assert_allclose(patch.displacement_x, path.displacement[k], rtol=1e-9)
        assert np.all(np.abs(patch.slip_x) < 1e-14 * path.displacement[1])
        assert contact.numbers()["tangential_force"] == path.tangential_force[k]


def test_then_is_one_path():
    rng = np.random.default_rng(5)
    load, force = rng.uniform(1.0, 20.0, 30), rng.uniform(-0.25, 0.25, 30)
    whole = load_path(PAIR, normal_force=load, tangential_force=force * load)
    part = load_path(PAIR, normal_force=load[:9], tangential_force=(force * load)[:9])
    part = part.then(penetration=whole.penetration[9:20], displacement=whole.displacement[9:20])
    part = part.then(normal_force=load[20:], displacement=whole.displacement[20:])
    assert len(part) == 30
    steps = whole.to_dataset().drop_vars("friction")
    for name in steps.data_vars:
        size = np.abs(getattr(whole, name)).max()
        assert_allclose(getattr(part, name), getattr(whole, name), rtol=0, atol=1e-10 * size)


def test_outside_coulombs_cone():
    load = np.array([5.0, 20.0, 8.0])
    edge = load_path(PAIR, normal_force=load, tangential_force=0.3 * load)
    assert np.all(edge.stick_radius == 0.0)
    with pytest.raises(InputError, match=r"tangential_force: -2.41 .* step 2: .* 2.4 N at F_z = 8"):
        load_path(PAIR, normal_force=load, tangential_force=[1.0, -6.0, -2.41])
    with pytest.raises(InputError, match=r"step 3: .* at most 0 N"):
        edge.then(penetration=-1e-6, tangential_force=0.1)
