"""Every example in a docstring is true."""

import doctest
import pkgutil
from importlib import import_module

import pytest

import carom

MODULES = sorted(info.name for info in pkgutil.walk_packages(carom.__path__, "carom."))


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    failed, _ = doctest.testmod(import_module(name))
    assert failed == 0


def test_every_public_name_has_an_example():
    """What users call or make shows how; the rest is seen in the examples of others."""
    results = {"Collisions", "Impact", "LoadPath", "WaltonFit"}
    plain = {"Cup", "HalfSpace", "InputError", "Status", "material_sources"}
    modules = {"classical", "plots"}
    for name in set(carom.__all__) - results - plain - modules:
        assert ">>>" in getattr(carom, name).__doc__, name


def test_every_name_of_the_bench_has_an_example():
    """Of `carom.verify`, too."""
    results = {"Bench", "EngineError", "Entry", "Ranking", "Score", "Tuning"}
    for name in set(carom.verify.__all__) - results - {"CATALOGUE"}:
        assert ">>>" in getattr(carom.verify, name).__doc__, name
