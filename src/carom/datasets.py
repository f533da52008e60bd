"""Measured rebounds and published parameters that come with Carom, with definitions and sources.

Examples
--------
>>> import carom
>>> carom.datasets.names()
('foerster1994', 'kharaz2001', 'kharaz2001_kratos', 'kharaz2001_mfix')
"""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
