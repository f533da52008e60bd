"""Mutations of texts, seeded; and what every answer to a user has in common."""

import random
import signal
from contextlib import contextmanager

import pytest
from tests.checks import one_line

from carom.quantities.refusals import InputError

ALPHABET = (
    "0123456789.+-eE,; \t\n\r\"'[](){}=:#/*^%°µ²⁻·−–_~<>?!$&@|\\\u00a0\u200b\u0663½∞\0mskgNPadrinfx"
)
PIECES = [
    *("nan", "inf", "-inf", "1e999", "1e-999", "9**9**9", "9" * 400, "1_000", "1 500", "1,5", "١٢"),
    *("true", "null", "None", "=1/2", "pi", "5 mm; 3", "−700", "–700", "5 deg 10 arcmin", "~2", ""),
    *("5 kHz", "20 %", "5° 10'", "2 m/s", "rad/s", "[rpm]", "[", "]]", "# case: {", "\ufeff", "''"),
    *('"', '"""', "{" * 50, "[" * 50, "a.b.c", "\r\n", ",,,,", ";", "../..", "-", "--", "="),
    "\u202e",
]


@pytest.fixture
def rng():
    return random.Random(19)


@pytest.fixture
def mutated(rng):
    """A function that returns a text with one to four changes."""

    def change(text):
        for _ in range(rng.choice([1, 1, 1, 2, 4])):
            start = rng.randrange(len(text) + 1)
            stop = min(len(text), start + rng.choice([0, 0, 1, 1, 3, 20]))
            new = rng.choice([rng.choice(ALPHABET), rng.choice(PIECES), text[start:stop] * 2, ""])
            text = text[:start] + new + text[stop:]
        return text

    return change


@pytest.fixture
def answered():
    """A function that tells whether a call gives a result, or one line of ours, within a time."""

    def call(function, *args, seconds=10):
        try:
            with _within(seconds):
                function(*args)
        except InputError as error:
            one_line(error, 3000)
            return False
        return True

    return call


@contextmanager
def _within(seconds):
    def too_long(*_):
        raise AssertionError(f"no answer after {seconds} s")

    before = signal.signal(signal.SIGALRM, too_long)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
