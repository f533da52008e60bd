"""Dynamic jam, 1 + sigma eps < 0: the normal force grows while the body slides, until it sticks."""

import numpy as np
import pytest
from tests.checks import FLOOR, refused
from tests.oracles import march_in_space as oracle, struck_bodies

import carom
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.layout import DEEPEST, PSI_OUT, RESTITUTION
from carom.dimensionless.lossy.springs import march
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia

# kappa 0.82, friction 2, 1.5, 3; sliding forth jams
JAMS = [Inertia(3.0, -1.5, -0.3075), Inertia(1.0, -1.05, -0.382667), Inertia(2.0, -3.0, -0.273333)]


def solved(psi, inertia):
    """Return status, the numbers and the error of psi_2."""
    numbers = np.empty(march.NUMBERS)
    status, error = march.run(psi, 0.0, inertia, ELASTIC, march.new_work(), numbers)
    return status, numbers, error


@pytest.mark.first_case
@pytest.mark.parametrize("inertia", JAMS)
@pytest.mark.parametrize("psi", [0.0, 1.0, 5.0])
def test_the_oracle_agrees(psi, inertia):
    """In units of the depth and of the speed there, as its places reach to 1.44 d_max only."""
    status, numbers, error = solved(psi, inertia)
    assert status == Status.SOLVED
    assert error < 2e-5 * max(1.0, psi)
    rates, deep = oracle.rates_of(inertia), 1.05 * numbers[DEEPEST]
    coarse, fine = (oracle.marched(psi, rates, n, reach=deep) for n in (300, 600))
    out = np.array([-numbers[RESTITUTION], numbers[PSI_OUT]])
    assert out == pytest.approx((4.0 * fine - coarse)[:2] / 3.0, abs=3e-5 * max(1.0, psi))


@pytest.mark.slow
def test_sliding_ends_in_stick_and_lifts_the_body():
    """e exceeds 1, what slides sticks before the deepest place, and the force outgrows Hertz's."""
    body = carom.Body(
        mass=0.01, inertia=2e-7, contact=(0.004, -0.012), curvature_radius=0.005, material="steel"
    )
    pair = carom.Pair(body, FLOOR, 1.2)
    hit = carom.impact(pair, normal_speed=1.0, tangential_speed=12.0)
    assert hit.solution._inertia.eps < -1.0
    assert hit.normal_restitution > 2.0
    assert [phase.kind for phase in hit.phases][:2] == ["gross slip", "stick"]
    deepest = hit.history(2001).penetration
    assert hit.phases[0].end < float(deepest.time[int(np.argmax(deepest.values))])
    assert hit.max_force > 1.5 * hit.scales.force
    came = struck_bodies.marched(
        [pair],
        *(np.array([each]) for each in ([12.0, 0, -1.0], [0, 0, 0], [0, 0, 0])),
        400,
        1.05 * hit.max_penetration / hit.scales.length,
    )
    assert hit.spin_out == pytest.approx(-came.spin[0][0, 1], rel=2e-5)
    assert hit.dissipated_energy == pytest.approx(came.work[0], rel=1e-3)
    kinetic = 0.5 * 0.01 * (12.0**2 + 1.0)
    speeds = hit.normal_speed_out**2 + hit.tangential_speed_out**2
    after = 0.5 * 0.01 * speeds + 0.5 * 2e-7 * hit.spin_out**2
    assert kinetic - after == pytest.approx(hit.dissipated_energy, abs=2e-6 * kinetic)


@pytest.mark.parametrize("inertia", JAMS)
def test_faster_sliding_strikes_harder(inertia):
    """e grows without a bound, as sliding feeds it; where springs do not do there is no number."""
    rebounds = [solved(psi, inertia) for psi in (1.0, 3.0, 10.0, 30.0, 100.0, 300.0)]
    assert all(status == Status.SOLVED for status, *_ in rebounds)
    e = np.array([numbers[RESTITUTION] for _, numbers, _ in rebounds])
    assert np.all(e[1:] > 1.3 * e[:-1])
    for psi in (9.9e3, 1.01e4, 1e6, 1e9):
        status, numbers, _ = solved(psi, inertia)
        assert status == Status.UNRESOLVED
        assert np.all(np.isnan(numbers))


def test_grazing_jam_is_refused():
    body = carom.Body(
        mass=0.01, inertia=2e-7, contact=(0.004, -0.012), curvature_radius=0.005, material="steel"
    )
    pair = carom.Pair(body, FLOOR, 1.2)
    with_speed = {"normal_speed": 1e-3, "tangential_speed": 100.0}
    refused("contact.*not resolved by springs", carom.impact, pair, **with_speed)
    hit = carom.impact(pair, normal_speed=1e-3, tangential_speed=-100.0)  # the other way it slides
    assert hit.normal_restitution == pytest.approx(1.0, abs=1e-6)
