"""Rate, scaling and memory of sweeps, each ratio of times taken in one run.

python benchmarks/sweeps.py            up to 1e6 impacts, about a minute
python benchmarks/sweeps.py --smoke    a quick pass through the same code
python benchmarks/sweeps.py --large    up to 1e7 impacts as well
"""

import argparse
import subprocess
import sys
import time
from math import nan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import carom
from carom.dimensionless.numerics.threads import available_cores
from carom.many.sweeps import sweep
from carom.many.sweeps.designs import LatinHypercube
from carom.many.sweeps.problem import SweepProblem

SEED = 20261121
CASE = {"first": {"radius": "5 mm", "material": "steel"}, "friction": 0.2, "speed": "2 m/s"}
# psi_1 from 0 to 5.9 at chi = 1.44: stick, microslip and slip, hardly any gross slip
RANGES = {"angle": ("0 deg", "55 deg"), "spin": ("-50 rad/s", "50 rad/s")}
LARGE = 10_000_000
PLACE = {False: "in memory   ", True: "into a store"}


class Run(NamedTuple):
    """Seconds of a sweep, and the peak memory in MB of the process that ran it."""

    seconds: float
    memory: float


def design(points: int) -> LatinHypercube:
    """Return the impacts."""
    return LatinHypercube(RANGES, samples=points, seed=SEED)


def run_here(points: int, workers: int, stored: bool) -> None:
    """Sweep and print the time and the peak memory; a small sweep before it loads the code."""
    with TemporaryDirectory(dir=".") as folder:
        first, second = (Path(folder) / f"{i}.zarr" if stored else None for i in range(2))
        sweep(CASE, design(64), store=first, workers=workers)
        start = time.perf_counter()
        sweep(CASE, design(points), store=second, workers=workers)
        seconds = time.perf_counter() - start
    print(seconds, peak_memory())


def peak_memory() -> float:
    """Return the peak memory of this process in MB; what `resource` tells may be its parent's."""
    status = Path("/proc/self/status")
    if not status.exists():
        return nan
    words = status.read_text().split()
    return float(words[words.index("VmHWM:") + 1]) / 1024.0


def measured(points: int, workers: int, stored: bool, repeats: int) -> Run:
    """Return the best of a few runs, each in a process of its own."""
    command = [sys.executable, __file__, "--run", str(points), str(workers), str(int(stored))]
    runs = []
    for _ in range(repeats):
        out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        runs.append(Run(*map(float, out.split())))
    return min(runs)


def kernel_seconds(points: int) -> float:
    """Return the time of the same impacts solved at once on all cores, without a sweep."""
    block = SweepProblem(CASE, design(points), ["psi_in", "chi"]).block((slice(0, points),))
    start = time.perf_counter()
    carom.rebound(block["psi_in"], block["chi"])
    return time.perf_counter() - start


def report(sizes: list[int], kernel: float, repeats: int) -> None:
    """Print what sweeps of several sizes cost on all cores, in memory and into a store."""
    cores = available_cores()
    for stored in (False, True):
        # 1e7 results in memory are 1.4 GB: that is what stores are for
        wanted = [points for points in sizes if stored or points < LARGE]
        runs = {n: measured(n, cores, stored, repeats if n < 10**6 else 1) for n in wanted}
        base = runs[wanted[-1]].seconds / wanted[-1]
        for points, run in runs.items():
            each = run.seconds / points
            print(
                f"{points:7.0e} impacts {PLACE[stored]}"
                f" {run.seconds:8.2f} s, {each * 1e6:6.1f} us each: {each / kernel:5.2f} of the"
                f" kernel alone, {each / base:5.2f} of the largest; peak {run.memory:4.0f} MB"
            )


def report_efficiency(points: int, repeats: int) -> None:
    """Print the parallel efficiency from one to two workers."""
    for stored in (False, True):
        one, two = (measured(points, workers, stored, repeats).seconds for workers in (1, 2))
        where = "into a store" if stored else "in memory   "
        print(
            f"{points:7.0e} impacts {where} from 1 to 2 workers: efficiency {one / two / 2.0:.2f}"
        )


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    parser.add_argument("--large", action="store_true", help="up to 1e7 impacts")
    parser.add_argument("--run", nargs=3, type=int, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.run:
        points, workers, stored = given.run
        run_here(points, workers, bool(stored))
        return
    sizes = [2_000] if given.smoke else [10_000, 100_000, 1_000_000]
    repeats = 1 if given.smoke else 3
    kernel_seconds(64)  # compiles
    kernel = min(kernel_seconds(sizes[-1] // 10) for _ in range(repeats)) / (sizes[-1] // 10)
    print(f"kernel alone, {available_cores()} threads: {kernel * 1e6:.1f} us for an impact")
    report([*sizes, LARGE] if given.large else sizes, kernel, repeats)
    if available_cores() > 1:
        report_efficiency(sizes[-1] // 5, repeats)


if __name__ == "__main__":
    main()
