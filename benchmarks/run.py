"""Time per impact of the exact solver and of its twin, in one run on one core; prints ratios.

python benchmarks/run.py            a few seconds
python benchmarks/run.py --smoke    a quick pass through the same code
"""

import argparse
import time
from collections.abc import Callable

import numpy as np

import carom
from carom.dimensionless.marching import march

SEED = 20261121
FINE, COARSE = (500, 2000), (125, 500)


def seconds(work: Callable[[], object], repeats: int) -> float:
    """Return the shortest time of a few runs; the first, which may compile, does not count."""
    work()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    many, few, repeats = (200, 4, 1) if smoke else (10_000, 100, 5)

    rng = np.random.default_rng(SEED)
    psi, chi = rng.uniform(0.0, 6.0, many), rng.uniform(1.1, 1.8, many)
    cases = list(zip(psi[:few], chi[:few], strict=True))
    truth = carom.rebound(psi[:few], chi[:few])

    exact = seconds(lambda: carom.rebound(psi, chi, threads=1), repeats) / many
    print(f"exact, psi in [0, 6], chi in [1.1, 1.8]   {exact * 1e6:8.1f} us per impact")
    for springs, steps in (FINE, COARSE):

        def marched(springs: int = springs, steps: int = steps) -> list[float]:
            return [march(p, c, springs, steps) for p, c in cases]

        each = seconds(marched, repeats) / few
        error = np.abs(np.array(marched()) - truth)
        print(
            f"marching, {springs} springs, {steps:4d} steps       {each * 1e6:8.1f} us per impact,"
            f" {each / exact:5.1f} times the exact; error {np.median(error):.0e},"
            f" at most {error.max():.0e}"
        )
    cores = seconds(lambda: carom.rebound(psi, chi), repeats) / many
    print(f"exact on all cores                        {cores * 1e6:8.1f} us per impact")


if __name__ == "__main__":
    main()
