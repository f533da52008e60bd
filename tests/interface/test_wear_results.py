"""What users see of wear: datasets, units, refusals, statuses, figures from stored files."""

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom.io.files import save


@pytest.fixture(scope="module")
def hit(pair):
    return carom.impact(pair, speed=2.0, angle="20 deg")


def test_dataset_tells_units_and_meaning(hit):
    worn = hit.wear(31, coefficient="1e-4 mm^3 N^-1 m^-1", x=[0.0, 1e-4], y=[-1e-4, 0.0, 1e-4])
    assert float(worn.wear_coefficient) == pytest.approx(1e-13, rel=1e-12, abs=0.0)
    assert worn.mean_friction_work.dims == worn.mean_wear_depth.dims == ("distance",)
    assert worn.friction_work.shape == (3, 2)
    units = {name: worn[name].attrs["units"] for name in worn}
    assert units["friction_work"] == units["max_friction_work"] == "J/m^2"
    assert (units["wear_depth"], units["worn_volume"]) == ("m", "m^3")
    assert all(worn[name].attrs["long_name"] for name in worn.variables)
    assert '"friction": 0.2' in worn.attrs["inputs"]
    plain = hit.wear(31)
    assert "wear_depth" not in plain
    assert float(plain.work_error) < 1e-8
    np.testing.assert_array_equal(plain.mean_friction_work, worn.mean_friction_work)


def test_map_is_symmetric_and_its_mean_is_the_profile(hit):
    """Around a circle; the depth is k/mu times the work."""
    angles = 2.0 * np.pi * (np.arange(24) + 0.5) / 24
    r = 0.8 * hit.max_radius
    maps = [hit.wear(x=[r * np.cos(t)], y=[r * np.sin(t)]) for t in angles]
    around = [float(one.friction_work[0, 0]) for one in maps]
    worn = hit.wear(6, coefficient=1e-13)
    assert np.mean(around) == pytest.approx(float(worn.mean_friction_work[4]), rel=1e-12, abs=0.0)
    assert np.ptp(around) > 1e-3 * np.mean(around)
    for flipped in (worn.friction_work[::-1], worn.friction_work[:, ::-1]):
        np.testing.assert_allclose(flipped.values, worn.friction_work.values, rtol=1e-9)
    np.testing.assert_allclose(worn.wear_depth, 5e-13 * worn.friction_work, rtol=1e-12)


@pytest.mark.parametrize(
    ("inputs", "said"),
    [
        ({"n": 1}, "n: 1 cannot be used; must be a whole number of at least 2"),
        ({"coefficient": -1e-13}, "coefficient: -1e-13 cannot be used; must be zero or pos"),
        ({"coefficient": "1e-13 m"}, "that is not a value in m^2/N; give a number in m^2/N, or"),
        ({"coefficient": "k"}, "text with a unit such as '1e-13 m^2/N'"),
        ({"x": [0.0, np.nan]}, "x: "),
    ],
)
def test_bad_input_is_refused_in_one_line(hit, inputs, said):
    assert said in refused("", hit.wear, **inputs)


@pytest.mark.slow
def test_yielding_spheres_wear_on_a_spot_as_one_impact_does(pair):
    law = carom.ElasticPlastic(yield_velocity="0.1 m/s")
    one = carom.impact(pair, speed=2.0, angle="20 deg", losses=law).wear()
    spot = carom.wear_of_many(pair, speed=2.0, angle="20 deg", losses=law)
    assert float(spot.max_friction_work) == pytest.approx(float(one.max_friction_work), rel=1e-3)
    assert float(one.work_error) < 5e-3
    assert float(carom.wear_of_many(pair, speed=2.0, losses=law, area=1.0).unsolved_impacts) == 0


def test_bad_impacts_have_a_status_and_are_left_out(pair):
    angles = ["20 deg", "95 deg", np.nan, "20 deg", "20 deg", "20 deg"]
    speeds, counts = [2.0, 2.0, 2.0, -1.0, 2.0, 1e300], [1.0, 1.0, 1.0, 1.0, -1.0, 1.0]
    worn = carom.wear_of_many(pair, speed=speeds, angle=angles, counts=counts)
    values = [carom.status.PointStatus(int(code)).name for code in worn.status]
    assert values[:3] == ["SOLVED", "NOT_APPROACHING", "NOT_A_NUMBER"]
    assert values[3:] == ["NOT_APPROACHING", "OUT_OF_RANGE", "BEYOND_FLOATING_POINT"]
    assert np.array_equal(np.isnan(worn.dissipated_energy), worn.status != 0)
    assert int(worn.unsolved_impacts) == 5
    alone = carom.impact(pair, speed=2.0, angle="20 deg").dissipated_energy
    assert float(worn.total_friction_work) == pytest.approx(alone, rel=1e-9, abs=0.0)
    assert np.all(np.isfinite(worn.mean_friction_work))
    none = carom.wear_of_many(pair, speed=[-1.0], coefficient=1e-13)
    assert np.isnan(none.total_friction_work)
    assert np.isnan(none.total_worn_volume)
    assert int(none.unsolved_impacts) == 1


@pytest.mark.parametrize(
    ("inputs", "said"),
    [
        ({}, "speed: missing; give speed and angle, or normal_speed"),
        ({"speed": 1.0, "normal_speed": 1.0}, "speed: give speed and angle, or normal_speed"),
        ({"normal_speed": 1.0, "angle": 0.1}, "angle: give speed and angle, or normal_speed"),
        ({"speed": [1.0, 2.0], "angle": [0.1, 0.2, 0.3]}, "do not fit each other"),
        ({"speed": 1.0, "area": 0.0}, "area: 0.0 cannot be used; must be positive and finite"),
        ({"speed": 1.0, "area": "2 m"}, "area: '2 m' cannot be used; that is not a value in m^2"),
        ({"speed": 1.0, "spin2": 1.0}, "spin2: 1.0 cannot be used; only a second sphere can spin"),
        ({"speed": "fast"}, "speed: 'fast' cannot be used"),
        ({"speed": 1.0, "losses": 3}, "losses: 3 cannot be used; must be a law of losses"),
        ({"speed": 1.0, "mu": 3}, "mu: no keyword of wear"),
    ],
)
def test_many_impacts_that_cannot_be_read_are_refused_in_one_line(pair, inputs, said):
    assert said in refused("", carom.wear_of_many, pair, **inputs)


def test_components_and_speeds_are_the_same_impacts(pair):
    one = carom.wear_of_many(pair, speed=2.0, angle=0.5, spin=[0.0, "60 rpm"], area=1.0)
    along = {"normal_speed": 2.0 * np.cos(0.5), "tangential_speed": 2.0 * np.sin(0.5)}
    other = carom.wear_of_many(pair, **along, spin=[0.0, 2.0 * np.pi], area=1.0)
    np.testing.assert_allclose(one.dissipated_energy, other.dissipated_energy, rtol=1e-12)


def test_two_spheres_that_spin(steel_ball):
    pair = carom.Pair(steel_ball, carom.Sphere(radius="3 mm", material="steel"), friction=0.3)
    motion = {"speed": 1.0, "angle": 0.3, "spin": 50.0, "spin2": -20.0}
    lost = carom.impact(pair, **motion).dissipated_energy
    many = carom.wear_of_many(pair, **motion)
    assert float(many.total_friction_work) == pytest.approx(lost, rel=1e-9, abs=0.0)


def test_progress_is_told(pair):
    said = []
    carom.wear_of_many(pair, speed=[1.0, 2.0], progress=lambda *answer: said.append(answer))
    assert said == [(2, 2), (1, 2), (2, 2)]


def test_stored_wear_is_read_again_and_drawn(hit, pair, tmp_path):
    many = carom.wear_of_many(pair, speed=[1.0, 2.0], angle=[0.3, 1.0])
    for k, worn in enumerate((hit.wear(coefficient=1e-13), hit.wear(), many)):
        save(worn, tmp_path / f"{k}.nc")
        back = carom.read(tmp_path / f"{k}.nc")
        assert back.identical(worn)
        figure = carom.plots.plot_wear(back)
        assert len(figure.axes) == (3 if "x" in back.coords else 1)
    title = carom.plots.plot_wear(hit.wear()).axes[0].get_title()
    assert title.startswith("largest ")


def test_what_has_no_profile_is_not_drawn(pair):
    spread = carom.wear_of_many(pair, speed=1.0, area=1.0)
    refused("plot_wear draws the wear of one spot", carom.plots.plot_wear, spread)
