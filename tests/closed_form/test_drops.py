"""Normal drops: restitution from heights, and how it depends on speed, against known truth."""

import json

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp
from tests import checks
from tests.checks import BALL, PAIR

import carom
from carom.lab.fitting.bounces import DENSITY, GRAVITY, VISCOSITY, taken_by_air
from carom.lab.fitting.loss_laws import metal, plastic, viscous
from carom.plots.fits import plot_drops

SEED = 20261124
HEIGHTS = np.geomspace(0.001, 0.5, 12)
SPEEDS = np.sqrt(2.0 * GRAVITY * HEIGHTS)
TRUTHS = {
    "constant": (carom.KelvinVoigt(restitution=0.9), 0.9),
    "KelvinVoigt": (carom.KelvinVoigt(loss_time="2 us"), 2e-6),
    "ElasticPlastic": (carom.ElasticPlastic(yield_velocity="0.3 m/s"), 0.3),
    "Metal": (carom.Metal(flow_stress="500 MPa"), 500e6),
}


def restitutions(losses, speeds=SPEEDS):
    hits = [carom.impact(PAIR, speed=speed, angle=0.0, losses=losses) for speed in speeds]
    return np.array([hit.normal_restitution for hit in hits])


def dropped(restitution, heights=HEIGHTS):
    return {"drop_height": heights, "rebound_height": heights * restitution**2}


@pytest.mark.parametrize("time", [1e-9, 1e-7, 2e-6, 3e-5, 3e-4])
def test_restitution_of_a_loss_time_is_that_of_the_impact(time):
    exact = restitutions(carom.KelvinVoigt(loss_time=time))
    actual = viscous(PAIR, SPEEDS, {"loss_time": np.array([[time]])})[0]
    np.testing.assert_allclose(actual, exact, atol=3e-9)


@pytest.mark.parametrize("velocity", [1e-3, 0.3, 10.0])
def test_restitution_of_a_yield_velocity_is_that_of_the_impact(velocity):
    exact = restitutions(carom.ElasticPlastic(yield_velocity=velocity))
    actual = plastic(PAIR, SPEEDS, {"yield_velocity": np.array([[velocity]])})[0]
    np.testing.assert_allclose(actual, exact, atol=1e-12)


@pytest.mark.parametrize("stress", [100e6, 300e6, 1e9, 5e9])
def test_restitution_of_a_flow_stress_is_that_of_the_impact(stress):
    """From no yield at all to V_1 = 3000 V_y; the impact is marched over springs."""
    exact = restitutions(carom.Metal(flow_stress=stress))
    actual = metal(PAIR, SPEEDS, {"flow_stress": np.array([[stress]])})[0]
    np.testing.assert_allclose(actual, exact, atol=3e-6)


def test_heights_give_the_restitution():
    """e = sqrt(h'/h), with errors of de/e = (dh'/h' + dh/h)/2 in squares; friction stays held."""
    data = dropped(0.8) | {"rebound_height_error": np.full(12, 1e-4)}
    result = carom.fit(data, pair=PAIR)
    assert result.restitution.value == pytest.approx(0.8, rel=1e-4)
    weight = np.sum((SPEEDS * 0.8 * SPEEDS / (GRAVITY * 1e-4)) ** 2)
    half = 1.96 / np.sqrt(weight)
    assert result.restitution.high - result.restitution.value == pytest.approx(half, rel=0.25)
    assert str(result.friction) == "0.2, not varied"
    uncertain = dropped(0.8) | {"drop_height_error": 0.05 * HEIGHTS}
    wide = carom.fit(uncertain | {"rebound_height_error": 1e-3 * HEIGHTS}, pair=PAIR).restitution
    expected = 1.96 * 0.8 * 0.025 / np.sqrt(12.0)
    assert 0.5 * (wide.high - wide.low) == pytest.approx(expected, rel=0.25)


@pytest.mark.slow
@pytest.mark.parametrize(("law", "truth"), TRUTHS.items(), ids=TRUTHS)
def test_the_law_of_losses_is_found_with_its_parameter(law, truth):
    """Scatter of 0.005 in e over a factor of 22 in speed; intervals of 95 %, in 7 of 8 sets."""
    sets, least = (8, 7) if law == "ElasticPlastic" else (4, 3)
    losses, value = truth
    exact, random = restitutions(losses), np.random.default_rng(SEED)
    held = 0
    for _ in range(sets):
        noisy = exact + random.normal(0.0, 0.005, exact.size)
        actual = carom.fit(dropped(noisy), pair=PAIR).losses
        first = actual.standings[0]
        assert first.law == law
        assert first.parameter.value == pytest.approx(value, rel=0.1)
        held += first.parameter.low <= value <= first.parameter.high
        assert ("the same at all speeds" if law == "constant" else law) in actual.verdict
    assert held >= least
    np.testing.assert_allclose(restitutions(first.losses), exact, atol=0.01)


@pytest.mark.parametrize("restitution", [0.05, 0.2, 0.999])
def test_any_restitution_is_found(restitution):
    """Also below 0.3, where no oblique impact is fitted."""
    noisy = restitution + np.random.default_rng(SEED).normal(0.0, 1e-3, 12)
    actual = carom.fit(dropped(noisy), pair=PAIR).restitution
    assert actual.value == pytest.approx(noisy.mean(), abs=2e-4)
    assert actual.low < restitution < actual.high


def test_a_ball_on_a_ball_tells_nothing_by_heights():
    both = carom.Pair(BALL, BALL, friction=0.2)
    with pytest.raises(carom.InputError, match=r"^drop_height: the second body flies off, too"):
        carom.fit(dropped(0.8), pair=both)


@pytest.mark.slow
def test_one_outlier_does_not_change_the_law():
    noisy = restitutions(TRUTHS["KelvinVoigt"][0])
    noisy += np.random.default_rng(SEED).normal(0.0, 0.005, noisy.size)
    noisy[4] *= 1.2
    losses = carom.fit(dropped(noisy), pair=PAIR).losses
    assert losses.standings[0].law == "KelvinVoigt"
    assert losses.standings[0].parameter.value == pytest.approx(2e-6, rel=0.05)


def test_laws_that_cannot_be_told_apart_are_said_so():
    """Over a factor of 1.4 in speed a small loss is the same at all speeds as any other."""
    heights = np.linspace(0.1, 0.2, 6)
    noisy = 0.98 + np.random.default_rng(SEED).normal(0.0, 0.02, 6)
    verdict = carom.fit(dropped(noisy, heights), pair=PAIR).losses.verdict
    assert "cannot tell" in verdict
    assert "constant" in verdict
    assert "KelvinVoigt" in verdict


def test_there_is_nothing_to_tell_at_one_speed():
    same = np.full(6, 0.2)
    assert carom.fit(dropped(np.linspace(0.8, 0.85, 6), same), pair=PAIR).losses is None
    ratios = {"angle [deg]": [5.0, 20.0, 40.0, 60.0], "impulse_ratio": [0.1, 0.2, 0.21, 0.2]}
    assert carom.fit(ratios, pair=PAIR, fixed={"restitution": 1.0}).losses is None


def slowed(ball, speed):
    """Return the deceleration of a ball in air, by Schiller & Naumann below Re = 960."""
    number = max(2.0 * ball.radius * abs(speed) / VISCOSITY, 1e-9)
    coefficient = max(24.0 / number * (1.0 + 0.15 * number**0.687), 0.45)
    area = np.pi * ball.radius**2
    return 0.5 * coefficient * DENSITY * area * speed * abs(speed) / ball.mass


def flown(ball, speed=0.0, height=0.0, ends="below"):
    """Return time, height and velocity at the end of a flight: at the top, or on the floor."""

    def end(t, y):
        return y[1] if ends == "top" else y[0]

    end.terminal, end.direction = True, -1.0
    flight = solve_ivp(
        lambda t, y: [y[1], -GRAVITY - slowed(ball, y[1])],
        (0.0, 10.0),
        [height, speed],
        events=end,
        rtol=1e-10,
        atol=1e-13,
    )
    return flight.t[-1], *flight.y[:, -1]


@pytest.mark.parametrize(("radius", "material"), [("2 mm", "nylon"), ("0.5 mm", "steel")])
def test_what_air_takes_is_said(radius, material):
    """Integrated with drag, heights and times from 1 m tell 1 to 3 % too little, to first order."""
    ball = carom.Sphere(radius=radius, material=material)
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    back = 0.8 * -flown(ball, height=1.0)[2]
    height = flown(ball, back, ends="top")[1]
    speeds = {"normal_speed": np.array([np.sqrt(2.0 * GRAVITY)])}
    speeds["normal_speed_out"] = np.array([np.sqrt(2.0 * GRAVITY * height)])
    lost = 0.8 / np.sqrt(height) - 1.0
    assert taken_by_air(speeds, {*speeds}, pair) == pytest.approx(lost, rel=0.1)
    first, _, down = flown(ball, back)
    second, _, _ = flown(ball, -0.8 * down)
    speeds = {"normal_speed": np.array([0.5 * GRAVITY * first])}
    speeds["normal_speed_out"] = np.array([0.5 * GRAVITY * second])
    lost = 0.8 * first / second - 1.0
    assert taken_by_air(speeds, {*speeds}, pair) == pytest.approx(lost, rel=0.1)
    assert lost > 0.01
    data = dropped(np.array([0.8, 0.81, 0.79]), np.array([1.0, 1.0, 1.0]))
    assert any(note.startswith("air: drag") for note in carom.fit(data, pair=pair).notes)
    assert not any(note.startswith("air") for note in carom.fit(dropped(0.8), pair=PAIR).notes)


def test_drag_is_not_used_beyond_its_range():
    """Of a ball that is too large or too light heights say so, and times are refused."""
    floor = carom.HalfSpace(material="steel")
    large = carom.Pair(carom.Sphere(radius="0.3 m", material="steel"), floor, friction=0.2)
    heights = {"drop_height": [2.0, 2.5, 2.9], "rebound_height": [1.0, 1.3, 1.5]}
    (note,) = [each for each in carom.fit(heights, pair=large).notes if each.startswith("air")]
    assert "Reynolds number reaches 3e+05" in note
    times = {"bounce_interval": [1.2, 0.9, 0.7, 0.52]}
    checks.refused("bounce_interval: the Reynolds number reaches", carom.fit, times, pair=large)
    foam = carom.Material(young="1 MPa", poisson=0.3, density=30.0)
    light = carom.Pair(carom.Sphere(radius="5 mm", material=foam), floor, friction=0.2)
    checks.refused("bounce_interval: drag takes more than 10 %", carom.fit, times, pair=light)


@pytest.mark.slow
def test_drops_are_stored_drawn_and_told(tmp_path):
    result = carom.fit(dropped(restitutions(TRUTHS["KelvinVoigt"][0])), pair=PAIR)
    carom.save(result.to_dataset(), tmp_path / "drops.nc")
    stored = carom.read(tmp_path / "drops.nc")
    (axis,) = plot_drops(stored).axes
    assert axis.get_xlabel() == "normal speed $V_1$\u00a0(m/s)"
    assert len(result.plot().axes) == 1
    losses = json.loads(json.dumps(result.to_dict(), allow_nan=False))["losses"]
    assert losses["KelvinVoigt"]["loss_time"]["value"] == pytest.approx(2e-6, rel=1e-3)
    words = str(result)
    assert "KelvinVoigt: loss_time" in words
    assert "rigid Coulomb" not in words


REFUSED = {
    "rebound_height: 0.3 in row 1": {"drop_height": [0.1, 0.2], "rebound_height": [0.3, 0.1]},
    "drop_height: -0.2 in row 2": {"drop_height": [0.1, -0.2], "rebound_height": [0.05, 0.1]},
    "drop_height: column missing": {"rebound_height": [0.3, 0.1]},
    "rebound_height: it gives the same as normal_restitution": {
        "drop_height": [0.1, 0.2],
        "rebound_height": [0.01, 0.02],
        "normal_restitution": [0.3, 0.1],
    },
    "drop_height: it gives the same as normal_speed": {
        "drop_height": [0.1, 0.2],
        "normal_speed": [0.3, 0.1],
        "normal_restitution": [0.3, 0.1],
    },
    "drop_height: 30 m is 24.3 m/s at the plate; is the unit cm or mm?": {
        "drop_height [m]": [10.0, 30.0],
        "normal_restitution": [0.3, 0.1],
    },
    "data: no measured response": {"drop_height": [0.1, 0.2]},
}

CENTIMETRES = {"drop_height": [8.0, 10.1, 17.9, 29.9], "rebound_height": [7.4, 8.8, 15.8, 25.0]}


def written(path, columns, heads="{}"):
    """A file of these columns; the heads as a pattern, which may add a unit."""
    rows = ["".join(f"{cell}," for cell in row)[:-1] for row in zip(*columns.values(), strict=True)]
    path.write_text("\n".join([",".join(heads.format(name) for name in columns), *rows]) + "\n")
    return path


def test_heights_without_a_unit_are_asked_for(tmp_path):
    """In a file whatever they are; in Python, where bare numbers are in m, if they are large."""
    metres = {name: np.array(values) / 100.0 for name, values in CENTIMETRES.items()}
    expected = carom.fit(metres, pair=PAIR).restitution.value
    path = tmp_path / "drops.csv"
    asked = r"drop_height: no unit.* 'drop_height \[m\]' or 'drop_height \[cm\]'"
    sources = [written(path, CENTIMETRES), CENTIMETRES, pd.DataFrame(CENTIMETRES)]
    sources += [{name: [str(cell) for cell in cells] for name, cells in CENTIMETRES.items()}]
    for source in sources:
        assert checks.refused(asked, carom.fit, source, pair=PAIR).startswith("2 faults")
    for bare in (metres, {**metres, "drop_height": ["8 cm", *metres["drop_height"][1:]]}):
        checks.refused(asked, carom.fit, written(path, bare), pair=PAIR)
    by_name = {name: [f"{cell} cm" for cell in cells] for name, cells in CENTIMETRES.items()}
    with_gap = {**by_name, "rebound_height": [*by_name["rebound_height"][:3], "-"]}
    carom.fit(written(path, with_gap), pair=PAIR)
    named = {f"{name} [cm]": cells for name, cells in CENTIMETRES.items()}
    for source in (written(path, CENTIMETRES, "{} [cm]"), written(path, by_name), by_name, named):
        value = carom.fit(source, pair=PAIR).restitution.value
        assert value == pytest.approx(expected, rel=1e-9)


def test_errors_of_heights_have_units_too(tmp_path):
    table = {f"{name} [cm]": cells for name, cells in CENTIMETRES.items()}
    table["rebound_height_error"] = [0.1] * 4
    for source in (written(tmp_path / "drops.csv", table), table):
        checks.refused("rebound_height_error: no unit", carom.fit, source, pair=PAIR)


@pytest.mark.parametrize(("words", "data"), REFUSED.items(), ids=REFUSED)
def test_heights_that_cannot_be_are_refused(words, data):
    with pytest.raises(carom.InputError) as refused:
        carom.fit(data, pair=PAIR)
    assert str(refused.value).startswith(words)
