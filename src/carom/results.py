"""What the functions of Carom return: one record for each question."""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
