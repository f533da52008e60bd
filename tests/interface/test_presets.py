"""The page's examples: links that hold, stories whose numbers are computed, warnings where due."""

import re
from dataclasses import replace
from urllib.parse import parse_qsl

import numpy as np
import pytest

from carom.explorer.outcomes import impact_of
from carom.explorer.page import SYMBOLS, presets
from carom.explorer.views import FIELDS, PAGE, View
from carom.quantities.glossary import GLOSSARY

NAMED = {preset["id"]: preset for preset in presets()}
IDS = list(NAMED)
MEASURED = {  # what stories quote of their sources
    "superball": ("98.4", "0.59"),
    "golf": ("59.2",),
    "steel": ("1.00", "0.54", "0.05"),
    "glass": ("3.18", "0.44", "0.07"),
    "alumina": ("0.597", "5"),
}
TRIED = {"throw": ("10",), "golf": ("0.15",), "glass": ("40",), "no-spin": ("100", "150")}


@pytest.fixture(scope="module", params=IDS)
def preset(request):
    return NAMED[request.param]


def solved(name, **changes):
    return impact_of(replace(View.of(NAMED[name]["query"]), **changes))


def thrown(hit):
    """Return the angle by which the object ball leaves off the line of centres."""
    along = 2 * hit.pair.normal_mass * hit.normal_speed
    return np.degrees(np.arctan(hit.tangential_impulse / along))


def rolling(hit):
    """Return the spin with which a rigid ball that comes to roll would leave."""
    return 5 / 7 * hit.tangential_speed / hit.pair.first.radius


def back(hit):
    return -np.degrees(hit.rebound_angle)


def numbers(name):
    """Return what a story tells, as it tells it."""
    hit = solved(name)
    spin, beta = f"{-hit.spin_out:.1f}", f"{-hit.contact_restitution:.3f}"
    e_t = f"{hit.tangential_restitution:.3f}"
    if name == "throw":
        faster = thrown(solved(name, angle=10.0))
        return f"{thrown(hit):.2f}", f"{-hit.spin_out:.2f}", f"{faster:.2f}"
    if name == "gearing":
        return f"{-thrown(solved(name, spin=2 * -17.4978)):.2f}", "17.5"
    if name == "no-spin":
        spins = (-solved(name, spin=100.0).spin_out, solved(name, spin=150.0).spin_out)
        return "112.8", f"{back(hit):.2f}", *(f"{each:.1f}" for each in spins)
    return {
        "superball": (f"{rolling(hit):.1f}", spin, e_t),
        "superball-back": (f"{back(hit):.1f}", spin),
        "golf": (spin, f"{-solved('golf', friction=0.15).spin_out:.1f}"),
        "steel": (beta,),
        "glass": (beta,),
        "alumina": (e_t,),
    }[name]


FAILED = {  # a finding that fails, and the words that a caution has for it
    "a_max/R*": r"contact radius is ({value:.2f})",
    "contact time/wave transit": "elastic waves matter",
    "energy of waves in the wall": r"glass take {value:.2g}",
}


def test_examples_are_told_apart():
    assert len(IDS) == len(presets()) == len({preset["title"] for preset in presets()})


def test_a_link_is_a_state_of_the_page(preset):
    view = View.of(preset["query"])
    assert sorted(parse_qsl(view.query())) != []
    assert View.of(view.query()) == view
    values = dict(parse_qsl(preset["query"]))
    assert {name: str(getattr(view, name)).removesuffix(".0") for name in values} == values


def test_a_story_tells_what_is_computed(preset):
    matches = re.findall(r"\d+(?:\.\d+)?", preset["story"])
    computed = numbers(preset["id"])
    assert [number for number in computed if number not in matches] == []
    values = dict(parse_qsl(preset["query"])).values()
    basis = {*computed, *values, *MEASURED.get(preset["id"], ()), *TRIED.get(preset["id"], ())}
    assert [number for number in matches if number not in basis] == []


def test_a_story_has_two_to_five_sentences_and_sources(preset):
    assert 2 <= len(re.findall(r"[.?!](?= |$)", preset["story"])) <= 5
    assert len(preset["sources"]) >= 2
    assert any(re.search(r"\b(19|20)\d\d\b|Alciatore", source) for source in preset["sources"])
    assert any(source.startswith("Assumed: ") for source in preset["sources"])


def test_a_caution_says_where_the_theory_fails(preset):
    for finding in impact_of(View.of(preset["query"])).validity.findings:
        if finding.holds is False:
            words = FAILED[finding.name].format(value=finding.value)
            assert re.search(words, preset["caution"]), finding.name


def test_the_steel_balls_yield_where_the_caution_says():
    def yields(speed):
        findings = solved("steel", speed=speed).validity.findings
        return any(f.name == "von Mises stress/Y" and f.holds is not True for f in findings)

    assert "about 0.45 m/s" in NAMED["steel"]["caution"]
    assert (yields(0.43), yields(0.47)) == (False, True)


def test_gearing_neither_rubs_nor_throws():
    hit = solved("gearing")
    assert abs(thrown(hit)) < 1e-3
    assert hit.dissipated_energy < 1e-9 * 0.5 * hit.pair.normal_mass


def test_symbols_are_sentences_in_letters_of_the_page():
    assert [symbol for symbol, text in SYMBOLS.items() if not text.endswith(".")] == []
    assert [text for text in SYMBOLS.values() if not text[0].isupper()] == []
    assert not any("\u03bc" in f"{symbol}{text}" for symbol, text in SYMBOLS.items())
    assert SYMBOLS["V₁"].lower().startswith(GLOSSARY["normal_speed"].meaning)


def test_every_symbol_of_fields_and_results_is_explained():
    shown = {words.symbol for words in FIELDS.values()} | {
        *PAGE["signs"].values(),
        *PAGE["signs_of_losses"].values(),
    }
    assert shown - {""} - set(SYMBOLS) == set()
