"""Measured rebounds and published parameters that come with Carom, with definitions and sources.

Examples
--------
>>> import carom
>>> carom.datasets.names()
('foerster1994', 'kharaz2001', 'kharaz2001_kratos', 'kharaz2001_mfix')
"""

from carom.datasets.shipped import load, names, parameters, path, table

__all__ = ["load", "names", "parameters", "path", "table"]
__dir__ = __all__.copy
