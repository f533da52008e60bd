"""How long a point of a map of strength takes, each ratio of times taken in one run.

python benchmarks/strength.py            about half a minute
python benchmarks/strength.py --smoke    a quick pass through the same code
"""

import argparse
import time
from collections.abc import Sequence

import numpy as np

import carom
from carom.dimensionless.numerics.threads import available_cores

SEED = 20261124
LIMIT = 20.0  # ms a point, which nine of ten should keep


def pairs() -> dict[str, carom.Pair]:
    """Return bodies whose yield is asked for, whose cracks are, and of which both are."""
    steel = carom.Sphere(radius="5 mm", material="bearing steel")
    glass = carom.material("float glass", flaw_size="20 um")
    blank = carom.Material(young="203 GPa", poisson=0.295, density=7810)
    ball = carom.Sphere(radius="5 mm", material=blank)
    return {
        "yield of both bodies": carom.Pair(steel, carom.HalfSpace(material="bearing steel"), 0.2),
        "cracks of the plate": carom.Pair(ball, carom.HalfSpace(material=glass), 0.2),
        "yield and cracks": carom.Pair(steel, carom.HalfSpace(material=glass), 0.2),
    }


def points(rng: np.random.Generator, count: int) -> Sequence[tuple[float, float]]:
    """Return angles in rad and coefficients of friction."""
    return list(zip(rng.uniform(0.0, 1.48, count), rng.uniform(0.05, 0.6, count), strict=True))


def seconds_of_points(pair: carom.Pair, drawn: Sequence[tuple[float, float]]) -> list[float]:
    """Return how long each point takes, alone."""
    times = []
    for angle, friction in drawn:
        start = time.perf_counter()
        carom.bearable_speeds(pair, angle=[angle], friction=[friction], workers=1, progress=False)
        times.append(time.perf_counter() - start)
    return times


def measure_map(pair: carom.Pair, side: int) -> None:
    """Print the time per point of a map, on one core and on all."""
    axes = {"angle": np.linspace(0.0, 1.45, side), "friction": np.linspace(0.05, 0.6, side)}
    times = []
    for workers in (1, available_cores()):
        start = time.perf_counter()
        carom.bearable_speeds(pair, **axes, workers=workers, progress=False)
        times.append((time.perf_counter() - start) / side**2)
    print(
        f"a map of {side} by {side}: {1e3 * times[0]:.1f} ms a point on one core, "
        f"{times[0] / times[1]:.2f} times as fast on {available_cores()}; "
        f"10,000 points take {1e4 * times[1] / 60.0:.1f} minutes"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--smoke", action="store_true")
    count, side = (5, 3) if parser.parse_args().smoke else (200, 20)
    rng = np.random.default_rng(SEED)
    for name, pair in pairs().items():
        drawn = points(rng, count)
        seconds_of_points(pair, drawn[:2])
        times = 1e3 * np.array(seconds_of_points(pair, drawn))
        print(
            f"{name:22s} median {np.median(times):5.1f} ms, nine of ten below "
            f"{np.quantile(times, 0.9):5.1f} ms, longest {times.max():5.1f} ms; "
            f"{np.mean(times <= LIMIT):.0%} within {LIMIT:g} ms"
        )
        measure_map(pair, side)


if __name__ == "__main__":
    main()
