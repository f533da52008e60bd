"""Every example in a docstring is true. Those of methods begin with a ball, a pair and a hit.

These are as the docstrings of `Sphere`, `Pair` and `impact` make them; all other examples have
only `carom` and what their module names.
"""

import doctest
import linecache
import pkgutil
from importlib import import_module

import pytest
from tests.checks import BALL, PAIR

import carom

MODULES = sorted(info.name for info in pkgutil.walk_packages(carom.__path__, "carom."))
HIT = carom.impact(PAIR, speed=2.0, angle="30 deg")
OF_METHODS = {"ball": BALL, "pair": PAIR, "hit": HIT}


@pytest.mark.parametrize("name", ["carom", *MODULES])
def test_examples(name):
    runner = doctest.DocTestRunner()
    linecache.clearcache()  # each run looks whether any of its files has changed
    for test in doctest.DocTestFinder().find(import_module(name), extraglobs={"carom": carom}):
        if "." in test.name.removeprefix(f"{name}."):
            test.globs.update(OF_METHODS)
        runner.run(test)
    assert runner.summarize().failed == 0
