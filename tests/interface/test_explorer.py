"""What the page of the explorer draws is what the library says."""

import re
from dataclasses import replace

import numpy as np
import pytest

import carom

pytest.importorskip("flask")

from carom.explorer.answers import answer, laws
from carom.explorer.files import curve_figure
from carom.explorer.overlays import exact_curve, law_curves
from carom.explorer.scenes import impact_of, scene_of
from carom.explorer.scripts import script
from carom.explorer.views import LAWS, NUMBERS, View

PATIENCE = 60.0  # s
BODIES = [
    *(View(), View(angle=70.0, friction=0.1), View(angle=10.0, spin=-900.0)),
    View(against="sphere", second_radius=7.5, second_material="soda-lime-glass", spin=300.0),
    *(View(against="cup", second_radius=25.0, angle=55.0, friction=0.45), View(friction=0.0)),
    View(material="own", young=5.8, poisson=0.34, density=1740.0, friction=0.06, angle=35.0),
    View(restitution=0.7),
    View(restitution=0.4, angle=55.0, spin=200.0, against="sphere", second_radius=7.5),
    View(restitution=0.9, angle=12.0, against="cup", second_radius=25.0),
    *(View(thickness=3.0), View(thickness=3.5, angle=50.0, spin=300.0, second_material="granite")),
]
NUMBERED = [
    View(given=NUMBERS, psi=psi, chi=chi, restitution=e)
    for psi, chi, e in ((0.5, 1.44, 1.0), (-2.0, 0.4, 1.0), (9.0, 1.2, 1.0), (-1.5, 1.44, 0.6))
]
NUMBERED.append(View(given=NUMBERS, psi=-1.5, inelasticity=0.7))


def losses(view):
    return None if view.restitution == 1.0 else carom.KelvinVoigt(restitution=view.restitution)


def exactly(view, psi, chi):
    """Return psi_2; the conversion to Zener's parameter is that of theory.md."""
    inelasticity = view.inelasticity
    if view.on_plate and not view.in_numbers:
        normal_speed = view.speed * np.cos(np.radians(view.angle))
        inelasticity = 1.25**0.4 * view.pair.plate_give(normal_speed)
    plate = carom.ZenerPlate(inelasticity=inelasticity) if view.on_plate else None
    return carom.rebound(psi, chi, losses=plate or losses(view))


def assert_coulomb(scene):
    """The force keeps within its limit, and is at it in gross slip, with the sign of the slip."""
    plate = isinstance(scene.losses, carom.ZenerPlate)
    rounding = 1e-11 * scene.limit.max() if plate else 0.0  # which its steps add up
    assert np.all(np.abs(scene.force) <= scene.limit * (1 + 1e-9) + 1e-12 + rounding)
    for phase in scene.phases:
        inside = (scene.share > phase.start) & (scene.share < phase.end)
        if phase.kind == "gross slip":
            expected = phase.sign * scene.limit[inside]
            np.testing.assert_allclose(scene.force[inside], expected, rtol=1e-9, atol=rounding)


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
    peak = 1e-4 if view.is_lossy else 1e-12  # only elastic ones on thick walls turn at an instant
    assert scene.contact.max() == pytest.approx(1.0, abs=peak)


@pytest.mark.parametrize("view", [BODIES[i] for i in (0, 2, 3, 6, 7, 8, 9, 11)], ids=str)
def test_tractions_are_those_of_the_fields(view):
    scene, hit = scene_of(view), impact_of(view)
    unit = hit.max_radius / hit.pair.effective_radius  # Hertz (1882): p_0 = (2 E*/pi) a/R*
    unit *= 2.0 / np.pi * hit.pair.effective_modulus
    for share in (0.2, 0.5, 0.8):
        row = round(share * (len(scene.tractions) - 1))
        at = round(200 * share)
        radius = scene.contact[at] * hit.max_radius
        places = np.linspace(0.0, radius, scene.tractions.shape[1])[:-1]
        fields = hit.fields(share * hit.duration, points=np.column_stack([places, 0 * places]))
        expected = fields.traction_x.values / (view.friction * unit)
        np.testing.assert_allclose(scene.tractions[row][:-1], expected, atol=1e-9)
        # the page's own formula of the pressure
        root = np.sqrt(scene.contact[at] ** 2 - (places / hit.max_radius) ** 2)
        pressed = root + 0.5 * scene.rim[at] / root
        np.testing.assert_allclose(pressed, fields.pressure.values / unit, rtol=1e-9)


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
    leaving = hit.normal_restitution * hit.normal_speed
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
    "view", [*(BODIES[i] for i in (0, 2, 7, 10)), NUMBERED[0], *NUMBERED[3:]], ids=str
)
def test_curves_go_through_the_present_point(view):
    scene = scene_of(view)
    psi, out = exact_curve(scene)
    close = 1e-12 if losses(view) is None else 1e-6  # as finely as it is drawn
    np.testing.assert_allclose(out, exactly(view, psi, scene.chi), atol=close)
    assert psi[0] <= scene.psi_in <= psi[-1]
    for law in law_curves(scene, ["mindlin", "rigid Coulomb", "Walton & Braun"]):
        entry = next(e for e in carom.verify.catalogue() if e.label == law.label)
        damped = replace(entry.law, restitution=scene.restitution)
        expected = damped.rebound(scene.psi_in, scene.chi, kappa=scene.kappa)
        np.testing.assert_allclose(law.at, expected, atol=1e-9)
        if law.psi_in[0] <= scene.psi_in <= law.psi_in[-1]:  # drawn as far as the regimes go
            near = np.interp(scene.psi_in, law.psi_in, law.psi_out)
            np.testing.assert_allclose(near, expected, atol=0.02)
        if law.force.size and scene.restitution == 1.0:
            assert np.abs(law.force).max() <= scene.limit.max() * (1 + 1e-3)


def test_curves_of_laws_that_take_long_follow():
    scene = scene_of(View(given=NUMBERS, psi=1.0, chi=2.71828))
    assert law_curves(scene, LAWS, seconds=0.0).count(None) > len(LAWS) // 2
    drawn = law_curves(scene, LAWS)
    assert [curve.label for curve in drawn] == list(LAWS)
    assert law_curves(scene, LAWS, seconds=PATIENCE) == drawn  # remembered
    for curve in drawn:
        law = next(e for e in carom.verify.catalogue() if e.label == curve.label).law
        meant = law.rebound(curve.psi_in, scene.chi, kappa=scene.kappa)
        np.testing.assert_allclose(curve.psi_out, meant, atol=1e-9, err_msg=curve.label)


def test_the_figure_of_the_curve_holds_laws_and_the_impact():
    view = View(law=LAWS[:3])
    scene = scene_of(view)
    axis = curve_figure(view, 0.5).axes[0]
    lines = {line.get_label(): line.get_xydata() for line in axis.get_lines()}
    for law in law_curves(scene, LAWS[:3]):
        np.testing.assert_array_equal(lines[law.label], np.stack([law.psi_in, law.psi_out], 1))
    np.testing.assert_array_equal(lines["this impact"], [[scene.psi_in, scene.psi_out]])
    entries = [text.get_text() for text in axis.get_legend().get_texts()]
    assert entries[-4:] == [*LAWS[:3], "this impact"]


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
    history = carom.dem.LinearSpring(restitution=0.6).history(
        scene.psi_in, scene.chi, kappa=scene.kappa, steps=400
    )
    scales = hit.pair.scales(hit.normal_speed)
    seconds = history["time"][::2] * scales.time
    np.testing.assert_allclose(law.share * hit.duration, seconds, rtol=1e-12)
    newtons = history["tangential_force"][::2] * view.friction * scales.force
    of_scene = scene.force / hit.history(201).tangential_force.values
    np.testing.assert_allclose(law.force, newtons * np.nanmedian(of_scene), rtol=1e-9)


SCRIPTED = [
    *(View(law=LAWS[:2], angle=41.5), NUMBERED[0]),
    View(law=LAWS[3:4], angle=41.5, restitution=0.75),
    *(View(given=NUMBERS, psi=1.5, restitution=0.9), View(friction=0.0, restitution=0.9)),
    View(material="own", young=70.0, second_material="own", against="sphere"),
    View(law=LAWS[3:4], thickness=3.0, second_material="own", second_density=2600.0),
    View(given=NUMBERS, law=LAWS[3:4], psi=1.5, inelasticity=0.4),
]


@pytest.mark.parametrize("view", SCRIPTED, ids=str)
def test_lines_of_python_give_the_same(view, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("carom.plots.style.DPI", 50)  # sooner stored
    scene = scene_of(view)
    exec(script(view, 0.6), {"__name__": "__main__"})
    printed = capsys.readouterr().out
    entries = [float(number) for number in re.findall(r"-?\d+\.\d+", printed)]
    assert any(tmp_path.glob("*.png"))
    if not np.isfinite(scene.psi_out):
        assert printed.startswith("inf inf ")
        return
    for psi in (scene.psi_out, *(law.at for law in law_curves(scene, view.law))):
        assert psi == pytest.approx(min(entries, key=lambda number: abs(number - psi)), abs=1e-9)


def test_both_modes_tell_the_same_of_a_plate():
    """Bodies on a plate, and psi_1, chi and Zener's parameter that go on from them."""
    view = View(thickness=2.0, angle=41.5)
    bodies, hit = answer(view), impact_of(view)
    numbers = answer(View(given=NUMBERS, **bodies["carried"]))
    for name in ("psi_out", "normal_restitution"):
        one, other = (
            next(float(row["value"]) for row in each["results"] if row["name"] == name)
            for each in (bodies, numbers)
        )
        assert one == pytest.approx(other, abs=2e-5)
    curve = carom.curve(hit.pair.chi, [1.0], losses=scene_of(view).losses)
    for each in (bodies, numbers):
        assert each["scene"]["plate"] == pytest.approx(hit.normal_restitution, rel=1e-5)
        np.testing.assert_allclose(each["curve"]["borders"], curve.border.values[0], rtol=1e-5)
    waves = bodies["history"]["energies"]["normal_loss"][-1]
    normal = np.cos(np.radians(41.5)) ** 2  # of the energy, which has no spin
    assert waves == pytest.approx(normal * (1.0 - hit.normal_restitution**2), abs=1e-6)
    assert "plate" not in answer(View())["scene"]


def test_the_plate_is_drawn_where_the_theory_has_its_middle():
    """It has moved by the impulse over 8 sqrt(D rho h), as the ball is drawn, magnified."""
    view = View(thickness=2.0)
    stage, hit = scene_of(view).stage, impact_of(view)
    ball, plate = stage.bodies
    assert (plate.kind, plate.radius) == ("plate", pytest.approx(0.4))
    impulse = hit.pair.normal_mass * hit.normal_speed * (1.0 + hit.normal_restitution)
    moved = impulse / hit.pair.second.impedance / hit.pair.first.radius
    magnified = (ball.y - plate.y)[stage.time < 0.0][0] - 1.0
    magnified /= 0.6 * hit.duration * hit.normal_speed / hit.pair.first.radius
    assert plate.y[0] == 0.0
    assert -plate.y[-1] == pytest.approx(magnified * moved, rel=1e-4)


@pytest.mark.parametrize("psi", [4000.0, -4000.0])
def test_the_curve_of_a_far_impact_has_all_regimes(psi):
    actual, out = exact_curve(scene_of(View(given=NUMBERS, psi=psi, chi=1.44)))
    assert np.sum(np.abs(actual) < 6.0) > 200
    assert min(actual[0], 0.0) <= psi <= actual[-1]
    np.testing.assert_allclose(out, carom.rebound(actual, 1.44), atol=1e-9)
