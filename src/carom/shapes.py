"""Bodies of common shapes. Others, as clubs and rackets, are a `Body` by mass and inertia."""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
