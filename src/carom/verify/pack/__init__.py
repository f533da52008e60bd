"""The benchmark pack: frozen reference impacts, and inputs of DEM codes for them."""

from carom.verify.pack.frozen import VERSION
from carom.verify.pack.writing import write_pack

__all__ = ["VERSION", "write_pack"]
