"""Rate, scaling and memory of sweeps, each ratio of times taken in one run.

python benchmarks/sweeps.py            up to 1e6 impacts, about a minute
python benchmarks/sweeps.py --smoke    a quick pass through the same code
python benchmarks/sweeps.py --large    up to 1e7 impacts as well
"""

import argparse
import os
import resource
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import carom
from carom.dimensionless.rebounds import available_cores
from carom.sweeps import sweep
from carom.sweeps.designs import LatinHypercube
from carom.sweeps.evaluation import Problem

SEED = 20261121
CASE = {
    "first": {"radius": "5 mm", "material": "steel"},
    "friction": 0.2,
    "speed": "2 m/s",
}
# psi_1 from 0 to 5.9 at chi = 1.44: stick, microslip and slip, hardly any gross slip
RANGES = {"angle": ("0 deg", "55 deg"), "spin": ("-50 rad/s", "50 rad/s")}
SMALLEST = 10_000


class Run(NamedTuple):
    """Seconds of a sweep, and the peak memory in MB of the process that ran it."""

    seconds: float
    memory: float


def design(points: int) -> LatinHypercube:
    """Return the impacts."""
    return LatinHypercube(RANGES, samples=points, seed=SEED)


def run_here(points: int, workers: int) -> None:
    """Sweep into a store and print the time and the peak memory; a small sweep loads the code."""
    with TemporaryDirectory(dir=".") as folder:
        sweep(CASE, design(64), store=Path(folder) / "first.zarr", workers=workers)
        start = time.perf_counter()
        sweep(CASE, design(points), store=Path(folder) / "sweep.zarr", workers=workers)
        seconds = time.perf_counter() - start
    print(seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0)


def measured(points: int, workers: int, repeats: int = 1) -> Run:
    """Return the best of a few runs, each in a process of its own."""
    command = [sys.executable, __file__, "--run", str(points), str(workers)]
    runs = []
    for _ in range(repeats):
        out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        runs.append(Run(*map(float, out.split())))
    return min(runs)


def kernel_seconds(points: int) -> float:
    """Return the time of the same impacts solved at once on all cores, without a sweep."""
    block = Problem(CASE, design(points), ["psi_in", "chi"]).block((slice(0, points),))
    start = time.perf_counter()
    carom.rebound(block["psi_in"], block["chi"])
    return time.perf_counter() - start


def report(sizes: list[int], repeats: int) -> None:
    """Print what sweeps of several sizes cost on all cores, and the largest of them on one."""
    cores = available_cores()
    most = sizes[-1]
    kernel_seconds(64)
    alone = kernel_seconds(min(most, 1_000_000)) / min(most, 1_000_000)
    runs = {points: measured(points, cores, repeats if points < most else 1) for points in sizes}
    base = runs[most].seconds / most
    for points, run in runs.items():
        each = run.seconds / points
        print(
            f"{points:9.0e} impacts into a store, {cores} threads {run.seconds:9.2f} s,"
            f" {each * 1e6:6.1f} us each, {each / alone:5.2f} times the kernel alone,"
            f" {each / base:5.2f} of the largest; peak {run.memory:4.0f} MB"
        )


def report_efficiency(points: int, repeats: int) -> None:
    """Print the parallel efficiency from one to two workers."""
    one, two = (measured(points, workers, repeats).seconds for workers in (1, 2))
    print(f"from 1 to 2 workers at {points:.0e}: efficiency {one / two / 2.0:.2f}")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    parser.add_argument("--large", action="store_true", help="up to 1e7 impacts")
    parser.add_argument("--run", nargs=2, type=int, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.run:
        run_here(*given.run)
        return
    sizes = [2_000] if given.smoke else [SMALLEST, 100_000, 1_000_000]
    report([*sizes, 10_000_000] if given.large else sizes, 1 if given.smoke else 3)
    if (os.cpu_count() or 1) > 1:
        report_efficiency(2_000 if given.smoke else 200_000, 1 if given.smoke else 3)


if __name__ == "__main__":
    main()
