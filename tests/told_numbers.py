"""Numbers that a text tells: each computed to its last digit, and none that is not computed."""

import re

import pytest

NUMBER = re.compile(
    r"(?<![\w.])\d+(?:\.\d+)?|\b(?:half|two|three|four|twice|double)\b|\bone(?= degree)"
)
IN_WORDS = {"half": 0.5, "one": 1.0, "two": 2.0, "three": 3.0, "twice": 2.0, "double": 2.0}


def check_numbers(text, claims):
    """Check that claims (words with one place for a number, its value) tell all of a text's numbers.

    A place is {:.1f} and so on, as the number is written, or a number in words, {half}.
    """
    told = set()
    for words, value in claims:
        in_words = re.search(r"\{(\w+)\}", words)
        if in_words:
            assert value == pytest.approx(IN_WORDS[in_words[1]], rel=5e-3), words
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
