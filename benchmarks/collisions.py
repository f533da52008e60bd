"""Time of collisions beside a triad's over the same bytes, in one run on all cores; prints ratios.

python benchmarks/collisions.py            half a minute
python benchmarks/collisions.py --smoke    a quick pass through the same code
"""

import argparse
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import cycle

import numba
import numpy as np

import carom
from carom.dimensionless.numerics.threads import available_cores

SEED = 20261121
CHIS = (0.3, 1.0, 1.44, 2.0, 3.0)
BYTES = 27 * 8 + 1  # read five vectors, write four and a status


@numba.njit(nogil=True)
def triad(a, b, c, factor):
    """McCalpin's STREAM triad."""
    for i in range(a.size):
        a[i] = b[i] + factor * c[i]


def alternately(works: list[Callable[[], object]], repeats: int) -> list[float]:
    """Return the median time of each of some works, run in turn; the first run does not count."""
    times: list[list[float]] = [[] for _ in works]
    for _ in range(repeats + 1):
        for work, found in zip(works, times, strict=True):
            start = time.perf_counter()
            work()
            found.append(time.perf_counter() - start)
    return [float(np.median(found[1:])) for found in times]


def threaded_triad(size: int) -> Callable[[], object]:
    """Return a triad over arrays of this size, in threads over blocks as collisions are."""
    a, b, c = (np.ones(size) for _ in range(3))
    pool, block = ThreadPoolExecutor(available_cores()), 1 << 18

    def part(low: int) -> None:
        some = slice(low, low + block)
        triad(a[some], b[some], c[some], 2.0)

    return lambda: list(pool.map(part, range(0, size, block)))


def measure_collisions(pairs: int, repeats: int) -> None:
    """Print the time per collision of every law against the triad's, and in how much memory."""
    rng = np.random.default_rng(SEED)
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, ball, friction=0.2)
    normal = rng.normal(size=(pairs, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, np.newaxis]
    speeds = {
        "velocity1": rng.normal(size=(pairs, 3)),
        "spin1": rng.normal(size=(pairs, 3)) / ball.radius,
        "velocity2": rng.normal(size=(pairs, 3)),
        "spin2": rng.normal(size=(pairs, 3)) / ball.radius,
    }
    walton = carom.laws.WaltonLaw(friction=0.2, tangential_restitution=0.4)
    laws = {
        "exact": None,
        "smooth": carom.laws.SmoothLaw(),
        "rough": carom.laws.RoughLaw(),
        "Walton": walton,
    }

    sides = cycle((normal, -normal))  # after a collision in place the next is on the other side

    def collided(law: object, inplace: bool) -> Callable[[], object]:
        return lambda: carom.collide(
            pair, **speeds, normal=next(sides) if inplace else normal, law=law, inplace=inplace
        )

    cases = [(name, inplace) for name in laws for inplace in (True, False)]
    works = [collided(laws[name], inplace) for name, inplace in cases]
    reference, *times = alternately([threaded_triad(pairs * BYTES // 24), *works], repeats)
    rate = pairs * BYTES / reference / 1e9
    print(
        f"triad over the bytes of a collision   {reference / pairs * 1e9:6.1f} ns, {rate:.1f} GB/s"
    )
    for (name, inplace), each in zip(cases, times, strict=True):
        where = "in place  " if inplace else "new arrays"
        print(
            f"collide, {name:7s} {where}           {each / pairs * 1e9:6.1f} ns, "
            f"{each / reference:5.2f} times the triad, {reference / each:.2f} of its bandwidth"
        )


def measure_laws(repeats: int) -> None:
    """Print the time to build a law and its size."""
    for chi in CHIS:
        (each,) = alternately([lambda chi=chi: carom.laws.ReboundLaw(chi)], repeats)
        size = carom.laws.ReboundLaw(chi).nbytes
        print(f"ReboundLaw({chi:<4g})                      {each * 1e3:6.1f} ms, {size} bytes")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    measure_collisions(10_000 if smoke else 4_000_000, 1 if smoke else 9)
    measure_laws(1 if smoke else 5)


if __name__ == "__main__":
    main()
