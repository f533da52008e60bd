"""The laws of normal loss as users meet them: units, refusals, how the loss follows the speed."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from matplotlib.text import Text
from scipy.optimize import brentq
from scipy.special import beta
from tests.checks import PAIR as STEEL, refused

import carom
from carom import HalfSpace, Material, Pair, Sphere
from carom.bodies.losses import LossLaw, yield_velocity
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.rebounds import lossy_rebounds
from carom.impacts.histories import spheres
from carom.impacts.validity import judge_losses
from carom.page.files import NumbersImpact
from carom.page.views import View

UNKNOWN = Material(young="70 GPa", poisson=0.22, density=2500)
GLASS = Pair(Sphere(radius="1 mm", material=UNKNOWN), HalfSpace(material=UNKNOWN), friction=0.1)


def hit(law: object, speed: float = 1.0, pair: Pair = STEEL) -> carom.results.Impact:
    return carom.impact(pair, normal_speed=speed, tangential_speed=0.4 * speed, losses=law)


def test_loss_time_is_read_with_its_unit() -> None:
    plain, worded = carom.KelvinVoigt(loss_time=2e-6), carom.KelvinVoigt(loss_time="2 us")
    assert worded.loss_time == plain.loss_time == pytest.approx(2e-6, rel=1e-15)
    assert hit(worded).normal_restitution == hit(plain).normal_restitution


def test_loss_time_is_in_units_of_the_elastic_impact() -> None:
    """alpha = tau V_1/d_max."""
    loss, alpha, _ = carom.KelvinVoigt(loss_time="2 us")._loss(STEEL, STEEL.scales(0.7))
    scales = STEEL.scales(0.7)
    assert loss == Loss.VISCOUS
    assert alpha == pytest.approx(2e-6 * 0.7 / scales.length, rel=1e-12)


def test_yield_velocity_is_read_with_its_unit() -> None:
    law = carom.ElasticPlastic(yield_velocity="50 mm/s")
    loss, y, _ = law._loss(STEEL, STEEL.scales(1.6))
    assert loss == Loss.PLASTIC
    assert y == pytest.approx((0.05 / 1.6) ** 0.4, rel=1e-14)


def test_yield_velocity_of_the_materials() -> None:
    """There the largest pressure of Hertz, (3/2) P/(pi a^2), is 1.6 yield strengths."""
    speed = yield_velocity(STEEL)
    scales = STEEL.scales(speed)
    radius = np.sqrt(STEEL.effective_radius * scales.length)
    pressure = 1.5 * scales.force / (np.pi * radius**2)
    assert pressure == pytest.approx(1.6 * STEEL.first.material.yield_strength, rel=1e-12)
    below = hit(carom.ElasticPlastic(), 0.99 * speed).normal_restitution
    assert below == pytest.approx(1, abs=1e-9)
    assert hit(carom.ElasticPlastic(), 1.5 * speed).normal_restitution < 0.99


def test_weaker_body_yields_first() -> None:
    soft, hard = (carom.material("steel", yield_strength=y) for y in ("100 MPa", "900 MPa"))

    def speed(first: Material, second: Material) -> float:
        ball, wall = Sphere(radius=0.01, material=first), HalfSpace(material=second)
        return float(yield_velocity(Pair(ball, wall, friction=0.2)))

    values = [speed(*bodies) for bodies in ((soft, soft), (hard, hard), (hard, soft))]
    assert values[1] / values[0] == pytest.approx(9.0**2.5, rel=1e-12)
    assert values[2] == pytest.approx(values[0], rel=1e-12)


@pytest.mark.parametrize("e", [0.001, 0.02, 0.3, 0.7, 0.95, 0.9999, 1.0])
@pytest.mark.parametrize("speed", [0.01, 3.0])
def test_wanted_restitution_is_what_comes_out(e: float, speed: float) -> None:
    """At any speed, to 1e-10."""
    actual = hit(carom.KelvinVoigt(restitution=e), speed).normal_restitution
    assert actual == pytest.approx(e, abs=1e-10)


def test_restitution_on_arrays_is_that_of_each() -> None:
    e = np.array([[0.5, 0.9], [0.9, 1.0]])
    loss, alpha, _ = carom.KelvinVoigt(restitution=e)._loss(STEEL, STEEL.scales(np.ones((2, 2))))
    each = [carom.KelvinVoigt(restitution=x)._loss(STEEL, STEEL.scales(1.0))[1] for x in e.ravel()]
    assert loss == Loss.VISCOUS
    assert np.array_equal(alpha, np.reshape(each, (2, 2)))


def test_speeds_in_arrays_give_the_loss_of_each() -> None:
    speed = np.array([0.1, 1.0, 4.0])
    for law in (carom.KelvinVoigt(loss_time="1 us"), carom.ElasticPlastic("0.2 m/s")):
        together = law._loss(STEEL, STEEL.scales(speed))[1]
        each = [law._loss(STEEL, STEEL.scales(v))[1] for v in speed]
        assert together == pytest.approx(each, rel=1e-14)


def test_arrays_mark_what_is_out_of_range() -> None:
    law = carom.KelvinVoigt(restitution=np.array([0.9, 0.0, 1.2, np.nan]))
    alpha = law._loss(STEEL, STEEL.scales(1.0))[1]
    assert np.array_equal(np.isnan(alpha), [False, True, True, True])


def test_viscous_loss_grows_with_the_fifth_root_of_the_speed() -> None:
    """1 - e -> (3/2) B(3/5, 3/2) tau V_1/d_max, d_max ~ V_1^(4/5)."""
    law = carom.KelvinVoigt(loss_time="1 ns")
    speeds = np.array([0.1, 3.2])
    lost = np.array([1.0 - hit(law, v).normal_restitution for v in speeds])
    assert lost[1] / lost[0] == pytest.approx(32.0**0.2, rel=1e-3)
    alpha = law._loss(STEEL, STEEL.scales(0.1))[1]
    assert lost[0] == pytest.approx(1.5 * beta(0.6, 1.5) * alpha, rel=1e-3)


def test_plastic_restitution_falls_with_the_fourth_root_of_the_speed() -> None:
    law = carom.ElasticPlastic(yield_velocity="1 mm/s")
    values = [hit(law, v).normal_restitution for v in (1.0, 4.0)]
    assert values[0] / values[1] == pytest.approx(4.0**0.25, rel=1e-3)


@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        *(({}, "restitution"), ({"restitution": 0.9, "loss_time": "1 us"}, "restitution")),
        *(({"restitution": 1.01}, "restitution.*1.01"), ({"restitution": 0.0}, "restitution.*0")),
        ({"restitution": 9e-4}, "restitution.*0.0009"),
        ({"restitution": -0.5}, "restitution.*-0.5"),
        ({"restitution": np.nan}, "restitution.*nan"),
        ({"restitution": np.inf}, "restitution.*inf"),
        ({"restitution": "high"}, "restitution.*high"),
        ({"restitution": "0.9 m"}, "restitution.*0.9 m"),
        *(({"loss_time": "2 mm"}, "loss_time.*2 mm"), ({"loss_time": -1e-6}, "loss_time.*-1e-06")),
        *(({"loss_time": np.nan}, "loss_time.*nan"), ({"loss_time": True}, "loss_time.*True")),
    ],
)
def test_viscous_law_refuses(inputs: dict[str, object], words: str) -> None:
    """Every refusal names the argument and what was given."""
    refused(words, carom.KelvinVoigt, **inputs)


@pytest.mark.parametrize("value", ["0.1 s", 0.0, -0.1, np.nan, np.inf, "fast"])
def test_plastic_law_refuses(value: object) -> None:
    refused(f"yield_velocity.*{value}", carom.ElasticPlastic, yield_velocity=value)


def test_plastic_law_wants_a_yield_strength() -> None:
    refused("yield_velocity: missing", hit, carom.ElasticPlastic(), pair=GLASS)
    refused("flow_stress: missing", hit, carom.Metal(), pair=GLASS)
    refused(r"flow_stress: 20000000000.0 cannot be used; a metal bears", hit, carom.Metal("20 GPa"))
    assert hit(carom.ElasticPlastic("0.5 m/s"), pair=GLASS).normal_restitution < 1.0


@pytest.mark.parametrize(
    "law", [carom.KelvinVoigt(loss_time="1 us"), carom.ElasticPlastic("1 m/s")]
)
def test_laws_of_the_speed_are_refused_without_units(law: object) -> None:
    for call in (carom.rebound, carom.solve):
        refused("losses", call, 1.0, 1.44, losses=law)


@pytest.mark.parametrize("law", [0.9, "KelvinVoigt", {"restitution": 0.9}])
def test_what_is_no_law_is_refused(law: object) -> None:
    refused(r"losses: .*law of losses", hit, law)


def test_too_large_a_loss_time_is_refused_not_answered() -> None:
    """alpha of 1e5: no bodies rebound so slowly; the impact says so."""
    refused("losses", hit, carom.KelvinVoigt(loss_time="1 s"))


def test_standard_linear_solid_is_in_units_of_the_elastic_impact() -> None:
    law = carom.StandardLinearSolid(modulus_ratio=1.5, relaxation_time="20 us")
    loss, theta, extra = law._loss(STEEL, STEEL.scales(0.7))
    assert (loss, extra) == (Loss.RELAXING, 0.5)
    assert theta == pytest.approx(2e-5 / STEEL.scales(0.7).time, rel=1e-12)
    assert law._describe() == {"modulus_ratio": 1.5, "relaxation_time": 2e-5}


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"modulus_ratio": 0.9, "relaxation_time": 1.0}, r"modulus_ratio: 0\.9 .* from 1 to 1000"),
        ({"modulus_ratio": 2.0, "relaxation_time": "2 mm"}, r"relaxation_time: '2 mm' .* in s"),
        ({"modulus_ratio": 2.0, "relaxation_time": -1.0}, r"relaxation_time: -1\.0 .* zero or"),
    ],
)
def test_what_is_no_standard_linear_solid_is_refused(inputs: dict[str, Any], message: str) -> None:
    refused(message, carom.StandardLinearSolid, **inputs)


@pytest.mark.parametrize(
    "call",
    [
        lambda **law: carom.rebound(0.5, 1.44, **law),
        lambda **law: carom.solve(0.5, 1.44, **law).psi_out,
        lambda **law: float(carom.curve(1.44, [0.5], **law).psi_out[0, 0]),
        lambda **law: carom.impact(STEEL, normal_speed=1.0, **law).duration,
        lambda **law: float(carom.laws.ReboundLaw(1.44, **law)(0.5)),
    ],
)
def test_the_old_name_of_losses_is_refused_with_the_new(call: Callable[..., float]) -> None:
    refused(
        r"^normal: no keyword of \w+; write losses$",
        call,
        normal=carom.KelvinVoigt(restitution=0.9),
    )


def test_validity_says_what_is_assumed_of_losses() -> None:
    """The solid and what another may change; of yielded spheres by how much psi_2 may be off."""
    by_name = {f.name: f for f in hit(carom.KelvinVoigt(restitution=0.8)).validity.findings}
    assert by_name["e"].value == pytest.approx(0.8)
    assert "as viscous in shear as in compression" in by_name["e"].verdict
    assert "by up to 0.35" in by_name["e"].verdict  # 0.2 (2.4 chi - 1.7), chi = 1.441
    by_name = {f.name: f for f in hit(carom.KelvinVoigt(restitution=0.4)).validity.findings}
    assert "not studied" in by_name["e"].verdict
    for ratio, words in ((2.0, "by up to 0.05"), (10.0, "by up to 0.05"), (11.0, "not studied")):
        law = carom.ElasticPlastic(yield_velocity=1.0 / ratio)
        by_name = {f.name: f for f in hit(law).validity.findings}
        assert by_name["V_1/V_y"].value == pytest.approx(ratio)
        assert words in by_name["V_1/V_y"].verdict
        assert by_name["V_1/V_y"].holds is None
    slow = yield_velocity(STEEL)
    for ratio, words in ((5.0, "off by up to 0.07"), (301.0, "not studied above 300")):
        by_name = {f.name: f for f in hit(carom.Metal(), ratio * slow).validity.findings}
        assert by_name["V_1/V_y"].value == pytest.approx(ratio)
        assert words in by_name["V_1/V_y"].verdict
        assert "lower by up to 0.12" in by_name["V_1/V_y"].verdict
        assert by_name["V_1/V_y"].holds is None
    assert "e" not in {f.name for f in hit(None).validity.findings}


@pytest.mark.first_case
@pytest.mark.parametrize(("chi", "e"), [(0.6, 0.99), (1.44, 0.7), (2.5, 0.99), (3.0, 0.95)])
def test_other_solids_of_one_restitution_are_as_near_as_validity_says(chi: float, e: float) -> None:
    """Yielding spheres, which are farthest off, against Kelvin & Voigt's at the same e."""
    psi = np.linspace(0.2, 4.0 * chi + 1.0, 40)
    one, many = np.ones(1), np.full(40, chi)

    def of(y: float) -> float:
        return float(lossy_rebounds(one, one, LossNumbers(Loss.PLASTIC, y)).restitution[0]) - e

    yielding = LossNumbers(Loss.PLASTIC, brentq(of, 0.05, 0.9999))
    viscous = carom.rebound(psi, chi, losses=carom.KelvinVoigt(restitution=e))
    off = float(np.abs(lossy_rebounds(psi, many, yielding).psi_out - viscous).max())
    verdict = judge_losses(LossNumbers(Loss.VISCOUS, 0.1), e, chi).verdict
    most = float(verdict.rpartition(" ")[2])
    assert 0.5 * most < off <= most


LOSSES = {
    "none": None,
    "Kelvin-Voigt": carom.KelvinVoigt(restitution=0.8),
    "loss time": carom.KelvinVoigt(loss_time="2 us"),
    "yielding": carom.ElasticPlastic(yield_velocity="0.1 m/s"),
    "metal": carom.Metal("300 MPa"),
    "relaxing": carom.StandardLinearSolid(modulus_ratio=1.5, relaxation_time="20 us"),
}
NOT_TITLES = ("elastic, normal", "elastic, tangential")  # energies that are stored


def texts(figure: Any) -> list[str]:
    """Return all that is written in a figure, names of energies apart."""
    values = [text.get_text() for text in figure.findobj(Text)]
    return [text for text in values if text not in NOT_TITLES]


@pytest.mark.first_case
@pytest.mark.parametrize("law", LOSSES.values(), ids=LOSSES.keys())
def test_titles_call_bodies_elastic_only_if_they_are(law: LossLaw | None) -> None:
    """All datasets of an impact, those in a sweep and in curves, and all figures of them."""
    actual, loss = hit(law), {} if law is None else law._describe()
    case = {"friction": 0.2, "speed": 2.0, "first": {"radius": "5 mm", "material": "steel"}, **loss}
    datasets = [actual.history(5), carom.sweep(case, carom.Grid({"angle": [0.1, 0.2]}))]
    titles = [str(dataset.attrs["title"]) for dataset in datasets]
    assert all(("elastic" in title) == (law is None) for title in titles), titles
    assert all(("with losses" in title) == (law is not None) for title in titles), titles
    others, drawn = [actual.spectrum(n=3)], [carom.plots.plot_spectrum(actual.spectrum(n=9))]
    drawn += [draw(actual) for draw in (carom.plots.plot_forces, carom.plots.plot_radii)]
    drawn.append(carom.plots.plot_impact(actual))
    if law in (LOSSES["none"], LOSSES["Kelvin-Voigt"]):  # fields are known
        time, first = 0.3 * actual.duration, actual.wear()
        fields, radial = actual.fields(time), actual.radial(time)
        others += [fields, radial, actual.stress(time), first]
        drawn += [carom.plots.plot_patch(fields), carom.plots.plot_wear(first)]
        drawn += [carom.plots.plot_contact(actual, count=2), carom.plots.plot_profiles(radial)]
    if law == LOSSES["Kelvin-Voigt"]:
        others.append(carom.curve(1.44, [0.5, 1.0], losses=law))
    entries = [str(dataset.attrs["title"]) for dataset in others]
    entries += [text for figure in drawn for text in texts(figure)]
    assert not [text for text in entries if "elastic" in text]


@pytest.mark.parametrize("restitution", [0.8, 1.0])
def test_figures_without_units_know_of_losses(restitution: float) -> None:
    """The page's figures of psi_1 and chi."""
    view = View(psi=1.5, chi=1.44, restitution=restitution)
    title = NumbersImpact(view).history(5).attrs["title"]
    assert title == f"oblique impact of {spheres(view.losses is not None)}"


@pytest.mark.parametrize("none", [[], [[]], ()], ids=str)
@pytest.mark.parametrize("law", LOSSES.values(), ids=list(LOSSES))
def test_no_instants_and_no_radii_have_no_states(law: LossLaw | None, none: Any) -> None:
    """An empty list is an answer of no rows, whatever computes the impact."""
    solution = hit(law).solution
    assert all(len(column) == 0 for column in vars(solution.at(none)).values())
    assert np.size(solution.touched(none)) == 0
