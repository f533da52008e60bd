"""Carom: how an elastic sphere leaves an oblique impact, and what happens inside the contact.

A `Sphere` and a `HalfSpace`, `Sphere` or `Cup` make a `Pair`. `impact` lets them meet, `collide`
does it for many, `sweep` varies any input, and `fit` finds parameters from measured rebounds.
Groups of names are `carom.laws`, `carom.dem` and `carom.verify` (contact laws of DEM codes),
`carom.plots`, `carom.datasets`, `carom.results` and `carom.status`; `dir(carom)` lists all.
"""

import lazy_loader  # a name is loaded when it is first used, from where `__init__.pyi` has it

from carom.old_names import with_old_names

_load, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__all__.remove("__version__")
__getattr__ = with_old_names(__name__, _load)
