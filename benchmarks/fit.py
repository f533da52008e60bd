"""What a fit costs, intervals and comparison included, beside solving for its rows once.

python benchmarks/fit.py            10 to 1000 rows
python benchmarks/fit.py --smoke    a quick pass through the same code
"""

import argparse
import time
from collections.abc import Callable

import numpy as np

import carom
from carom.lab.fitting import fit

SEED = 20261121
BALL = carom.Sphere(radius="2.5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.12)
NAMES = ("friction", "kappa", "restitution", "spin_offset")
SIGMA = {"tangential_restitution": 0.01, "spin_out": 8.0, "normal_restitution": 0.01}
LOSS = 0.05  # 1 - e of the truth


def measured(rows: int) -> dict[str, np.ndarray]:
    """Return synthetic data: three responses a row, errors to be taken from the scatter."""
    random = np.random.default_rng(SEED)
    angles = np.radians(np.linspace(3.0, 70.0, rows))
    law = carom.KelvinVoigt(restitution=1.0 - LOSS)
    hits = [carom.impact(PAIR, speed=3.9, angle=float(angle), losses=law) for angle in angles]
    exact = {name: np.array([getattr(hit, name) for hit in hits]) for name in SIGMA}
    noisy = {n: values + random.normal(0.0, SIGMA[n], rows) for n, values in exact.items()}
    return {"angle": angles, "speed": np.full(rows, 3.9), **noisy}


def best_of(repeats: int, work: Callable[[], object]) -> float:
    """Return the shortest time of a few runs, in s."""
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
    repeats = 1 if smoke else 5
    law = carom.KelvinVoigt(restitution=1.0 - LOSS)
    for rows in (10,) if smoke else (10, 100, 1000):
        data = measured(rows)
        psi = PAIR.kappa / PAIR.friction * np.tan(data["angle"])
        fit(data, pair=PAIR, vary=NAMES)  # compiles
        whole = best_of(repeats, lambda data=data: fit(data, pair=PAIR, vary=NAMES))
        found = fit(data, pair=PAIR, vary=NAMES)
        rivals = best_of(1, lambda found=found: found.comparison)
        solving = best_of(repeats, lambda psi=psi: carom.rebound(psi, PAIR.chi, losses=law))
        print(
            f"{rows:5d} rows, {len(NAMES)} parameters: {whole:6.3f} s with intervals,"
            f" {rivals:6.3f} s more for two rival laws;"
            f" {whole / solving:6.1f} times solving for the rows once"
        )


if __name__ == "__main__":
    main()
