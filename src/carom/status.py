"""Status codes: what became of each point of a batch. They are integers with a `message`."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("carom", __file__)
