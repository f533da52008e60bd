"""What holds in every impact at every time: energy, Coulomb's bound, symmetry, one memory."""

import numpy as np
from hypothesis import given, settings, strategies as st

import carom

PSI = st.one_of(st.floats(-8.0, 8.0), st.sampled_from([0.0, 1.0, -1.0, 1e-9]))
CHI = st.one_of(st.floats(0.05, 10.0), st.floats(10.0, 60.0), st.sampled_from([0.5, 1.44, 4.0]))
ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(200)  # 60 miss 2e-10 where slip is thin


def spread(inner, outer):
    """Gauss-Legendre points and weights between two radii."""
    half = 0.5 * (outer - inner)
    return inner + half * (1.0 + ABSCISSAS), half * WEIGHTS


@settings(max_examples=60, deadline=None, derandomize=True)
@given(psi=PSI, chi=CHI, place=st.floats(0.001, 0.999))
def test_memory_gives_force_energy_and_keeps_coulombs_law(psi, chi, place):
    """Q = int q dx, psi^2/2 + (15/8) chi int q^2 dx + (15/4) chi W constant, |q| <= d - s."""
    solution = carom.solve(psi, chi)
    time = place * solution.duration
    now, memory = solution.at(time), solution.memory(time)
    force = energy = 0.0
    for annulus in memory.annuli:
        x, weights = spread(annulus.inner, annulus.outer)
        q = memory.q(x**2)
        force += weights @ q
        energy += weights @ q**2
        assert np.all(np.abs(q) <= memory.penetration - x**2 + 1e-12)
        assert np.all(np.abs(memory.g(x**2)) <= 1.0 + 1e-9)
    assert abs(force - now.force[0]) <= 1e-11
    assert abs(1.875 * chi * energy - now.stored[0]) <= 1e-10
    total = 0.5 * now.psi[0] ** 2 + 1.875 * chi * energy + now.dissipated[0]
    assert abs(total - 0.5 * psi**2) <= 1e-10
    assert memory.g(now.penetration[0] * 1.01) == 0.0


@settings(max_examples=80, deadline=None, derandomize=True)
@given(psi=PSI, chi=CHI)
def test_energy_is_lost_but_never_gained(psi, chi):
    solution = carom.solve(psi, chi)
    history = solution.history(101)
    assert np.all(np.diff(history.dissipated) >= -1e-12)
    assert np.all(history.stored >= -1e-10 * max(1.0, psi**2))
    assert abs(history.stored[-1]) <= 1e-10 * max(1.0, psi**2)
    assert abs(solution.psi_out) <= abs(psi) * (1.0 + 1e-12)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(psi=PSI, chi=CHI)
def test_histories_keep_their_bounds(psi, chi):
    history = carom.solve(psi, chi).history(101)
    limit = history.penetration**1.5 * 2.0 / 3.0
    assert np.all(np.abs(history.force) <= limit + 1e-12)
    assert np.all(history.stick_radius <= history.contact_radius)
    assert np.all(history.stick_radius >= 0.0)
    assert history.psi[0] == psi
    assert abs(history.psi[-1] - carom.rebound(psi, chi)) <= 1e-11 * max(1.0, abs(psi))


@settings(max_examples=40, deadline=None, derandomize=True)
@given(psi=PSI, chi=CHI)
def test_mirror_image(psi, chi):
    one, other = carom.solve(psi, chi), carom.solve(-psi, chi)
    times = np.linspace(0.0, one.duration, 17)
    assert np.array_equal(one.at(times).psi, -other.at(times).psi)
    assert np.array_equal(one.at(times).force, -other.at(times).force)
    assert np.array_equal(one.at(times).stick_radius, other.at(times).stick_radius)
    assert [(p.kind, p.sign) for p in one.phases] == [(p.kind, -p.sign) for p in other.phases]
    for time in times[1::5]:
        here, there = one.memory(time), other.memory(time)
        assert here.displacement == -there.displacement
        assert [a.sign for a in here.annuli] == [-a.sign for a in there.annuli]
        for annulus in here.annuli:
            inside = [(0.5 * (annulus.inner + annulus.outer)) ** 2]
            assert np.array_equal(here.q(inside), -there.q(inside))
            if annulus.sign and abs(psi) >= 1e-6:
                assert here.g(inside)[0] == annulus.sign


def test_history_satisfies_the_equations_of_motion():
    """dU/dt = psi and d(psi)/dt = -(15/4) chi Q, by differences of the dense solution."""
    for psi, chi in ((0.5, 1.44), (1.5, 1.44), (0.3, 1.75), (0.5, 8.0), (3.0, 6.0)):
        solution = carom.solve(psi, chi)
        times, step = np.linspace(0.02, 2.92, 59), 1e-4
        before, now, after = (solution.at(times + shift) for shift in (-step, 0.0, step))
        rate_u = (after.displacement - before.displacement) / (2 * step)
        rate_psi = (after.psi - before.psi) / (2 * step)
        # where a phase changes, Q' jumps and the differences are good to the first order only
        assert np.max(np.abs(rate_u - now.psi)) <= 20 * chi * step**2
        assert np.max(np.abs(rate_psi + 3.75 * chi * now.force)) <= 20 * chi * step
