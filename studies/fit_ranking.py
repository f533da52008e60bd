"""Does one bad value change which law of rebound comes first? fit_ranking.csv.

python studies/fit_ranking.py               200 sets, some minutes
python studies/fit_ranking.py --sets 20     a quick look, nothing is stored

Twelve rebounds of a sphere by the exact law, with Gaussian noise so large that laws are not always
told apart. In each set one value is then made bad: a spin or an angle mistyped, a value 6 to 40
standard deviations off.
"""

import argparse
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

import carom
from carom.fitting import Fit, fit

TABLE = Path(__file__).with_name("fit_ranking.csv")
SEED, SETS = 20261123, 200
CLEAR = 2.0  # of AICc between the first two laws
BALL = carom.Sphere(radius="2.5 mm", material="steel")
FLOOR = carom.HalfSpace(material="steel")
SIGMA = {"rebound_angle": 0.02, "spin_out": 25.0, "normal_restitution": 0.02}


def clean(random: np.random.Generator) -> dict[str, Any]:
    """Return twelve rebounds, friction and restitution drawn anew."""
    pair = carom.Pair(BALL, FLOOR, friction=random.uniform(0.08, 0.3))
    losses = carom.KelvinVoigt(restitution=random.uniform(0.6, 0.98))
    angles = np.radians(np.linspace(4.0, 65.0, 12))
    hits = [carom.impact(pair, speed=3.9, angle=angle, losses=losses) for angle in angles]
    size = random.uniform(0.1, 2.0)
    data: dict[str, Any] = {"speed": np.full(12, 3.9), "angle": angles}
    for name, sigma in SIGMA.items():
        values = np.array([getattr(hit, name) for hit in hits])
        data[name] = values + size * sigma * random.normal(size=12)
    return data | {"size": size}


def spoilt(data: dict[str, Any], size: float, random: np.random.Generator) -> dict[str, Any]:
    """Return the data with one bad value."""
    name = random.choice(list(SIGMA))
    values, row = data[name].copy(), random.integers(12)
    if name == "spin_out" and random.random() < 0.5:
        values[row] *= random.choice([10.0, 0.1, -1.0])
    else:
        values[row] += random.choice([-1.0, 1.0]) * random.uniform(6.0, 40.0) * size * SIGMA[name]
    if name == "normal_restitution":
        values[row] = abs(values[row]) % 1.4
    if name == "rebound_angle":
        values[row] = np.clip(values[row], -1.5, 1.5)
    return {**data, name: values}


def ranked(found: Fit) -> tuple[str, float]:
    """Return the first law, and by how much of AICc it is ahead."""
    first, second, *_ = sorted(found.comparison, key=lambda each: each.excess)
    return first.law, second.excess


def compared(seed: int) -> tuple[str, float, str, float]:
    """Return the first law and its lead, of clean data and with one bad value."""
    random = np.random.default_rng([SEED, seed])
    data = clean(random)
    size = data.pop("size")
    pair = carom.Pair(BALL, FLOOR, friction=0.3)
    before = ranked(fit(data, pair=pair))
    after = ranked(fit(spoilt(data, size, random), pair=pair))
    return *before, *after


def main() -> None:
    """Fill the table, or print a quick look."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=SETS, help="that are clear while clean")
    sets = parser.parse_args().sets
    lines = [
        "# the first law and its lead in AICc, of clean data and with one bad value in 12 rows;",
        "# made by studies/fit_ranking.py; sets whose clean lead is above 2",
        "set,first,lead,first with a bad value,lead with it",
    ]
    changed: Counter[str] = Counter()
    with ProcessPoolExecutor() as pool:
        for seed, (law, lead, spoilt_law, spoilt_lead) in enumerate(
            pool.map(compared, range(4 * sets), chunksize=5)
        ):
            if lead > CLEAR and len(lines) < sets + 3:
                lines.append(f"{seed},{law},{lead:.1f},{spoilt_law},{spoilt_lead:.1f}")
                changed[f"{law} -> {spoilt_law}"] += 1
    print(len(lines) - 3, "sets:", dict(changed))
    if sets >= SETS:
        TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
