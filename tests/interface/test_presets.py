"""The page's examples: links that hold, stories whose numbers are computed, warnings where due."""

import re
from dataclasses import replace
from functools import partial
from urllib.parse import parse_qsl

import numpy as np
import pytest
from tests.told_numbers import check_numbers

import carom
from carom.page.outcomes import impact_of
from carom.page.page import SYMBOLS, presets
from carom.page.views import FIELDS, PAGE, View
from carom.quantities.glossary import GLOSSARY

NAMED = {preset["id"]: preset for preset in presets()}
IDS = list(NAMED)


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


def of(name, quantity, **changes):
    """Return a quantity of an example, as it is told: without its sign, angles in degrees."""
    value = abs(getattr(solved(name, **changes), quantity))
    return np.degrees(value) if GLOSSARY[quantity].unit == "rad" else value


def throw(name, **changes):
    return abs(thrown(solved(name, **changes)))


def given(name, field):
    return abs(getattr(View.of(NAMED[name]["query"]), field))


def diameter(name):
    return 2.0 * given(name, "radius")


def finding(name, which):
    """Return the number of a finding on an example."""
    findings = {
        each.name: each for each in impact_of(View.of(NAMED[name]["query"])).validity.findings
    }
    return findings[which].value


def quoted(_, value):
    """Return what a source tells; its words are in the example's sources."""
    return value


def per_speed(name, spin):
    """Return the spin that a source gives for each m/s."""
    return spin * given(name, "speed")


def measured_by_kharaz(name):
    data = carom.datasets.load("kharaz2001")
    angles, ratios = (data[column].values for column in ("angle", "tangential_restitution"))
    known = np.isfinite(ratios)
    return np.interp(np.radians(given(name, "angle")), angles[known], ratios[known])


def rolls(name):
    return rolling(solved(name))


def half_ball(name):
    return np.sin(np.radians(given(name, "angle")))


def yields_from(name):
    """Return the speed from which on the balls yield, to 1 mm/s."""
    low, high = 300, 700
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if yields(name, middle * 1e-3) else (middle, high)
    return high * 1e-3


def yields(name, speed):
    findings = solved(name, speed=float(speed)).validity.findings
    return any(f.name == "von Mises stress/Y" and f.holds is not True for f in findings)


TOLD = {  # of stories and cautions: words with a place for each number, and what it is
    "throw": [
        ("at {:g} m/s", given, "speed"),
        ("m/s, {:g}° off the line", given, "angle"),
        ("a {half}-ball hit", half_ball),
        ("arctan {:g} = ", given, "friction"),
        ("= {:.2f}° off that line", throw),
        ("spin of {:.2f} rad/s", of, "spin_out"),
        ("Try {:g}°", quoted, 10.0),
        ("falls to {:.2f}°", partial(throw, angle=10.0)),
    ],
    "gearing": [
        ("spin of {:.1f} rad/s", given, "spin"),
        ("as {two} gear", quoted, 2.0),
        ("{Double} the spin", quoted, 2.0),
        ("thrown by {:.2f}° to", partial(throw, spin=-2 * 17.4978)),
    ],
    "superball": [
        ("at {:g} m/s", given, "speed"),
        ("{:g}° from the normal", given, "angle"),
        ("leave with {:.1f} rad/s", rolls),
        ("leaves with {:.1f} rad/s", of, "spin_out"),
        ("and {:.3f} of its", of, "tangential_restitution"),
        ("measured {:g} rad/s", quoted, 98.4),
        ("rad/s and {:g}.", quoted, 0.59),
        ("radius is {:.2f} of", finding, "a_max/R*"),
        ("where {:g} is the limit", quoted, 0.1),
    ],
    "superball-back": [
        ("superball at {:g}°", given, "angle"),
        ("backspin of {:g} rad/s", given, "spin"),
        ("back at {:.1f}° with", of, "rebound_angle"),
        ("with {:.1f} rad/s", of, "spin_out"),
        ("radius is {:.2f} of", finding, "a_max/R*"),
        ("where {:g} is the limit", quoted, 0.1),
    ],
    "golf": [
        ("at {:g} m/s", given, "speed"),
        ("{:g}° from the normal", given, "angle"),
        ("friction of {:g} and", given, "friction"),
        ("leaves with {:.1f} rad/s", of, "spin_out"),
        ("measured {:g}.", per_speed, 14.8),
        ("friction to {:g}:", quoted, 0.15),
        ("spins with {:.1f} rad/s", partial(of, friction=0.15), "spin_out"),
        ("radius is {:.2f} of", finding, "a_max/R*"),
        ("where {:g} is the limit", quoted, 0.1),
    ],
    "steel": [
        ("{Two} small", quoted, 2.0),
        ("at {:g} m/s and", given, "speed"),
        ("m/s and {:g}°", given, "angle"),
        ("restitution of {:.2f} and", quoted, 1.0),
        ("friction of {:g}.", given, "friction"),
        ("with {:.3f} of its speed", of, "contact_restitution"),
        ("had {:g} with", quoted, 0.54),
        ("error of {:g}.", quoted, 0.05),
        ("about {:.2f} m/s on", yields_from),
    ],
    "glass": [
        ("{Two} glass", quoted, 2.0),
        ("beads of {:g} mm", diameter),
        ("at {:g} m/s and", given, "speed"),
        ("m/s and {:g}°", given, "angle"),
        ("with {:.3f} of its speed", of, "contact_restitution"),
        ("where {:g} was", quoted, 0.44),
        ("error of {:g}.", quoted, 0.07),
        ("Try {:g}°", quoted, 40.0),
    ],
    "alumina": [
        ("balls of {:g} mm", diameter),
        ("at {:g} m/s", given, "speed"),
        ("At {:g}° the", given, "angle"),
        ("falls to {:.3f} of", of, "tangential_restitution"),
        ("measured {:.3f}.", measured_by_kharaz),
        ("by up to {:.2f} here", finding, "error of psi_2"),
        ("take {:.2g} of the energy", finding, "energy of waves in the wall"),
    ],
    "no-spin": [
        ("plate at {:g}° with", given, "angle"),
        ("backspin of {:.1f} rad/s", given, "spin"),
        ("at {:.2f}° on", of, "rebound_angle"),
        ("from {:g} rad/s it", quoted, 100.0),
        ("with {:.1f} rad/s of topspin", partial(of, spin=100.0), "spin_out"),
        ("from {:g} with", quoted, 150.0),
        ("with {:.1f} rad/s of backspin", partial(of, spin=150.0), "spin_out"),
    ],
}


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


def claims(name):
    return [(words, compute(name, *more)) for words, compute, *more in TOLD[name]]


def test_a_story_and_its_caution_tell_what_is_computed(preset):
    """Every number, in its place; what is quoted of a measurement stands in the sources."""
    check_numbers(f"{preset['story']} {preset['caution']}", claims(preset["id"]))
    sources = " ".join(preset["sources"])
    for words, compute, *more in TOLD[preset["id"]]:
        if compute in (quoted, per_speed) and re.search(
            "measured|had|error|restitution|where .* was", words
        ):
            assert f"{more[0]:g}" in sources, words


def test_a_wrong_number_is_noticed(preset):
    text = f"{preset['story']} {preset['caution']}"
    known = claims(preset["id"])
    for found in re.finditer(r"\d+(?:\.\d+)?", text):
        wrong = f"{found[0][:-1]}{(int(found[0][-1]) + 1) % 10}"
        with pytest.raises(AssertionError):
            check_numbers(text[: found.start()] + wrong + text[found.end() :], known)


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
