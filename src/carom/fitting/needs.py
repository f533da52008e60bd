"""Packages of the extra `fit`."""

from importlib import import_module
from types import ModuleType

from carom.quantities import InputError


def needed(name: str, purpose: str) -> ModuleType:
    """Return a package, or raise InputError that says how to get it."""
    try:
        return import_module(name)
    except ImportError:
        raise InputError(f"{purpose} needs the package {name}; pip install 'carom[fit]'") from None
