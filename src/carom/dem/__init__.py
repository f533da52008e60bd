"""Contact laws as the codes of the discrete element method define them, each with its source."""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
