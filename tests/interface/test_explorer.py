"""What the page of the explorer draws is what the library says, and a link holds all of it."""

import json
import re
import subprocess
import sys
from dataclasses import fields, replace
from urllib.parse import urlencode

import numpy as np
import pytest
from hypothesis import event, given, settings, strategies as st

import carom

pytest.importorskip("flask")

from carom.explorer.answers import answer, laws
from carom.explorer.config import REGIMES, config
from carom.explorer.figures import curve_figure
from carom.explorer.files import write
from carom.explorer.knobs import CHOICES, KNOBS, NUMBERS, OF_MATERIAL, label
from carom.explorer.overlays import exact_curve, law_curves
from carom.explorer.refused import Refused
from carom.explorer.scenes import ENERGIES, impact_of, scene_of
from carom.explorer.scripts import script
from carom.explorer.views import LAWS, OF_BODIES, OF_NUMBERS, View
from carom.plots.impact import ENERGIES as IN_FIGURES, LOST
from carom.plots.regimes import REGIMES as OF_FIGURES

NUMBER = {name: st.floats(knob.least, knob.most) for name, knob in KNOBS.items()}
WORD = {name: st.sampled_from(known) for name, known in CHOICES.items()}
PATIENCE = 60.0  # s
SOME_LAWS = st.lists(st.sampled_from(LAWS), unique=True, max_size=4).map(tuple)
BODIES = [
    View(),
    View(angle=70.0, friction=0.1),
    View(angle=10.0, spin=-900.0),
    View(against="sphere", second_radius=7.5, second_material="soda-lime-glass", spin=300.0),
    View(against="cup", second_radius=25.0, angle=55.0, friction=0.45),
    View(friction=0.0),
    View(material="own", young=5.8, poisson=0.34, density=1740.0, friction=0.06, angle=35.0),
    View(restitution=0.7),
    View(restitution=0.4, angle=55.0, spin=200.0, against="sphere", second_radius=7.5),
    View(restitution=0.9, angle=12.0, against="cup", second_radius=25.0),
]
NUMBERED = [
    View(given=NUMBERS, psi=psi, chi=chi, restitution=e)
    for psi, chi, e in ((0.5, 1.44, 1.0), (-2.0, 0.4, 1.0), (9.0, 1.2, 1.0), (-1.5, 1.44, 0.6))
]


def losses(view):
    return None if view.restitution == 1.0 else carom.KelvinVoigt(restitution=view.restitution)


def exactly(view, psi, chi):
    return carom.rebound(psi, chi, losses=losses(view))


@given(st.builds(View, law=SOME_LAWS, **NUMBER, **WORD))
@settings(max_examples=200, derandomize=True, deadline=None)
def test_every_state_is_a_link_that_restores_it(view):
    assert View.of("?" + view.query()) == view


@pytest.mark.parametrize("name", KNOBS)
def test_numbers_out_of_range_are_refused_by_name(name):
    knob, using = KNOBS[name], {"against": "sphere", "material": "own", "second_material": "own"}
    if name in OF_NUMBERS:
        using = {"given": NUMBERS}
    for text in ("", "nan", "inf", "x", "1e400", str(knob.most * 1.01), str(knob.least - 0.1)):
        with pytest.raises(Refused, match=r": must be a number from .*(not '|empty)") as error:
            View.of(urlencode(using | {name: text}))
        assert error.value.field == name
        assert error.value.message.startswith("must be")


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("material=stell", "did you mean 'steel'"),
        ("law=mindlinn", "did you mean 'mindlin'"),
        ("frction=1", "did you mean 'friction'"),
        ("against=wall", "there are half-space; sphere; cup"),
        ("psi=1&" * 1000, "at most"),
        ("angle=3 m", "must be a number from 0 to 89.9 deg, not '3 m'"),
    ],
)
def test_links_that_say_nonsense_are_refused_in_one_line(query, says):
    view, wrong = View.with_complaints(query)
    assert view == View()
    line = str(next(iter(wrong.values())))
    assert says in line
    assert "\n" not in line


def test_what_a_view_does_not_use_may_be_anything():
    assert View.of("psi=&chi=x&second_radius=-1").pair == View().pair
    assert View.of("given=numbers&psi=2&radius=&angle=95").psi == 2.0
    for query in ("against=sphere&second_radius=-1", "second_material=own&second_young=soft"):
        with pytest.raises(Refused) as error:
            View.of(query)
        assert error.value.field in query
    assert View.of("young=soft&second_density=&psi=x").pair == View().pair
    assert View.of("second_material=own&second_density=").pair.second.material.young == 70e9


def test_what_a_link_says_right_is_kept_beside_what_it_says_wrong():
    view, wrong = View.with_complaints(
        "angle=40&friction=-1&material=brass&time=0.3&theme=dark&slow=1&tab=Files&beside=angle%3D5"
    )
    assert (view.angle, view.friction, view.material) == (40.0, 0.2, "brass")
    assert len(wrong) == 1


@pytest.mark.parametrize(
    ("view", "field", "says"),
    [
        (View(against="cup", second_radius=5.0), "second_radius", "must be above 5 mm: the ball"),
        (View(against="cup", second_radius=1.0), "second_radius", "fit into the cup"),
        (
            View(against="sphere", second_material="rigid"),
            "second_material",
            "must have a density, which a rigid one has not",
        ),
        (View(speed=1e300), "speed", "that a computer cannot hold"),
        (View(given=NUMBERS, psi=np.inf), "psi", "that a computer cannot hold"),
    ],
)
def test_what_does_not_go_together_is_told_of_a_field(view, field, says):
    with pytest.raises(Refused, match=says) as error:
        answer(view)
    assert error.value.field == field
    assert str(error.value).startswith(f"{label(field)}: ")  # not an argument of Python


EXTREME = {name: st.sampled_from([knob.least, knob.most]) for name, knob in KNOBS.items()}


@given(st.builds(View, **{name: st.one_of(EXTREME[name], NUMBER[name]) for name in KNOBS}, **WORD))
@settings(max_examples=40, derandomize=True, deadline=None)
def test_any_numbers_are_answered_or_refused_by_field(view):
    try:
        told = json.dumps(answer(view), allow_nan=False)
    except Refused as error:
        told = error.field
        event(told)
    assert told in OF_BODIES or 10_000 < len(told) < 200_000


def test_own_materials_are_those_of_the_numbers():
    own = View(material="own", young=203.0, poisson=0.295, density=7810.0, angle=20.0)
    assert scene_of(own).psi_out == pytest.approx(scene_of(View(angle=20.0)).psi_out, rel=1e-12)
    soft = View(against="sphere", second_material="own", second_young=0.01, second_poisson=0.5)
    stuff = carom.Material(young="10 MPa", poisson=0.5, density=soft.second_density)
    assert soft.pair.second.material.young == stuff.young
    assert {soft.unused} == {(*OF_NUMBERS, *OF_MATERIAL)}


def assert_coulomb(scene):
    """The force keeps within its limit, and is at it in gross slip, with the sign of the slip."""
    assert np.all(np.abs(scene.force) <= scene.limit * (1 + 1e-9) + 1e-12)
    for phase in scene.phases:
        inside = (scene.share > phase.start) & (scene.share < phase.end)
        if phase.kind == "gross slip":
            expected = phase.sign * scene.limit[inside]
            np.testing.assert_allclose(scene.force[inside], expected, rtol=1e-9)


@pytest.mark.parametrize("view", BODIES, ids=str)
def test_scene_is_the_impact(view):
    scene, hit = scene_of(view), impact_of(view)
    motion = {"speed": view.speed, "angle": np.radians(view.angle), "spin": view.spin}
    again = carom.impact(view.pair, losses=losses(view), **motion)
    np.testing.assert_allclose(scene.psi_out, again.psi_out, atol=1e-12)
    if np.isfinite(hit.psi_in):
        exact = exactly(view, scene.psi_in, scene.chi)
        np.testing.assert_allclose(scene.psi_out, exact, atol=1e-10 * max(1, abs(hit.psi_in)))
    np.testing.assert_allclose(sum(scene.energies.values()), 1.0, atol=1e-10)
    assert_coulomb(scene)
    assert scene.phases[0].start == 0.0
    assert scene.phases[-1].end == pytest.approx(1.0)
    assert scene.contact.max() == pytest.approx(1.0, abs=1e-12 if losses(view) is None else 1e-4)


@pytest.mark.parametrize("view", [BODIES[i] for i in (0, 2, 3, 6, 7, 8, 9)], ids=str)
def test_tractions_are_those_of_the_fields(view):
    scene, hit = scene_of(view), impact_of(view)
    unit = hit.max_radius / hit.pair.effective_radius  # Hertz (1882): p_0 = (2 E*/pi) a/R*
    unit *= 2.0 / np.pi * hit.pair.effective_modulus
    for share in (0.2, 0.5, 0.8):
        row = round(share * (len(scene.tractions) - 1))
        at = round(200 * share)
        radius = scene.contact[at] * hit.max_radius
        places = np.linspace(0.0, radius, scene.tractions.shape[1])[:-1]
        found = hit.fields(share * hit.duration, points=np.column_stack([places, 0 * places]))
        expected = found.traction_x.values / (view.friction * unit)
        np.testing.assert_allclose(scene.tractions[row][:-1], expected, atol=1e-9)
        # the page's own formula of the pressure
        root = np.sqrt(scene.contact[at] ** 2 - (places / hit.max_radius) ** 2)
        pressed = root + 0.5 * scene.rim[at] / root
        np.testing.assert_allclose(pressed, found.pressure.values / unit, rtol=1e-9)


def seen_from_second(view, stage):
    """Return how far apart the surfaces are drawn, and the path along the second's surface."""
    first, second = stage.bodies
    x, y = first.x - second.x, first.y - second.y
    if view.against == "half-space" or view.in_numbers:
        return y - 1.0, x
    away, sign = np.hypot(x, y), 1.0 if view.against == "sphere" else -1.0
    reach = second.radius + sign
    return sign * (away - reach), reach * np.arctan2(x, sign * y)


@pytest.mark.parametrize("view", [*BODIES, *NUMBERED], ids=str)
def test_bodies_overlap_while_they_touch_and_elastic_ones_only_then(view):
    stage = scene_of(view).stage
    apart, _ = seen_from_second(view, stage)
    within = (stage.time > 1e-9) & (stage.time < 1.0 - 1e-9)
    assert np.all(apart[within] < 0.0)
    before = stage.time <= 1e-9
    assert np.all(apart[~within & (before | (view.restitution == 1.0))] >= -1e-9)
    if view.restitution < 1.0:  # viscous bodies part with a dent, which recovers afterwards
        assert apart[~within & ~before][0] < -1e-4
    assert apart.min() < -1e-4


@pytest.mark.parametrize("view", BODIES, ids=str)
def test_balls_leave_as_the_impact_says(view):
    """Directions and turns before and after; the mass centre of two free spheres stays."""
    stage, hit = scene_of(view).stage, impact_of(view)
    first, second = stage.bodies
    apart, along = seen_from_second(view, stage)
    angle = np.radians(view.angle)
    for end, leaves, sign in ((slice(0, 5), angle, -1), (slice(-5, None), hit.rebound_angle, 1)):
        slope = np.diff(along[end]) / (sign * np.diff(apart[end]))
        np.testing.assert_allclose(slope, np.tan(leaves), rtol=1e-6, atol=1e-9)
    leaving = view.restitution * hit.normal_speed
    rise = np.diff(apart[-2:])[0] * view.radius * 1e-3 / leaving  # s, magnified
    turned = np.diff(first.turn[-2:])[0]
    np.testing.assert_allclose(turned, hit.spin_out * rise, rtol=1e-6, atol=1e-9)
    if view.against == "sphere":
        heavier = view.pair.second.mass / view.pair.first.mass
        centre = np.array([first.x + heavier * second.x, first.y + heavier * second.y])
        np.testing.assert_allclose(np.ptp(centre, axis=1), 0.0, atol=1e-12)


@pytest.mark.parametrize("view", NUMBERED, ids=str)
def test_scene_of_numbers_is_the_solution(view):
    scene = scene_of(view)
    np.testing.assert_allclose(scene.psi_out, exactly(view, view.psi, view.chi), atol=1e-9)
    np.testing.assert_allclose(sum(scene.energies.values()), 1.0, atol=1e-10)
    assert_coulomb(scene)
    first = scene.stage.bodies[0]
    kappa = 4.0 / 7.0 * view.chi
    before = np.diff(first.x[:2]) / -np.diff(first.y[:2])
    np.testing.assert_allclose(before, view.friction * view.psi / kappa, rtol=1e-6)


@pytest.mark.parametrize(
    "view", [BODIES[0], BODIES[2], BODIES[7], NUMBERED[0], NUMBERED[3]], ids=str
)
def test_curves_go_through_the_present_point(view):
    scene = scene_of(view)
    psi, out = exact_curve(scene)
    close = 1e-12 if losses(view) is None else 1e-6  # as finely as it is drawn
    np.testing.assert_allclose(out, exactly(view, psi, scene.chi), atol=close)
    assert psi[0] <= scene.psi_in <= psi[-1]
    for law in law_curves(scene, ["mindlin", "rigid Coulomb", "Walton & Braun"]):
        entry = next(e for e in carom.verify.CATALOGUE if e.label == law.label)
        damped = replace(entry.law, restitution=view.restitution)
        expected = damped.rebound(scene.psi_in, scene.chi, kappa=scene.kappa)
        np.testing.assert_allclose(law.at, expected, atol=1e-9)
        if law.psi_in[0] <= scene.psi_in <= law.psi_in[-1]:  # drawn as far as the regimes go
            near = np.interp(scene.psi_in, law.psi_in, law.psi_out)
            np.testing.assert_allclose(near, expected, atol=0.02)
        if law.force.size and view.restitution == 1.0:
            assert np.abs(law.force).max() <= scene.limit.max() * (1 + 1e-3)


def test_curves_of_laws_that_take_long_follow():
    scene = scene_of(View(given=NUMBERS, psi=1.0, chi=2.71828))
    assert law_curves(scene, LAWS, seconds=0.0).count(None) > len(LAWS) // 2
    drawn = law_curves(scene, LAWS)
    assert [curve.label for curve in drawn] == list(LAWS)
    assert law_curves(scene, LAWS, seconds=PATIENCE) == drawn  # remembered
    for curve in drawn:
        law = next(e for e in carom.verify.CATALOGUE if e.label == curve.label).law
        meant = law.rebound(curve.psi_in, scene.chi, kappa=scene.kappa)
        np.testing.assert_allclose(curve.psi_out, meant, atol=1e-9, err_msg=curve.label)


def test_an_answer_is_the_scene_as_json_holds_it():
    view = View(law=LAWS[:2], angle=41.5)
    scene, told = scene_of(view), json.loads(json.dumps(answer(view), allow_nan=False))
    assert View.of(told["query"]) == view
    assert told["carried"] == {
        "psi": float(f"{scene.psi_in:.6g}"),
        "chi": float(f"{scene.chi:.6g}"),
    }
    psi, out = exact_curve(scene)
    np.testing.assert_allclose(told["curve"]["psi"], psi, atol=1e-7)
    np.testing.assert_allclose(told["curve"]["out"], out, atol=1e-7)
    assert told["curve"]["at"] == [scene.psi_in, scene.psi_out]
    chi = scene.chi
    np.testing.assert_allclose(told["curve"]["borders"], [1.0, 2.0 * chi, 4.0 * chi - 1.0])
    history = told["history"]
    np.testing.assert_allclose(history["force"], scene.force, atol=1e-5)
    np.testing.assert_allclose(np.sum(list(history["energies"].values()), axis=0), 1.0, atol=1e-4)
    assert set(history["energies"]) == set(scene.energies)


def test_laws_that_are_not_there_follow():
    view = View(given=NUMBERS, psi=1.0, chi=1.61803, law=LAWS)
    told = answer(view)
    assert {law["label"] for law in told["laws"]} | set(told["late"]) == set(LAWS)
    followed = json.loads(json.dumps(laws(view), allow_nan=False))
    assert followed["slow"] == []
    assert [law["label"] for law in followed["laws"]] == list(LAWS)
    scene = scene_of(view)
    for law, curve in zip(followed["laws"], law_curves(scene, LAWS), strict=True):
        assert law["at"] == curve.at
        assert law["off"] == pytest.approx(curve.at - scene.psi_out, abs=1e-15)
        np.testing.assert_allclose(law["out"], curve.psi_out, atol=1e-7)
    assert answer(view)["late"] == []  # remembered


def test_results_are_the_numbers_of_the_impact():
    view = View(restitution=0.8, spin=40.0)
    hit = impact_of(view)
    rows = {row["name"]: row for row in answer(view)["results"]}
    assert float(rows["psi_out"]["value"]) == pytest.approx(hit.psi_out, rel=1e-5)
    assert rows["psi_out"]["symbol"] == "ψ₂"
    angle = rows["rebound_angle"]
    assert angle["unit"] == "deg"
    assert float(angle["value"]) == pytest.approx(np.degrees(hit.rebound_angle), rel=1e-5)
    micro = {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "ns": 1e-9}[rows["duration"]["unit"]]
    assert float(rows["duration"]["value"]) * micro == pytest.approx(hit.duration, rel=1e-5)
    assert float(rows["normal_restitution"]["value"]) == pytest.approx(0.8, abs=1e-3)
    assert rows["kappa"]["unit"] == ""
    assert set(config()["symbols"]) >= {row["symbol"] for row in rows.values()}
    free = {row["name"]: row["value"] for row in answer(View(friction=0.0))["results"]}
    assert free["psi_in"] == "none: it slides freely"


def test_findings_speak_of_the_page():
    view = View(radius=0.2, material="rubber", speed=60.0, second_material="steel", friction=0.05)
    told, found = answer(view)["findings"], impact_of(view).validity
    assert len(told) == len(found.findings)
    marks = [row["mark"] for row in told]
    assert marks == sorted(marks, key=["FAILS", "?", "ok"].index)
    assert marks.count("FAILS") == sum(finding.holds is False for finding in found.findings) > 0
    for row in told:
        for word in ("method=", "psi_", "mu ", "chi"):
            assert word not in row["text"]


def test_the_page_is_told_all_that_it_shows():
    told = json.loads(json.dumps(config(), allow_nan=False))
    assert set(told["fields"]) == {field.name for field in fields(View)}
    for name, field in told["fields"].items():
        assert field["label"]
        assert (name in KNOBS) == (field["most"] is not None)
        assert View.of(urlencode({name: field["default"]}, doseq=True)) == View()
        assert field["symbol"] in ("", *told["symbols"])
    assert [law["label"] for law in told["laws"]] == list(LAWS)
    assert told["materials"]["rigid"]["young"] is None
    assert told["materials"]["steel"] == {"young": 210e9, "poisson": 0.3, "density": 7850}
    assert tuple(OF_FIGURES) == REGIMES
    assert {name: words[0] for name, words in (IN_FIGURES | LOST).items()} == ENERGIES
    for preset in told["presets"]:
        answer(View.of(preset["query"]))


def test_the_figure_of_the_curve_holds_laws_and_the_impact():
    view = View(law=LAWS[:3])
    scene = scene_of(view)
    axis = curve_figure(view, 0.5).axes[0]
    lines = {line.get_label(): line.get_xydata() for line in axis.get_lines()}
    for law in law_curves(scene, LAWS[:3]):
        np.testing.assert_array_equal(lines[law.label], np.stack([law.psi_in, law.psi_out], 1))
    np.testing.assert_array_equal(lines["this impact"], [[scene.psi_in, scene.psi_out]])
    told = [text.get_text() for text in axis.get_legend().get_texts()]
    assert told[-4:] == [*LAWS[:3], "this impact"]


def test_laws_without_damping_are_not_laid_over_losses():
    label = "Thornton, incremental"
    view = View(law=("mindlin", label), restitution=0.8)
    assert (view.laid_over, view.undamped) == (("mindlin",), (label,))
    assert answer(view)["undamped"] == [label]
    assert [law["label"] for law in laws(view)["laws"]] == ["mindlin"]
    assert View(law=(label,)).laid_over == (label,)


def test_laws_are_drawn_in_units_of_the_impact_with_losses():
    """A linear spring without friction's limit in reach: its force is that of its own history."""
    view = View(restitution=0.6, angle=0.0, spin=5.0, friction=0.9)
    scene, hit = scene_of(view), impact_of(view)
    (law,) = law_curves(scene, ["linear spring, k_t/k_n = kappa"])
    told = carom.LinearSpring(restitution=0.6).history(
        scene.psi_in, scene.chi, kappa=scene.kappa, steps=400
    )
    scales = hit.pair.scales(hit.normal_speed)
    seconds = told["time"][::2] * scales.time
    np.testing.assert_allclose(law.share * hit.duration, seconds, rtol=1e-12)
    newtons = told["tangential_force"][::2] * view.friction * scales.force
    of_scene = scene.force / hit.history(201).tangential_force.values
    np.testing.assert_allclose(law.force, newtons * np.nanmedian(of_scene), rtol=1e-9)


@pytest.mark.parametrize(
    "view",
    [
        View(law=LAWS[:2], angle=41.5),
        NUMBERED[0],
        View(law=LAWS[3:4], angle=41.5, restitution=0.75),
        View(given=NUMBERS, psi=1.5, restitution=0.9),
        View(friction=0.0, restitution=0.9),
        View(material="own", young=70.0, second_material="own", against="sphere"),
    ],
    ids=str,
)
def test_lines_of_python_give_the_same(view, tmp_path):
    scene = scene_of(view)
    ran = subprocess.run(
        [sys.executable, "-c", script(view, 0.6)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    told = [float(number) for number in re.findall(r"-?\d+\.\d+", ran.stdout)]
    assert any(tmp_path.glob("*.png"))
    if not np.isfinite(scene.psi_out):
        assert ran.stdout.startswith("inf inf ")
        return
    for psi in (scene.psi_out, *(law.at for law in law_curves(scene, view.law))):
        assert psi == pytest.approx(min(told, key=lambda number: abs(number - psi)), abs=1e-9)


@pytest.mark.parametrize("view", [BODIES[7], NUMBERED[3]], ids=str)
def test_histories_with_losses_are_those_of_the_library(view, tmp_path):
    found = carom.read(write("history.csv", view, 0.5, tmp_path))
    if view.in_numbers:
        solution = carom.solve(view.psi, view.chi, losses=losses(view))
        expected = {name: getattr(solution.history(201), name) for name in ("psi", "shear_lost")}
    else:
        history = impact_of(view).history(201)
        expected = {name: history[name].values for name in ("contact_velocity", "shear_loss")}
    for name, values in expected.items():
        np.testing.assert_allclose(np.asarray(found[name]), values, atol=1e-9 * np.ptp(values))
        assert np.ptp(values) > 0.0


@pytest.mark.parametrize("psi", [4000.0, -4000.0])
def test_the_curve_of_a_far_impact_has_all_regimes(psi):
    found, out = exact_curve(scene_of(View(given=NUMBERS, psi=psi, chi=1.44)))
    assert np.sum(np.abs(found) < 6.0) > 200
    assert min(found[0], 0.0) <= psi <= found[-1]
    np.testing.assert_allclose(out, carom.rebound(found, 1.44), atol=1e-9)
