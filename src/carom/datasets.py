"""Measured rebounds that come with Carom; their home is `carom.measurements.datasets`."""

from carom.measurements.datasets import load, names, path, table

__all__ = ["load", "names", "path", "table"]


def __dir__() -> list[str]:
    return __all__
