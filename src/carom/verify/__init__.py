"""The bench: contact laws of DEM codes, and the codes themselves, against the exact impact.

Examples
--------
>>> import carom
>>> best = carom.verify.rank().standings[0]
>>> best.entry.label, round(best.max_error, 3)
('exact, 32 springs', 0.001)
"""

import lazy_loader

from carom.old_names import with_old_names

_load, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = with_old_names(__name__, _load)
