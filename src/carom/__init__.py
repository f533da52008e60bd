"""Carom: how an elastic sphere leaves an oblique impact, and what happens inside the contact.

A `Sphere` and a `HalfSpace`, `Sphere` or `Cup` make a `Pair`. `impact` lets them meet, `collide`
does it for many, `sweep` varies any input, and `fit` finds parameters from measured rebounds.
Groups of names are `carom.laws`, `carom.dem` and `carom.verify` (contact laws of DEM codes),
`carom.shapes`, `carom.plots`, `carom.datasets`, `carom.results` and `carom.status`; `dir(carom)`
lists all.
"""

from carom.names import attach  # a name is loaded when first used, from where the stub has it

__getattr__, __dir__, __all__ = attach(__name__, __file__)
__all__.remove("__version__")
