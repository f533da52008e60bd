"""Numbers that a text tells: each computed to its last digit, and none that is not computed."""

import re

import pytest

DIGITS = r"(?<![\w.])\d+(?:\.\d+)?"
NUMBER = re.compile(
    rf"{DIGITS}|\b(?:half|two|three|four|twice|double)\b|\bone(?= degree)", re.IGNORECASE
)
IN_WORDS = {"half": 0.5, "one": 1.0, "two": 2.0, "three": 3.0, "twice": 2.0, "double": 2.0}


def check_numbers(text, claims):
    """Check that claims tell all numbers of a text.

    A claim is words with one place for a number, and its value. The place is as the number is
    written, {:.1f} and so on, or the word for it, {half}.
    """
    told = set()
    for words, value in claims:
        in_words = re.search(r"\{(\w+)\}", words)
        if in_words:
            assert value == pytest.approx(IN_WORDS[in_words[1].lower()], rel=5e-3), words
            written = words.replace(in_words[0], in_words[1])
        else:
            written = words.format(float(f"{value:.12g}"))
        assert text.count(written) == 1, f"{written}: in {text}"
        start = text.index(written)
        told |= {
            found.start()
            for found in NUMBER.finditer(text)
            if start <= found.start() < start + len(written)
        }
    assert [found[0] for found in NUMBER.finditer(text) if found.start() not in told] == []
