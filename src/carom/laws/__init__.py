"""Rebound laws: the exact one as a table, and those that are used in its place."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
