"""Packages that only some tasks need."""

from importlib import import_module
from types import ModuleType

from carom.quantities import InputError


def extra(name: str, purpose: str) -> ModuleType:
    """Return a package of the extra `cluster`, or raise InputError that says how to get it."""
    try:
        return import_module(name)
    except ImportError:
        raise InputError(
            f"{purpose} needs the package {name.partition('.')[0]}; pip install 'carom[cluster]'"
        ) from None
