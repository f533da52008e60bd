"""What the functions of Carom return: one record for each question."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("carom", __file__)
