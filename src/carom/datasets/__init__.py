"""Measured rebounds that come with Carom: tables with units, definitions, errors and sources.

Examples
--------
>>> import carom
>>> carom.datasets.names()
('kharaz2001', 'kharaz2001_kratos', 'kharaz2001_mfix')
"""

from carom.datasets.shipped import load, names, path, table

__all__ = ["load", "names", "path", "table"]
__dir__ = __all__.copy
