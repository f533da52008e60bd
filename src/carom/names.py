"""Public names: each is loaded when it is first used; one that is not there is told where it is."""

import os
import sys
from importlib import import_module
from typing import Any

import lazy_loader

NAMES_OF_GROUPS = (
    "classical",
    "datasets",
    "dem",
    "laws",
    "plots",
    "results",
    "shapes",
    "status",
    "verify",
)
GROUPS = ("carom", *(f"carom.{name}" for name in NAMES_OF_GROUPS))


def attach(package: str, file: str) -> tuple[Any, Any, list[str]]:
    """Return `__getattr__`, `__dir__` and `__all__` of a module with its public names in a stub."""
    is_folder = os.path.basename(file).startswith("__init__.")
    home = package if is_folder else package.rpartition(".")[0]
    load, __dir__, __all__ = lazy_loader.attach_stub(home, file)

    def __getattr__(name: str) -> Any:
        if name not in __dir__():
            where = "" if name.startswith("_") else f"; {_hint(package, name)}"
            raise AttributeError(f"{package} has no {name}{where}", name=name)

        value = load(name)
        if not is_folder:
            vars(sys.modules[home]).pop(name, None)  # where the loader has left it, too
        setattr(sys.modules[package], name, value)
        return value

    return __getattr__, __dir__, __all__


def _hint(package: str, name: str) -> str:
    """Return where a name is, or the nearest to it, in this group before the others."""
    from difflib import get_close_matches

    of_groups = {group: import_module(group).__all__ for group in GROUPS}
    own = {each: f"{package}.{each}" for each in of_groups[package]}
    every = {each: f"{group}.{each}" for group in GROUPS for each in of_groups[group]}
    if name in every:
        return f"it is {every[name]}"
    for places in (own, every):
        if near := get_close_matches(name, places, n=1):
            return f"did you mean {places[near[0]]}?"
    return f"dir({package}) lists its names"
