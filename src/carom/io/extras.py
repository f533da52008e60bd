"""Packages that only some tasks need."""

from importlib import import_module
from types import ModuleType

from carom.quantities.refusals import InputError


def extra(name: str, purpose: str, group: str = "cluster") -> ModuleType:
    """Return a package of an extra, or a module that needs one, or say how to get it.

    Raises InputError if a package is missing.
    """
    try:
        return import_module(name)
    except ImportError as error:
        package = (error.name or name).partition(".")[0]
        hint = f"pip install 'carom[{group}]'"
        raise InputError(f"{purpose} needs the package {package}; {hint}") from None
