"""The bench: contact laws of DEM codes, and the codes themselves, against the exact impact.

Examples
--------
>>> import carom
>>> best = carom.verify.rank().standings[0]
>>> best.entry.label, round(best.max_error, 3)
('exact, 16 springs', 0.001)
"""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
