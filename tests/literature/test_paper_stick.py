"""What Barber (1979) says of the stick phase, sentence by sentence; and where it is in error.

'Adhesive contact during the oblique impact of elastic spheres', J. Appl. Math. Phys. (ZAMP)
30:468-476. Equation numbers are the paper's.
"""

import mpmath as mp
import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.special import hyp2f1
from tests.oracles.stick import Stick, transition_speed

CHI_N = [((11 + 20 * n) ** 2 - 1) / 240 for n in range(6)]  # 1/2, 4, 65/6, 21, ...
SLIDING = [(1.05, 0.6), (1.5, 1.44), (2.8, 1.44), (5.0, 4.0), (12.0, 10.0), (3.0, 60.0)]


def gross_slip(psi, chi):
    """(33) again, by stepping the equation of motion until psi = v, (32): v, psi, d there."""

    def rates(t, y):
        d, v, _ = y
        return [v, -1.25 * d**1.5, -3.75 * chi * (2 / 3) * d**1.5]

    def excess(t, y):
        return y[2] - y[1]

    excess.terminal = True
    run = solve_ivp(rates, (0, 2.943), [0.0, 1.0, psi], events=excess, rtol=1e-12, atol=1e-14)
    return run.y_events[0][0] if run.y_events[0].size else None


def test_22_for_a_solid_sphere_gives_the_gauss_series_27():
    """(21), (22), (27): g = psi_1 F(alpha, beta; 3/5; x), by scipy's own sum up to x = 0.95."""
    chi = 1.44
    root = np.sqrt(240 * chi + 1)
    x = np.linspace(0.0, 0.95, 30)
    series = hyp2f1((11 + root) / 20, (11 - root) / 20, 0.6, x)
    np.testing.assert_allclose(Stick.from_touch(0.7, chi).g(x=x), 0.7 * series, rtol=1e-12)


def test_12_force_is_the_moment_of_g():
    """(12): F_x goes as the integral of s^2 g(s) ds, here Q = 2 integral b^2 g db."""
    for chi in (0.2, 1.44, 30.0):
        stick = Stick.from_touch(0.6, chi)
        for b in (0.2, 0.7, 0.95):
            moment, _ = quad(lambda r, s=stick: 2 * r**2 * s.g(x=r**5), 0.0, b, epsrel=1e-11)
            assert stick.force(x=b**5) == pytest.approx(moment, rel=1e-10, abs=1e-13)


@pytest.mark.parametrize(("psi", "chi"), SLIDING)
def test_12_holds_after_gross_slip_with_g_1_inside(psi, chi):
    """After (35): g(s) = 1 where contact was laid in gross slip, the solution outside."""
    stick = Stick.after_gross_slip(psi, chi)
    b0 = (1 - stick.start**2) ** 0.2
    b = (1 - (0.6 * stick.start) ** 2) ** 0.2
    moment, _ = quad(lambda r: 2 * r**2 * stick.g(x=r**5), b0, b, epsrel=1e-11)
    assert stick.force(x=b**5) == pytest.approx(2 / 3 * b0**3 + moment, rel=1e-10)


@pytest.mark.parametrize("chi", [0.05, 0.5, 1.44, 10.0])
def test_10_and_14_displacement_velocity_force(chi):
    """(10) U' = psi = g v and (14) psi' = -(15/4) chi Q, by stepping both in time."""
    stick = Stick.from_touch(0.6, chi)

    def rates(t, y):
        d, v, psi, force, _ = y
        return [v, -1.25 * d**1.5, -3.75 * chi * force, psi * d**0.5, psi]

    run = solve_ivp(
        rates, (0, 1.3), [0, 1, 0.6, 0, 0], rtol=1e-11, atol=1e-13, t_eval=np.linspace(0.1, 1.3, 7)
    )
    _, v, psi, force, moved = run.y
    np.testing.assert_allclose(stick.psi(v), psi, atol=2e-9)
    np.testing.assert_allclose(stick.force(v), force, atol=2e-9)
    np.testing.assert_allclose(stick.displacement(v), moved, atol=2e-9)


@pytest.mark.parametrize("chi", [0.05, 0.5, 1.44, 100.0])
def test_26_g_starts_at_psi_1_without_slope(chi):
    """(26) g(0) = psi_1, and g' is of order b^4: g - psi_1 = (1 - 2 chi)/2 psi_1 b^5."""
    stick = Stick.from_touch(0.6, chi)
    assert stick.g(1.0) == 0.6
    b = np.array([1e-2, 2e-2])
    rise = stick.g(x=b**5) - 0.6
    np.testing.assert_allclose(rise, 0.3 * (1 - 2 * chi) * b**5, rtol=1e-4, atol=1e-16)


@pytest.mark.parametrize("chi", [0.6, 1.44, 4.0, 30.0])
def test_34_contains_the_three_borders(chi):
    """V_z = V_1 at psi_1 = 1, 0 at 2 chi, -V_1 at 4 chi - 1."""
    assert transition_speed(1.0, chi) == pytest.approx(1.0, rel=1e-14)
    assert transition_speed(2 * chi, chi) == 0.0
    assert transition_speed(4 * chi - 1, chi) == pytest.approx(-1.0, rel=1e-12)
    slides_on = 4 * chi - 1 + 1e-6
    speeds = np.linspace(-1, 1, 201)
    assert np.all(slides_on - 2 * chi * (1 - speeds) > speeds)  # (33) never meets (32)


@pytest.mark.parametrize(("psi", "chi"), SLIDING)
def test_31_to_34_sliding_stops_where_the_equation_of_motion_says(psi, chi):
    """(33) and (34) against gross slip stepped in time until psi = v."""
    _, v, psi_then = gross_slip(psi, chi)
    assert transition_speed(psi, chi) == pytest.approx(v, rel=1e-8)
    stick = Stick.after_gross_slip(psi, chi)
    assert stick.start == pytest.approx(v, rel=1e-8)
    assert stick.psi(stick.start) == pytest.approx(psi_then, rel=1e-8)


@pytest.mark.parametrize(("psi", "chi"), SLIDING)
def test_31_sliding_stops_at_all_points_at_once(psi, chi):
    """(29), (30): the surfaces move at the same rate at every r and theta, and V_x meets it."""
    stick = Stick.after_gross_slip(psi, chi)
    v = stick.start
    d, nu = (1 - v**2) ** 0.4, 0.3

    def surface(depth, s, theta):
        """(29) in units of mu d_max/kappa, s = r^2/(R d_max), b^2 = R d_max depth."""
        unit = (2 - nu) / (2 * (1 - nu))
        two_d = 2 * (2 - nu) * (2 * depth - s) + nu * s * np.cos(2 * theta)
        return two_d / (8 * (1 - nu)) / unit

    draw = np.random.default_rng(7)
    s, theta = d * draw.uniform(0, 1, 20), draw.uniform(0, 2 * np.pi, 20)
    rate = v * (surface(d + 1e-3, s, theta) - surface(d - 1e-3, s, theta)) / 2e-3
    np.testing.assert_allclose(rate, stick.psi(v), rtol=1e-11)


@pytest.mark.parametrize(("psi", "chi"), SLIDING)
def test_velocity_and_force_are_continuous_at_the_transition(psi, chi):
    """'For continuity in velocity and force': g = 1, psi = v, Q = (2/3) d^(3/2), U as in (33)."""
    stick = Stick.after_gross_slip(psi, chi)
    v = stick.start
    assert stick.g(v) == pytest.approx(1.0, rel=1e-13)
    assert stick.psi(v) == pytest.approx(v, rel=1e-13)
    assert stick.force(v) == pytest.approx(2 / 3 * (1 - v**2) ** 0.6, rel=1e-13)


def slope_at_transition(stick):
    """b g'(b) just after gross slip, by a one-sided difference of the third order."""
    b0 = (1 - stick.start**2) ** 0.2
    h = 1e-4 * b0 * stick.start**2
    g = stick.g(x=(b0 + h * np.arange(4)) ** 5)
    return b0 * float(np.dot([-11 / 6, 3, -3 / 2, 1 / 3], g)) / h


@pytest.mark.parametrize(("psi", "chi"), SLIDING)
def test_erratum_35_slope_at_the_transition_is_not_zero(psi, chi):
    """(14) with a continuous force gives b g' = (5/2) (1 - 2 chi) x/(1 - x), not (35)'s g' = 0."""
    stick = Stick.after_gross_slip(psi, chi)
    x = 1 - stick.start**2
    expected = 2.5 * (1 - 2 * chi) * x / (1 - x)
    assert slope_at_transition(stick) == pytest.approx(expected, rel=1e-5)
    # the force by (14), in units of Q, from g = 1 and a slope: 2/3 d^(3/2) needs that slope
    for slope, ratio in ((expected, 1.0), (0.0, 1 / (2 * chi))):
        force = 4 / (15 * chi) / x**0.4 * (1.25 * x - 0.5 * (1 - x) * slope)
        assert force == pytest.approx(ratio * 2 / 3 * x**0.6, rel=1e-12)


@pytest.mark.parametrize(("psi", "chi"), SLIDING)
def test_stick_after_gross_slip_follows_from_the_equations_of_motion(psi, chi):
    """Velocity and force after (34), by stepping psi' = -(15/4) chi Q and Q' = psi sqrt(d)."""
    stick = Stick.after_gross_slip(psi, chi)
    v = stick.start
    d = (1 - v**2) ** 0.4

    def rates(t, y):
        d, v, psi, force = y
        return [v, -1.25 * d**1.5, -3.75 * chi * force, psi * d**0.5]

    def halfway(t, y):
        return y[1] - 0.5 * stick.start

    halfway.terminal = True
    state = [d, v, v, 2 / 3 * d**1.5]
    run = solve_ivp(rates, (0, 2), state, rtol=1e-11, atol=1e-13, events=halfway)
    _, speed, velocity, force = run.y_events[0][0]
    assert stick.psi(speed) == pytest.approx(velocity, abs=1e-8)
    assert stick.force(speed) == pytest.approx(force, abs=1e-8)


def test_stick_ends_before_maximum_penetration():
    """Section 6: 2 chi > 1 ends stick at V_z > 0, by unbounded g; random psi_1 and chi."""
    draw = np.random.default_rng(30468)
    for _ in range(15):
        chi = draw.uniform(0.55, 30.0)
        assert 0.0 < Stick.from_touch(draw.uniform(0.05, 1.0), chi).end < 1.0
        slid = Stick.after_gross_slip(1 + draw.uniform(0.01, 0.99) * (2 * chi - 1), chi)
        assert 0.0 < slid.end < slid.start


@pytest.mark.first_case
@pytest.mark.parametrize("n", range(4))
def test_exceptions_where_f_is_a_polynomial(n):
    """chi_n = ((11 + 20 n)^2 - 1)/240: stick to the turning point for |psi_1| <= 1/max|F|."""
    chi = CHI_N[n]
    v = np.sin(np.linspace(1e-3, np.pi / 2, 2001))
    v[0] = 1e-9
    largest = np.abs(Stick.from_touch(1.0, chi).g(v)).max()
    if n < 3:
        assert 1 / largest == pytest.approx([1.0, 0.4, 0.256][n], rel=2e-3)
    quiet = Stick.from_touch(0.999999 / largest, chi)
    assert quiet.end is None
    assert quiet.slip_sign == 0
    if n:
        assert Stick.from_touch(1.01 / largest, chi).end is not None


@pytest.mark.parametrize(("psi", "chi"), [(0.4, 4.0), (-0.4, 4.0), (1.0, 0.5)])
def test_touching_the_limit_is_no_slip(psi, chi):
    """|g| = 1 at the turning point itself, or all along: stick lasts."""
    assert Stick.from_touch(psi, chi).end is None


@pytest.mark.parametrize("psi", [1e-6, 0.01, 0.3, 0.99])
@pytest.mark.parametrize(
    ("chi", "sign"), [(0.05, 1), (0.499, 1), (0.501, -1), (1.44, -1), (3.99, -1)]
)
def test_sense_of_the_first_microslip(psi, chi, sign):
    """Section 6: with the initial motion for chi < 1/2, against it for 1/2 < chi < 4."""
    assert Stick.from_touch(psi, chi).slip_sign == sign
    assert Stick.from_touch(-psi, chi).slip_sign == -sign


@pytest.mark.parametrize(("chi", "sign"), [(4.01, 1), (10.8, 1), (10.9, -1), (20.9, -1), (21.1, 1)])
def test_sense_of_the_first_microslip_alternates_for_small_psi(chi, sign):
    """Correction to section 6: g goes to -infinity for 1/2 < chi < 4 only, then by turns."""
    assert Stick.from_touch(1e-3, chi).slip_sign == sign
    assert np.sign(Stick.from_touch(1e-3, chi).g(1e-9)) == sign


def test_sense_after_gross_slip_is_against_the_initial_motion():
    """'A state in which a surrounding annulus slips in the reverse sense.'"""
    for psi, chi in SLIDING:
        assert Stick.after_gross_slip(psi, chi).slip_sign == -1
        assert Stick.after_gross_slip(-psi, chi).slip_sign == 1


@pytest.mark.parametrize("psi", [-1.0, 0.3, 1.0])
def test_36_and_37_constant_g_at_chi_one_half(psi):
    """chi = 1/2: h_1 = 1, g = psi_1 and stick, to the last digit and to the turning point."""
    stick = Stick.from_touch(psi, 0.5)
    v = np.array([1.0, 0.5, 1e-3, 1e-9, 0.0])
    np.testing.assert_array_equal(stick.g(v), psi)
    assert stick.end is None
    d = (1 - v**2) ** 0.4
    np.testing.assert_allclose(stick.displacement(v), psi * d, rtol=1e-15, atol=0)
    np.testing.assert_allclose(stick.force(v), psi * 2 / 3 * d**1.5, rtol=1e-15, atol=0)


@pytest.mark.parametrize(("psi", "chi"), [(1.5, 0.4), (0.999, 0.4), (1.0, 0.49), (1.0001, 0.5)])
def test_below_one_half_stick_only_at_the_beginning(psi, chi):
    """Section 6: for chi < 1/2 gross slip gives way to no stick; psi - v grows in it."""
    with pytest.raises(ValueError, match="psi"):
        Stick.after_gross_slip(psi, chi)


@pytest.mark.parametrize("chi", [0.05, 1.44, 10.0, 100.0])
def test_15_differential_equation(chi):
    """(1 - x) b^2 g'' - (1 + 13 x/2) b g' + 15 x (2 chi - 1) g/2 = 0, with Chebyshev slopes."""
    stick = Stick.from_touch(0.5, chi)
    for middle in (0.3, 0.6, 0.85):
        g = np.polynomial.Chebyshev.interpolate(
            lambda b: stick.g(x=b**5), 18, domain=[middle - 0.05, middle + 0.05]
        )
        b = middle + np.linspace(-0.03, 0.03, 11)
        x = b**5
        terms = np.array(
            [
                (1 - x) * b**2 * g.deriv(2)(b),
                -(1 + 6.5 * x) * b * g.deriv()(b),
                7.5 * x * (2 * chi - 1) * g(b),
            ]
        )
        assert np.abs(terms.sum(axis=0)).max() <= 2e-9 * np.abs(terms).max()


@pytest.mark.parametrize("chi", [0.05, 0.5, 1.44, 4.0, 65 / 6, 100.0])
def test_exponent_minus_one_half_at_the_turning_point(chi):
    """g agrees with the 1 - x connection formula (DLMF 15.8.4), which shows the (1 - x)^(-1/2)."""
    stick = Stick.from_touch(1.0 if chi >= 0.5 else 0.5, chi)
    with mp.workdps(40):
        root, c = mp.sqrt(240 * mp.mpf(chi) + 1), mp.mpf(3) / 5
        a, b = (11 + root) / 20, (11 - root) / 20
        for v in (0.3, 1e-3, 1e-6):
            y = mp.mpf(v) ** 2
            regular = mp.gammaprod([c, c - a - b], [c - a, c - b]) * mp.hyp2f1(a, b, 1.5, y)
            singular = mp.gammaprod([c, a + b - c], [a, b]) * mp.hyp2f1(c - a, c - b, 0.5, y)
            true = float(stick.psi_1 * (regular + singular / mp.mpf(v)))
            assert stick.g(v) == pytest.approx(true, rel=1e-14)
