"""Time of impacts, load paths and fields, in one run on one core where not said; prints ratios.

python benchmarks/run.py            a few seconds
python benchmarks/run.py --smoke    a quick pass through the same code
"""

import argparse
import time
from collections.abc import Callable
from functools import partial

import numpy as np

import carom
from carom.dimensionless.lossy.layout import PSI_OUT
from carom.dimensionless.lossy.springs.march import marched
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia

SEED = 20261121
FINE, COARSE = 500, 125  # springs


def seconds(work: Callable[[], object], repeats: int) -> float:
    """Return the shortest time of a few runs; the first, which may compile, does not count."""
    work()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def measure_impacts(many: int, few: int, repeats: int) -> float:
    """Print the time per impact of the exact solver and of its twin; return the exact one."""
    rng = np.random.default_rng(SEED)
    psi, chi = rng.uniform(0.0, 6.0, many), rng.uniform(1.1, 1.8, many)
    cases = list(zip(psi[:few], chi[:few], strict=True))
    truth = carom.rebound(psi[:few], chi[:few])

    exact = seconds(lambda: carom.rebound(psi, chi, threads=1), repeats) / many
    print(f"exact, psi in [0, 6], chi in [1.1, 1.8]   {exact * 1e6:8.1f} us per impact")
    for springs in (FINE, COARSE):

        def by_springs(springs: int = springs) -> list[float]:
            return [marched(p, Inertia(c), ELASTIC, springs)[PSI_OUT] for p, c in cases]

        each = seconds(by_springs, repeats) / few
        error = np.abs(np.array(by_springs()) - truth)
        print(
            f"marching, {springs} springs                   {each * 1e6:8.1f} us per impact,"
            f" {each / exact:5.1f} times the exact; error {np.median(error):.0e},"
            f" at most {error.max():.0e}"
        )
    cores = seconds(lambda: carom.rebound(psi, chi), repeats) / many
    print(f"exact on all cores                        {cores * 1e6:8.1f} us per impact")
    law = carom.KelvinVoigt(restitution=0.9)
    lossy = partial(carom.rebound, psi[:few], chi[:few], threads=1, losses=law)
    each = seconds(lossy, repeats) / few
    print(
        f"with losses, e = 0.9                      {each * 1e6:8.1f} us per impact,"
        f" {each / exact:5.1f} times the exact"
    )
    return exact


def measure_paths(pair: carom.Pair, many: int, repeats: int) -> None:
    """Print the time per random step of a load path, and how it grows with their number."""
    rng = np.random.default_rng(SEED)
    normal = rng.uniform(1.0, 10.0, many)
    tangential = pair.friction * normal * rng.uniform(-1.0, 1.0, many)
    few = many // 100

    def followed(n: int) -> carom.results.LoadPath:
        return carom.load_path(pair, normal_force=normal[:n], tangential_force=tangential[:n])

    whole = followed(many)

    def moved(n: int) -> carom.results.LoadPath:
        path = {"penetration": whole.penetration[:n], "displacement": whole.displacement[:n]}
        return carom.load_path(pair, **path)

    for name, run in (("forces", followed), ("displacements", moved)):
        total = seconds(partial(run, many), repeats)
        growth = total / many / (seconds(partial(run, few), repeats) / few)
        print(
            f"load path by {name:13s}                {total / many * 1e6:8.2f} us per step,"
            f" {total:.2f} s for {many:.0e}; {growth:.2f} times that of {few:.0e}"
        )


def measure_fields(hit: carom.results.Impact, exact: float, repeats: int) -> None:
    """Print the time of the fields and stresses of one instant on their own grids."""
    time = 0.6 * hit.duration
    for name, work in (("fields, 101 x 101", hit.fields), ("stress, 101 x 61", hit.stress)):
        each = seconds(partial(work, time), repeats)
        print(f"{name:18s} {each * 1e3:31.1f} ms, {each / exact:5.0f} times an exact impact")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    many, few, repeats = (200, 4, 1) if smoke else (10_000, 100, 5)
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    exact = measure_impacts(many, few, repeats)
    measure_paths(pair, 2_000 if smoke else 1_000_000, repeats)
    measure_fields(carom.impact(pair, speed=2.0, angle="30 deg"), exact, repeats)


if __name__ == "__main__":
    main()
