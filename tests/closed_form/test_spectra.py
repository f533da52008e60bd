"""Spectra of forces against closed forms: powers of a sine, Hertz's pulse, impulses, transforms.

The Fourier integral of sin^nu is a quotient of Gamma functions. Of Hertz's pulse F dt is dv, so
that its spectrum is an integral over the speed, whose times are incomplete beta functions.
"""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar
from scipy.special import beta, betainc, gamma, rgamma

import carom
from carom.dimensionless.numerics.spectra import corners, sampled, widest

DURATION = 0.8 * beta(0.4, 0.5)  # of Hertz's impact in d_max/V_1


def sine_power(nu, cycles):
    """Return the amplitude of sin^nu(pi t), 0 < t < 1, at frequencies; of one sign to the zero."""
    front = gamma(1.0 + nu) / 2.0**nu
    half = 0.5 * nu
    return front * rgamma(1.0 + half + cycles) * rgamma(1.0 + half - cycles)


def hertz(cycles):
    """Return the spectrum of Hertz's pulse over its impulse at f t_c, about its middle."""

    def of_speed(s):  # v = 1 - s^5 makes the times smooth at the touch
        after = 0.4 * beta(0.5, 0.4) * betainc(0.5, 0.4, (1.0 - s**5) ** 2)
        return 5.0 * s**4 * np.cos(2.0 * np.pi * cycles / DURATION * after)

    return quad(of_speed, 0.0, 1.0, epsabs=1e-12, limit=200)[0]


def pulse_of(function, highest=40.0):
    return sampled(lambda t: function(np.clip(t, 0.0, 1.0))[None], np.array([0.0, 1.0]), highest)


@pytest.mark.parametrize("nu", [1.0, 1.5, 2.0])
def test_powers_of_a_sine_have_the_spectrum_of_the_closed_form(nu):
    cycles = np.linspace(0.0, 40.0, 333)
    actual = pulse_of(lambda t: np.sin(np.pi * t) ** nu).transform(cycles)[0]
    expected = sine_power(nu, cycles) * np.exp(-1j * np.pi * cycles)
    np.testing.assert_allclose(actual, expected, atol=2e-14)


@pytest.mark.parametrize("nu", [1.0, 1.5, 2.0])
def test_corners_of_powers_of_a_sine(nu):
    pulse = pulse_of(lambda t: np.sin(np.pi * t) ** nu)
    actual = corners(pulse, 0, 1.0, float(widest(pulse, 1.0, 40.0)[0]))
    whole = sine_power(nu, 0.0)
    for share, corner in ((0.5**0.5, actual.corner), (0.5, actual.half)):
        expected = brentq(lambda f, share=share: sine_power(nu, f) - share * whole, 0.1, 1.2)
        assert corner == pytest.approx(expected, rel=1e-12)
    assert actual.peak == 0.0
    assert actual.notch == pytest.approx(1.0 + 0.5 * nu, rel=1e-9)


def test_kinks_that_nobody_knows_are_found():
    """Two ramps and a jump within: every frequency to 1e-12 of the closed form."""
    place, cycles = 0.3137, np.array([0.0, 0.7, 5.3, 31.0])
    pulse = pulse_of(lambda t: np.where(t < place, t, 2.0 - t), 31.0)
    w = -2j * np.pi * np.where(cycles == 0.0, 1.0, cycles)

    def ramp(a, b, offset, slope):
        def primitive(t):
            return np.exp(w * t) * ((offset + slope * t) / w - slope / w**2)

        at_zero = offset * (b - a) + 0.5 * slope * (b * b - a * a)
        return np.where(cycles == 0.0, at_zero, primitive(b) - primitive(a))

    expected = ramp(0.0, place, 0.0, 1.0) + ramp(place, 1.0, 2.0, -1.0)
    np.testing.assert_allclose(pulse.transform(cycles)[0], expected, atol=1e-12)


@pytest.fixture
def head_on(pair):
    return carom.impact(pair, normal_speed=2.0, tangential_speed=0.0)


def test_the_normal_force_is_hertz_pulse(head_on):
    cycles = np.linspace(0.0, 10.0, 41)
    data = head_on.spectrum(cycles / head_on.duration)
    parts = data.normal_spectrum_real.values + 1j * data.normal_spectrum_imag.values
    middle = parts * np.exp(1j * np.pi * cycles) / float(data.normal_impulse)
    np.testing.assert_allclose(middle, [hertz(each) for each in cycles], atol=1e-11)


def test_corners_of_hertz_pulse(head_on):
    """In units of 1/t_c: 0.6696 at -3 dB, 0.9278 at -6 dB, and the first zero at 1.8040."""
    data = head_on.spectrum(n=2)
    for share, name, answer in (
        (0.5**0.5, "normal_corner_frequency", 0.669616),
        (0.5, "normal_half_frequency", 0.927810),
        (0.0, "normal_notch_frequency", 1.804028),
    ):
        expected = brentq(lambda f, share=share: hertz(f) - share, 0.3, 2.0, xtol=1e-12)
        assert float(data[name]) * head_on.duration == pytest.approx(expected, rel=1e-9)
        assert expected == pytest.approx(answer, abs=1e-6)


@pytest.mark.parametrize(
    ("nu", "most", "where", "impulse", "half", "lobe"),
    [
        (1.5, 0.02432, 0.217, 0.02356, 0.98456, 1.197),
        (1.0, 0.16899, 0.158, 0.17109, 0.88348, 1.973),
    ],
)
def test_how_far_powers_of_a_sine_are_from_hertz_pulse(nu, most, where, impulse, half, lobe):
    """As the page on sensors tells it: of the same peak and duration; `where` twice, mirrored."""
    speed = np.linspace(0.0, 1.0, 200_001)
    after = 0.4 * beta(0.5, 0.4) * betainc(0.5, 0.4, speed**2) / DURATION
    excess = np.cos(np.pi * after) ** nu - (1.0 - speed**2) ** 0.6
    place = int(np.abs(excess).argmax())
    assert excess[place] == pytest.approx(most, abs=1e-5)
    assert 0.5 - after[place] == pytest.approx(where, abs=1e-3)
    assert sine_power(nu, 0.0) * DURATION / 1.6 - 1.0 == pytest.approx(impulse, abs=1e-5)

    def relative(f):
        return sine_power(nu, f) / sine_power(nu, 0.0)

    halves = [brentq(lambda f, of=of: of(f) - 0.5, 0.3, 1.5) for of in (relative, hertz)]
    ratio = halves[0] / halves[1]
    assert ratio == pytest.approx(half, abs=1e-5)
    lobes = (
        -minimize_scalar(lambda f, of=of: -abs(of(f)), bounds=(1.6, 2.7), method="bounded").fun
        for of in (relative, hertz)
    )
    assert np.divide(*lobes) == pytest.approx(lobe, abs=1e-3)


LAWS = {
    "elastic": {},
    "viscous": {"losses": carom.KelvinVoigt(restitution=0.8)},
    "yielding": {"losses": carom.ElasticPlastic(yield_velocity="0.1 m/s")},
    "relaxing": {"losses": carom.StandardLinearSolid(2.0, "20 us")},
    "elements": {"method": carom.BoundaryElements(elements=12, steps=60)},
}
ERRORS = {"elastic": 1e-12, "viscous": 1e-11, "yielding": 1e-5, "relaxing": 3e-6, "elements": 3e-5}


@cache
def oblique(law="elastic", mirror=1.0, friction=0.2, **motion):
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=friction)
    inputs = {"normal_speed": 1.7, "tangential_speed": 1.0, "spin": 20.0} | motion
    inputs |= {name: mirror * inputs[name] for name in ("tangential_speed", "spin")}
    return carom.impact(pair, **inputs, **LAWS[law])


@pytest.mark.first_case
@pytest.mark.parametrize("law", LAWS)
def test_at_zero_stand_the_impulses(law):
    """Of both forces, m_n V_1 (1 + e) and what changes V_x; of the moment what changes the spin."""
    hit = oblique(law)
    actual, ball = hit.spectrum([0.0]), hit.pair.first
    normal = hit.pair.normal_mass * hit.normal_speed * (1.0 + hit.normal_restitution)
    turned = ball.mass * ball.gyration_ratio * ball.radius**2 * (hit.spin - hit.spin_out)
    error = ERRORS[law]
    assert float(actual.normal_impulse) == normal
    assert actual.normal_spectrum_real.values[0] == pytest.approx(normal, rel=error)
    assert abs(actual.tangential_spectrum_real.values[0] - hit.tangential_impulse) < error * normal
    assert abs(actual.moment_spectrum_real.values[0] - turned) < error * normal * ball.radius
    assert actual.normal_spectrum_imag.values[0] == 0.0


def test_impulses_of_random_impacts():
    """Any regime; where a front jumps over memory the tangential force has kinks of its own."""
    rng = np.random.default_rng(11)
    for _ in range(15):
        ball = carom.Sphere(radius=10 ** rng.uniform(-4, -1), material="steel")
        plate = carom.HalfSpace(material=rng.choice(["steel", "lead", "pmma"]))
        pair = carom.Pair(ball, plate, friction=rng.uniform(0.02, 1.0))
        slip = rng.uniform(-6.0, 6.0) * pair.friction / pair.kappa
        hit = carom.impact(pair, normal_speed=1.0, tangential_speed=slip)
        data = hit.spectrum([0.0])
        off = data.tangential_spectrum_real.values[0] - hit.tangential_impulse
        assert abs(off) < 1e-11 * float(data.normal_impulse)


@cache
def dense(law):
    return oblique(law).history(40_001)


@pytest.mark.first_case
@pytest.mark.parametrize("law", LAWS)
def test_dense_sums_of_the_history_agree(law):
    """The rule of the trapezium on 40,001 times, and nothing of panels or phases."""
    hit, history = oblique(law), dense(law)
    frequencies = np.linspace(0.0, 5.0, 11) / hit.duration
    data = hit.spectrum(frequencies)
    turn = np.exp(-2j * np.pi * np.outer(frequencies, history.time.values))
    for name in ("normal", "tangential"):
        expected = np.trapezoid(turn * history[f"{name}_force"].values, history.time.values)
        parts = data[f"{name}_spectrum_real"] + 1j * data[f"{name}_spectrum_imag"]
        atol = 2e-7 * float(data.normal_impulse)
        np.testing.assert_allclose(parts.values, expected, atol=atol)
        np.testing.assert_allclose(data[f"{name}_spectrum"], np.abs(expected), atol=atol)


@pytest.mark.first_case
@pytest.mark.parametrize("law", ["elastic", "viscous", "yielding"])
def test_parseval(law):
    """Frequencies k/(2 t_c) are a Fourier series over twice the contact: sums of squares agree."""
    hit = oblique(law)
    step = 0.5 / hit.duration
    data = hit.spectrum(step * np.arange(1200))
    history = dense(law)
    for name in ("normal", "tangential"):
        power = data[f"{name}_spectrum"].values ** 2
        expected = np.trapezoid(history[f"{name}_force"].values ** 2, history.time.values)
        assert step * (2.0 * power.sum() - power[0]) == pytest.approx(expected, rel=3e-6)


@pytest.mark.slow
def test_the_inverse_transform_is_the_force():
    """As a user comes back to time: `irfft` of the parts; what is cut off falls like f^(-3/2)."""
    hit = oblique()
    count = 4096
    step = 0.5 / hit.duration
    data = hit.spectrum(step * np.arange(count // 2 + 1)[:1999])
    history = hit.history(count // 2 + 1)
    for name in ("normal", "tangential"):
        parts = np.zeros(count // 2 + 1, complex)
        parts[:1999] = (data[f"{name}_spectrum_real"] + 1j * data[f"{name}_spectrum_imag"]).values
        force = np.fft.irfft(parts, count) * count * step
        expected = history[f"{name}_force"].values
        np.testing.assert_allclose(force[: count // 2 + 1], expected, atol=2e-4 * hit.max_force)
        assert np.abs(force[count // 2 + 1 :]).max() < 2e-4 * hit.max_force


def test_frequencies_scale_with_the_duration():
    """The same psi_1 and chi at another size, stiffness and speed: the same numbers times t_c."""
    items = []
    for radius, speed, young in ((1e-3, 0.1, 1e9), (0.2, 3.0, 2e11)):
        stuff = carom.Material(young=young, poisson=0.3, density=4000.0)
        ball = carom.Sphere(radius=radius, material=stuff)
        pair = carom.Pair(ball, carom.HalfSpace(material=stuff), friction=0.3)
        hit = carom.impact(pair, normal_speed=speed, tangential_speed=0.4 * speed)
        data = hit.spectrum()
        corners_ = [float(data[name]) for name in data if str(name).endswith("_frequency")]
        shape = [data[f"{name}_spectrum"].values[::50] for name in ("normal", "tangential")]
        scale = float(data.normal_impulse)
        items.append(np.concatenate([np.multiply(corners_, hit.duration), np.ravel(shape) / scale]))
    np.testing.assert_allclose(*items, rtol=1e-6, atol=1e-11)


@pytest.mark.first_case
@pytest.mark.parametrize("law", LAWS)
def test_a_mirrored_impact_has_the_mirrored_spectrum(law):
    one, other = (oblique(law, mirror).spectrum(n=31) for mirror in (1.0, -1.0))
    scale = float(one.normal_impulse)
    for name in one:
        sign = -1.0 if str(name).startswith(("tangential", "moment")) else 1.0
        sign = sign if str(name).endswith(("real", "imag", "impulse")) else 1.0
        values = one[name].values, sign * other[name].values
        np.testing.assert_allclose(*values, rtol=1e-9, atol=1e-11 * scale)


def test_without_friction_nothing_is_tangential():
    data = oblique(friction=0.0).spectrum(n=11)
    assert not data.tangential_spectrum.values.any()
    assert not data.moment_spectrum.values.any()
    assert np.isnan(float(data.tangential_corner_frequency))
    assert float(data.normal_corner_frequency) > 0.0


def test_a_force_that_turns_has_its_largest_amplitude_above_zero():
    """Nearly no impulse is left of a swing to and fro: corners are told from the largest value."""
    hit = oblique(tangential_speed=0.15, spin=0.0)
    data = hit.spectrum(n=2001)
    amplitude = data.tangential_spectrum.values
    assert amplitude[0] < 0.5 * amplitude.max()
    place = data.frequency.values[amplitude.argmax()]
    assert float(data.tangential_peak_frequency) == pytest.approx(place, rel=1e-3)
    at = hit.spectrum([float(data[f"tangential_{each}_frequency"]) for each in ("corner", "half")])
    shares = at.tangential_spectrum.values / amplitude.max()
    np.testing.assert_allclose(shares, [0.5**0.5, 0.5], rtol=1e-5)
    assert float(data.tangential_peak_frequency) < at.frequency.values[0] < at.frequency.values[1]
