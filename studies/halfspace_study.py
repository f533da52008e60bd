"""How far is the theory off where slip turns and materials differ? Impacts by boundary elements.

The table is halfspace_study.csv.

python studies/halfspace_study.py              what the table lacks, hours on one core
python studies/halfspace_study.py --workers 2  the same on two
python studies/halfspace_study.py --check      a few rows again, compared with the table
python studies/halfspace_study.py --smoke      three coarse impacts, nothing is stored

Every impact is stored as soon as it is done; a run that was broken off goes on where it stopped.
"""

import argparse
import csv
import multiprocessing
import os
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np
from rich.progress import track

import carom
from carom.halfspace.compliance import Materials
from carom.halfspace.solution import HalfspaceSolution, Resolution, solve
from carom.io.files import replace_whole

TABLE = Path(__file__).with_name("halfspace_study.csv")
HEAD = """\
# oblique impacts of solid spheres on half-spaces by boundary elements; docs/halfspace.md
# made by studies/halfspace_study.py; angles in degrees, duration in that of Hertz, seconds of CPU
# angle: between slip and the direction of motion, averaged over the work of friction; micro_: while
# part of the contact sticks; gross_: while nothing does; _max: the largest, but for the steps in
# which friction does less than a tenth of its work in a mean step; work_across: share of the work;
# slip_across: |slip velocity| across to along, summed over contact and time
"""
GRIDS = {n: Resolution(n, round(4.6875 * n)) for n in (12, 24, 32, 48, 64, 96)}
RATIOS = (0.0, 0.2, 0.3, 0.5)  # Poisson's, of both bodies
STRENGTHS = (  # beta, friction: none, beta/friction = 1 at next to no friction, and many
    (0.0, 1.0),
    (0.02, 0.02),
    *((beta, mu) for beta in (0.05, 0.1, 0.2, 0.3, 0.45) for mu in (0.1, 0.3, 0.6, 1.0)),
)
PAIRS = {  # ball, half-space, friction
    "steel on rubber": ("steel", "rubber", 1.0),  # typical of dry rubber
    "glass on steel": ("soda-lime-glass", "steel", 0.125),  # of glass on aluminium, second hand
    "alumina on glass": ("alumina", "soda-lime-glass", 0.092),  # Kharaz et al. 2001 as modelled
    "POM on steel": ("pom", "steel", 0.2),  # typical, dry
    "steel on concrete": ("steel", "concrete", 0.57),  # second hand
}
SOLID, SHELL = 1.75, 1.25  # chi/kappa of spheres on half-spaces: solid, thin shell
DURATION = 2.94327518432470  # of Hertz's impact, in d_max/V_1


class Impact(NamedTuple):
    """One impact to be computed."""

    label: str  # like, shell, pair, sweep; control: nu = 0, the same chi
    case: str
    kappa: float
    beta: float
    friction: float
    chi: float
    psi_1: float
    elements: int
    steps: int


class Row(NamedTuple):
    """What an impact came to, as in the head of the table."""

    psi_2: float
    restitution: float
    duration: float
    angle: float
    micro_angle: float
    micro_angle_max: float
    gross_angle_max: float
    work_across: float
    slip_across: float
    energy_error: float
    seconds: float


def incidences(chi: float) -> list[float]:
    """Return 12 incidences: 4 that start in stick, 3 up to 2 chi, 4 up to 4 chi - 1, one beyond."""
    width = 2.0 * chi - 1.0
    fractions = np.array([1 / 3, 2 / 3, 1.0, 1.25, 1.5, 1.75, 2.0])
    return [0.2, 0.5, 0.8, 1.0, *np.round(1.0 + width * fractions, 4), round(4.0 * chi + 1.0, 4)]


def shared(poisson: float) -> float:
    """Return kappa of like materials."""
    return 2.0 * (1.0 - poisson) / (2.0 - poisson)


def like(poisson: float, grid: int, per_kappa: float = SOLID) -> Iterator[Impact]:
    """Yield the impacts of like materials, then those of nu = 0 at the same chi."""
    kappa = shared(poisson)
    label = "like" if per_kappa == SOLID else "shell"
    chi, case = round(per_kappa * kappa, 6), f"{'' if label == 'like' else 'shell '}nu {poisson:g}"
    for psi in incidences(chi):
        yield Impact(label, case, kappa, 0.0, 1.0, chi, psi, *GRIDS[grid])
    if poisson:
        for psi in incidences(chi):
            yield Impact("control", case, 1.0, 0.0, 1.0, chi, psi, *GRIDS[grid])


def pairs(names: Iterable[str], grid: int) -> Iterator[Impact]:
    """Yield the impacts of unlike materials, then those of nu = 0 at the same chi."""
    for name in names:
        ball, plane, friction = PAIRS[name]
        pair = carom.Pair(
            carom.Sphere(radius="5 mm", material=ball), carom.HalfSpace(material=plane), friction
        )
        kappa, beta = round(pair.kappa, 6), round(pair.dundurs_beta, 6)
        chi = round(pair.chi, 6)
        for psi in incidences(chi):
            yield Impact("pair", name, kappa, beta, friction, chi, psi, *GRIDS[grid])
            yield Impact("control", name, 1.0, 0.0, 1.0, chi, psi, *GRIDS[grid])


def sweep(grid: int, psis: Iterable[float]) -> Iterator[Impact]:
    """Yield impacts with all strengths of coupling, and with none."""
    kappa, chi = shared(0.3), round(SOLID * shared(0.3), 6)
    for beta, friction in STRENGTHS:
        case = f"beta {beta:g} friction {friction:g}"
        for psi in psis:
            yield Impact("sweep", case, kappa, beta, friction, chi, psi, *GRIDS[grid])


def plan() -> list[Impact]:
    """Return all impacts of the study, the coarse ones first, none twice."""
    every = [impact for ratio in RATIOS for impact in like(ratio, 32)]
    every += [*pairs(PAIRS, 24), *sweep(24, (0.4, 1.0, 1.5, 2.9, 4.2, 6.8))]
    every += [impact for ratio in RATIOS for impact in like(ratio, 48)]
    far = [impact for impact in sweep(32, (12.0,)) if not 0.0 < impact.beta <= impact.friction]
    every += [*_spots(pairs(PAIRS, 32)), *far]
    every += [*like(0.0, 64), *_spots(like(0.5, 64))]
    every += [impact for ratio in (0.3, 0.5) for impact in like(ratio, 32, per_kappa=SHELL)]
    every += [*pairs(PAIRS, 32), *_spots(pairs(PAIRS, 48))]
    every += [*_spots(like(0.0, 96)), *_spots(like(0.5, 96))]
    return list(dict.fromkeys(every))


def _spots(impacts: Iterable[Impact]) -> list[Impact]:
    """Return the impacts of four incidences: 0.2, 1, 2 chi, and above."""
    return [impact for impact in impacts if impact.psi_1 in incidences(impact.chi)[::3]]


def compute(impact: Impact) -> Row:
    """Return what an impact comes to."""
    started = time.process_time()
    materials = Materials(impact.kappa, impact.beta, impact.friction)
    grid = Resolution(impact.elements, impact.steps)
    found = solve(impact.psi_1, impact.chi, materials, grid)
    work = np.maximum(found.column("lost"), 0.0)
    micro = work * (found.column("slip_share") < 1.0)
    return Row(
        found.psi_out,
        found.restitution,
        found.duration / DURATION,
        _angles(found, work)[0],
        *_angles(found, micro),
        _angles(found, work - micro)[1],
        float(found.column("lost_across").sum() / work.sum()),
        _slip_across(found),
        found.energy_error,
        time.process_time() - started,
    )


def _angles(found: HalfspaceSolution, work: np.ndarray) -> tuple[float, float]:
    """Return mean and largest angle of slip in degrees, over the steps with this work."""
    if not work.any():
        return 0.0, 0.0
    mean = np.average(found.column("slip_angle"), weights=work)
    counts = work > 0.1 * work[work > 0.0].mean()
    largest = found.column("slip_angle_max")[counts].max()
    return float(np.degrees(mean)), float(np.degrees(largest))


def _slip_across(found: HalfspaceSolution) -> float:
    speeds = [
        np.abs(kept.slip_velocity[:, kept.step.gripped]).sum(axis=1) for kept in found.snapshots
    ]
    along, across = np.sum(speeds, axis=0)
    return float(across / along)


def computed(impact: Impact) -> tuple[Impact, Row | str]:
    """Return an impact and what it comes to, or why it failed."""
    try:
        return impact, compute(impact)
    except (RuntimeError, FloatingPointError) as failure:
        return impact, str(failure)


def load(table: Path) -> dict[Impact, Row]:
    """Return the stored impacts."""
    if not table.exists():
        return {}
    with table.open(encoding="utf-8", newline="") as stream:
        rows = csv.reader(line for line in stream if not line.startswith("#"))
        next(rows)
        return dict(_parsed(row) for row in rows if len(row) == WIDTH)


WIDTH = len(Impact._fields) + len(Row._fields)


def _parsed(row: list[str]) -> tuple[Impact, Row]:
    numbers = [float(text) for text in row[2:]]
    grid = [int(number) for number in numbers[5:7]]
    return Impact._make([*row[:2], *numbers[:5], *grid]), Row._make(numbers[7:])


def _line(impact: Impact, row: Row) -> str:
    plain = [str(part) for part in impact]
    return ",".join([*plain, *(f"{value:.9g}" for value in row)]) + "\n"


def _whole(rows: dict[Impact, Row]) -> str:
    names = ",".join(Impact._fields + Row._fields) + "\n"
    return HEAD + names + "".join(_line(impact, row) for impact, row in rows.items())


def fill(table: Path, wanted: list[Impact], workers: int) -> int:
    """Compute what the table lacks and store it; return how many impacts failed."""
    done = load(table)
    missing = [impact for impact in wanted if impact not in done]
    table.write_text(_whole(done), encoding="utf-8")  # without a line that was cut off
    failed = 0
    os.environ["OMP_NUM_THREADS"] = "1"
    with multiprocessing.get_context("spawn").Pool(workers) as pool:
        results = pool.imap_unordered(computed, missing)
        for impact, row in track(results, "impacts", len(missing)):
            if isinstance(row, str):
                failed += 1
                print(f"{impact}: {row}", file=sys.stderr)
                continue
            done[impact] = row
            with table.open("a", encoding="utf-8") as stream:
                stream.write(_line(impact, row))
    order = {impact: place for place, impact in enumerate(wanted)}
    tidy = dict(sorted(done.items(), key=lambda item: order.get(item[0], len(order))))
    replace_whole(table, lambda path: path.write_text(_whole(tidy), encoding="utf-8"))
    return failed


def check(table: Path) -> int:
    """Compute a coarse impact of each kind again, that of the strongest coupling.

    Return how many differ in psi_2 by 1e-5.
    """
    stored = load(table)
    chosen: dict[str, Impact] = {}
    for impact in sorted(stored, key=lambda one: (one.elements, -abs(one.beta) / one.friction)):
        chosen.setdefault(impact.label, impact)
    differ = 0
    for impact in chosen.values():
        change = compute(impact).psi_2 - stored[impact].psi_2
        differ += abs(change) > 1e-5
        print(f"{impact.label}, {impact.case}, psi_1 {impact.psi_1:g}: psi_2 off by {change:.1e}")
    return differ


def smoke() -> int:
    """Compute three coarse impacts into a temporary table, then again: nothing is left to do."""
    ball = [i._replace(elements=12, steps=56) for i in (*plan()[:2], *list(pairs(PAIRS, 24))[2:3])]
    with TemporaryDirectory() as folder:
        table = Path(folder) / TABLE.name
        failed = fill(table, ball, 1)
        first = table.read_text(encoding="utf-8")
        failed += fill(table, ball, 1)
        return failed + (table.read_text(encoding="utf-8") != first) + (len(load(table)) != 3)


def main() -> int:
    """Fill the table, or check it, or try it out."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--check", action="store_true", help="compare a few rows")
    parser.add_argument("--smoke", action="store_true", help="three impacts, not stored")
    asked = parser.parse_args()
    if asked.smoke:
        return int(smoke() > 0)
    if asked.check:
        return int(check(TABLE) > 0)
    return int(fill(TABLE, plan(), asked.workers) > 0)


if __name__ == "__main__":
    sys.exit(main())
