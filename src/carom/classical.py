"""Closed forms of tangential contact of spheres; their home is `carom.contacts.classical`."""

from carom.contacts.classical import Obliquity, cattaneo_mindlin, critical_obliquity, loop_energy

__all__ = ["Obliquity", "cattaneo_mindlin", "critical_obliquity", "loop_energy"]
__dir__ = __all__.copy
