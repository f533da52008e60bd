"""Every example in a docstring is true, and stands alone: it imports all that it names."""

import doctest
import pkgutil
from importlib import import_module

import pytest

import carom

MODULES = sorted(info.name for info in pkgutil.walk_packages(carom.__path__, "carom."))


@pytest.mark.parametrize("name", ["carom", *MODULES])
def test_examples(name):
    runner = doctest.DocTestRunner()
    for test in doctest.DocTestFinder().find(import_module(name), globs={}):
        runner.run(test)
    assert runner.summarize().failed == 0
