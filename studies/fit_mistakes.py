"""What does `carom.fit` say of tables with a usual mistake, and does it cry wolf? fit_mistakes.csv.

python studies/fit_mistakes.py               20 sets of each mistake, 500 clean ones, some minutes
python studies/fit_mistakes.py --sets 5      a quick look, nothing is stored
"""

import argparse
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import carom
from carom.fitting import fit

TABLE = Path(__file__).with_name("fit_mistakes.csv")
SEED, SETS, CLEAN = 20261123, 20, 500
SIGMA = {"rebound_angle": 0.006, "spin_out": 8.0, "normal_restitution": 0.01}
SPEEDS = {"normal_speed_out": 0.04, "tangential_speed_out": 0.04, "spin_out": 8.0}
RPM = np.pi / 30.0

Data = dict[str, Any]


def rebounds(random: np.random.Generator, sigma: dict[str, float], radius: float = 2.5e-3) -> Data:
    """Return 12 rebounds with noise; materials, friction and restitution drawn anew."""
    pair = bodies(radius, random.uniform(0.08, 0.3))
    losses = carom.KelvinVoigt(restitution=random.uniform(0.7, 0.98))
    angles, speed = np.radians(np.linspace(5.0, 65.0, 12)), 3.9
    hits = [carom.impact(pair, speed=speed, angle=angle, losses=losses) for angle in angles]
    data: Data = {"angle": angles, "speed": np.full(12, speed)}
    for name, size in sigma.items():
        data[name] = np.array([getattr(h, name) for h in hits]) + size * random.normal(size=12)
    return data


def bodies(radius: float, friction: float = 0.3) -> carom.Pair:
    """Return a steel ball on steel."""
    ball = carom.Sphere(radius=radius, material="steel")
    return carom.Pair(ball, carom.HalfSpace(material="steel"), friction=friction)


def components(data: Data) -> Data:
    """Return speeds by component instead of angle and speed."""
    angle, speed = data.pop("angle"), data.pop("speed")
    return {"normal_speed": speed * np.cos(angle), "tangential_speed": speed * np.sin(angle)} | data


def from_surface(data: Data) -> Data:
    """Angles from the surface instead of the normal."""
    turned = {name: np.pi / 2.0 - data[name] for name in ("angle", "rebound_angle")}
    return data | turned | {"rebound_angle": np.clip(turned["rebound_angle"], -1.5, 1.5)}


def in_radians(data: Data) -> Data:
    """Radians under a head in degrees."""
    angles = {f"{name} [deg]": data.pop(name) for name in ("angle", "rebound_angle")}
    return data | angles


def exchanged(data: Data) -> Data:
    """Motion after where that before belongs, and the other way round."""
    data = components(data)
    before, after = (
        ("normal_speed", "tangential_speed"),
        ("normal_speed_out", "tangential_speed_out"),
    )
    return data | {a: data[b] for a, b in zip((*before, *after), (*after, *before), strict=True)}


def of_centre(data: Data) -> Data:
    """The tangential restitution of the centre as that of the contact point."""
    return data | {"contact_restitution": data.pop("tangential_restitution")}


def spins(factor: float, data: Data) -> Data:
    """Spins by a factor."""
    return data | {"spin_out": factor * data["spin_out"]}


def same(data: Data) -> Data:
    """As it is."""
    return data


CENTRE = {"tangential_restitution": 0.01, "spin_out": 8.0, "normal_restitution": 0.01}
MISTAKES: dict[str, tuple[Callable[[Data], Data], dict[str, float], float, str]] = {
    "clean": (same, SIGMA, 2.5e-3, ""),
    "angles from the surface": (from_surface, SIGMA, 2.5e-3, "angles from the surface"),
    "radians under degrees": (in_radians, SIGMA, 2.5e-3, "angles in radians"),
    "spin reversed": (partial(spins, -1.0), SIGMA, 2.5e-3, "other sign"),
    "spin in rpm": (partial(spins, 1.0 / RPM), SIGMA, 2.5e-3, "spins in rpm"),
    "diameter as radius": (same, SIGMA, 5e-3, "half the radius"),
    "radius halved": (same, SIGMA, 1.25e-3, "twice the radius"),
    "after as before": (exchanged, SPEEDS, 2.5e-3, "before and the motion after exchanged"),
    "centre as contact point": (of_centre, CENTRE, 2.5e-3, "in the column contact_restitution"),
}


def said(mistake: str, told: bool, seed: int) -> str:
    """Return what the fit says of one set."""
    change, sigma, radius, _ = MISTAKES[mistake]
    random = np.random.default_rng([SEED, list(MISTAKES).index(mistake), told, seed])
    data = rebounds(random, sigma)
    if told and mistake not in ("after as before", "radians under degrees"):
        data |= {f"{name}_error": np.full(12, size) for name, size in sigma.items()}
    if told and mistake == "centre as contact point":
        data["contact_restitution_error"] = data.pop("tangential_restitution_error")
    try:
        found = fit(change(data), pair=bodies(radius))
    except carom.InputError as error:
        return f"refused: {error}"
    return next((note for note in found.notes if note.startswith("these data fit as")), "")


def main() -> None:
    """Fill the table, or print a quick look."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=SETS, help="of each mistake")
    sets = parser.parse_args().sets
    lines = [
        "# what carom.fit says of tables with a usual mistake; made by studies/fit_mistakes.py",
        "# right, wrong: sets in which it names this mistake, another one; refused: not fitted",
        "mistake,errors,sets,right,wrong,refused,for example",
    ]
    with ProcessPoolExecutor() as pool:
        for mistake, (*_, words) in MISTAKES.items():
            count = CLEAN * sets // SETS if mistake == "clean" else sets
            for told in (False, True):
                found = list(pool.map(partial(said, mistake, told), range(count), chunksize=5))
                refused = [each for each in found if each.startswith("refused")]
                right = [each for each in found if words and words in each]
                wrong = sum(bool(each) for each in found) - len(refused) - len(right)
                example = next(iter(right or refused), "").replace('"', "'")
                errors = "stated" if told else "not stated"
                lines.append(
                    f'{mistake},{errors},{count},{len(right)},{wrong},{len(refused)},"{example}"'
                )
                print(lines[-1], flush=True)
    if sets >= SETS:
        TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
