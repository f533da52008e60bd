"""Why do measured rebounds of alumina on glass not show the coupling of unlike materials?

python studies/coupling.py              what coupling.csv lacks, the tables of the page, its figure
python studies/coupling.py --workers 2  the same on two cores
python studies/coupling.py --smoke      one coarse impact by each law, nothing is stored

Boundary elements whose law of friction or whose surface is varied, against the rebounds of Kharaz,
Gorham & Salman (2001), and unchanged against the finite elements in Chung & Ooi (2011), test 5.
Every impact is stored as soon as it is done; a run that was broken off goes on where it stopped.
"""

import argparse
import multiprocessing
import os
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
from coupling_figure import draw
from coupling_laws import LAWS, Impact, SoftCompliance
from coupling_plan import SOLID, Row, Rows, Variant, plan
from coupling_tables import Coulomb, tables
from rich.progress import track

from carom.halfspace.compliance import Compliance, Materials
from carom.halfspace.grid import elements_across
from carom.halfspace.ledger import LedgerEntry, entry
from carom.halfspace.motion import move
from carom.halfspace.transforms import Mirrors
from carom.io.files import replace_whole

TABLE = Path(__file__).with_suffix(".csv")
HEAD = """\
# solid spheres on half-spaces by boundary elements with other laws of friction, or a layer that
# shears; made by studies/coupling.py, told in docs/coupling.md. x: V_x/(friction V_1) at first;
# scale: slip in friction d_max, speed in friction V_1, layer in a_max/E*, asperities in d_max;
# slipping: share of the contact, mean over area and time; slip_angle: degrees against the motion
"""


def compute(impact: Impact) -> Row:
    """Return what an impact comes to."""
    materials = Materials(impact.kappa, impact.beta, impact.friction)
    given = elements_across(impact.elements), 2.0 / impact.elements, materials, Mirrors(y=True)
    layer = {"layer": impact.scale, "asperities": 2.0 * impact.scale}.get(impact.law, 0.0)
    surface = SoftCompliance(*given, layer=layer) if layer else Compliance(*given)
    psi = np.array([impact.kappa * impact.x, 0.0])
    patch = LAWS[impact.law](surface, impact)
    steps = pairwise(move(patch, psi, SOLID * impact.kappa, impact.steps))
    ledger = LedgerEntry(*np.array([entry(patch, *step) for step in steps]).T)
    touched = np.diff(ledger.time, prepend=0.0) * ledger.contact_radius**2
    work = np.maximum(ledger.lost, 0.0) + 1e-300
    return Row(
        impact.kappa * float(ledger.velocity[-1]),
        -float(ledger.approach[-1]),
        float(np.average(ledger.slip_share, weights=touched)),
        float(np.degrees(np.average(ledger.slip_angle, weights=work))),
    )


def load() -> Rows:
    """Return what is stored."""
    if not TABLE.exists():
        return {}
    stored = pd.read_csv(TABLE, comment="#").dropna()
    return {Impact(*line[:11]): Row(*line[11:]) for line in stored.itertuples(index=False)}


def store(rows: Rows) -> None:
    """Store impacts."""
    columns = Impact._fields + Row._fields
    frame = pd.DataFrame([(*impact, *row) for impact, row in rows.items()], columns=columns)
    text = HEAD + frame.to_csv(index=False, float_format="%.9g", lineterminator="\n")
    replace_whole(TABLE, lambda path: path.write_text(text, encoding="utf-8"))


def fill(workers: int) -> Rows:
    """Compute what the table lacks, store it, and return the table."""
    wanted, done = plan(), load()
    missing = [impact for impact in wanted if impact not in done]
    os.environ["OMP_NUM_THREADS"] = "1"
    with multiprocessing.get_context("spawn").Pool(workers) as pool:
        found = track(pool.imap(compute, missing), "impacts", len(missing))
        for count, (impact, row) in enumerate(zip(missing, found, strict=True), 1):
            done[impact] = row
            if count % 10 == 0 or count == len(missing):
                store(done)
    rows = {impact: done[impact] for impact in wanted}
    store(rows)
    return rows


def smoke() -> None:
    """Compute one coarse impact by each law."""
    scales = {"layer": 0.1, "speed": 0.1}
    for law in LAWS:
        strength = 3.0 if law in ("slip", "speed") else 0.3
        impact = Variant(law, strength, scales.get(law, 3e-7), elements=8).at(4.0)
        row = compute(impact)
        assert 0.9 < row.restitution <= 1.001, (impact, row)
        print(law, row)


def main() -> None:
    """Fill the table and print what it says, or try the laws out."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--smoke", action="store_true", help="six impacts, not stored")
    asked = parser.parse_args()
    if asked.smoke:
        smoke()
        return
    rows = fill(asked.workers)
    full = Coulomb(rows)
    tables(rows, full)
    draw(rows, full)


if __name__ == "__main__":
    main()
