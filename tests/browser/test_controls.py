"""What is set on the page is what the library solves."""

import pytest

import carom

pytestmark = pytest.mark.browser
AFTER, BEFORE = "psi_out", "psi_in"
WAVES = "lost to waves in the plate"


def steel(friction=0.2, restitution=1.0, **motion):
    ball = carom.Sphere(radius="5 mm", material="bearing-steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="bearing-steel"), friction=friction)
    losses = None if restitution == 1.0 else carom.KelvinVoigt(restitution=restitution)
    return carom.impact(pair, losses=losses, **({"speed": 0.6, "angle": "30 deg"} | motion))


def shows(seen, hit):
    """The table and the present point of the chart tell this impact."""
    assert seen.number(BEFORE) == pytest.approx(hit.psi_in, rel=1e-5)
    assert seen.number(AFTER) == pytest.approx(hit.psi_out, rel=1e-5)
    point = seen.traces("rebounds")["this impact", "markers"]
    assert point["x"] == pytest.approx([hit.psi_in], rel=1e-5)
    assert point["y"] == pytest.approx([hit.psi_out], rel=1e-5)
    return True


def test_the_page_as_it_opens(visit):
    seen, chi = visit(loading=True), steel().pair.chi
    assert shows(seen, steel())
    assert seen.link() == ""
    assert seen.notice() == ""
    exact = seen.traces("rebounds")["exact", "lines"]
    assert len(exact["x"]) > 200
    assert exact["y"] == pytest.approx(list(carom.rebound(exact["x"], chi)), abs=2e-5)


def test_sliders_moved_by_keys(visit):
    seen = visit()
    motion, words = {"angle": 30.0, "friction": 0.2, "speed": 0.6, "spin": 0.0}, {}
    motion["restitution"] = 1.0
    moves = {"angle": (0.25, 3), "friction": (0.005, -2), "speed": (0.05, 2), "spin": (5.0, -4)}
    moves["restitution"] = (0.01, -3)
    for name, (step, presses) in moves.items():
        seen.page.focus(f"#{name}-slider")
        for _ in range(abs(presses)):
            seen.page.keyboard.press("ArrowRight" if presses > 0 else "ArrowLeft")
        motion[name] += step * presses
        words[name] = f"{name}={motion[name]:g}"
        seen.linked(words[name])
        assert float(seen.page.input_value(f"#{name}")) == pytest.approx(motion[name])
        hit = steel(**motion | {"angle": f"{motion['angle']} deg"})
        seen.until(lambda hit=hit: shows(seen, hit))
    assert sorted(seen.link().split("&")) == sorted(words.values())


def test_losses_are_shown_wherever_the_impact_is(visit):
    seen, law = visit("?law=mindlin&law=Thornton%2C+incremental"), "mindlin"
    seen.page.fill("#restitution", "0.8")
    hit = steel(restitution=0.8)
    seen.until(lambda: shows(seen, hit))
    lost = {"normal_loss", "shear_loss", "frictional_work"}
    seen.until(lambda: lost <= {name for name, _ in seen.traces("energies")})
    exact = seen.traces("rebounds")["exact", "lines"]
    losses = carom.KelvinVoigt(restitution=0.8)
    expected = carom.rebound(exact["x"], hit.pair.chi, losses=losses)
    assert exact["y"] == pytest.approx(list(expected), abs=2e-5)
    drawn = seen.laid_over(law)[law, "lines"]
    damped = carom.dem.LammpsMindlin("mindlin", restitution=0.8)
    expected = damped.rebound(drawn["x"], hit.pair.chi, kappa=hit.pair.kappa)
    assert drawn["y"] == pytest.approx(list(expected), abs=2e-5)
    text = seen.page.locator("#laws").inner_text()
    assert "no damping" in text
    assert seen.number("shear_lost_energy") == pytest.approx(hit.shear_lost_energy * 1e6, rel=1e-5)
    assert "µJ" in seen.result("shear_lost_energy")
    seen.page.fill("#restitution", "1")
    seen.until(lambda: shows(seen, steel()))
    seen.laid_over(law, "Thornton, incremental")


def test_the_thickness_of_a_plate(visit):
    """Its slider ends at the thick wall; what a plate comes to is told beside the film."""
    seen = visit()
    assert seen.page.input_value("#thickness") == "thick"
    seen.page.focus("#thickness-slider")
    seen.page.keyboard.press("Home")
    seen.until(lambda: seen.notice().startswith("Its thickness: so thin a plate gives way"))
    for _ in range(8):
        seen.page.keyboard.press("ArrowRight")
    seen.linked("thickness=3")
    ball = carom.Sphere(radius="5 mm", material="bearing-steel")
    plate = carom.HalfSpace(material="bearing-steel", thickness="3 mm")
    hit = carom.impact(carom.Pair(ball, plate, friction=0.2), speed=0.6, angle="30 deg")
    seen.until(lambda: shows(seen, hit))
    assert seen.number("normal_restitution") == pytest.approx(hit.normal_restitution, rel=1e-5)
    whole = 0.5 * hit.pair.normal_mass * 0.6**2
    share = f"{100.0 * hit.lost_energy / whole:.3g} % is {WAVES}"
    assert share in seen.page.inner_text("#findings")
    assert WAVES in seen.page.inner_text("#energies")
    seen.page.evaluate("Carom.clock.set(1.3)")
    seen.until(lambda: f"part of the energy is {WAVES}" in seen.page.inner_text("#sentence"))
    seen.page.click("#level")
    assert share in seen.page.inner_text("#summary")  # the same in the first level
    seen.page.click("#level")
    seen.page.fill("#restitution", "0.9")
    seen.until(lambda: seen.notice().startswith("Restitution: must be 1 on a plate"))
    seen.page.fill("#restitution", "1")
    seen.choose("given", "ψ₁ and χ")
    seen.until(lambda: seen.page.input_value("#inelasticity") == "0.380814")
    seen.until(lambda: seen.number(AFTER) == pytest.approx(hit.psi_out, rel=1e-4))
    seen.choose("given", "bodies")
    seen.page.focus("#thickness-slider")
    seen.page.keyboard.press("End")
    seen.linked("!thickness")
    assert seen.page.input_value("#thickness") == "thick"
    seen.until(lambda: shows(seen, steel()))


def test_numbers_typed_move_their_sliders(visit):
    seen = visit()
    seen.page.fill("#angle", "47.3")
    seen.until(lambda: shows(seen, steel(angle="47.3 deg")))
    assert float(seen.page.input_value("#angle-slider")) == pytest.approx(47.25)
    assert float(seen.page.input_value("#angle")) == 47.3
    seen.page.fill("#speed", "25")  # more than the slider has
    seen.until(lambda: shows(seen, steel(angle="47.3 deg", speed=25.0)))
    assert float(seen.page.input_value("#speed-slider")) == 10.0
    assert float(seen.page.input_value("#speed")) == 25.0


def test_numbers_that_cannot_be_are_told_in_a_line(visit):
    seen = visit()
    for name, label, typed, right in (
        ("angle", "Incidence", "95", "30"),
        ("friction", "Friction", "-1", "0.2"),
        ("radius", "Ball radius", "", "5"),
        ("speed", "Speed", "1,5", "0.6"),  # a comma is not dropped: 15
        ("friction", "Friction", "\N{MINUS SIGN}3", "0.2"),  # nor a sign that no keyboard has: 3
    ):
        seen.page.fill(f"#{name}", typed)
        notice = seen.until(lambda: seen.notice())
        assert notice.startswith(f"{label}: ")
        assert "must be a number from" in notice
        assert "\n" not in notice
        assert seen.page.inner_text(f"#{name}-wrong") in notice  # told beside the field, too
        assert shows(seen, steel())
        seen.page.fill(f"#{name}", right)
        seen.until(lambda: seen.notice() == "")
    seen.page.fill("#spin", "\N{MINUS SIGN}3")
    seen.until(lambda: shows(seen, steel(spin=-3.0)))


def test_bodies_chosen_from_lists(visit):
    seen = visit()
    assert seen.page.is_hidden("#second_radius")
    seen.choose("material", "brass")
    seen.linked("material=brass")
    seen.choose("against", "ball")
    seen.until(lambda: seen.page.is_visible("#second_radius"))
    seen.page.fill("#second_radius", "8")
    seen.linked("second_radius=8")
    seen.choose("second_material", "pmma")
    first = carom.Sphere(radius="5 mm", material="brass")
    second = carom.Sphere(radius="8 mm", material="pmma")
    hit = carom.impact(carom.Pair(first, second, 0.2), speed=0.6, angle="30 deg")
    seen.until(lambda: shows(seen, hit))


def test_numbers_instead_of_bodies(visit):
    """The numbers are those of the controls, not of an earlier answer."""
    seen, hit = visit(), steel(angle="50 deg")
    seen.page.fill("#angle", "50")
    seen.choose("given", "ψ₁ and χ")
    seen.until(lambda: seen.page.is_visible("#psi"))
    assert seen.page.is_hidden("#speed")
    for name, value in (("psi", hit.psi_in), ("chi", hit.pair.chi)):  # the impact is kept
        seen.until(lambda name=name, v=value: seen.page.input_value(f"#{name}") == f"{v:.6g}")
    seen.until(lambda: seen.number(AFTER) == pytest.approx(hit.psi_out, rel=1e-4))
    seen.page.fill("#psi", "1.5")
    seen.page.focus("#chi-slider")
    seen.page.keyboard.press("ArrowRight")
    seen.linked("chi=1.45")
    solved = carom.solve(1.5, 1.45)
    seen.until(lambda: seen.number(AFTER) == pytest.approx(solved.psi_out, rel=1e-5))


def test_what_is_hidden_blocks_nothing(visit):
    """A field that is not in use may hold anything; the fields in use are always to be seen."""
    seen = visit("?angle=88.5&friction=0.1")  # psi_1 = 316, more than its slider has
    seen.choose("given", "ψ₁ and χ")
    hit = steel(friction=0.1, angle="88.5 deg")
    seen.until(lambda: seen.page.input_value("#psi") == f"{hit.psi_in:.6g}")
    seen.until(lambda: seen.number(AFTER) == pytest.approx(hit.psi_out, rel=1e-4))
    seen.page.fill("#psi", "")
    seen.until(lambda: seen.notice().startswith("Velocity before: "))
    assert seen.page.is_visible("#psi")
    seen.choose("given", "bodies")
    seen.until(lambda: seen.notice() == "" and shows(seen, hit))
    assert seen.page.is_visible("#radius")
