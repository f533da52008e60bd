"""Rebound laws: the exact one as a table, and those that are used in its place."""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
