"""Compiled kernels are cached under a key of their sources: numba does not see an edit in a
callee.
"""

import hashlib
import os
import tempfile
from importlib.util import find_spec
from pathlib import Path

KERNELS = sorted(Path(find_spec("carom.dimensionless").submodule_search_locations[0]).glob("*.py"))
KEY = hashlib.sha256(b"".join(path.read_bytes() for path in KERNELS)).hexdigest()[:16]

os.environ["NUMBA_CACHE_DIR"] = str(Path(tempfile.gettempdir()) / f"carom-kernels-{KEY}")
