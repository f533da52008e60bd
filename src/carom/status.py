"""Status codes: what became of each point of a batch. They are integers with a `message`."""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
