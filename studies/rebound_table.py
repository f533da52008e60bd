"""Is the table of psi_2 that `carom.fit` uses, src/carom/data/rebounds.npz, the solver's?

python studies/rebound_table.py              makes it anew, some minutes
python studies/rebound_table.py --check      how far it is from the solver, by ranges of chi
"""

import argparse
import sys
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

import carom
from carom.dimensionless.rebound_tables import (
    STORED,
    STORED_CHI,
    STORED_E,
    psi_at,
    psi_out,
    stored,
    tabulated,
)
from carom.io.progress import advancing

FILE = STORED
DEGREES, TOLERANCE, SOLVED = (6, 6, 8), 2e-6, 1e-8
FADING, POWER = 1.5, 6  # chi beyond which errors may grow, and how: curves have more kinks there
# Largest errors in psi_2 that are allowed between these chi and the next.
ALLOWED = {0.248: 1e-5, 1.75: 5e-5, 2.2: 5e-4, 3.0: 2e-3, 4.09: None}
IMPACTS, SEED = 2000, 7


def check() -> int:
    """Print how far psi_2 of the table is from the solver's; return 1 if too far."""
    rng, bad = np.random.default_rng(SEED), 0
    for low, high in pairwise(ALLOWED):
        chi = rng.uniform(low, high, IMPACTS)
        e = rng.choice([1.0, *rng.uniform(*STORED_E, 19)], IMPACTS)
        psi = psi_at(rng.uniform(0.0, 3.0, IMPACTS), chi, e)
        table = psi_out(stored(), psi[:, np.newaxis], chi, e)[:, 0]
        exact = np.empty(IMPACTS)
        for one in np.unique(e):
            some, law = e == one, carom.KelvinVoigt(restitution=float(one))
            exact[some] = carom.rebound(psi[some], chi[some], losses=law)
        error = np.abs(table - exact)
        rms = float(np.sqrt(np.mean(error**2)))
        print(f"chi {low:g} to {high:g}: largest {error.max():.1e}, rms {rms:.1e}")
        bad += error.max() > ALLOWED[low]
    return int(bad > 0)


def weight(chi: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what an error in psi_2 weighs."""
    return np.asarray(np.minimum(1.0, FADING / chi) ** POWER)


def main() -> int:
    """Make the table, or check it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only compare with the solver")
    if parser.parse_args().check:
        return check()
    with advancing("tabulating the rebounds", None, unit="impacts") as advance:
        made = {"degrees": DEGREES, "weight": weight, "impact_tolerance": SOLVED}
        table = tabulated(STORED_CHI, STORED_E, TOLERANCE, advance, **made)
    parts = table._asdict()
    parts |= {"series": table.series.astype(np.float32)}
    parts |= {name: parts[name].astype(np.int32) for name in ("axes", "children", "terms")}
    np.savez_compressed(FILE, **parts)
    print(f"{len(table.series)} patches, {FILE.stat().st_size / 1e3:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
