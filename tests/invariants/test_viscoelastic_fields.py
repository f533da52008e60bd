"""What happens in the contact of viscoelastic bodies: Coulomb's law everywhere, forces, slip.

Over 500 random impacts, 20 instants each, |traction| exceeded mu times the pressure by at most
6e-11 of it, at radii up to 1 - 1e-6 of the edge.
"""

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson, quad

import carom
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import flat, stacked
from carom.dimensionless.fields.subsurface import stresses

INSIDE = np.append(np.linspace(0.0, 0.999, 200), 1.0 - 10.0 ** -np.arange(4.0, 6.5, 0.5))


def solutions(count, seed):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        chi, e = 0.1 * 50.0 ** rng.uniform(), rng.uniform(0.1, 0.99)
        psi = rng.uniform(-1.0, 1.0) * (2.0 * chi * (1.0 + e) + 1.0)
        yield carom.solve(psi, chi, losses=carom.KelvinVoigt(restitution=e))


@pytest.mark.slow
def test_coulombs_law_holds_at_every_point():
    """And where it slips the traction is at the limit, against the slip."""
    rng = np.random.default_rng(4)
    for solution in solutions(40, 12):
        for time in solution.duration * rng.uniform(0.001, 0.999, 6):
            state, now = solution.contact_at(time), solution.at(time)
            r = state.radius * INSIDE
            out = np.empty((r.size, 5))
            surface.sample(state.profile, 0.0, state.radius**2, state.rim, r, out)
            pressure, traction = out[:, 0], out[:, 1]
            assert np.all(np.abs(traction) <= (1.0 + 1e-9) * pressure)
            slides = r > now.stick_radius[0] + 1e-6
            rate = state.slipping(r)[:, 0]
            assert np.max(np.abs(rate[r < now.stick_radius[0] - 1e-6]), initial=0.0) == 0.0
            if solution.phase_at(time).kind != "stick":
                sign = solution.phase_at(time).sign
                np.testing.assert_allclose(sign * traction[slides], pressure[slides], rtol=1e-9)
                assert np.min(sign * rate[slides], initial=0.0) > -1e-7


def density(angle, state, which):
    """Return pressure or traction times r dr/d(angle), r = b sin(angle)."""
    r, out = state.radius * np.sin(angle), np.empty((1, 5))
    surface.sample(state.profile, 0.0, state.radius**2, state.rim, np.array([r]), out)
    return out[0, which] * r * state.radius * np.cos(angle)


def test_tractions_add_up_to_the_forces():
    """P = 3 integral of p r dr, and Q = 2 integral of f r dr."""
    rng = np.random.default_rng(5)
    for solution in solutions(15, 13):
        for time in solution.duration * rng.uniform(0.01, 0.99, 4):
            state, now = solution.contact_at(time), solution.at(time)
            pressed, pulled = (
                quad(density, 0.0, np.pi / 2.0, (state, which), epsabs=1e-9, limit=200)[0]
                for which in (0, 1)
            )
            assert 3.0 * pressed == pytest.approx(now.normal_force[0], abs=1e-6)
            assert 2.0 * pulled == pytest.approx(now.force[0], abs=2e-6)


@pytest.mark.slow
def test_slip_is_what_slip_velocity_makes(pair):
    """At four points, from after the touch of the outermost on until contact there ends."""
    law = carom.KelvinVoigt(restitution=0.6)
    hit = carom.impact(pair, speed=2.0, angle="14 deg", losses=law)
    points = np.array([[0.3, 0.2], [0.6, 0.1], [0.2, 0.7], [0.05, 0.0]]) * hit.max_radius
    times = np.linspace(0.3, 0.6, 121) * hit.duration
    patches = [hit.fields(time, points=points) for time in times]
    for axis in ("slip_x", "slip_y"):
        slip = np.array([patch[axis].values for patch in patches])
        name = axis.replace("slip", "slip_velocity")
        velocity = np.array([patch[name].values for patch in patches])
        actual = cumulative_simpson(velocity, x=times, axis=0, initial=0.0)
        size = np.abs(patches[-1].slip_x.values).max()
        np.testing.assert_allclose(slip - slip[0], actual, rtol=0.0, atol=2e-3 * size)


def test_vanishing_losses_give_the_elastic_contact():
    law = carom.KelvinVoigt(restitution=1.0 - 1e-7)
    for psi in (0.6, 1.5, 4.0):
        lossy, elastic = carom.solve(psi, 1.44, losses=law), carom.solve(psi, 1.44)
        for part in (0.2, 0.6, 0.8):
            radii = np.linspace(0.0, 0.95, 30) * lossy.contact_at(part * lossy.duration).radius
            one, other = (s.traction(part * s.duration, radii) for s in (lossy, elastic))
            np.testing.assert_allclose(one, other, rtol=0.0, atol=2e-5)
            one, other = (s.contact_at(part * s.duration) for s in (lossy, elastic))
            np.testing.assert_allclose(one.slid(radii), other.slid(radii), rtol=0.0, atol=2e-5)


def test_stress_of_a_density_that_ends_with_a_jump():
    """Traction: as if it fell to nothing within 1e-5 of the radius. Pressure: Boussinesq's."""
    points = np.array([[0.3, 0.1, 0.2], [0.0, 0.0, 0.05], [1.0, 0.4, 0.3], [0.9, 0.0, 0.02]])
    jump, inner, inputs = 0.4, 1.0 - 1e-5, {"friction": 1.0, "poisson": 0.3}
    ends = stacked([1.0], [flat(0.0, 1.0, 1.0, jump)], jump)
    falls = [flat(0.0, inner, 1.0, jump), flat(inner, 1.0, jump / (1.0 - inner**2), 0.0)]
    plain = stacked([1.0], [flat(0.0, 1.0, 1.0, 0.0)])
    with_rim = stresses(points, ends, **inputs, rim=jump)
    pressed = stresses(points, ends._replace(rim=0.0), **inputs, rim=jump)
    smooth = stresses(points, stacked([inner, 1.0], falls), **inputs)
    pulled = smooth - stresses(points, plain, **inputs)
    assert np.abs(pulled).max(axis=1).min() > 0.01
    np.testing.assert_allclose(with_rim - pressed, pulled, rtol=0.0, atol=1e-4)
    for z in (0.05, 0.5, 2.0):  # on the axis, p = (jump/2)/sqrt(1 - r^2)
        ring = quad(lambda a, z=z: np.sin(a) / (np.sin(a) ** 2 + z * z) ** 2.5, 0.0, np.pi / 2.0)
        axis = np.array([[0.0, 0.0, z]])
        value = stresses(axis, plain, **inputs, rim=jump) - stresses(axis, plain, **inputs)
        assert value[0, 2] == pytest.approx(-1.5 * jump * z**3 * ring[0], rel=1e-6)


def test_bodies_without_friction_have_no_traction_at_an_infinite_pressure(pair):
    smooth = carom.Pair(pair.first, pair.second, friction=0.0)
    hit = carom.impact(smooth, speed=2.0, angle=0.5, losses=carom.KelvinVoigt(restitution=0.7))
    line = hit.radial(0.2 * hit.duration, 11)
    assert line.pressure[-1] == np.inf
    assert not line.friction_limit.values.any()
    assert not line.traction_x.values.any()


def test_stress_while_the_load_grows_is_told_from_a_depth_on(pair):
    hit = carom.impact(pair, speed=2.0, angle="30 deg", losses=carom.KelvinVoigt(restitution=0.7))
    for part, grows in ((0.2, True), (0.7, False)):
        below = hit.stress(part * hit.duration)
        assert (float(below.z[0]) > 0.0) == grows
        assert ("max_tension" in below) == (not grows)
        assert np.all(np.isfinite(below.von_mises))
    radius = hit.contact(0.2 * hit.duration).radius
    with pytest.raises(carom.InputError, match=r"points: 'z = .*infinite at the edge while the"):
        hit.stress(0.2 * hit.duration, points=[[0.0, 0.0, 0.01 * radius]])
    assert hit.fields(0.2 * hit.duration, points=[[radius, 0.0]]).pressure[0] == np.inf
