"""Do the intervals of `carom.fit` hold where rows are not independent? fit_repeats.csv.

python studies/fit_repeats.py              200 to 400 sets of each design, on all cores
python studies/fit_repeats.py --sets 40    a quick look, nothing is stored

Groups: six angles, ten drops each; an angle is set once and off by 0.5 degrees, restitutions
scatter by 3 %, rebound angles by 0.5 degrees, and one of 180 values may be 35 % off. Bounces: six
drops, three bounces each, read to 1 % of a height or to 1 ms of a time, or with exact readings and
restitutions that scatter as much from bounce to bounce.
"""

import argparse
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from fit_coverage import BAD, BALL, HALF_DEGREE, PAIR, PICTURES, SHARE, SPEED, START, STEEPEST
from numpy.typing import NDArray

import carom
from carom.impacts.validity import GRAVITY

TABLE = Path(__file__).with_name("fit_repeats.csv")
SEED = 20261126
DEGREES, TIMES = (10.0, 20.0, 30.0, 40.0, 55.0, 70.0), 10
FRICTION, RESTITUTION = 0.14, 0.95
BOUNCED, DROPS, BOUNCES = 0.9, 6, 3  # restitution, drops, bounces of each
HEIGHT, TIME = 0.01, 1e-3  # of a height; s

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Groups:
    """Ten drops at each of six angles: with their column `group` or without, and `angle_error`."""

    name: str
    group: bool = True
    told: bool = True
    bad: bool = False
    sets: int = 400

    @property
    def truth(self) -> dict[str, float]:
        """The parameters that are to be found."""
        return {"friction": FRICTION, "kappa": PAIR.kappa, "restitution": RESTITUTION}

    def measured(self, random: np.random.Generator) -> dict[str, Any]:
        """Return one set of measured rebounds."""
        set_at, losses = np.radians(DEGREES), carom.KelvinVoigt(restitution=RESTITUTION)
        pair = carom.Pair(BALL, PAIR.second, friction=FRICTION)
        angles = set_at + HALF_DEGREE * random.normal(size=len(set_at))
        hits = [carom.impact(pair, speed=SPEED, angle=angle, losses=losses) for angle in angles]
        count = len(set_at) * TIMES
        data: dict[str, Any] = {"speed": np.full(count, SPEED), "angle": np.repeat(set_at, TIMES)}
        for name in PICTURES:
            values = np.repeat([getattr(hit, name) for hit in hits], TIMES)
            sigma = HALF_DEGREE if "angle" in name else SHARE * np.abs(values)
            data[name] = values + sigma * random.normal(size=count)
        if self.bad:
            name, row = random.choice(PICTURES), random.integers(count)
            data[name][row] *= 1.0 + BAD * random.choice([-1.0, 1.0])
        data["rebound_angle"] = np.clip(data["rebound_angle"], -STEEPEST, STEEPEST)
        if self.told:
            data["angle_error"] = np.full(count, HALF_DEGREE)
        if self.group:
            data["group"] = np.repeat([f"{each:g} degrees" for each in DEGREES], TIMES).tolist()
        return data


@dataclass(frozen=True)
class Drops:
    """Several bounces of each drop; without `readings` the bounces themselves scatter."""

    name: str
    kind: str
    told: bool = False
    readings: bool = True
    sets: int = 300

    @property
    def truth(self) -> dict[str, float]:
        """The parameter that is to be found."""
        return {"restitution": BOUNCED}

    def measured(self, random: np.random.Generator) -> dict[str, Any]:
        """Return one set of heights, intervals or times."""
        ratios = np.full((DROPS, BOUNCES + 1), BOUNCED)
        if not self.readings:
            ratios *= random.normal(1.0, HEIGHT / np.sqrt(2.0), ratios.shape)
        ratios[:, 0] = np.linspace(1.0, 2.0, DROPS)
        speeds = np.cumprod(ratios, axis=1)
        if self.kind == "heights":
            heights = speeds**2 / (2.0 * GRAVITY)
            read = heights * (1.0 + self.readings * HEIGHT * random.normal(size=speeds.shape))
            data = {f"h{i} [m]": column.tolist() for i, column in enumerate(read.T)}
            if self.told:
                data |= {f"h{i}_error [m]": HEIGHT * each for i, each in enumerate(heights.T)}
            return data
        flights = 2.0 * speeds / GRAVITY
        start = np.full((DROPS, 1), 5.0)
        if self.kind == "times":
            flights = np.hstack([start, start + np.cumsum(flights, axis=1)])
        read = flights + self.readings * TIME * random.normal(size=flights.shape)
        if self.kind == "times":
            column = read.ravel().tolist()
        else:  # an empty cell parts two drops
            column = [cell for row in read.tolist() for cell in (*row, "-")]
        data = {f"bounce_{self.kind.removesuffix('s')}": column}
        if self.told:
            data[f"bounce_{self.kind.removesuffix('s')}_error"] = np.full(len(column), TIME)
        return data


ENDS = ("", ", a bad value")
DESIGNS = (
    *(Groups(f"groups{end}", bad=bool(bad)) for bad, end in enumerate(ENDS)),
    *(
        Groups(f"groups without their column{end}", group=False, bad=bool(bad), sets=200)
        for bad, end in enumerate(ENDS)
    ),
    *(
        Groups(f"groups, no error of the angle{end}", told=False, bad=bool(bad))
        for bad, end in enumerate(ENDS)
    ),
    *(
        Drops(f"{kind} of bounces, errors {'' if told else 'not '}stated", kind, told)
        for kind in ("heights", "intervals", "times")
        for told in (False, True)
    ),
    Drops("heights of bounces that scatter, errors not stated", "heights", readings=False),
)


def intervals(design: Groups | Drops, seed: int) -> list[tuple[float, float, float]]:
    """Return value, low and high of each parameter."""
    random = np.random.default_rng([SEED, DESIGNS.index(design), seed])
    found = carom.fit(design.measured(random), pair=START)
    return [(found[name].value, found[name].low, found[name].high) for name in design.truth]


def rows_of(design: Groups | Drops, sets: int, pool: ProcessPoolExecutor) -> Iterator[str]:
    """Yield a line of the table for each parameter of a design."""
    ends = np.array(list(pool.map(partial(intervals, design), range(sets), chunksize=10)))
    for place, (name, value) in enumerate(design.truth.items()):
        found, low, high = ends[:, place].T
        inside = 100.0 * float(((low <= value) & (value <= high)).mean())
        numbers = f"{sets},{inside:.1f},{np.median(high - low):.3g},{found.std():.3g}"
        yield f'"{design.name}",{name},{value:.6g},{numbers}'


def main() -> None:
    """Fill the table, or print a quick look."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, help="of each design; none are stored then")
    parser.add_argument("--workers", type=int, help="processes; by default as many as there are")
    options = parser.parse_args()
    lines = [
        "# how often 95 % intervals of carom.fit hold the truth where rows are not independent",
        "# made by studies/fit_repeats.py; width: the median; deviation: that of the values, SI",
        "design,parameter,truth,sets,coverage [%],width,deviation",
    ]
    with ProcessPoolExecutor(options.workers) as pool:
        for design in DESIGNS:
            rows = list(rows_of(design, options.sets or design.sets, pool))
            print(*rows, sep="\n", flush=True)
            lines += rows
    if options.sets is None:
        TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
