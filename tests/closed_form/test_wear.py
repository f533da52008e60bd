"""Work of friction per area and wear, against integrals made in other ways."""

from itertools import pairwise

import numpy as np
import pytest
from tests.checks import BALL as STEEL, FLOOR as PLANE, PAIR
from tests.oracles.friction_work import at_radius, over_the_radius

import carom

LOSSES = carom.KelvinVoigt(restitution=0.7)
POINTS = np.array([[0.0, 0.0], [0.25, 0.1], [0.1, 0.55], [-0.7, 0.2], [0.0, 0.9]])


def power(hit, time, points):
    """Return traction times slip velocity, as the fields at an instant have them."""
    patch = hit.fields(time, points=points)
    return patch.traction_x.values * patch.slip_velocity_x.values


def in_time(hit, point, scans=25, nodes=24):
    """Integrate between the instants at which power sets in or ends, found by bisection."""
    cuts = [phase.start for phase in hit.phases] + [hit.duration]
    scan = np.unique(np.concatenate([np.linspace(a, b, scans) for a, b in pairwise(cuts)]))
    works = [power(hit, time, [point])[0] > 0.0 for time in scan]
    for k in np.flatnonzero(np.diff(works)):
        low, high = scan[k], scan[k + 1]
        for _ in range(30):
            middle = 0.5 * (low + high)
            below = (power(hit, middle, [point])[0] > 0.0) == works[k]
            low, high = (middle, high) if below else (low, middle)
        cuts.append(high)
    x, weights = np.polynomial.legendre.leggauss(nodes)
    phi, total = 0.25 * np.pi * (1.0 + x), 0.0
    for start, end in pairwise(sorted(cuts)):
        times = start + (end - start) * np.sin(phi) ** 2
        values = [power(hit, time, [point])[0] for time in times]
        total += 0.25 * np.pi * (end - start) * (weights * np.sin(2.0 * phi)) @ values
    return total


@pytest.mark.parametrize("chi", [0.3, 0.5, 1.44, 5.0])
def test_gross_slip_throughout(chi):
    """W_0 = 4 (psi_1 - 2 chi) integral of b sqrt(b^2 - r^2)/sqrt(1 - b^5) db, and W_2 = 0.

    With dt = 2 b db/v; what the slip rate has of v cancels between loading and unloading.
    """
    psi = 4.0 * chi + 1.5
    radii = [0.0, 1e-3, 0.3, 0.79, 0.81, 0.95, 0.9999]
    actual = carom.solve(psi, chi).friction_work(radii)
    expected = [4.0 * (psi - 2.0 * chi) * over_the_radius(r) for r in radii]
    np.testing.assert_allclose(actual[:, 0], expected, rtol=1e-9)
    assert not actual[:, 1].any()


@pytest.mark.first_case
@pytest.mark.parametrize(("psi", "chi"), [(0.5, 1.44), (1.5, 1.44)])
def test_single_radii_against_the_states(psi, chi):
    """Also next to where fronts begin, and where one series of the solution takes over."""
    solution = carom.solve(psi, chi)
    radii = np.concatenate([[0.1, 0.6], solution._slip_borders()[5:10] + 2e-5])
    values = solution.friction_work(radii)[:, 0]
    expected = [at_radius(solution, r) for r in radii]
    np.testing.assert_allclose(values, expected, rtol=0.0, atol=3e-9 * values.max())


def test_pressure_over_the_time():
    radii = [0.0, 0.4, 0.9]
    expected = [4.0 * over_the_radius(r) for r in radii]
    np.testing.assert_allclose(carom.solve(0.5, 1.44).pressed(radii), expected, rtol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("angle", ["10 deg", "-20 deg"])
def test_fields_through_the_impact_add_up_to_the_map(angle):
    hit = carom.impact(PAIR, speed=2.0, angle=angle, spin="20 rad/s")
    at = POINTS[1:4] * hit.max_radius
    worn = hit.wear(x=np.unique(at[:, 0]), y=np.unique(at[:, 1]))
    values = [float(worn.friction_work.sel(x=x, y=y)) for x, y in at]
    summed = [in_time(hit, point, 15, 16) for point in at]
    np.testing.assert_allclose(values, summed, rtol=0.0, atol=1e-5 * max(summed))


@pytest.mark.slow
def test_fields_of_viscous_bodies_add_up_to_the_map():
    hit = carom.impact(PAIR, speed=2.0, angle="20 deg", losses=LOSSES)
    at = POINTS[2:3] * hit.max_radius
    worn = hit.wear(x=np.unique(at[:, 0]), y=np.unique(at[:, 1]))
    values = [float(worn.friction_work.sel(x=x, y=y)) for x, y in at]
    summed = [in_time(hit, point, 10, 12) for point in at]
    np.testing.assert_allclose(values, summed, rtol=0.0, atol=1e-4 * max(summed))
    assert float(worn.work_error) < 1e-5


@pytest.mark.first_case
@pytest.mark.parametrize(("friction", "losses"), [(0.0, None), (0.1, LOSSES), (0.6, None)])
def test_profile_and_volume(friction, losses):
    """The mean depth over the contact is the volume, k/mu times the work; at mu = 0 k V_x J_n."""
    pair = carom.Pair(STEEL, PLANE, friction=friction)
    hit = carom.impact(pair, speed=2.0, angle="25 deg", losses=losses)
    worn = hit.wear(4001, coefficient=1e-13)
    r, depth = worn.distance.values, worn.mean_wear_depth.values
    volume = np.trapezoid(2.0 * np.pi * r * depth, r)
    assert float(worn.worn_volume) == pytest.approx(volume, rel=1e-5, abs=0.0)
    if friction:
        assert float(worn.worn_volume) == pytest.approx(
            1e-13 / friction * hit.dissipated_energy, rel=1e-12, abs=0.0
        )
    else:
        impulse = pair.normal_mass * hit.normal_speed * (1.0 + hit.normal_restitution)
        assert float(worn.worn_volume) == pytest.approx(
            1e-13 * impulse * hit.contact_velocity, rel=1e-12, abs=0.0
        )
        assert not worn.mean_friction_work.any()
    deepest = max(depth.max(), worn.wear_depth.values.max())
    assert float(worn.max_wear_depth) == pytest.approx(deepest, rel=1e-3, abs=0.0)
    assert float(worn.max_wear_depth) >= deepest * (1.0 - 1e-9)


@pytest.mark.first_case
@pytest.mark.parametrize("angle", [0.3, 3.0, 35.0])
@pytest.mark.parametrize("friction", [0.2, 0.6])
def test_the_largest_wear_is_that_of_a_dense_map(angle, friction):
    """Anywhere in the contact, on the axes of x or y, which a line along each shows."""
    hit = carom.impact(carom.Pair(STEEL, PLANE, friction=friction), speed=2.0, angle=f"{angle} deg")
    line = np.linspace(0.0, hit.max_radius, 4001)
    along = hit.wear(x=line, y=[0.0]).friction_work.values
    across = hit.wear(x=[0.0], y=line).friction_work.values
    worn = hit.wear()
    assert float(worn.max_friction_work) == pytest.approx(max(along.max(), across.max()), rel=2e-5)


@pytest.mark.slow
def test_a_viscous_ball_near_the_normal_does_not_wear_less_than_nothing():
    """There the energies tell rounding alone; volumes are those of the work per area."""
    pair = carom.Pair(STEEL, PLANE, friction=0.3)
    law = carom.KelvinVoigt(restitution=0.3)
    hit = carom.impact(pair, speed=1.0, angle="0.1 deg", losses=law)
    worn = hit.wear(4001, coefficient=1e-13)
    r, depth = worn.distance.values, worn.mean_wear_depth.values
    volume = np.trapezoid(2.0 * np.pi * r * depth, r)
    assert volume > 0.0
    assert float(worn.worn_volume) == pytest.approx(volume, rel=1e-4)
    assert float(worn.work_error) > 0.0  # which says that energies differ
    many = carom.wear_of_many(
        pair, speed=1.0, angle=np.radians([1e-2, 2e-2, 0.1]), losses=law, area=1.0
    )
    assert (many.dissipated_energy.values >= 0.0).all()


def test_little_friction_is_like_none():
    """The depth has a limit as the friction goes to zero."""
    some, none = (
        carom.impact(carom.Pair(STEEL, PLANE, friction=mu), speed=2.0, angle=0.5).wear(
            coefficient=1e-13
        )
        for mu in (1e-9, 0.0)
    )
    np.testing.assert_allclose(some.wear_depth, none.wear_depth, rtol=1e-7, atol=1e-22)


def test_many_impacts_are_the_sum_of_each():
    """With counts, on one spot and over an area; the first slips throughout."""
    angles, counts, speeds = [1.2, 0.5, -0.1], [2.0, 0.5, 10.0], [1.0, 2.0, 0.5]
    hits = [carom.impact(PAIR, speed=v, angle=a) for v, a in zip(speeds, angles, strict=True)]
    spot = carom.wear_of_many(
        PAIR, speed=speeds, angle=angles, counts=counts, coefficient=1e-13, n=5
    )
    work = sum(n * hit.dissipated_energy for n, hit in zip(counts, hits, strict=True))
    assert float(spot.total_friction_work) == pytest.approx(work, rel=1e-8, abs=0.0)
    assert float(spot.total_worn_volume) == pytest.approx(5e-13 * work, rel=1e-8, abs=0.0)
    widest = max(hit.max_radius for hit in hits)
    np.testing.assert_allclose(spot.distance, np.linspace(0.0, widest, 5))
    works = [hit.wear(2).mean_friction_work.values[0] for hit in hits]
    inmost = sum(n * work for n, work in zip(counts, works, strict=True))
    assert float(spot.mean_friction_work[0]) == pytest.approx(inmost, rel=1e-12, abs=0.0)
    assert float(spot.max_friction_work) >= inmost * (1.0 - 1e-12)
    coarse, fine = (
        carom.wear_of_many(PAIR, speed=speeds, angle=angles, counts=counts, n=n).max_friction_work
        for n in (2, 2001)
    )
    assert float(coarse) == pytest.approx(float(fine), rel=1e-5)
    over = carom.wear_of_many(
        PAIR, speed=speeds, angle=angles, counts=counts, coefficient=1e-13, area="2 cm^2"
    )
    assert float(over.spread_wear_depth) == pytest.approx(5e-13 * work / 2e-4, rel=1e-8, abs=0.0)
