"""How far is the theory off where slip turns and materials differ? Impacts by boundary elements.

The table is halfspace_study.csv.

python studies/halfspace_study.py              what the table lacks, hours on one core
python studies/halfspace_study.py --workers 2  the same on two

Every impact is stored as soon as it is done; a run that was broken off goes on where it stopped.
"""

import argparse
import csv
import multiprocessing
import os
import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
from halfspace_plan import Impact, plan
from rich.progress import track

from carom.halfspace.compliance import Materials
from carom.halfspace.motion import NormalSpin
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
DURATION = 2.94327518432470  # of Hertz's impact, in d_max/V_1


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


def compute(impact: Impact) -> Row:
    """Return what an impact comes to."""
    started = time.process_time()
    materials = Materials(impact.kappa, impact.beta, impact.friction)
    grid = Resolution(impact.elements, impact.steps)
    spin = NormalSpin(impact.spin, impact.lightness)
    found = solve(impact.psi_1, impact.chi, materials, grid, spin=spin)
    work = np.maximum(found.ledger.lost, 0.0)
    micro = work * (found.ledger.slip_share < 1.0)
    return Row(
        found.psi_out,
        found.restitution,
        found.duration / DURATION,
        _angles(found, work)[0],
        *_angles(found, micro),
        _angles(found, work - micro)[1],
        float(found.ledger.lost_across.sum() / work.sum()),
        _slip_across(found),
        found.energy_error,
        time.process_time() - started,
    )


def _angles(found: HalfspaceSolution, work: np.ndarray) -> tuple[float, float]:
    """Return mean and largest angle of slip in degrees, over the steps with this work."""
    if not work.any():
        return 0.0, 0.0
    mean = np.average(found.ledger.slip_angle, weights=work)
    counts = work > 0.1 * work[work > 0.0].mean()
    largest = found.ledger.slip_angle_max[counts].max()
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


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--workers", type=int, default=1, help="processes")
    sys.exit(fill(TABLE, plan(), parser.parse_args().workers) > 0)
