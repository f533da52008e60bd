"""Closed forms of tangential contact of spheres; their home is `carom.contacts.classical`."""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
