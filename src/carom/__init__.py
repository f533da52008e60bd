"""Carom: how an elastic sphere leaves an oblique impact, and what happens inside the contact.

The public names are listed in `__init__.pyi` with their modules. They are loaded when they are
first used, so that `import carom` is fast.
"""

import lazy_loader

from carom.old_names import with_old_names

_load, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__all__.remove("__version__")
__getattr__ = with_old_names(__name__, _load)
