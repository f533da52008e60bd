"""What numba compiles is cached under a key of all sources: it does not see an edit in a callee, or
of a constant in another module.
"""

import hashlib
import os
import tempfile
from importlib.util import find_spec
from pathlib import Path

import pytest

SOURCES = sorted(Path(find_spec("carom").submodule_search_locations[0]).rglob("*.py"))
KEY = hashlib.sha256(b"".join(path.read_bytes() for path in SOURCES)).hexdigest()[:16]

# jax is here to agree, not to be quick: a third of the time of its tests
XLA = "--xla_backend_optimization_level=0 --xla_llvm_disable_expensive_passes=true"
os.environ.setdefault("XLA_FLAGS", XLA)
os.environ["NUMBA_CACHE_DIR"] = str(Path(tempfile.gettempdir()) / f"carom-kernels-{KEY}")


def pytest_addoption(parser):
    words = "calls of the cheapest fuzz test; the others take a share of it (default: %(default)s)"
    parser.addoption("--fuzz", type=int, default=2000, metavar="N", help=words)


@pytest.fixture
def calls(request):
    """How many calls the cheapest fuzz test makes."""
    return request.config.getoption("--fuzz")
