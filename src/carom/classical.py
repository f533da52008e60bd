"""Classical solutions for spheres: loads along the surface, impacts with adhesion."""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
