"""Fields at the surface against closed forms, and slip against displacements at two times."""

import numpy as np
import pytest

import carom
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import coefficients, flat, radii, stacked
from carom.dimensionless.numerics.chebyshev import evaluate

IMPACTS = [
    (0.5, 1.44),  # stick, slip -, gross slip -
    (1.5, 1.44),  # gross slip +, stick, slip -, gross slip -
    (3.5, 1.44),  # gross slip + through maximum penetration
    (0.3, 1.75),  # the ring closes
    (0.2, 4.0),  # retraces its path
    (0.9525, 4.3),  # sticks again while loading
    (62.7, 40.0),  # gross slip twice
    (1e-9, 1.44),
    (-0.5, 1.44),
]
NU_RATIO = 0.3 / 1.7


def constant(g, d):
    """Return the profile of constant g on a contact of penetration d."""
    b = float(np.sqrt(d))
    return stacked([b], [flat(0.0, b, g, 0.0)])


def sampled(profile, d, r):
    """Return p, f, u_z, u_0, u_2 at radii."""
    out = np.empty((np.size(r), 5))
    surface.sample(profile, d, d, 0.0, np.atleast_1d(r).astype(float), out)
    return out.T


def test_a_panel_reproduces_polynomials():
    low, high, x = 0.3, 0.9, np.linspace(0.3, 0.9, 50)
    row = coefficients(radii(low, high) ** 12 - 2.0 * radii(low, high) ** 3)
    values = np.array([evaluate(row, low, high, at) for at in x])
    assert np.max(np.abs(values - x**12 + 2.0 * x**3)) <= 2e-15


@pytest.mark.parametrize(("psi", "chi"), IMPACTS)
@pytest.mark.parametrize("place", [0.1, 0.45, 0.6, 0.9])
def test_profile_is_the_memory(psi, chi, place):
    """The panels give g, q and the force Q = int q dx = 2 int g x^2 dx of the memory."""
    solution = carom.solve(psi, chi)
    time = place * solution.duration
    memory, force = solution.memory(time), solution.at(time).force[0]
    edges, rows_q, rows_g, *_ = memory.profile()
    assert edges[0] == 0.0
    assert edges[-1] == np.sqrt(memory.penetration)
    nodes, weights = np.polynomial.legendre.leggauss(20)
    by_q = by_g = 0.0
    for low, high, row_q, row_g in zip(edges, edges[1:], rows_q, rows_g, strict=False):
        x, w = low + 0.5 * (high - low) * (1.0 + nodes), 0.5 * (high - low) * weights
        q = np.array([evaluate(row_q, low, high, at) for at in x])
        g = np.array([evaluate(row_g, low, high, at) for at in x])
        assert np.max(np.abs(q - memory.q(x**2))) <= 2e-14
        assert np.max(np.abs(g - memory.g(x**2))) * np.sqrt(high - low) <= 2e-14
        by_q += w @ q
        by_g += 2.0 * w @ (g * x**2)
    assert abs(by_q - force) <= 2e-13
    assert abs(by_g - force) <= 2e-13


def test_gross_slip_gives_28_and_29():
    """g = 1: f = sqrt(b^2 - r^2), u_x = b^2 - r^2/2 + lambda (r^2/4) cos 2 theta inside."""
    d, r = 0.7, np.linspace(0.0, np.sqrt(0.7), 30)
    p, f, u_z, u_0, u_2 = sampled(constant(1.0, d), d, r)
    assert np.max(np.abs(p - np.sqrt(np.maximum(d - r**2, 0.0)))) <= 1e-16
    assert np.max(np.abs(f - p)) <= 2e-15
    assert np.max(np.abs(u_z - (d - 0.5 * r**2))) <= 1e-16
    assert np.max(np.abs(u_0 - (d - 0.5 * r**2))) <= 2e-15
    assert np.max(np.abs(u_2 - 0.25 * r**2)) <= 2e-15


def test_outside_a_sliding_contact():
    """Outside, u_0 is Hertz's u_z (Johnson 1985, 3.42a); u_2 is the mean of u_0 over the disc
    of radius r minus u_0(r), since the potential of the traction is harmonic.
    """
    d, r = 0.7, np.array([0.84, 0.9, 1.3, 4.0, 50.0])
    _p, f, u_z, u_0, u_2 = sampled(constant(1.0, d), d, r)
    assert np.all(f == 0.0)
    a = np.sqrt(d)
    johnson = ((2 * d - r**2) * np.arcsin(a / r) + r * a * np.sqrt(1 - d / r**2)) / np.pi
    assert np.max(np.abs(u_0 - johnson)) <= 2e-15 * 50**2
    assert np.max(np.abs(u_0 - u_z)) <= 2e-15 * 50**2
    nodes, weights = np.polynomial.legendre.leggauss(400)
    for at, ours, local in zip(r[:3], u_2[:3], u_0[:3], strict=True):
        inside = d**2 / 2 - d**2 / 8
        x = a + 0.5 * (at - a) * (1.0 + nodes)
        ring = 0.5 * (at - a) * weights @ (x * sampled(constant(1.0, d), d, x)[3])
        assert abs(2.0 / at**2 * (inside + ring) - local - ours) <= 1e-8


def test_cattaneo_is_sliding_minus_sliding_of_the_stick_zone():
    """g = 1 on [a, b] and 0 on [0, a]: f = sqrt(b^2 - r^2) - sqrt(a^2 - r^2), u_x uniform inside a
    (Cattaneo 1938; Mindlin 1949)."""
    a, b, r = 0.5, 0.9, np.linspace(0.0, 2.0, 81)
    q_a = b**2 - a**2
    ring = stacked([a, b], [flat(0.0, a, 0.0, q_a), flat(a, b, 1.0, 0.0)])
    whole, part = (sampled(constant(1.0, d), d, r) for d in (b**2, a**2))
    assert np.max(np.abs(sampled(ring, b**2, r)[[1, 3, 4]] - (whole - part)[[1, 3, 4]])) <= 3e-15
    stick = r < a
    assert np.ptp(sampled(ring, b**2, r)[3][stick]) <= 1e-15
    assert np.max(np.abs(sampled(ring, b**2, r)[4][stick])) <= 1e-15


def test_slip_angles_of_phases():
    solution = carom.solve(1.5, 1.44)
    angles = solution.slip_angles(NU_RATIO)
    for phase, angle in zip(solution.phases, angles, strict=True):
        if phase.kind == "slip":
            assert angle.largest == np.arcsin(NU_RATIO)
            assert 0.0 < angle.mean < angle.largest
        else:
            assert angle == (0.0, 0.0)
    assert all(angle == (0.0, 0.0) for angle in solution.slip_angles(0.0))
