"""The compliance of a grid: sums element by element, reciprocity, energy, its rough inverse."""

import numpy as np
import pytest

from carom.halfspace.compliance import Compliance, Materials, influence
from carom.halfspace.quasistatic import Patch
from carom.halfspace.transforms import DENSE_ELEMENTS, NO_MIRRORS, Mirrors

SIZE, SPACING = 9, 0.23
UNLIKE = Materials(kappa=0.81, beta=-0.34, friction=0.6)
RANGE = [
    Materials(1.0),  # nu = 0
    Materials(2.0 / 3.0),  # incompressible: the least kappa of like materials
    UNLIKE,
    Materials(0.8, 0.5, 0.05),
    Materials(1.2, -0.45, 2.0),  # kernel with a negative lateral factor
]


def random(*shape, seed=1):
    return np.random.default_rng(seed).normal(size=shape)


@pytest.fixture(scope="module")
def compliance():
    return Compliance(SIZE, SPACING, UNLIKE)


@pytest.fixture(scope="module")
def dense():
    """Every kernel as a matrix over the elements: the sum without FFT, padding or wrap-around."""
    line = np.arange(SIZE)
    x, y = (axis.ravel() for axis in np.meshgrid(line, line, indexing="ij"))
    unit = influence((x[:, None] - x).astype(float), (y[:, None] - y).astype(float))
    return {name: SPACING / np.pi * matrix for name, matrix in unit._asdict().items()}


def apart(values, exact):
    """Return the largest difference as part of the largest value."""
    return np.abs(values.ravel() - exact).max() / np.abs(exact).max()


def test_normal(compliance, dense):
    """u = (1/pi) sum of p over r."""
    pressure = random(SIZE, SIZE)
    exact = (dense["xx"] + dense["yy"]) @ pressure.ravel()
    assert apart(compliance.normal(pressure), exact) <= 1e-14


def test_tangential(compliance, dense):
    """u_x = (1/pi) sum of q_x/r + m (q_x x^2 + q_y x y)/r^3, u_y alike; m = 2 (1/kappa - 1)."""
    along, across = traction = random(2, SIZE, SIZE)
    m = 2.0 * (1.0 / 0.81 - 1.0)
    isotropic = dense["xx"] + dense["yy"]
    x = (isotropic + m * dense["xx"]) @ along.ravel() + m * dense["xy"] @ across.ravel()
    y = (isotropic + m * dense["yy"]) @ across.ravel() + m * dense["xy"] @ along.ravel()
    actual = compliance.tangential(traction)
    assert apart(actual[0], x) <= 1e-14
    assert apart(actual[1], y) <= 1e-14


def test_coupling(compliance, dense):
    """Tangential (beta/(pi f)) sum of p x/r^2; normal -(beta f/pi) sum of q.x/r^2."""
    pressure, traction = random(SIZE, SIZE), random(2, SIZE, SIZE, seed=2)
    moved = compliance.tangential_of_pressure(pressure)
    for part, name in zip(moved, "xy", strict=True):
        assert apart(part, -0.34 / 0.6 * dense[name] @ pressure.ravel()) <= 1e-14
    lifted = dense["x"] @ traction[0].ravel() + dense["y"] @ traction[1].ravel()
    assert apart(compliance.normal_of_traction(traction), 0.34 * 0.6 * lifted) <= 1e-14


def test_lateral_factor_of_like_materials():
    """kappa = 2 (1 - nu)/(2 - nu) makes m = nu/(1 - nu): Cerruti's kernel (Johnson 1985, 3.6)."""
    for nu in (0.0, 0.2, 0.3, 0.42, 0.5):
        lateral = Materials(2.0 * (1.0 - nu) / (2.0 - nu)).lateral
        assert lateral == pytest.approx(nu / (1.0 - nu), abs=1e-15)


def test_no_wrap_around():
    """A load in a corner moves the opposite corner as over the whole diagonal, not over an edge.

    The same elements in the middle of a grid three times as large give way as much.
    """
    small, large = (Compliance(size, SPACING, UNLIKE) for size in (SIZE, 3 * SIZE))
    pressure, traction = np.zeros((SIZE, SIZE)), np.zeros((2, SIZE, SIZE))
    pressure[0, 0], traction[:, -1, 0] = 1.0, (0.3, -2.0)
    middle = slice(SIZE, 2 * SIZE)
    wide_pressure, wide_traction = np.pad(pressure, SIZE), np.zeros((2, 3 * SIZE, 3 * SIZE))
    wide_traction[:, middle, middle] = traction
    for name, load, wide in [
        ("normal", pressure, wide_pressure),
        ("tangential", traction, wide_traction),
        ("tangential_of_pressure", pressure, wide_pressure),
        ("normal_of_traction", traction, wide_traction),
    ]:
        actual, exact = getattr(small, name)(load), getattr(large, name)(wide)
        assert np.abs(actual - exact[..., middle, middle]).max() <= 1e-14, name
    furthest = small.normal(pressure)[-1, -1]
    point = SPACING**2 / np.pi / (np.sqrt(2.0) * (SIZE - 1) * SPACING)
    assert furthest == pytest.approx(point, rel=2e-3)


@pytest.mark.parametrize("materials", RANGE)
def test_reciprocity(materials):
    """Betti: either load does the same work on the displacement of the other; in all 3 parts.

    Traction and tangential displacement are over friction, their product over its square.
    """
    both = Compliance(SIZE, SPACING, materials)
    p, other_p = random(2, SIZE, SIZE, seed=3)
    q, other_q = random(2, 2, SIZE, SIZE, seed=4)

    def work(p, q, moved_by_p, moved_by_q):
        normal = both.normal(moved_by_p) + both.normal_of_traction(moved_by_q)
        tangential = both.tangential(moved_by_q) + both.tangential_of_pressure(moved_by_p)
        return np.sum(p * normal) + materials.friction**2 * np.sum(q * tangential)

    here, there = work(p, q, other_p, other_q), work(other_p, other_q, p, q)
    assert here == pytest.approx(there, rel=1e-11)
    if materials.beta:
        alone = np.sum(p * both.normal_of_traction(q))
        back = materials.friction**2 * np.sum(q * both.tangential_of_pressure(p))
        assert alone == pytest.approx(back, rel=1e-11)
        assert abs(alone) > 1e-3 * work(p, q, p, q)


@pytest.mark.parametrize("materials", RANGE)
def test_energy_is_positive(materials):
    """The least eigenvalue of the whole matrix of 3 x 36 loads, about its mean, is above 1 %."""
    size, friction = 6, materials.friction
    both = Compliance(size, SPACING, materials)
    columns = []
    for unit in np.eye(3 * size**2).reshape(-1, 3, size, size):
        p, q = unit[0], unit[1:] / friction
        normal = both.normal(p) + both.normal_of_traction(q)
        tangential = friction * (both.tangential(q) + both.tangential_of_pressure(p))
        columns.append(np.concatenate([normal[None], tangential]).ravel())
    matrix = np.array(columns)
    assert np.abs(matrix - matrix.T).max() <= 1e-14
    values = np.linalg.eigvalsh(matrix)
    assert values[0] >= 0.01 * values.mean()


@pytest.mark.parametrize("materials", RANGE)
def test_rough_inverse_is_positive(materials):
    """Without that conjugate gradients may break down; roughly the inverse: within 4 or so."""
    size = 8
    both = Compliance(size, SPACING, materials)

    def matrix(operator, parts):
        units = np.eye(parts * size**2).reshape(-1, parts, size, size)
        loads = units[:, 0] if parts == 1 else units
        return np.array([operator(load).ravel() for load in loads])

    for inverse, exact, parts in [
        (both.roughly_pressure, both.normal, 1),
        (both.roughly_traction, both.tangential, 2),
    ]:
        rough = matrix(inverse, parts)
        assert np.abs(rough - rough.T).max() <= 1e-12 * np.abs(rough).max()
        assert np.linalg.eigvalsh(rough)[0] > 0.0
        product = np.sort(np.linalg.eigvals(rough @ matrix(exact, parts)).real)
        assert product[0] > 0.2
        assert product[-1] < 5.0


def unfolded(field, mirrors, odd):
    """Return a field on both sides of its mirrors, by indices."""
    sign = -1.0 if odd else 1.0
    for axis, mirrored in enumerate(mirrors):
        if mirrored:
            field = np.concatenate([sign * np.flip(field, axis), field], axis)
    return field


@pytest.mark.parametrize("size", [8, 2 * DENSE_ELEMENTS + 4])  # as a product with a matrix, by FFT
@pytest.mark.parametrize("mirrors", [Mirrors(True, True), Mirrors(True, False), Mirrors(y=True)])
def test_a_mirrored_grid_gives_way_as_the_whole(size, mirrors):
    """Every operator, and both rough inverses."""
    materials = Materials(0.8, 0.0 if mirrors.x else 0.3, 0.5)
    whole, part = (Compliance(size, 0.2, materials, kept) for kept in (NO_MIRRORS, mirrors))
    shape = [size // 2 if mirrored else size for mirrored in mirrors]
    p, q = random(*shape), random(2, *shape, seed=2)

    def vector(field):
        return np.stack([unfolded(field[0], mirrors, False), unfolded(field[1], mirrors, True)])

    def scalar(field):
        return unfolded(field, mirrors, False)

    for name, load, values, actual in [
        *(("normal", p, scalar, scalar), ("tangential", q, vector, vector)),
        *(("normal_of_traction", q, vector, scalar), ("tangential_of_pressure", p, scalar, vector)),
        *(("roughly_pressure", p, scalar, scalar), ("roughly_traction", q, vector, vector)),
    ]:
        exact = getattr(whole, name)(values(load))
        off = np.abs(actual(getattr(part, name)(load)) - exact).max()
        assert off <= 1e-12 * max(np.abs(exact).max(), 1e-3), name


def test_unlike_materials_are_not_mirrored_along_the_motion():
    """Pressure pulls outwards, that is against itself in the mirror."""
    with pytest.raises(ValueError, match="odd there"):
        Compliance(8, 0.2, UNLIKE, Mirrors(x=True))


def test_diagonals_are_those_of_the_matrices():
    both = Compliance(SIZE, SPACING, UNLIKE)
    unit, middle = np.zeros((SIZE, SIZE)), SIZE // 2
    unit[middle, middle] = 1.0
    assert both.normal(unit)[middle, middle] == pytest.approx(both.normal_diagonal, rel=1e-13)
    moved = both.tangential(np.stack([unit, 0.0 * unit]))
    assert moved[0, middle, middle] == pytest.approx(both.tangential_diagonal, rel=1e-13)
    assert abs(moved[1, middle, middle]) <= 1e-15


def test_finer_elements_refine_the_same_displacement():
    """Of a smooth pressure, at the centre: errors fall with the square of the spacing."""
    entries = []
    for size in (15, 45, 135):
        patch = Patch(Compliance(size, 4.0 / size, Materials(1.0)))
        squares = patch.grid.line[:, None] ** 2 + patch.grid.line**2
        entries.append(patch.compliance.normal(np.exp(-4.0 * squares))[size // 2, size // 2])
    exact = np.sqrt(np.pi) / 2.0  # (1/pi) times 2 pi times the integral of exp(-4 r^2) over r
    coarse, fine, finest = np.abs(np.array(entries) - exact)
    assert finest <= 3e-4
    assert 5.0 < coarse / fine < fine / finest < 9.0
