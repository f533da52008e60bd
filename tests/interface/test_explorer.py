"""What the page asks the program for, of a view, is what the library says."""

import re
from dataclasses import replace

import numpy as np
import pytest

import carom

pytest.importorskip("flask")

from carom.page.files import curve_figure
from carom.page.outcomes import impact_of, outcome_of
from carom.page.overlays import law_curves, laws, places
from carom.page.scripts import script
from carom.page.views import LAWS, NUMBERS, View

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


def newtons(view, hit):
    """Return what a newton is in the page's unit, of which the largest friction has 1 to 1000."""
    largest = (view.friction or 1.0) * hit.max_force
    return 10.0 ** (-3.0 * np.floor(np.log10(largest) / 3.0))


@pytest.mark.parametrize("view", BODIES, ids=str)
def test_an_outcome_is_the_impact(view):
    outcome, hit = outcome_of(view), impact_of(view)
    motion = {"speed": view.speed, "angle": np.radians(view.angle), "spin": view.spin}
    again = carom.impact(view.pair, losses=losses(view), **motion)
    np.testing.assert_allclose(outcome.psi_out, again.psi_out, atol=1e-12)
    if np.isfinite(hit.psi_in):
        exact = exactly(view, outcome.psi_in, outcome.chi)
        np.testing.assert_allclose(outcome.psi_out, exact, atol=1e-10 * max(1, abs(hit.psi_in)))
    assert (outcome.chi, outcome.kappa) == (again.pair.chi, again.pair.kappa)
    assert outcome.restitution == pytest.approx(again.normal_restitution, abs=1e-6)
    scales = again.pair.scales(again.normal_speed)
    assert outcome.lasts == pytest.approx(again.duration / scales.time, rel=1e-12)
    limit = view.friction * scales.force * newtons(view, again)
    assert outcome.force_scale == pytest.approx(limit, rel=1e-12)


@pytest.mark.parametrize("view", NUMBERED, ids=str)
def test_an_outcome_of_numbers_is_the_solution(view):
    outcome = outcome_of(view)
    np.testing.assert_allclose(outcome.psi_out, exactly(view, view.psi, view.chi), atol=1e-9)
    solution = carom.solve(view.psi, view.chi, losses=view.losses)
    assert (outcome.lasts, outcome.force_scale) == (solution.duration, 1.0)
    assert outcome.restitution == pytest.approx(solution.restitution, abs=1e-6)
    assert outcome.kappa == pytest.approx(4.0 / 7.0 * view.chi, rel=1e-15)  # a solid ball


@pytest.mark.first_case
@pytest.mark.parametrize(
    "view", [*(BODIES[i] for i in (0, 2, 7, 10)), NUMBERED[0], *NUMBERED[3:]], ids=str
)
def test_curves_go_through_the_present_point(view):
    outcome = outcome_of(view)
    drawn = [line for line in curve_figure(view).axes[0].get_lines() if len(line.get_xdata()) > 50]
    psi, out = drawn[0].get_xdata(), drawn[0].get_ydata()
    close = 1e-12 if losses(view) is None else 1e-6  # as finely as it is drawn
    np.testing.assert_allclose(out, exactly(view, psi, outcome.chi), atol=close)
    assert psi[0] <= outcome.psi_in <= psi[-1]
    for law in law_curves(outcome, ["mindlin", "rigid Coulomb", "Walton & Braun"]):
        entry = next(e for e in carom.verify.catalogue() if e.label == law.label)
        damped = replace(entry.law, restitution=outcome.restitution)
        expected = damped.rebound(outcome.psi_in, outcome.chi, kappa=outcome.kappa)
        np.testing.assert_allclose(law.at, expected, atol=1e-9)
        if law.psi_in[0] <= outcome.psi_in <= law.psi_in[-1]:  # drawn as far as the regimes go
            near = np.interp(outcome.psi_in, law.psi_in, law.psi_out)
            np.testing.assert_allclose(near, expected, atol=0.02)
        if law.force.size and outcome.restitution == 1.0:
            assert np.abs(law.force).max() <= outcome.force_scale * (1 + 1e-3)


def test_curves_of_laws_that_take_long_follow():
    outcome = outcome_of(View(given=NUMBERS, psi=1.0, chi=2.71828))
    assert law_curves(outcome, LAWS, seconds=0.0).count(None) > len(LAWS) // 2
    drawn = law_curves(outcome, LAWS)
    assert [curve.label for curve in drawn] == list(LAWS)
    assert law_curves(outcome, LAWS, seconds=PATIENCE) == drawn  # remembered
    for curve in drawn:
        law = next(e for e in carom.verify.catalogue() if e.label == curve.label).law
        meant = law.rebound(curve.psi_in, outcome.chi, kappa=outcome.kappa)
        np.testing.assert_allclose(curve.psi_out, meant, atol=1e-9, err_msg=curve.label)


def test_the_figure_of_the_curve_holds_laws_and_the_impact():
    view = View(law=LAWS[:3])
    outcome = outcome_of(view)
    axis = curve_figure(view, 0.5).axes[0]
    lines = {line.get_label(): line.get_xydata() for line in axis.get_lines()}
    for law in law_curves(outcome, LAWS[:3]):
        np.testing.assert_array_equal(lines[law.label], np.stack([law.psi_in, law.psi_out], 1))
    np.testing.assert_array_equal(lines["this impact"], [[outcome.psi_in, outcome.psi_out]])
    entries = [text.get_text() for text in axis.get_legend().get_texts()]
    assert entries[-4:] == [*LAWS[:3], "this impact"]


def test_laws_without_damping_are_not_laid_over_losses():
    label = "Thornton, incremental"
    view = View(law=("mindlin", label), restitution=0.8)
    assert (view.laid_over, view.undamped) == (("mindlin",), (label,))
    assert [law["label"] for law in laws(view)["laws"]] == ["mindlin"]
    assert View(law=(label,)).laid_over == (label,)


def test_laws_are_drawn_in_units_of_the_impact_with_losses():
    """A linear spring without friction's limit in reach: its force is that of its own history."""
    view = View(restitution=0.6, angle=0.0, spin=5.0, friction=0.9)
    outcome, hit = outcome_of(view), impact_of(view)
    (law,) = law_curves(outcome, ["linear spring, k_t/k_n = kappa"])
    history = carom.dem.LinearSpring(restitution=0.6).history(
        outcome.psi_in, outcome.chi, kappa=outcome.kappa, steps=400
    )
    scales = hit.pair.scales(hit.normal_speed)
    seconds = history["time"][::2] * scales.time
    np.testing.assert_allclose(law.share * hit.duration, seconds, rtol=1e-12)
    force = history["tangential_force"][::2] * view.friction * scales.force
    np.testing.assert_allclose(law.force, force * newtons(view, hit), rtol=1e-9)


SCRIPTED = [
    *(View(law=LAWS[:2], angle=41.5), NUMBERED[0]),
    View(law=LAWS[3:4], angle=41.5, restitution=0.75),
    *(View(given=NUMBERS, psi=1.5, restitution=0.9), View(friction=0.0, restitution=0.9)),
    View(material="own", young=70.0, second_material="own", against="sphere"),
    View(law=LAWS[3:4], thickness=3.0, second_material="own", second_density=2600.0),
    View(given=NUMBERS, law=LAWS[3:4], psi=1.5, inelasticity=0.4),
]


@pytest.mark.first_case
@pytest.mark.parametrize("view", SCRIPTED, ids=str)
def test_lines_of_python_give_the_same(view, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("carom.plots.style.DPI", 50)  # sooner stored
    outcome = outcome_of(view)
    exec(script(view, 0.6), {"__name__": "__main__"})
    printed = capsys.readouterr().out
    entries = [float(number) for number in re.findall(r"-?\d+\.\d+", printed)]
    assert any(tmp_path.glob("*.png"))
    if not np.isfinite(outcome.psi_out):
        assert printed.startswith("inf inf ")
        return
    for psi in (outcome.psi_out, *(law.at for law in law_curves(outcome, view.law))):
        assert psi == pytest.approx(min(entries, key=lambda number: abs(number - psi)), abs=1e-9)


def test_both_modes_tell_the_same_of_a_plate():
    """Bodies on a plate, and psi_1, chi and Zener's parameter that go on from them."""
    view = View(thickness=2.0, angle=41.5)
    bodies, give = outcome_of(view), view.pair.plate_give(impact_of(view).normal_speed)
    carried = {"psi": bodies.psi_in, "chi": bodies.chi, "inelasticity": 1.25**0.4 * give}
    numbers = outcome_of(View(given=NUMBERS, **carried))
    assert numbers.psi_out == pytest.approx(bodies.psi_out, abs=1e-9)
    assert numbers.restitution == pytest.approx(bodies.restitution, abs=1e-9)
    assert numbers.losses == bodies.losses
    assert impact_of(view).normal_restitution == bodies.restitution


@pytest.mark.parametrize("psi", [4000.0, -4000.0])
def test_the_curve_of_a_far_impact_has_all_regimes(psi):
    actual = places(outcome_of(View(given=NUMBERS, psi=psi, chi=1.44)))
    assert np.sum(np.abs(actual) < 6.0) > 200
    assert min(actual[0], 0.0) <= psi <= actual[-1]
