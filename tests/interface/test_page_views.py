"""A link holds all of a view of the page, and any of it is answered or refused by a field."""

import json
from urllib.parse import urlencode

import numpy as np
import pytest
from hypothesis import event, given, settings, strategies as st

import carom

pytest.importorskip("flask")

from carom.page.outcomes import outcome_of, verdict
from carom.page.views import CHOICES, FIELDS, LAWS, NUMBERS, OF_MATERIAL, Refused, View

KNOBS = {name: field for name, field in FIELDS.items() if field.is_number}
NUMBER = {name: st.floats(knob.least, knob.most) for name, knob in KNOBS.items()}
WORD = {name: st.sampled_from(each) for name, each in CHOICES.items() if name != "law"}
NUMBER["thickness"] |= st.just(np.inf)
SOME_LAWS = st.lists(st.sampled_from(LAWS), unique=True, max_size=4).map(tuple)


@given(st.builds(View, law=SOME_LAWS, **NUMBER, **WORD))
@settings(max_examples=200, derandomize=True, deadline=None)
def test_every_state_is_a_link_that_restores_it(view):
    assert View.of("?" + view.query()) == view


@pytest.mark.parametrize("name", KNOBS)
def test_numbers_out_of_range_are_refused_by_name(name):
    knob, using = KNOBS[name], {"against": "sphere", "material": "own", "second_material": "own"}
    if name in ("psi", "chi", "inelasticity"):
        using = {"given": NUMBERS}
    elif name == "thickness":
        using = {}
    empty = [] if knob.otherwise else [""]
    beyond = str(knob.most * 1.01), str(knob.least - 0.1)
    for text in (*empty, "nan", "inf", "x", "1e400", *beyond):
        with pytest.raises(Refused, match=r": must be a number from .*(not '|empty)") as error:
            View.of(urlencode(using | {name: text}))
        assert error.value.field == name
        assert error.value.message.startswith("must be")


def test_what_a_view_does_not_use_may_be_anything():
    assert View.of("psi=&chi=x&second_radius=-1").pair == View().pair
    assert View.of("given=numbers&psi=2&radius=&angle=95").psi == 2.0
    for query in ("against=sphere&second_radius=-1", "second_material=own&second_young=soft"):
        with pytest.raises(Refused) as error:
            View.of(query)
        assert error.value.field in query
    assert View.of("young=soft&second_density=&psi=x").pair == View().pair
    assert View.of("second_density=&inelasticity=x&against=cup&thickness=x").pair.thickness is None


def test_a_wall_without_a_number_is_thick():
    for text in ("", "thick", " thick "):
        view = View.of(urlencode({"thickness": text}))
        assert (view, view.query()) == (View(), "")
    assert View.of("thickness=0.2 cm").pair.thickness == pytest.approx(2e-3)
    with pytest.raises(Refused, match=r"from 0.001 to 10000 mm, or thick, not 'thin'"):
        View.of("thickness=thin")


def test_what_a_link_says_to_the_page_alone_is_passed_over():
    view = View.of("angle=40&time=0.3&theme=dark&slow=1&tab=Files&beside=angle%3D5&pace=2")
    assert view == View(angle=40.0)


RIGID = View(against="sphere", second_material="rigid")
HELD = "that a computer cannot hold"


@pytest.mark.parametrize(
    ("view", "field", "says"),
    [
        (View(against="cup", second_radius=5.0), "second_radius", "must be above 5 mm: the ball"),
        (View(against="cup", second_radius=1.0), "second_radius", "fit into the cup"),
        (RIGID, "second_material", "must have a density, which a rigid one has not"),
        (View(speed=1e300), "speed", HELD),
        (View(thickness=3.0, second_material="rigid"), "second_material", "gives no way"),
        (View(thickness=3.0, restitution=0.9), "restitution", "must be 1 on a plate"),
        (View(given=NUMBERS, inelasticity=1.0, restitution=0.9), "restitution", "must be 1 on"),
        (View(thickness=1.0), "thickness", "so thin a plate gives way like a foil"),
        (View(thickness=1.253), "thickness", "so thin a plate gives way like a foil"),
        (View(thickness=1e-3), "thickness", "must be above the penetration; the sphere would be"),
        (View(given=NUMBERS, psi=np.inf), "psi", HELD),
    ],
)
def test_what_does_not_go_together_is_told_of_a_field(view, field, says):
    with pytest.raises(Refused, match=says) as error:
        outcome_of(view)
    assert error.value.field == field
    assert str(error.value).startswith(f"{FIELDS[field].label}: ")  # not an argument of Python


EXTREME = {name: st.sampled_from([knob.least, knob.most]) for name, knob in KNOBS.items()}


@given(st.builds(View, **{name: st.one_of(EXTREME[name], NUMBER[name]) for name in KNOBS}, **WORD))
@settings(max_examples=40, derandomize=True, deadline=None)
def test_any_numbers_are_answered_or_refused_by_field(view):
    try:
        outcome = outcome_of(view)
        numbers = outcome.chi, outcome.kappa, outcome.lasts, outcome.force_scale
        text = json.dumps([verdict(view), *numbers], allow_nan=False)
    except Refused as error:
        text = error.field
        event(text)
    assert text in FIELDS or text.startswith("[[],") == view.in_numbers


def test_own_materials_are_those_of_the_numbers():
    own = View(material="own", young=203.0, poisson=0.295, density=7810.0, angle=20.0)
    assert outcome_of(own).psi_out == pytest.approx(outcome_of(View(angle=20.0)).psi_out, rel=1e-12)
    soft = View(against="sphere", second_material="own", second_young=0.01, second_poisson=0.5)
    stuff = carom.Material(young="10 MPa", poisson=0.5, density=soft.second_density)
    assert soft.pair.second.material.young == stuff.young
    assert set(soft.unused) == {"psi", "chi", "inelasticity", "thickness", *OF_MATERIAL}
