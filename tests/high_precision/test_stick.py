"""The closed form of the stick phase against the paper's hypergeometric functions in 60 digits."""

from functools import lru_cache

import mpmath as mp
import numpy as np
import pytest

from carom.dimensionless.twins.doubledouble import (
    DoubleDouble,
    coefficients,
    fifth_root,
    square_root,
)
from carom.dimensionless.twins.stick import Stick, transition_speed

CHI = (0.05, 0.2, 0.499999999, 0.5, 0.500000001, 1.44, 4.0, 10.0, 65 / 6, 30.0, 60.0, 100.0)
X = (0.0, 1e-10, 1e-6, 1e-3, 0.05, 0.2, 0.5, 0.8, 0.95, 0.99, 1 - 1e-4, 1 - 1e-6, 1 - 1e-9)
X_ALL = (*X, 1 - 1e-12)
SPEEDS = (1.0, 1 - 1e-10, 0.9, 0.6, 0.3, 0.1, 1e-3, 1e-6)
# Of the value itself, not only of the local envelope: near zeros and near v = 0, too.
TOLERANCE = 1e-14


@pytest.fixture(autouse=True)
def _sixty_digits():
    with mp.workdps(60):
        yield


def parameters(chi):
    """The paper's (22)."""
    root = mp.sqrt(240 * mp.mpf(chi) + 1)
    return (11 + root) / 20, (11 - root) / 20, mp.mpf(3) / 5


@lru_cache(maxsize=4096)
def solutions(chi, x):
    """h_1, h_2 of (20) and x^(3/5) times their derivatives."""
    a, b, c = parameters(chi)
    first = mp.hyp2f1(a, b, c, x)
    slope = a * b / c * mp.hyp2f1(a + 1, b + 1, c + 1, x)
    a, b, c = a - c + 1, b - c + 1, 2 - c
    inner = mp.hyp2f1(a, b, c, x)
    inner_slope = a * b / c * mp.hyp2f1(a + 1, b + 1, c + 1, x)
    second = mp.power(x, mp.mpf(2) / 5) * inner
    second_slope = 2 * inner / 5 + x * inner_slope
    return first, second, mp.power(x, mp.mpf(3) / 5) * slope, second_slope


def place(v=None, x=None):
    """v and x in full digits of a place given as a double."""
    if x is None:
        return mp.mpf(v), 1 - mp.mpf(v) ** 2
    return mp.sqrt(1 - mp.mpf(x)), mp.mpf(x)


def reference(chi, constants, v=None, x=None):
    """g, psi = g v and Q = -(4/(15 chi)) psi' of constants[0] h_1 + constants[1] h_2."""
    v, x = place(v, x)
    h1, h2, s1, s2 = solutions(chi, x)
    g = constants[0] * h1 + constants[1] * h2
    slope = constants[0] * s1 + constants[1] * s2  # x^(3/5) dg/dx
    bend = mp.power(x, mp.mpf(3) / 5) * g
    force = -2 / (3 * mp.mpf(chi)) * (slope * v**2 - bend / 2)
    return g, g * v, force


def gross_slip_constants(psi, chi):
    """The constants that make psi and Q continuous at (34), by solving two linear equations."""
    psi, chi_exact = mp.mpf(psi), mp.mpf(chi)
    v = (psi - 2 * chi_exact) / (1 - 2 * chi_exact)
    x = 1 - v * v
    columns = [reference(chi, unit, v=v) for unit in ((1, 0), (0, 1))]
    matrix = mp.matrix([[c[1] for c in columns], [c[2] for c in columns]])
    force = 2 * mp.power(x, mp.mpf(3) / 5) / 3
    return tuple(mp.lu_solve(matrix, mp.matrix([v, force])))


def assert_close(found, true, tolerance=TOLERANCE):
    __tracebackhide__ = True
    assert abs(mp.mpf(float(found)) - true) <= tolerance * abs(true), (found, mp.nstr(true, 20))


def sliding(chi):
    """Incidences with stick after gross slip: early, in the middle, late."""
    return [1 + part * (2 * chi - 1) for part in (0.01, 0.4, 0.999)]


@pytest.mark.parametrize("chi", CHI)
def test_from_touch_is_h1(chi):
    """g = psi_1 h_1, psi = g v and the force are those of (27), in relative error."""
    stick = Stick.from_touch(0.75, chi)
    for x in X_ALL:
        g, psi, force = reference(chi, (mp.mpf(0.75), 0), x=x)
        assert_close(stick.g(x=x), g)
        assert_close(stick.psi(x=x), psi)
        assert_close(stick.force(x=x), force)


@pytest.mark.parametrize("chi", CHI)
def test_speed_keeps_its_digits(chi):
    """Places given as the speed: 1 - x = v^2 does not lose digits near the turning point."""
    stick = Stick.from_touch(0.75, chi)
    for v in SPEEDS:
        g, psi, force = reference(chi, (mp.mpf(0.75), 0), v=v)
        assert_close(stick.g(v), g)
        assert_close(stick.psi(v), psi)
        assert_close(stick.force(v), force)


@pytest.mark.parametrize("chi", [c for c in CHI if c > 0.5])
def test_after_gross_slip_mixes_h1_and_h2(chi):
    """psi and Q continuous at (34): h_1 and h_2 with constants found by linear algebra."""
    for psi_1 in sliding(chi):
        stick = Stick.after_gross_slip(psi_1, chi)
        constants = gross_slip_constants(psi_1, chi)
        for v in (*(stick.start * np.array([1.0, 0.97, 0.5, 0.1])), 1e-6):
            g, psi, force = reference(chi, constants, v=v)
            assert_close(stick.g(v), g, 4e-14)
            assert_close(stick.psi(v), psi, 4e-14)
            assert_close(stick.force(v), force, 4e-14)


def moved(chi, constants, v_from, v_to):
    """Integral of psi dt = -(4/5) integral g v (1 - v^2)^(-3/5) dv, by quadrature in d^(1/2)."""

    def integrand(b):
        return reference(chi, constants, x=b**5)[0] * 2 * b

    ends = [mp.power(1 - mp.mpf(v) ** 2, mp.mpf(1) / 5) for v in (v_from, v_to)]
    with mp.workdps(25):
        return mp.quad(integrand, mp.linspace(*ends, 3))


@pytest.mark.parametrize("chi", [0.05, 0.499999999, 0.5, 1.44, 65 / 6, 100.0])
def test_displacement_from_touch(chi):
    """U = integral of g dd over h_1, by quadrature."""
    stick = Stick.from_touch(0.75, chi)
    for v in (0.999, 0.3):
        assert_close(stick.displacement(v), moved(chi, (mp.mpf(0.75), 0), 1, v))


@pytest.mark.parametrize("chi", [0.500000001, 1.44, 4.0, 100.0])
def test_displacement_after_gross_slip(chi):
    """U = (33) integrated to the transition, then the integral of g dd."""
    psi_1 = sliding(chi)[1]
    stick = Stick.after_gross_slip(psi_1, chi)
    v0 = (mp.mpf(psi_1) - 2 * mp.mpf(chi)) / (1 - 2 * mp.mpf(chi))
    time = mp.betainc(mp.mpf(2) / 5, mp.mpf(1) / 2, 0, 1 - v0**2) * 2 / 5
    depth = mp.power(1 - v0**2, mp.mpf(2) / 5)
    before = (mp.mpf(psi_1) - 2 * mp.mpf(chi)) * time + 2 * mp.mpf(chi) * depth
    constants = gross_slip_constants(psi_1, chi)
    for v in (stick.start, 0.5 * stick.start):
        assert_close(stick.displacement(v), before + moved(chi, constants, v0, v), 4e-14)


@pytest.mark.parametrize("chi", CHI)
def test_exponent_minus_one_half_at_the_turning_point(chi):
    """g agrees with the 1 - x connection formula (DLMF 15.8.4), which shows the (1 - x)^(-1/2)."""
    a, b, c = parameters(chi)
    stick = Stick.from_touch(1.0 if chi >= 0.5 else 0.5, chi)
    for v in (0.3, 1e-3, 1e-6):
        y = mp.mpf(v) ** 2
        regular = mp.gammaprod([c, c - a - b], [c - a, c - b]) * mp.hyp2f1(a, b, 1.5, y)
        singular = mp.gammaprod([c, a + b - c], [a, b]) * mp.hyp2f1(c - a, c - b, 0.5, y)
        assert_close(stick.g(v), stick.psi_1 * (regular + singular / mp.mpf(v)))


@pytest.mark.parametrize("chi", [0.500001, 1.44, 10.0, 100.0])
def test_influences_keep_the_area(chi):
    """psi and Q are conjugate: psi_a Q_b - psi_b Q_a is the same at all places."""
    touch = Stick.from_touch(0.5, chi)
    slid = Stick.after_gross_slip(chi + 0.5, chi)
    v = np.sin(np.linspace(0.0, np.pi / 2, 40))
    area = touch.psi(v) * slid.force(v) - slid.psi(v) * touch.force(v)
    size = np.abs(touch.psi(v) * slid.force(v)) + np.abs(slid.psi(v) * touch.force(v))
    assert np.abs(area - area[0]).max() <= 1e-14 * size.max()


def first_end(psi, chi, constants, start):
    """Speed of the first |g| = 1 in 60 digits, bracketed by a fine scan of its own."""
    grid = np.sin(np.linspace(np.arcsin(start), 0.0, 300))[1:-1]
    with mp.workdps(20):
        past = next(v for v in grid if abs(reference(chi, constants, v=v)[0]) > 1)
        before = min(mp.mpf(start), mp.mpf(past) * (1 + mp.mpf(2) / 100))
        sign = mp.sign(reference(chi, constants, v=past)[1])

    def excess(v):
        return sign * reference(chi, constants, v=v)[1] - v

    return mp.findroot(excess, (before, mp.mpf(past)), solver="anderson", tol=1e-40), int(sign)


@pytest.mark.parametrize(
    ("psi", "chi"), [(0.5, 1.44), (0.999999, 0.05), (0.3, 0.2), (1.0, 4.0), (0.3, 30.0), (0.1, 100)]
)
def test_end_from_touch(psi, chi):
    """The phase ends where |g| is first 1, with the slip of the sign of g."""
    true, sign = first_end(psi, chi, (mp.mpf(psi), 0), 1.0)
    stick = Stick.from_touch(psi, chi)
    assert_close(stick.end, true)
    assert_close(stick.end_x, 1 - true**2)
    assert stick.slip_sign == sign


@pytest.mark.parametrize(("psi", "chi"), [(2.0, 1.44), (1.000001, 1.44), (5.0, 10.0), (1.5, 100.0)])
def test_end_after_gross_slip(psi, chi):
    """The phase after gross slip ends where |g| is next 1, at g = -1."""
    stick = Stick.after_gross_slip(psi, chi)
    constants = gross_slip_constants(psi, chi)
    true, sign = first_end(psi, chi, constants, stick.start * (1 - 1e-12))
    assert_close(stick.end, true)
    assert stick.slip_sign == sign


def test_a_maximum_that_only_just_passes_one_ends_the_phase():
    """A bulge of |g| past 1 far narrower than any scan is found; one that stays below is no end."""
    chi = 100.0
    grid = np.linspace(0.05, 0.3, 500)
    size = np.abs(Stick.from_touch(1.0, chi).g(grid))
    top = 1 + int(np.argmax((size[1:-1] > size[:-2]) & (size[1:-1] > size[2:])))
    with mp.workdps(30):
        a, b, c = parameters(chi)
        sides = [1 - grid[top + 1] ** 2, 1 - grid[top - 1] ** 2]
        x = mp.findroot(
            lambda y: mp.hyp2f1(a + 1, b + 1, c + 1, y), sides, solver="anderson", tol=1e-25
        )
        bulge = abs(solutions(chi, x)[0])
    assert bulge > 1
    v = float(mp.sqrt(1 - x))
    above = Stick.from_touch(float((1 + mp.mpf("1e-9")) / bulge), chi)
    below = Stick.from_touch(float((1 - mp.mpf("1e-9")) / bulge), chi)
    assert above.end == pytest.approx(v, abs=1e-5)
    assert above.end > v
    assert below.end < v - 0.01


@pytest.mark.parametrize("chi", [0.05, 1.44, 10.0, 100.0])
def test_differential_equation_15(chi):
    """(1 - x) b^2 g'' - (1 + 13 x/2) b g' + 15 x (2 chi - 1) g/2 = 0, with Chebyshev slopes."""
    stick = Stick.from_touch(0.5, chi)
    for middle in (0.3, 0.6, 0.85):
        b = np.polynomial.Chebyshev.interpolate(
            lambda r: stick.g(x=r**5), 18, domain=[middle - 0.05, middle + 0.05]
        )
        r = middle + np.linspace(-0.03, 0.03, 11)
        x = r**5
        terms = np.array(
            [
                (1 - x) * r**2 * b.deriv(2)(r),
                -(1 + 6.5 * x) * r * b.deriv()(r),
                7.5 * x * (2 * chi - 1) * b(r),
            ]
        )
        assert np.abs(terms.sum(axis=0)).max() <= 2e-9 * np.abs(terms).max()


def test_scalars_arrays_and_signs():
    """Arrays give what floats give, to the bit; -psi_1 gives the mirror image, to the bit."""
    v = np.array([[1.0, 0.7], [0.2, 1e-7]])
    for plus, minus in (
        (Stick.from_touch(0.4, 7.3), Stick.from_touch(-0.4, 7.3)),
        (Stick.after_gross_slip(4.0, 7.3), Stick.after_gross_slip(-4.0, 7.3)),
    ):
        for name in ("g", "psi", "force", "displacement"):
            many = getattr(plus, name)(v)
            np.testing.assert_allclose(
                many, [[getattr(plus, name)(float(w)) for w in row] for row in v], rtol=1e-15
            )
            assert np.array_equal(getattr(minus, name)(v), -many)
        assert (minus.end, minus.slip_sign) == (plus.end, -plus.slip_sign)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: Stick.from_touch(1.2, 1.44), "psi = 1.2: .*|psi| < 1"),
        (lambda: Stick.from_touch(1.0, 0.3), "psi = 1.0"),
        (lambda: Stick.from_touch(np.nan, 0.3), "psi = nan: a finite"),
        (lambda: Stick.from_touch(0.5, 0.0), "chi = 0.0: 0 < chi <= 400"),
        (lambda: Stick.from_touch(0.5, 401.0), "chi = 401"),
        (lambda: Stick.after_gross_slip(3.0, 1.44), "psi = 3.0: .* 2 chi = 2.88"),
        (lambda: Stick.after_gross_slip(0.9, 1.44), "psi = 0.9"),
        (lambda: Stick.from_touch(0.5, 1.44).g(1.5), "v = 1.5: .*0 <= v <= 1"),
        (lambda: Stick.from_touch(0.5, 1.44).g(x=[0.5, -1.0]), "x = -1: .*0 <= x <= 1"),
        (lambda: Stick.from_touch(0.5, 1.44).g(), "give one"),
        (lambda: Stick.from_touch(0.5, 1.44).psi(0.5, x=0.5), "give one"),
        (lambda: transition_speed(2.0, 0.5), "chi = 0.5"),
    ],
)
def test_bad_input_is_refused(call, words):
    """One line that names the argument, its value and what is allowed."""
    with pytest.raises(ValueError, match=words) as refusal:
        call()
    assert "\n" not in str(refusal.value)


def exact(x):
    return mp.mpf(float(x.hi)) + mp.mpf(float(x.lo))


def test_double_double_arithmetic():
    """+ - * / and the roots of random pairs, arrays and floats, keep 31 digits."""
    draw = np.random.default_rng(1979)
    for _ in range(200):
        a, b = (
            DoubleDouble(h, low)
            for h, low in zip(
                draw.uniform(0.5, 2, 2), draw.uniform(-1, 1, 2) * 2.0**-54, strict=True
            )
        )
        p, q = exact(a), exact(b)
        assert_exact(a + b, p + q, p)
        assert_exact(a - b, p - q, p)
        assert_exact(a * b, p * q, p * q)
        assert_exact(a / b, p / q, p / q)
        assert_exact(2.0 - a, 2 - p, p)
        assert_exact(square_root(a), mp.sqrt(p), 1)
        assert_exact(fifth_root(a), mp.root(p, 5), 1)
    cancelled = DoubleDouble(1.0, 2.0**-54) + DoubleDouble(-1.0, 2.0**-110)
    assert exact(cancelled) == mp.mpf(2) ** -54 + mp.mpf(2) ** -110
    array = DoubleDouble(np.array([0.0, 2.0]))
    assert fifth_root(array).hi[0] == 0.0
    assert square_root(array).hi[0] == 0.0
    assert (np.array([1.0, 2.0]) * array).hi.tolist() == [0.0, 4.0]


def test_a_vanishing_coefficient_does_not_end_a_series_of_three_terms():
    """1/(1 + t^2/2): c[n+1] = -c[n-1]/2 with c[1] = 0."""
    found = coefficients((0, 0, 3), (0, 0, 2), DoubleDouble(3.0), (0, 0, 4))
    assert [c.hi for c in found[:5]] == [1.0, 0.0, -0.5, 0.0, 0.25]


def assert_exact(found, true, scale):
    __tracebackhide__ = True
    assert abs(exact(found) - true) <= mp.mpf(2) ** -101 * abs(scale)
