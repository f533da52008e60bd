"""Are the curves that `carom.fit` interpolates in, src/carom/data/fit_curves.npz, the solver's?

python studies/fit_curves.py              makes them anew, some minutes
python studies/fit_curves.py --check      whether the stored table is theirs, at a few curves
"""

import argparse
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rich.progress import track

import carom
from carom.dimensionless.interpolation import TABLE, grid, nodes, table

FILE = Path(carom.__file__).parent / TABLE
CHECKED = (0, 3, 11)  # of the e of the table
SAME = 1e-6  # of single precision, and of what solvers promise


def curves(chi: NDArray[np.float64], restitution: float) -> NDArray[np.float64]:
    """Return the curves of one e, one a row."""
    psi = nodes(chi, restitution)
    law = None if restitution == 1.0 else carom.KelvinVoigt(restitution=restitution)
    return np.asarray(carom.rebound(psi, chi[:, np.newaxis], losses=law)) / psi


def check() -> int:
    """Print how far the stored curves are from the solver's; return 1 if too far."""
    chis, losses = grid()
    worst = 0.0
    for place in CHECKED:
        found = curves(chis[::13], float(losses[place]))
        stored = table()[::13, place]
        worst = max(worst, float(np.abs((found - stored) / (1.0 + np.abs(stored))).max()))
    print(f"largest difference {worst:.1e}, allowed {SAME:.0e}")
    return int(worst > SAME)


def main() -> int:
    """Make the table, or check it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only compare a few curves")
    if parser.parse_args().check:
        return check()
    chis, losses = grid()
    rows = [curves(chis, float(restitution)) for restitution in track(losses)]
    np.savez_compressed(FILE, curves=np.stack(rows, axis=1).astype(np.float32))
    print(f"{FILE.stat().st_size / 1e3:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
