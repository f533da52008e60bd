"""`fit` on plates that give way: thickness, friction and stiffness against known truth."""

import json
from math import pi

import numpy as np
import pytest
from scipy.stats import binom, norm

import carom
from carom.impacts.validity import GRAVITY
from carom.lab.fitting import plates
from carom.lab.fitting.model import EXACT, Model, suited
from carom.lab.fitting.options import read_options
from carom.lab.fitting.reading import read_problem, read_rebounds

SEED = 20261126
BALL = carom.Sphere(radius="5 mm", material="bearing steel")
STEEL = BALL.material
MU, H, SETS = 0.15, 3e-3, 40
SPEEDS = np.geomspace(0.1, 1.0, 12)
ANGLES = np.radians([3.0, 7.0, 11.0, 15.0, 20.0, 25.0, 30.0, 36.0, 42.0, 50.0, 60.0, 70.0])


def on_plate(thickness=H, friction=MU, **wall):
    plate = carom.HalfSpace("bearing steel", thickness=thickness, **wall)
    return carom.Pair(BALL, plate, friction)


START = on_plate("5 mm", 0.3)
WALL = carom.Pair(BALL, carom.HalfSpace("bearing steel"), MU)


def observed(*names, speed=SPEEDS, angle=0.0, thickness=H, spin=0.0):
    """Return what `impact` gives, without noise, by name."""
    each = np.broadcast_arrays(speed, angle, thickness)
    hits = [
        carom.impact(on_plate(float(h)), speed=float(v), angle=float(a), spin=spin)
        for v, a, h in zip(*each, strict=True)
    ]
    return {name: np.array([getattr(hit, name) for hit in hits]) for name in names}


def drops(sigma, seed=SEED, thickness=H):
    """Return normal impacts with noise of the restitution, not told."""
    e = observed("normal_restitution", thickness=thickness)["normal_restitution"]
    noise = np.random.default_rng(seed).normal(0.0, sigma, e.size)
    return {"normal_speed": SPEEDS, "normal_restitution": e + noise}


def test_what_a_plate_gives_is_that_of_the_impact():
    """Restitution and contact time, interpolated over lambda, against the solver."""
    random = np.random.default_rng(SEED)
    for thickness, speed in random.uniform((1.6e-3, 0.05), (0.1, 2.0), (40, 2)).tolist():
        pair = on_plate(thickness)
        hit, values = carom.impact(pair, speed=speed), {"thickness": np.array([[thickness]])}
        arguments = START, np.array([speed]), values
        near = 1e-10 if pair.gives_way(hit.scales) else 1e-3  # of a thick wall, which fits bend
        assert plates.restitution(*arguments)[0, 0] == pytest.approx(
            hit.normal_restitution, abs=near
        )
        assert plates.duration(*arguments)[0, 0] == pytest.approx(hit.duration, rel=near)


def test_a_thick_plate_by_hand():
    """e = exp(-1.8917 lambda), lambda = m V/(8 sqrt(D rho h) d), d = (15 m V^2/(16 E* sqrt R))^0.4.

    1 - e is linear in 1/h^2, and so are the weighted mean and the ends of its interval.
    """
    young, nu, rho, radius = STEEL.young, STEEL.poisson, STEEL.density, BALL.radius
    mass = 4.0 / 3.0 * pi * radius**3 * rho
    deep = (15.0 * mass * SPEEDS**2 * 2.0 * (1.0 - nu**2) / (16.0 * young * radius**0.5)) ** 0.4
    thin = young * rho / (12.0 * (1.0 - nu**2))  # D rho h = this times h^4
    slopes = 1.8917 * mass * SPEEDS / (8.0 * thin**0.5 * deep)
    truth, sigma = 0.030, 3e-4
    noise = np.random.default_rng(SEED).normal(0.0, sigma, SPEEDS.size)
    data = {
        "normal_speed": SPEEDS,
        "normal_restitution": np.exp(-slopes / truth**2) + noise,
        "normal_restitution_error": np.full(SPEEDS.size, sigma),
    }
    whole = (slopes**2).sum()
    inverse = (slopes * -np.log(data["normal_restitution"])).sum() / whole
    reach = norm.ppf(0.975) * sigma / whole**0.5
    result = carom.fit(data, pair=START, robust=False).thickness
    assert result.value == pytest.approx(inverse**-0.5, rel=2e-3)
    assert result.low - result.value == pytest.approx(
        (inverse + reach) ** -0.5 - inverse**-0.5, rel=0.03
    )
    assert result.high - result.value == pytest.approx(
        (inverse - reach) ** -0.5 - inverse**-0.5, rel=0.03
    )
    assert result.low < truth < result.high


@pytest.mark.first_case
@pytest.mark.parametrize("thickness", [1.5e-3, 2e-3, 3e-3, 8e-3])
@pytest.mark.parametrize("name", ["normal_restitution", "normal_speed_out", "duration"])
def test_a_thickness_is_found_by_any_normal_response(name, thickness):
    """Without noise, from 5 mm on, to the accuracy that `fit` works with."""
    data = {"normal_speed": SPEEDS, **observed(name, thickness=thickness)}
    result = carom.fit(data, pair=START)
    assert result.thickness.value == pytest.approx(thickness, rel=1e-6)
    assert result.pair == on_plate(result.thickness.value, 0.3)


def test_heights_of_drops_tell_the_thickness():
    e = observed("normal_restitution")["normal_restitution"]
    height = SPEEDS**2 / (2.0 * GRAVITY)
    data = {"drop_height": height, "rebound_height": height * e**2}
    assert carom.fit(data, pair=START).thickness.value == pytest.approx(H, rel=1e-6)


def test_where_a_fit_starts_does_not_matter():
    values = [
        carom.fit(drops(0.01), pair=on_plate(start)).thickness for start in ("1 um", "3 mm", "1 m")
    ]
    for other in values[1:]:
        assert other.value == pytest.approx(values[0].value, rel=1e-7)
        assert other.high == pytest.approx(values[0].high, rel=1e-6)


@pytest.mark.slow
def test_friction_and_stiffness_on_a_plate_of_known_thickness():
    """No restitution is asked for; what was measured of it is compared with that of the plate."""
    names = ("normal_restitution", "rebound_angle", "spin_out")
    seen = observed(*names, angle=ANGLES, speed=SPEEDS[::-1])
    for some in (names, names[1:]):
        data = {"speed": SPEEDS[::-1], "angle": ANGLES, **{name: seen[name] for name in some}}
        result = carom.fit(data, pair=on_plate(friction=0.4))
        assert result.friction.value == pytest.approx(MU, rel=1e-6)
        assert result.kappa.value == pytest.approx(WALL.kappa, rel=1e-6)
        assert str(result.thickness) == "3 mm, not varied"
        median = np.median(seen["normal_restitution"])
        assert "restitution: as the plate also shears, 1 - e is some 2.2 % larger" in result.notes
        assert result.restitution.value == pytest.approx(median, rel=1e-9)


@pytest.mark.slow
def test_many_plates_in_one_table():
    """Each row has its own thickness, whatever that of the pair, and an error of it counts."""
    thickness = np.linspace(2e-3, 8e-3, 12)
    seen = observed("rebound_angle", "spin_out", angle=ANGLES, speed=0.5, thickness=thickness)
    data = {"speed": np.full(12, 0.5), "angle": ANGLES, "thickness [mm]": 1e3 * thickness, **seen}
    for pair in (WALL, START):
        result = carom.fit(data, pair=pair)
        assert result.friction.value == pytest.approx(MU, rel=1e-6)
        assert result.thickness is None
    errors = {"thickness_error [mm]": np.full(12, 0.3)}
    noisy = {**data, "spin_out": seen["spin_out"] + 1e-3, "spin_out_error": np.full(12, 0.01)}
    noisy["rebound_angle_error"] = np.full(12, 1e-3)
    sure, unsure = (carom.fit({**noisy, **more}, pair=START) for more in ({}, errors))
    width = [each.friction.high - each.friction.low for each in (sure, unsure)]
    assert width[1] > 1.5 * width[0]


@pytest.mark.slow
def test_intervals_of_thickness_hold_it_as_often_as_they_say():
    """40 sets, errors from the scatter: misses within what is likely for 95 %, 1 in 2000."""
    results = [carom.fit(drops(0.01, seed), pair=START).thickness for seed in range(SETS)]
    misses = sum(not each.low <= H <= each.high for each in results)
    assert misses <= binom.ppf(1.0 - 5e-4, SETS, 0.05)
    values = np.array([each.value for each in results])
    width = np.median([each.high - each.low for each in results])
    assert 0.7 < width / (2.0 * 1.96 * values.std()) < 1.45
    assert abs(values.mean() - H) < 4.0 * values.std() / np.sqrt(SETS)


@pytest.mark.slow
def test_thickness_friction_and_stiffness_at_once():
    """5 sets of 12 oblique impacts: misses of 15 intervals within what is likely."""
    names = {"normal_restitution": 0.01, "rebound_angle": 0.005, "spin_out": 1.0}
    seen = observed(*names, angle=ANGLES, speed=SPEEDS[::-1])
    truth = {"friction": MU, "kappa": WALL.kappa, "thickness": H}
    misses = 0
    for seed in range(5):
        random = np.random.default_rng(seed)
        noisy = {name: seen[name] + random.normal(0.0, s, 12) for name, s in names.items()}
        data = {"speed": SPEEDS[::-1], "angle": ANGLES, **noisy}
        result = carom.fit(data, pair=START, vary=[*truth])
        misses += sum(not result[n].low <= value <= result[n].high for n, value in truth.items())
        assert result.thickness.value == pytest.approx(H, rel=0.05)
    assert misses <= binom.ppf(1.0 - 5e-4, 15, 0.05)
    assert result.comparison["Walton"].excess > 2.0
    assert result.comparison["rigid Coulomb"].values.keys() == {"friction", "thickness"}


def test_regimes_are_those_of_the_impacts():
    angles, speed = np.radians(np.arange(1.0, 80.0)), 0.5
    data = {"speed": np.full(79, speed), "angle": angles}
    data |= observed("rebound_angle", angle=angles, speed=speed)
    problem = read_problem(read_rebounds(data), on_plate())
    options = read_options(problem, None, None)
    regimes = Model(suited(EXACT, problem), problem, (), options.start).regimes(np.zeros(0))
    for angle, regime in zip(angles, regimes, strict=True):
        phases = carom.impact(on_plate(), speed=speed, angle=float(angle)).phases
        assert (regime == 0) == (phases[0].kind == "stick"), angle
        assert (regime == 3) == (len(phases) == 1), angle


@pytest.mark.slow
def test_a_plate_too_thick_to_be_told_has_an_open_interval():
    result = carom.fit(drops(0.02, thickness=30e-3), pair=START)
    assert result.thickness.high == np.inf
    assert result.thickness.low < 30e-3
    assert "at least" in str(result.thickness)
    assert result.restitution.high == 1.0
    assert "thickness: the data do not tell the plate from a thick wall" in result.notes
    assert result.to_dict()["parameters"]["thickness"]["high"] is None


def test_sliding_alone_gives_friction_and_thickness_together_at_one_speed():
    """mu (1 + e) is all that it tells, and at one speed e is one number."""
    angles = np.radians([60.0, 65.0, 70.0, 75.0])
    normal = np.full(4, 0.3)
    seen = observed("spin_out", angle=angles, speed=normal / np.cos(angles))
    data = {"normal_speed": normal, "angle": angles, **seen, "spin_out_error": np.full(4, 0.1)}
    result = carom.fit(data, pair=START, vary=["friction", "thickness"])
    assert "friction and thickness only together" in result.thickness.reason
    assert "fixed={'thickness': '3 mm'}" in result.friction.reason
    held = carom.fit(data, pair=START, vary="friction", fixed={"thickness": "3 mm"})
    assert held.friction.value == pytest.approx(MU, rel=1e-5)


@pytest.mark.slow
def test_the_speed_tells_a_plate_from_other_losses():
    """lambda grows as V^(1/5), and e falls faster than that of a viscous ball."""
    losses = carom.fit(drops(0.003), pair=START).losses
    assert losses.standings[0].law == "ZenerPlate"
    assert losses.standings[0].losses is None
    assert losses["ZenerPlate"].parameter.low < H < losses["ZenerPlate"].parameter.high
    assert losses["constant"].excess > 10.0


def test_where_the_theory_of_plates_ends_is_noted():
    def noted(words, thickness=H, **inputs):
        notes = carom.fit(drops(1e-3, thickness=thickness), pair=START, **inputs).notes
        return [note for note in notes if words in note]

    assert not noted("bending wave/h")
    (shear,) = noted("it comes out some")
    assert "1.1 % too small" in shear
    (thick,) = noted("bending wave/h", 25e-3)
    assert "1 - e is an estimate" in thick
    assert noted("it comes out more than 9.7 % too small", 25e-3)
    narrow = carom.fit(drops(1e-3), pair=on_plate(width="5 cm"))
    assert any("the rim answers" in note for note in narrow.notes)


@pytest.mark.slow
def test_all_that_a_fit_offers(tmp_path):
    result = carom.fit(drops(0.01), pair=START)
    json.dumps(result.to_dict(), allow_nan=False)
    assert "@article{zener1941," in result.cite()
    assert result.advice(2, "thickness").parameter == "thickness"
    samples = result.posterior(200, seed=1)
    assert samples.thickness.units == "m"
    reach = 0.5 * (result.thickness.high - result.thickness.low)
    assert float(samples.thickness.std()) == pytest.approx(reach / 2.0, rel=0.3)
    assert len(result.plot().axes) == 1
    again = carom.read(carom.save(result, tmp_path / "fit.nc"))
    assert again.value.sel(parameter="thickness") == result.thickness.value
    held = carom.fit(
        {"speed": SPEEDS, "angle": ANGLES, **observed("spin_out", angle=ANGLES)}, pair=on_plate()
    )
    assert len(held.plot().axes) == 2


DATA = drops(0.01)
OBLIQUE = {"speed": SPEEDS, "angle": ANGLES, "rebound_angle": 0.9 * ANGLES}


@pytest.mark.parametrize(
    ("data", "inputs", "words"),
    [
        (DATA, {"vary": "restitution"}, "follows from its thickness and the speed; leave it out"),
        (DATA, {"fixed": {"restitution": 0.9}}, "fixed: 'restitution' cannot be used"),
        (DATA, {"vary": "friction"}, "fit thickness alone, vary='thickness'"),
        (DATA, {"pair": WALL, "vary": "thickness"}, "the wall is thick; give its thickness"),
        (DATA, {"pair": WALL, "fixed": {"thickness": 1e-3}}, "the wall is thick"),
        (DATA, {"fixed": {"thickness": "1 mm"}}, "thickness must lie between 1.3"),
        (OBLIQUE, {"pair": on_plate("0.9 mm")}, "gives way like a foil .* in every row"),
        ({**DATA, "thickness": np.full(12, H)}, {}, "plates of known thickness do not depend on"),
        ({**DATA, "thickness": np.full(12, H)}, {"vary": "thickness"}, "a column of the data"),
        (
            {**OBLIQUE, "thickness": np.full(12, -H)},
            {},
            "thickness: -0.003 in every row .* positive",
        ),
        ({"angle": ANGLES, "rebound_angle": ANGLES}, {}, "speed: column missing; a plate needs"),
        ({"normal_speed": SPEEDS, "duration": SPEEDS}, {}, "duration: .* check its unit"),
        ({"normal_speed": SPEEDS, "duration": SPEEDS}, {"pair": WALL}, "no measured response"),
        ({"normal_speed": SPEEDS, "spin_out": SPEEDS}, {}, "angle: column missing"),
        ({"speed": SPEEDS, "normal_restitution": SPEEDS / 9.0}, {}, "head-on impacts normal_speed"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(data, inputs, words):
    with pytest.raises(carom.InputError, match=words) as caught:
        carom.fit(data, **{"pair": START, **inputs})
    assert "\n" not in str(caught.value)


def test_a_thick_wall_takes_no_notice_of_contact_times():
    result = carom.fit({**DATA, "duration": SPEEDS}, pair=WALL)
    assert "columns that were not used: duration" in result.notes
