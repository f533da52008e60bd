"""The film's pictures and sentences: words that fit, zones in their colours, what is told is so."""

import re
from base64 import b64decode

import numpy as np
import pytest
from tests.browser.scripts import script

import carom

WORDS = script("picture_words")
PARTS = ("stage", "patch")
BOXES = [(170, 140), (170, 300), (250, 200), (330, 390), (420, 360), (560, 240), (700, 500)]
SHARES = [-0.4, 0.05, 0.3, 0.5, 0.62, 0.8, 0.95, 1.4]
PICTURE = script("picture")
SENTENCES = script("sentences")
TIMES = [round(float(share), 3) for share in np.linspace(0.02, 0.98, 49)]


def faults(words, width, height, **_):
    """Yield what is wrong with the words of one picture."""
    for row, (text, size, left, top, right, bottom) in enumerate(words):
        if size < 11.0:
            yield f"{text}: {size} px"
        if left < 0.0 or top < 0.0 or right > width or bottom > height:
            yield f"{text}: cut"
        for other, _, start, high, end, low in words[:row]:
            if left < end and start < right and top < low and high < bottom:
                yield f"{text}: over {other}"


@pytest.mark.first_case
@pytest.mark.parametrize(
    "query",
    [
        *("", "angle=2", "angle=0", "friction=0", "restitution=0.7&angle=15"),
        *("against=sphere&second_radius=5&angle=20", "against=cup&second_radius=7&angle=20"),
        "given=numbers&psi=-1.5&chi=1.9",
    ],
)
def test_no_word_is_cut_small_or_over_another(page, query):
    pictures = page.evaluate(WORDS, [query, PARTS, BOXES, SHARES])
    assert len(pictures) == len(PARTS) * len(BOXES) * len(SHARES)
    assert [each for each in pictures if not each["words"] or [*faults(**each)]] == []


def test_the_key_stays_in_the_smallest_box(page):
    for each in page.evaluate(WORDS, ["", PARTS, BOXES[:1], [0.75]]):
        assert {"stick", "slip \N{MINUS SIGN}"} <= {text for text, *_ in each["words"]}


def picture(page, part, share, colors, width=420, height=360):
    """Return where each colour is drawn, as masks of pixels."""
    value = page.evaluate(PICTURE, [part, share, width, height, colors])
    pixels = np.frombuffer(b64decode(value["data"]), np.uint8).reshape(*value["size"], 4)
    masks = {}
    for name, color in zip(colors, value["colors"], strict=True):
        rgb = [int(pair, 16) for pair in re.findall("..", color.lstrip("#"))]
        masks[name] = (np.abs(pixels[..., :3] - rgb).max(axis=-1) < 8) & (pixels[..., 3] > 200)
    return masks


def test_zones_on_the_map_in_their_colours(visit, usual):
    """The blue circle against the orange edge is the stick radius against the contact's."""
    page, history = visit("?theme=light").page, usual.history(201)
    for row in (120, 150, 160):
        masks = picture(page, "patch", row / 200, ["stick", "slip"])
        spans = {}
        for name, mask in masks.items():
            columns = np.nonzero(mask[: int(0.55 * mask.shape[0])].any(axis=0))[0]
            spans[name] = columns.max() - columns.min() + 1 - 2.5
        at = history.isel(time=row)
        expected = float(at["stick_radius"] / at["contact_radius"])
        assert spans["stick"] / spans["slip"] == pytest.approx(expected, abs=0.03)


def test_gross_slip_is_grey_on_both_pictures(visit):
    page = visit("?angle=80&theme=light").page
    for part in PARTS:
        masks = picture(page, part, 0.5, ["gross", "slip", "stick"])
        assert masks["gross"].sum() > 100
        assert not masks["slip"].any()
        assert not masks["stick"].any()


def test_hatches_tell_the_sign(page):
    words = script("hatch")
    for sign in (1, -1):
        level = np.array(page.evaluate(words, sign)).reshape(60, 60, 4)[..., 2].astype(float)
        rising = np.abs(level[1:, :-1] - level[:-1, 1:]).mean()
        falling = np.abs(level[:-1, :-1] - level[1:, 1:]).mean()
        assert (rising < 0.2 * falling) if sign > 0 else (falling < 0.2 * rising)


@pytest.mark.parametrize(
    ("query", "share", "sentence"),
    [
        ("angle=5", -0.3, "The ball approaches: .* its contact point moves forwards"),
        ("angle=5", 0.1, "the whole contact sticks: .* stretches the tangential spring"),
        ("angle=5", 0.42, "the whole contact sticks: the ball springs back tangentially"),
        ("angle=5", 0.5, "rim slips backwards while the centre still sticks: .* springs back"),
        ("angle=30", 0.2, "the whole contact slips forwards: .* too fast to stick"),
        ("angle=30", 0.8, "the rim slips backwards .*: friction has reversed and brakes"),
        ("angle=30", 0.95, "the whole contact slips backwards: friction has reversed"),
        ("angle=30", 1.3, "The ball has left: its contact point now moves backwards, at 4\\d"),
        ("angle=80", 0.8, "slips forwards: .* less and less as the pressure falls"),
        ("angle=80", 1.3, "its contact point still moves forwards"),
        ("angle=0", 0.3, "no tangential velocity and sticks: only the normal force acts"),
        ("friction=0", 0.3, "the surfaces slide freely: without friction"),
        ("friction=0", 1.3, "no friction acted"),
        ("angle=15&restitution=0.7", 1.3, "part of the energy is lost in the bodies: its"),
        ("thickness=4&speed=2", 1.3, "part of the energy is lost to waves in the plate: its"),
        ("against=sphere", 0.2, "As the balls are pressed together, the whole contact slips"),
        ("against=sphere", 1.3, "The balls have parted: .* as seen from the other, now moves"),
        ("against=sphere&friction=0", 0.3, "only the normal force acts and drives the struck"),
        ("angle=20&spin=-300&speed=0.5", -0.3, "it spins so fast that .* moves backwards"),
    ],
)
def test_sentences(page, query, share, sentence):
    (text,) = page.evaluate(SENTENCES, [query, [share]])
    assert re.search(sentence, text)
    assert text[0].isupper()
    assert text.endswith(".")
    assert text.count(".") == 1


def test_what_is_told_is_so(page):
    """Random impacts: where the spring is said to drive the ball, it does work on it, and so on."""
    generator = np.random.default_rng(29)
    for _ in range(24):
        psi = float(generator.choice([-1.0, 1.0]) * generator.uniform(0.05, 6.0))
        chi, e = float(generator.uniform(0.5, 3.0)), float(generator.choice([1.0, 0.8]))
        query = f"given=numbers&psi={psi:.4f}&chi={chi:.4f}&restitution={e}"
        losses = None if e == 1.0 else carom.KelvinVoigt(restitution=e)
        solved = carom.solve(round(psi, 4), round(chi, 4), losses=losses)
        for share, reply in zip(TIMES, page.evaluate(SENTENCES, [query, TIMES]), strict=True):
            check(solved, share, reply, query)


def check(solved, share, text, query):
    """Compare one sentence with the state that the library knows."""
    edges = [phase.end / solved.duration for phase in solved.phases]
    if min(abs(share - edge) for edge in edges) < 0.005:
        return
    phase = solved.phase_at(share * solved.duration)
    near = solved.at((share + np.array([-2e-4, 0.0, 2e-4])) * solved.duration)
    where = f"{query} at {share}: {text}"
    zone = {"stick": "whole contact sticks", "slip": "rim slips", "gross slip": "contact slips"}
    assert zone[phase.kind] in text, where
    way = "forwards" if phase.sign * solved.psi_in > 0.0 else "backwards"
    assert phase.kind == "stick" or f"slips {way}" in text, where
    gains = np.diff(near.psi[[0, 2]] ** 2)[0]
    instant = "for an instant" in text or "friction reverses" in text
    if "springs back" in text or "spring drives" in text or "still drives" in text:
        assert gains > 0.0, where
    elif not instant:
        assert gains < 0.0, where
    if "springs back" in text:
        assert near.psi[1] * solved.psi_in < 0.0, where
    if "has reversed" in text:
        assert near.force[1] * solved.psi_in < 0.0, where
    if "pressed in" in text:
        assert near.speed[1] > -0.05, where
    if "pushed away" in text:
        assert near.speed[1] < 0.05, where


def test_slow_motion_is_smooth(page):
    words = script("slow_motion")
    pace = page.evaluate("Carom.clock.pace()")
    value = page.evaluate(words)
    usual, slow = (np.diff(value[name])[:-1] for name in ("usual", "slow"))
    step = 2.2 / pace / 60.0
    assert usual == pytest.approx(step)
    assert slow.max() == pytest.approx(step)
    assert slow.min() == pytest.approx(step / 6.0, rel=0.05)
    assert np.abs(np.diff(slow)).max() < 0.25 * step
    middles = np.array(value["slow"])[:-2]
    far = np.min(np.abs(middles[:, np.newaxis] - [0.4, 0.8]), axis=1) > 0.06
    assert slow[far] == pytest.approx(step)


def test_jumps_to_changes_of_phase(visit):
    """They are held by links, as they are rounded there: the phase is the one that begins."""
    seen = visit("?time=-0.6")
    words = script("jump")
    phases = seen.page.evaluate("Carom.page.scenes[0].data.phases")
    names = [seen.page.evaluate("phase => Carom.scene.nameOf(phase)", phase) for phase in phases]
    borders = [-0.6, 0.0, *(phase["end"] for phase in phases), 1.6]
    reply = ["before", *names, names[-1], "after"]
    seen.page.evaluate("Carom.clock.play()")
    for name, rows in (("next", range(1, len(reply))), ("previous", range(len(reply) - 2, -1, -1))):
        for row in rows:
            now, playing, phase = seen.page.evaluate(words, name)
            assert (playing, phase) == (False, reply[row])
            assert borders[row] <= now <= borders[row] + 1.1e-6


def test_tiny_forces_are_told_as_large_ones_are(page):
    """Billiard balls that roll on each other as gear wheels all but do: nothing is rounded away."""
    queries = [f"given=numbers&psi={psi:.15g}" for psi in (1e-4, 1e-9)]
    shares = [-0.3, 0.1, 0.3, 0.5, 0.7, 0.9, 1.3]
    one, other = (page.evaluate(SENTENCES, [query, shares]) for query in queries)
    assert one == other
    assert not any("without friction" in sentence or "to rest" in sentence for sentence in one)
