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
from carom.halfspace.motion import NormalSpin
from carom.halfspace.refinement import Resolution
from carom.halfspace.solution import HalfspaceSolution, solve
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
GRIDS = {n: Resolution(n, round(4.6875 * n)) for n in (8, 16, 32, 48, 64)}
RATIOS = (0.0, 0.2, 0.3, 0.5)  # Poisson's, of both bodies
PAIRS = {  # ball, half-space, friction
    "steel on rubber": ("steel", "rubber", 1.0),  # typical of dry rubber
    "glass on steel": ("soda-lime-glass", "steel", 0.125),  # of glass on aluminium, second hand
    "alumina on glass": ("alumina", "soda-lime-glass", 0.092),  # Kharaz et al. 2001 as modelled
    "POM on steel": ("pom", "steel", 0.2),  # typical, dry
    "steel on concrete": ("steel", "concrete", 0.57),  # second hand
}
# Impacts drawn at random: label, seed, how many, of like or unlike materials
DRAWN = {
    "like": (20261124, 300, "like"),
    "unlike": (20261125, 300, "unlike"),
    "apart like": (20261126, 50, "like"),  # kept apart: no bound has seen them
    "apart unlike": (20261127, 50, "unlike"),
    "spin": (20261129, 200, "like"),
    "spin unlike": (20261130, 40, "unlike"),
    "apart spin": (20261131, 40, "like"),
    "apart spin unlike": (20261132, 10, "unlike"),
}
SPINS, LIGHTNESS = (0.02, 20.0), (0.0005, 0.03)  # a_max/R up to 0.1
LEAST_CHI, LARGEST_CHI, LARGEST_NU = 0.3, 8.0, 0.5
LARGEST_BETA, FRICTIONS, LARGEST_RATIO = 0.5, (0.02, 1.0), 10.0
SOLID = 1.75  # chi/kappa of a solid sphere on a half-space
DURATION = 2.94327518432470  # of Hertz's impact, in d_max/V_1


class Impact(NamedTuple):
    """One impact to be computed."""

    label: str  # solid, pair, a key of DRAWN, judge; control: nu = 0, the same chi; still: no spin
    case: str
    kappa: float
    beta: float
    friction: float
    chi: float
    psi_1: float
    elements: int
    steps: int
    spin: float = 0.0  # about the normal, and what opposes it less: `NormalSpin`
    lightness: float = 0.0


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


def solid(poisson: float, grid: int) -> Iterator[Impact]:
    """Yield the impacts of solid spheres of like materials."""
    kappa = shared(poisson)
    chi = round(SOLID * kappa, 6)
    for psi in incidences(chi):
        yield Impact("solid", f"nu {poisson:g}", kappa, 0.0, 1.0, chi, psi, *GRIDS[grid])


def pairs(grid: int) -> Iterator[Impact]:
    """Yield the impacts of unlike materials."""
    for name, (ball, plane, friction) in PAIRS.items():
        pair = carom.Pair(
            carom.Sphere(radius="5 mm", material=ball), carom.HalfSpace(material=plane), friction
        )
        kappa, beta = round(pair.kappa, 6), round(pair.dundurs_beta, 6)
        chi = round(pair.chi, 6)
        for psi in incidences(chi):
            yield Impact("pair", name, kappa, beta, friction, chi, psi, *GRIDS[grid])


def control(impacts: Iterable[Impact]) -> Iterator[Impact]:
    """Yield each impact and the one of nu = 0 at the same chi, on the same grid."""
    for impact in impacts:
        yield impact
        if impact.kappa != 1.0:
            yield impact._replace(label="control", case="nu 0", kappa=1.0)


def drawn_chi(rng: np.random.Generator) -> float:
    """Return a chi, evenly in its logarithm."""
    return float(np.exp(rng.uniform(np.log(LEAST_CHI), np.log(LARGEST_CHI))))


def drawn_psi(rng: np.random.Generator, chi: float) -> float:
    """Return an incidence: below 1.2, near 1, up to 4 chi + 1, or beyond."""
    last = max(4.0 * chi - 1.0, 1.0)
    choices = (
        rng.uniform(0.02, 1.2),
        rng.uniform(0.9, 1.1),
        rng.uniform(1.0, last + 2.0),
        last + rng.exponential(2.0),
    )
    return float(choices[rng.choice(4, p=(0.3, 0.2, 0.4, 0.1))])


def drawn_kappa(rng: np.random.Generator) -> float:
    """Return kappa of a Poisson's ratio."""
    return shared(float(rng.uniform(-LARGEST_NU, LARGEST_NU)))


def drawn_strength(rng: np.random.Generator) -> tuple[float, float]:
    """Return Dundurs' beta and friction, of whose ratio little and much are as likely."""
    while True:
        friction = float(np.exp(rng.uniform(*np.log(FRICTIONS))))
        beta = float(rng.choice((-1, 1)) * np.exp(rng.uniform(np.log(0.01), np.log(LARGEST_BETA))))
        if abs(beta) <= LARGEST_RATIO * friction:
            return beta, friction


def drawn(label: str, grid: int) -> Iterator[Impact]:
    """Yield the impacts of a series that is drawn at random; the same at each call."""
    seed, count, kind = DRAWN[label]
    rng = np.random.default_rng(seed)
    for number in range(count):
        chi, kappa = drawn_chi(rng), drawn_kappa(rng)
        beta, friction = (0.0, 1.0) if kind == "like" else drawn_strength(rng)
        numbers = (round(n, 6) for n in (kappa, beta, friction, chi, drawn_psi(rng, chi)))
        impact = Impact(label, f"{number}", *numbers, *GRIDS[grid])
        yield impact._replace(**drawn_spin(rng)) if "spin" in label else impact


def drawn_spin(rng: np.random.Generator) -> dict[str, float]:
    """Return a spin about the normal, evenly in its logarithm."""
    spin = np.exp(rng.uniform(*np.log(SPINS)))
    return {"spin": round(float(spin), 6), "lightness": round(float(rng.uniform(*LIGHTNESS)), 6)}


def still(impacts: Iterable[Impact]) -> Iterator[Impact]:
    """Yield each impact and the one without spin about the normal."""
    for impact in impacts:
        yield impact
        yield impact._replace(label=f"still {impact.label}", spin=0.0, lightness=0.0)


JUDGED = {"nu 0": 80, "like": 80, "unlike": 40}  # impacts of the study of errors


def judge(kind: str, grid: int) -> Iterator[Impact]:
    """Yield the impacts on which estimates of errors are judged."""
    rng = np.random.default_rng([20261128, len(kind)])
    for number in range(JUDGED[kind]):
        chi, kappa = drawn_chi(rng), 1.0 if kind == "nu 0" else drawn_kappa(rng)
        beta, friction = drawn_strength(rng) if kind == "unlike" else (0.0, 1.0)
        numbers = (round(n, 6) for n in (kappa, beta, friction, chi, drawn_psi(rng, chi)))
        yield Impact("judge", f"{kind} {number}", *numbers, *GRIDS[grid])


def plan() -> list[Impact]:
    """Return all impacts of the study, the coarse ones first, none twice."""
    every = [i for grid in (8, 16, 32) for kind in JUDGED for i in judge(kind, grid)]
    every += [*judge("nu 0", 64), *control(judge("like", 64))]
    for label in ("like", "apart like"):
        every += [*control(drawn(label, 32)), *control(drawn(label, 48))]
    for label in ("unlike", "apart unlike"):
        every += [*drawn(label, 16), *drawn(label, 32)]
    for label in ("spin", "apart spin"):
        every += [i for grid in (16, 32) for i in still(drawn(label, grid))]
    for label in ("spin unlike", "apart spin unlike"):
        every += [*still(drawn(label, 16))]
    every += [i for grid in (32, 64) for ratio in RATIOS for i in control(solid(ratio, grid))]
    every += [*pairs(16), *pairs(32)]
    every += [*judge("unlike", 48), *judge("unlike", 64)]
    return list(dict.fromkeys(every))


def compute(impact: Impact) -> Row:
    """Return what an impact comes to."""
    started = time.process_time()
    materials = Materials(impact.kappa, impact.beta, impact.friction)
    grid = Resolution(impact.elements, impact.steps)
    spin = NormalSpin(impact.spin, impact.lightness)
    found = solve(impact.psi_1, impact.chi, materials, grid, spin=spin)
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
        np.abs(kept.slip_velocity[:, kept.step.touching]).sum(axis=1) for kept in found.snapshots
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
    return Impact._make([*row[:2], *numbers[:5], *grid, *numbers[7:9]]), Row._make(numbers[9:])


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
    ball = [*judge("nu 0", 8)][:1] + [*judge("unlike", 8)][:1] + [*drawn("like", 8)][:1]
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
