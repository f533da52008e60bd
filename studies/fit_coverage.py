"""How often do the intervals of `carom.fit` hold the truth? On synthetic data: fit_coverage.csv.

python studies/fit_coverage.py                  500 sets of each design, on all cores, ten minutes
python studies/fit_coverage.py --only "bad value" --sets 200 --store    some of them, stored
python studies/fit_coverage.py --sets 40        a quick look, nothing is stored

Truth is made by `carom.impact`, not by the curves that are fitted. A coverage of 95 % is known to
1.5 % in 200 sets, to 1 % in 500.
"""

import argparse
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.progress import track

import carom
from carom.lab.fitting import fit

TABLE = Path(__file__).with_name("fit_coverage.csv")
SEED, SETS = 20261123, 500
SPEED, SPIN = 3.9, 15.0  # m/s; rad/s that nobody meant
BALL = carom.Sphere(radius="2.5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.12)
START = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.3)
SIGMA = {
    "rebound_angle": 0.006,
    "spin_out": 8.0,
    "normal_restitution": 0.01,
    "normal_speed_out": 0.04,
    "tangential_speed_out": 0.04,
}
RELATIVE = ("normal_restitution", "tangential_restitution")  # with noise of a share of the value
MEASURED = ("rebound_angle", "spin_out", "normal_restitution")
PICTURES = (*RELATIVE, "rebound_angle")
SPEEDS = ("normal_speed_out", "tangential_speed_out", "spin_out")
SIGMA_ANGLE, SHARE = 0.006, 0.03  # rad; of a value, where the noise is proportional to it
HALF_DEGREE, STEEPEST = np.radians(0.5), np.radians(89.0)
BAD = 0.35  # of a value that is wrong
UNSEEN = 1000  # sets with pictures begin here: by some of those before, the fit was chosen
AWAY = 2.0  # times the truth, or a part of it

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Design:
    """What is measured how often, and its noise; `outliers` from so many sigma to so many.

    `bad` values are 35 % off, whichever they are.
    """

    name: str
    rows: int = 12
    told: bool = False
    restitution: float = 0.95
    measured: tuple[str, ...] = MEASURED
    noise: str = "normal"  # or "student", of 4 degrees, "proportional", or that of "pictures"
    outliers: tuple[float, float] | None = None
    angle_errors: bool = False
    spin: float = 0.0
    speeds: tuple[float, float] = (SPEED, SPEED)  # from the least to the largest, by equal factors
    degrees: tuple[float, float] = (4.0, 65.0)
    friction: float = 0.12
    bad: int = 0

    @property
    def speed(self) -> Array:
        """The speeds, in no order."""
        return np.random.default_rng(SEED).permutation(np.geomspace(*self.speeds, self.rows))

    @property
    def angles(self) -> Array:
        """The incidences."""
        return np.radians(np.linspace(*self.degrees, self.rows))

    @property
    def truth(self) -> dict[str, float]:
        """The parameters that are to be found."""
        known = {"friction": self.friction, "kappa": PAIR.kappa, "restitution": self.restitution}
        return known | ({"spin_offset": self.spin} if self.spin else {})


FEW = {  # impacts measured by a student
    "9 rows, 20 to 75 degrees": Design("", 9, degrees=(20.0, 75.0), friction=0.14),
    "the same, errors stated": Design("", 9, told=True, degrees=(20.0, 75.0), friction=0.14),
    "9 rows, friction 0.3": Design("", 9, degrees=(20.0, 75.0), friction=0.3),
    "9 rows, e = 0.7": Design("", 9, restitution=0.7, degrees=(20.0, 75.0), friction=0.14),
    "12 rows, 5 to 65 degrees": Design("", degrees=(5.0, 65.0), friction=0.14),
    "15 rows": Design("", 15, degrees=(10.0, 75.0), friction=0.2),
}
PICTURED = tuple(
    replace(design, name=f"{name}, {end}", measured=PICTURES, noise="pictures", bad=bad)
    for name, design in FEW.items()
    for bad, end in enumerate(("pictures, clean", "pictures, a bad value"))
)
DESIGNS = (
    *(Design(f"12 rows, e = {e:g}", restitution=e) for e in (0.95, 0.7, 0.5)),
    Design("4 % outliers, 8 sigma, errors stated", told=True, outliers=(8.0, 8.0)),
    Design("4 % outliers, 8 to 25 sigma, errors stated", told=True, outliers=(8.0, 25.0)),
    Design("Student's t of 4 degrees", noise="student"),
    *(
        Design(
            f"proportional noise, errors {'' if told else 'not '}stated",
            told=told,
            noise="proportional",
            measured=SPEEDS,
            speeds=(0.5, 8.0),
        )
        for told in (False, True)
    ),
    *(Design(f"{rows} rows", rows) for rows in (5, 8, 30)),
    Design("angles alone", measured=("rebound_angle",)),
    Design("4 % outliers, 8 to 25 sigma", outliers=(8.0, 25.0)),
    Design("Student's t, errors stated", told=True, noise="student"),
    Design("errors stated", told=True),
    Design("angles uncertain, errors stated", told=True, angle_errors=True),
    Design("a spin that nobody meant", spin=SPIN),
    *PICTURED,
)


@cache
def exact(design: Design) -> dict[str, Array]:
    """Return what would be measured without noise."""
    losses = carom.KelvinVoigt(restitution=design.restitution)  # at any speed
    pair = carom.Pair(BALL, PAIR.second, friction=design.friction)
    hits = [
        carom.impact(pair, speed=speed, angle=angle, spin=design.spin, losses=losses)
        for speed, angle in zip(design.speed, design.angles, strict=True)
    ]
    return {name: np.array([getattr(hit, name) for hit in hits]) for name in design.measured}


def noise(design: Design, random: np.random.Generator) -> Array:
    """Return errors in standard deviations, one a row."""
    if design.noise == "student":
        return random.standard_t(4, design.rows) / np.sqrt(2.0)
    found = random.normal(size=design.rows)
    if design.outliers:
        far = random.uniform(*design.outliers, design.rows) * random.choice(
            [-1.0, 1.0], design.rows
        )
        found = np.where(random.random(design.rows) < 0.04, far, found)
    return found


def deviation(design: Design, name: str, values: Array) -> Array:
    """Return the standard deviations of a column."""
    if design.noise == "pictures" and name not in RELATIVE:
        return np.full(design.rows, HALF_DEGREE)
    if design.noise in ("pictures", "proportional"):
        return np.asarray(SHARE * np.abs(values))
    return np.full(design.rows, SIGMA[name])


def measured(design: Design, seed: int) -> dict[str, Any]:
    """Return one set of measured rebounds."""
    random = np.random.default_rng([SEED, DESIGNS.index(design), seed])
    data: dict[str, Any] = {"speed": design.speed, "angle": design.angles}
    if design.angle_errors:
        data["angle"] = data["angle"] + random.normal(0.0, SIGMA_ANGLE, design.rows)
        data["angle_error"] = np.full(design.rows, SIGMA_ANGLE)
    for name, values in exact(design).items():
        sigma = deviation(design, name, values)
        data[name] = values + sigma * noise(design, random)
        if design.told:
            data[f"{name}_error"] = sigma
    for _ in range(design.bad):
        name, row = random.choice(design.measured), random.integers(design.rows)
        data[name][row] *= 1.0 + BAD * random.choice([-1.0, 1.0])
    if "rebound_angle" in data:
        data["rebound_angle"] = np.clip(data["rebound_angle"], -STEEPEST, STEEPEST)
    return data


def intervals(design: Design, seed: int) -> list[tuple[float, float, float]]:
    """Return value, low and high of each parameter."""
    found = fit(measured(design, seed), pair=START, vary=list(design.truth))
    each = (found[name] for name in design.truth)
    return [(e.value, *((e.low, e.high) if e.determined else (-np.inf, np.inf))) for e in each]


def rows_of(design: Design, sets: int, pool: ProcessPoolExecutor) -> Iterator[str]:
    """Yield a line of the table for each parameter of a design."""
    first = UNSEEN if design in PICTURED else 0
    results = pool.map(partial(intervals, design), range(first, first + sets), chunksize=10)
    ends = np.array(list(track(results, design.name, sets, transient=True)))
    for place, (name, value) in enumerate(design.truth.items()):
        _, low, high = ends[:, place].T
        below, above = int((high < value).sum()), int((low > value).sum())
        inside = 100.0 * float(((low <= value) & (value <= high)).mean())
        width = float(np.median(high - low))
        off = np.abs(np.log(np.abs(ends[:, place, 0] / value))) > np.log(AWAY)
        numbers = f"{sets},{inside:.1f},{below},{above},{width:.3g},{off.sum()}"
        yield f'"{design.name}",{name},{value:.6g},{numbers}'


def main() -> None:
    """Fill the table, or print a quick look."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=SETS, help="of each design")
    parser.add_argument("--only", default="", help="part of the names of designs")
    parser.add_argument("--store", action="store_true", help="replace these rows of the table")
    parser.add_argument("--workers", type=int, help="processes; by default as many as there are")
    options = parser.parse_args()
    rows: dict[str, list[str]] = {}
    with ProcessPoolExecutor(options.workers) as pool:
        for design in DESIGNS:
            if options.only in design.name:
                rows[design.name] = list(rows_of(design, options.sets, pool))
                print(*rows[design.name], sep="\n", flush=True)
    if options.store:
        store(rows)


def store(rows: dict[str, list[str]]) -> None:
    """Replace the rows of these designs in the table, in the order of the designs."""
    head, kept = [], {}
    for line in TABLE.read_text(encoding="utf-8").splitlines():
        if not line.startswith('"'):
            head.append(line)
        else:
            kept.setdefault(line.split('"')[1], []).append(line)
    whole = kept | rows
    lines = [line for design in DESIGNS for line in whole.get(design.name, [])]
    TABLE.write_text("\n".join([*head, *lines]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
