"""How often do the intervals of `carom.fit` hold the truth? On synthetic data: fit_coverage.csv.

python studies/fit_coverage.py              500 sets of each design, some minutes
python studies/fit_coverage.py --sets 40    a quick look, nothing is stored

Truth is made by `carom.impact`, not by the curves that are fitted; all noise is Gaussian but for
the design with outliers. A coverage of 95 % in 500 sets is known to 1 %.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.progress import track

import carom
from carom.fitting import fit

TABLE = Path(__file__).with_name("fit_coverage.csv")
SEED = 20261121
SPEED, SPIN = 3.9, 15.0  # m/s; rad/s that nobody meant
BALL = carom.Sphere(radius="2.5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.12)
START = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.3)
TRUTH = {"friction": PAIR.friction, "kappa": PAIR.kappa, "spin_offset": SPIN}
SIGMA = {"tangential_restitution": 0.01, "spin_out": 8.0, "rebound_angle": 0.006}
SIGMA_ANGLE = 0.006  # rad

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Design:
    """Incidences in degrees, which errors there are and which are told, part of outliers."""

    name: str
    angles: tuple[float, ...]
    told: bool
    angle_errors: bool = False
    outliers: float = 0.0
    restitution: float = 0.95

    @property
    def truth(self) -> dict[str, float]:
        """The parameters that are to be found."""
        return TRUTH | {"restitution": self.restitution}


DESIGNS = (
    Design("15 rows, errors known", tuple(np.linspace(4.0, 65.0, 15)), told=True),
    Design("15 rows, errors from the scatter", tuple(np.linspace(4.0, 65.0, 15)), told=False),
    Design("15 rows, angles uncertain", tuple(np.linspace(4.0, 65.0, 15)), True, True),
    Design("40 rows, 5 % outliers", tuple(np.linspace(4.0, 65.0, 40)), False, False, 0.05),
    *(
        Design(f"15 rows, e = {e:g}", tuple(np.linspace(4.0, 65.0, 15)), True, restitution=e)
        for e in (0.3, 0.5, 0.7)
    ),
)


def truth(design: Design) -> dict[str, Array]:
    """Return what would be measured without noise."""
    losses = carom.KelvinVoigt(restitution=design.restitution)
    hits = [
        carom.impact(PAIR, speed=SPEED, angle=f"{angle} deg", spin=SPIN, losses=losses)
        for angle in design.angles
    ]
    return {name: np.array([getattr(hit, name) for hit in hits]) for name in SIGMA}


def measured(design: Design, exact: dict[str, Array], seed: int) -> dict[str, Any]:
    """Return one set of measured rebounds."""
    random = np.random.default_rng([SEED, seed])
    rows = len(design.angles)
    data: dict[str, Any] = {"speed": np.full(rows, SPEED), "angle": np.radians(design.angles)}
    if design.angle_errors:
        data["angle"] = data["angle"] + random.normal(0.0, SIGMA_ANGLE, rows)
        data["angle_error"] = np.full(rows, SIGMA_ANGLE)
    for name, sigma in SIGMA.items():
        far = 8.0 * (random.random(rows) < design.outliers) * random.choice([-1.0, 1.0], rows)
        data[name] = exact[name] + sigma * (random.normal(size=rows) + far)
        if design.told:
            data[f"{name}_error"] = np.full(rows, sigma)
    data["normal_restitution"] = design.restitution + random.normal(0.0, 0.01, rows)
    if design.told:
        data["normal_restitution_error"] = np.full(rows, 0.01)
    return data


def rows_of(design: Design, sets: int) -> Iterator[str]:
    """Yield a line of the table for each parameter of a design."""
    exact = truth(design)
    intervals = []
    for seed in track(range(sets), design.name, transient=True):
        found = fit(measured(design, exact, seed), pair=START, vary=list(design.truth))
        intervals.append([(found[name].low, found[name].high) for name in design.truth])
    ends = np.array(intervals)
    for place, (name, value) in enumerate(design.truth.items()):
        low, high = ends[:, place].T
        below, above = int((high < value).sum()), int((low > value).sum())
        inside = 100.0 * float(((low <= value) & (value <= high)).mean())
        width = float(np.median(high - low))
        yield f"{design.name},{name},{value:.6g},{sets},{inside:.1f},{below},{above},{width:.3g}"


def main() -> None:
    """Fill the table, or print a quick look."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=500, help="of each design")
    sets = parser.parse_args().sets
    lines = [
        "# how often 95 % intervals of carom.fit hold the truth; made by studies/fit_coverage.py",
        "# below, above: sets whose interval lies below, above the truth; width: the median, SI",
        "design,parameter,truth,sets,coverage [%],below,above,width",
    ]
    for design in DESIGNS:
        for line in rows_of(design, sets):
            print(line, flush=True)
            lines.append(line)
    if sets >= 500:
        TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
