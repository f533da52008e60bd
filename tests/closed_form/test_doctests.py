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
