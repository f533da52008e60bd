"""Carom: how an elastic sphere leaves an oblique impact, and what happens inside the contact.

The public names stand in `__init__.pyi`, each with its home, and are loaded when they are first
used, so that `import carom` costs nothing.
"""

import lazy_loader

_named, _names, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    if name == "__version__":
        from carom.io.labels import carom_version

        return carom_version()
    return _named(name)


def __dir__() -> list[str]:
    return [*_names(), "__version__"]
