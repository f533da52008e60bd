"""Does the exact contact law matter in bulk? Packings, flows, drums and gases in LAMMPS.

The table is bulk.csv.

python studies/bulk_study.py              what the table lacks, two hours on two cores
python studies/bulk_study.py --only drum  of one experiment

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

from bulk import decay, drum, gas, modulus, shear, simulations
from bulk.simulations import Found, Run
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
    stored = simulations.read()
    missing = [asked for asked in plan if asked not in stored]
    for asked, found in simulated(missing, workers):
        stored[asked] = found
        simulations.write(stored, everything())


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
    asked = parser.parse_args()
    complete([run for run in everything() if run.experiment in asked.only], asked.workers)


if __name__ == "__main__":
    main()
