"""One impact without compiled kernels: done sooner than they are loaded, let alone compiled."""

import sys

allowed = False  # in a process that runs one command


def interpret() -> None:
    """Let kernels run as they are written for the rest of this process, where that is allowed."""
    if allowed and "carom.dimensionless._jit" not in sys.modules:
        import numba
        import numpy as np

        numba.config.DISABLE_JIT = True  # type: ignore[attr-defined]
        np.seterr(all="ignore")  # as in compiled code
