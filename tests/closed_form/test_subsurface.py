"""The stress below a contact against closed forms, other integrations, and the field equations."""

import numpy as np
import pytest
from tests.oracles.point_forces import boussinesq, cerruti, summed

from carom.dimensionless.fields import subsurface
from carom.dimensionless.fields.profile import coefficients, flat, radii, stacked
from carom.dimensionless.fields.subsurface import stresses

STICK = 0.6  # radius of Cattaneo's stick zone
FRICTION = 0.7
SPREAD = np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False)

SLIDING = stacked([1.0], [flat(0.0, 1.0, 1.0, 0.0)])
CATTANEO = stacked([STICK, 1.0], [flat(0.0, STICK, 0.0, 0.0), flat(STICK, 1.0, 1.0, 0.0)])
CURVED = stacked(  # g = s^2 in two panels
    [0.3, 1.0],
    [(np.zeros(17), coefficients(radii(low, high) ** 2)) for low, high in [(0.0, 0.3), (0.3, 1.0)]],
)
BOTH = pytest.mark.parametrize("poisson", [0.0, 0.3, 0.5])


def places(n, seed=7):
    generator = np.random.default_rng(seed)
    r, angle = generator.uniform(0.05, 2.0, n), generator.uniform(0.0, 2.0 * np.pi, n)
    return np.stack([r * np.cos(angle), r * np.sin(angle), generator.uniform(0.3, 2.0, n)], axis=-1)


def hemisphere(r, radius=1.0):
    return np.sqrt(np.maximum(radius**2 - r * r, 0.0))


TRACTIONS = [
    (SLIDING, hemisphere),
    (CATTANEO, lambda r: hemisphere(r) - hemisphere(r, STICK)),
    (CURVED, lambda r: hemisphere(r) * (1.0 + 2.0 * r * r) / 3.0),
]


@BOTH
def test_axis_of_hertz(poisson):
    """Johnson (1985), section 3.4: -p_0/(1 + z^2), and sigma_r with an arc tangent."""
    z = np.array([1e-12, 1e-6, 0.01, 0.48, 1.0, 10.0, 1e3])
    stress = stresses(np.outer(z, [0, 0, 1]), SLIDING, friction=0.0, poisson=poisson)
    radial = -(1.0 + poisson) * (1.0 - z * np.arctan(1.0 / z)) + 0.5 / (1.0 + z * z)
    expected = np.stack([radial, radial, -1.0 / (1.0 + z * z), 0 * z, 0 * z, 0 * z], axis=-1)
    assert np.abs(stress - expected).max() < 1e-13


@BOTH
def test_surface_of_hertz(poisson):
    """Johnson (1985), section 3.4: radial and hoop stress inside, at the edge, outside."""
    r = np.array([1e-9, 1e-3, 0.3, 0.999, 1.0, 1.001, 1.5, 40.0])
    stress = stresses(np.outer(r, [1, 0, 0]), SLIDING, friction=0.0, poisson=poisson)
    p = hemisphere(r)
    part = (1.0 - 2.0 * poisson) / 3.0 * (1.0 + p + p * p) / (1.0 + p)  # (1 - p^3)/r^2
    part = np.where(r > 1.0, (1.0 - 2.0 * poisson) / 3.0 / r**2, part)
    assert np.abs(stress[:, 0] - (part - p)).max() < 1e-13
    assert np.abs(stress[:, 1] - (-part - 2.0 * poisson * p)).max() < 1e-13


@pytest.mark.parametrize(("profile", "traction"), TRACTIONS)
def test_traction_on_the_surface(profile, traction):
    """sigma_zz = -p, sigma_xz = -mu f, sigma_yz = 0, with f integrated in closed form."""
    r = np.array([0.0, 1e-7, 0.2, STICK, 0.61, 0.9, 0.9999, 1.0, 1.0001, 3.0, 1e3])
    for angle in (0.0, 1.0, 4.0):
        at = np.outer(r, [np.cos(angle), np.sin(angle), 0.0])
        stress = stresses(at, profile, friction=FRICTION, poisson=0.3)
        assert stress[:, 2] == pytest.approx(-hemisphere(np.hypot(*at.T[:2])), abs=3e-8)
        smooth = np.abs(r - 1.0) > 1e-9  # at the edge the radius itself is rounded
        assert stress[smooth, 2] == pytest.approx(-hemisphere(r[smooth]), abs=1e-12)
        assert stress[smooth, 4] == pytest.approx(-FRICTION * traction(r[smooth]), abs=2e-8)
        smooth &= np.abs(r - STICK) > 1e-9
        assert stress[smooth, 4] == pytest.approx(-FRICTION * traction(r[smooth]), abs=1e-12)
        assert np.abs(stress[:, 5]).max() == 0.0


def one(r):
    return np.ones_like(r)


@BOTH
def test_boussinesq_and_cerruti_over_the_contact(poisson):
    """Pressure and three tractions, integrated over the surface with the textbook's point forces:
    sliding, partial slip, and one with g = s^2.
    """
    for at in places(12):
        pressure = summed(boussinesq, at, poisson, one)
        whole = summed(cerruti, at, poisson, one)
        inner = summed(cerruti, at, poisson, one, radius=STICK)
        curved = summed(cerruti, at, poisson, lambda r: (1.0 + 2.0 * r * r) / 3.0)
        for profile, pulled in [(SLIDING, whole), (CATTANEO, whole - inner), (CURVED, curved)]:
            stress = stresses(at[np.newaxis], profile, friction=FRICTION, poisson=poisson)[0]
            assert stress == pytest.approx(pressure + FRICTION * pulled, abs=1e-11)


@BOTH
def test_sliding_surface_is_linear_inside(poisson):
    """Under f = mu p the displacement (29) of Barber (1979) is quadratic, the stress linear:
    sigma_xx = -(pi/8)(4 + nu) mu x, sigma_yy = -(3 pi/8) nu mu x, sigma_xy = -(pi/8)(2 - nu) mu y.
    """
    at = places(20) * [0.45, 0.45, 0.0]
    both = stresses(at, SLIDING, friction=FRICTION, poisson=poisson)
    pulled = both - stresses(at, SLIDING, friction=0.0, poisson=poisson)
    x, y = FRICTION * np.pi / 8.0 * at[:, :2].T
    expected = [-(4.0 + poisson) * x, -3.0 * poisson * x, -(2.0 - poisson) * y]
    assert pulled[:, [0, 1, 3]] == pytest.approx(np.stack(expected, axis=-1), abs=1e-13)


def differences(profile, at, poisson, h):
    """Return the stress and its first and second derivatives at a point, of fourth order."""
    near = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / (12.0 * h)
    steps = h * np.stack(np.meshgrid(*[np.arange(-2, 3)] * 3, indexing="ij"), axis=-1)
    cube = stresses((at + steps).reshape(-1, 3), profile, friction=FRICTION, poisson=poisson)
    tensor = cube[:, [[0, 3, 4], [3, 1, 5], [4, 5, 2]]].reshape(5, 5, 5, 3, 3)
    here = np.array([0.0, 0.0, 1.0, 0.0, 0.0])
    bend = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / (12.0 * h * h)

    def derivative(*axes):
        rows = [here, here, here]
        for axis in axes:
            rows[axis] = near if axes.count(axis) == 1 else bend
        return np.einsum("i,j,k,ijkab->ab", *rows, tensor)

    first = np.array([derivative(k) for k in range(3)])
    second = np.array([[derivative(k, m) for m in range(3)] for k in range(3)])
    return first, second


@pytest.mark.parametrize("profile", [SLIDING, CATTANEO, CURVED])
def test_equilibrium_and_compatibility(profile):
    """div sigma = 0, and Beltrami and Michell: laplace sigma + grad grad tr sigma/(1 + nu) = 0."""
    poisson = 0.3
    for at in places(4):
        first, second = differences(profile, at, poisson, 4e-3)
        assert np.abs(np.einsum("kkb->b", first)).max() < 1e-8
        laplace = np.einsum("kkab->ab", second)
        trace = np.einsum("abkk->ab", second)
        assert np.abs(laplace + trace / (1.0 + poisson)).max() < 1e-6


@pytest.mark.parametrize(
    ("profile", "pull"), [(SLIDING, 1.0), (CATTANEO, 1.0 - STICK**3), (CURVED, 0.6)]
)
def test_forces_through_a_plane(profile, pull):
    """The stress on a plane below carries P = 2 pi/3 and F_x = 2 pi mu times the integral of
    g s^2, and no lateral force.
    """
    nodes, weights = np.polynomial.legendre.leggauss(60)
    t = np.pi / 4 * (1.0 + nodes)
    r, angle = np.meshgrid(np.tan(t), SPREAD)
    at = np.stack([r * np.cos(angle), r * np.sin(angle), np.ones_like(r)], axis=-1)
    stress = stresses(at.reshape(-1, 3), profile, friction=FRICTION, poisson=0.3)
    area = np.pi / 4 * weights * np.tan(t) / np.cos(t) ** 2 * (2.0 * np.pi / SPREAD.size)
    force = np.einsum("ijk,j->k", stress.reshape(*r.shape, 6), area)
    whole = 2.0 * np.pi / 3.0
    assert force[[2, 4, 5]] == pytest.approx([-whole, -FRICTION * whole * pull, 0.0], abs=1e-10)


def test_symmetries():
    """Friction is odd in x, pressure even; both are even in y: components flip accordingly."""
    at = places(30)
    stress = stresses(at, CURVED, friction=FRICTION, poisson=0.3)
    turned = stresses(at * [-1, 1, 1], CURVED, friction=-FRICTION, poisson=0.3)
    beside = stresses(at * [1, -1, 1], CURVED, friction=FRICTION, poisson=0.3)
    assert np.abs(turned - stress * [1, 1, 1, -1, -1, 1]).max() < 1e-14
    assert np.abs(beside - stress * [1, 1, 1, -1, 1, -1]).max() < 1e-14


def test_partial_slip_is_a_difference_of_slidings():
    """Cattaneo's traction is that of sliding on b less that of sliding on a: scaled by the radius,
    at any depth and next to the edges.
    """
    at = places(40) * [1.0, 1.0, 1e-3]
    at[:8, :2] *= STICK / np.hypot(*at[:8, :2].T)[:, np.newaxis]

    def pulled(points, profile):
        with_it = stresses(points, profile, friction=FRICTION, poisson=0.3)
        return with_it - stresses(points, profile, friction=0.0, poisson=0.3)

    expected = pulled(at, SLIDING) - STICK * pulled(at / STICK, SLIDING)
    assert np.abs(pulled(at, CATTANEO) - expected).max() < 1e-12


@pytest.mark.first_case
@pytest.mark.parametrize("depth", [1e-12, 1e-9, 1e-6, 1e-3, 0.1, 1e3])
def test_near_the_edges(depth, monkeypatch):
    """The same integral over panels that halve towards s = r, where it is nearly singular."""
    monkeypatch.setattr(subsurface, "inverse", lambda c: 1.0 / c)
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for r in (0.0, 1e-7, 0.3, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.5):
        at = (0.6 * r, 0.8 * r, depth)
        parts = np.zeros(subsurface.PARTS)
        halved = 0.5 ** np.arange(-1, 48)
        cuts = np.unique(np.clip(np.concatenate([-halved, [0.0], halved]), -r, 1.0 - r))
        half = 0.5 * np.diff(cuts)[:, np.newaxis]
        beyond = cuts[:-1, np.newaxis] + half * (1.0 + nodes)
        s = r + beyond
        distance = np.sqrt((depth + 1j * beyond) * (depth + 1j * (s + r)))
        amounts = half * weights * s, half * weights * s**3  # of CURVED, g = s^2
        points = (depth + 1j * s, distance, *amounts)
        for zeta, away, push, pull in zip(*map(np.ravel, points), strict=True):
            subsurface.add_point.py_func(parts, r, depth, zeta, away, 0.3, push, pull)
        expected = np.empty(6)
        subsurface.turn(expected, parts, 0.6, 0.8, FRICTION)
        stress = stresses([at], CURVED, friction=FRICTION, poisson=0.3)[0]
        assert stress == pytest.approx(expected, abs=3e-13)
