"""Does the exact contact law matter in bulk? Packings, flows, drums and gases in LAMMPS.

The table is bulk.csv.

python studies/bulk_study.py              what the table lacks, two hours on two cores
python studies/bulk_study.py --only drum  of one experiment
python studies/bulk_study.py --check      the shear moduli of seed 1 again, against the table

Every simulation is stored as soon as it is done; a run that was broken off goes on where it
stopped. It needs `pair_style carom`: pip install 'carom[verify]', then carom lammps build.
"""

import argparse
import multiprocessing
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory, gettempdir

from bulk import decay, drum, gas, modulus, shear, table
from bulk.experiment import Found, Run
from rich.progress import track

PACKINGS = Path(gettempdir(), "carom_packings")  # kept for the next run
EXPERIMENTS = {"decay": decay, "gas": gas, "drum": drum, "modulus": modulus, "shear": shear}


def computed(packings: Path, asked: Run) -> tuple[Run, list[Found] | str]:
    """Return a simulation and what it gave, or why it failed."""
    begun = time.perf_counter()
    with TemporaryDirectory() as folder:
        try:
            found = EXPERIMENTS[asked.experiment].compute(asked, packings, Path(folder))
        except (RuntimeError, ValueError, OSError) as failure:
            return asked, f"{type(failure).__name__}: {failure}"
    return asked, [*found, Found("seconds", 0.0, round(time.perf_counter() - begun, 1))]


def complete(plan: list[Run], workers: int) -> None:
    """Compute what the table lacks and store it."""
    stored = table.read()
    missing = [asked for asked in plan if asked not in stored]
    for asked, found in simulated(missing, workers):
        stored[asked] = found
        table.write(stored, everything())


def check(workers: int) -> None:
    """Compute again what does not depend on chance: packings that are hardly sheared."""
    stored = table.read()
    again = [
        asked for asked in modulus.runs() if asked.at == modulus.STRAINS[0] and asked.seed == 1
    ]
    off = 0.0
    for asked, found in simulated(again, workers):
        before = {each.quantity: each.value for each in stored[asked]}
        here = {each.quantity: each.value for each in found}
        off = max(off, abs(here["modulus"] / before["modulus"] - 1.0))
    print(f"{len(again)} moduli are off by {off:.1e} at most")
    raise SystemExit(0 if off < 1e-3 else 1)


def simulated(runs: list[Run], workers: int) -> Iterator[tuple[Run, list[Found]]]:
    """Yield simulations with what they gave, as they are done; say which failed."""
    PACKINGS.mkdir(exist_ok=True)
    with multiprocessing.Pool(workers) as pool:
        work = pool.imap_unordered(partial(computed, PACKINGS), runs)
        for asked, found in track(work, "simulating", len(runs)):
            if isinstance(found, str):
                print(f"failed: {asked}: {found}")
            else:
                yield asked, found


def everything() -> list[Run]:
    """Return all simulations of the study."""
    return [asked for experiment in EXPERIMENTS.values() for asked in experiment.runs()]


def main() -> None:
    """Do what is asked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", choices=EXPERIMENTS, default=list(EXPERIMENTS))
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--check", action="store_true", help="compute a few again")
    asked = parser.parse_args()
    if asked.check:
        check(asked.workers)
    complete([run for run in everything() if run.experiment in asked.only], asked.workers)


if __name__ == "__main__":
    main()
