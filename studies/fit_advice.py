"""Is the interval halved after as many further measurements as `Fit.advice` says? fit_advice.csv.

python studies/fit_advice.py               60 sets of each, ten minutes on two cores
python studies/fit_advice.py --sets 5      a quick look, nothing is stored
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

import carom
from carom.fitting import fit

TABLE = Path(__file__).with_name("fit_advice.csv")
SEED, SETS = 20261124, 60
SPEED = 3.9
PAIR = carom.Pair(
    carom.Sphere(radius="2.5 mm", material="steel"), carom.HalfSpace(material="steel"), 0.17
)
LOSSES = carom.KelvinVoigt(restitution=0.95)
SIGMA = {"rebound_angle": 0.006, "spin_out": 8.0, "normal_restitution": 0.01}


def measured(random: np.random.Generator, angles: np.ndarray, told: bool) -> dict[str, np.ndarray]:
    """Return rebounds with noise, and with its size if that is told."""
    hits = [carom.impact(PAIR, speed=SPEED, angle=angle, losses=LOSSES) for angle in angles]
    data = {"angle": angles, "speed": np.full(len(angles), SPEED)}
    for name, sigma in SIGMA.items():
        exact = np.array([getattr(hit, name) for hit in hits])
        data[name] = exact + random.normal(0.0, sigma, len(angles))
        if told:
            data[f"{name}_error"] = np.full(len(angles), sigma)
    return data


def followed(name: str, told: bool, seed: int) -> tuple[int, float, float]:
    """Follow the advice on one set: measurements, their angle in degrees, new width over old."""
    random = np.random.default_rng([SEED, seed, told])
    first = measured(random, np.radians(np.linspace(5.0, 65.0, 12)), told)
    before = fit(first, pair=PAIR)
    best = before.advice(1, name).best
    more = measured(random, np.full(best.needed, best.angle), told)
    after = fit({key: np.concatenate([first[key], more[key]]) for key in first}, pair=PAIR)
    widths = [each[name].high - each[name].low for each in (after, before)]
    return best.needed, float(np.degrees(best.angle)), widths[0] / widths[1]


def main() -> None:
    """Fill the table, or print a quick look."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=SETS, help="of each parameter")
    sets = parser.parse_args().sets
    lines = [
        "# width of the interval after the measurements that Fit.advice asks for to halve it, over",
        "# that before; made by studies/fit_advice.py: 12 rows first, medians of the sets",
        "parameter,errors,sets,measurements,angle [deg],width,width (lower quartile),width (upper)",
    ]
    with ProcessPoolExecutor() as pool:
        for name in ("friction", "kappa", "restitution"):
            for told in (True, False):
                found = np.array(list(pool.map(partial(followed, name, told), range(sets))))
                count, angle, width = np.median(found, axis=0)
                low, high = np.quantile(found[:, 2], (0.25, 0.75))
                errors = "stated" if told else "not stated"
                lines.append(
                    f"{name},{errors},{sets},{count:.0f},{angle:.0f},{width:.3f},{low:.3f},{high:.3f}"
                )
                print(lines[-1], flush=True)
    if sets >= SETS:
        TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
