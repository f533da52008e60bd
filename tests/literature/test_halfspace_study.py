"""The study behind the validity of the theory, studies/halfspace_study.*: it holds, is current.

Full solutions of impacts of solid spheres by boundary elements. Their difference from the theory is
that from nu = 0 at the same chi, psi_1 and grid, where the theory is exact.
"""

import csv
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.halfspace.compliance import Materials
from carom.halfspace.refinement import Resolution
from carom.halfspace.solution import solve
from carom.impacts.validity import rebound_error

TABLE = Path(__file__).parents[2] / "studies" / "halfspace_study.csv"
NUMBERS = ("kappa", "beta", "friction", "chi", "psi_1", "psi_2")


@pytest.fixture(scope="module")
def rows():
    lines = TABLE.read_text(encoding="utf-8").splitlines()
    found = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return [{**row, **{name: float(row[name]) for name in NUMBERS}} for row in found]


def key(row):
    return row["chi"], row["psi_1"], row["elements"], row["steps"]


@pytest.fixture(scope="module")
def differences(rows):
    """Rows with what they differ by from nu = 0 on the same grid."""
    plain = {key(row): row["psi_2"] for row in rows if row["kappa"] == 1.0 and row["beta"] == 0.0}
    return [
        (row, row["psi_2"] - plain[key(row)])
        for row in rows
        if row["kappa"] < 1.0 and key(row) in plain
    ]


def bound(row):
    return rebound_error(*(row[name] for name in ("kappa", "beta", "friction", "chi", "psi_1")))


def test_the_theory_is_exact_without_lateral_displacement(rows):
    """nu = 0: within 2e-3, extrapolated with order 3/2 from the two finest grids, 3e-4 mostly."""
    grids = defaultdict(dict)
    for row in rows:
        if row["kappa"] == 1.0 and row["beta"] == 0.0:
            off = row["psi_2"] - carom.rebound(row["psi_1"], row["chi"])
            grids[row["chi"], row["psi_1"]][int(row["elements"])] = off
    extrapolated = []
    for found in grids.values():
        if max(found) >= 48 and len(found) > 1:
            coarse, fine = sorted(found)[-2:]
            step = (found[fine] - found[coarse]) / ((fine / coarse) ** 1.5 - 1.0)
            extrapolated.append(abs(found[fine] + step))
    assert len(extrapolated) > 20
    assert max(extrapolated) < 2e-3
    assert np.median(extrapolated) < 3e-4


def test_like_materials_are_within_the_bound(differences):
    """Slip off x: 0.26, 0.63 and 1.68 thousandths at most for nu = 0.2, 0.3, 0.5, upwards."""
    like = [(row, off) for row, off in differences if row["label"] == "like"]
    for row, off in like:
        assert -2e-5 <= off <= bound(row) + 2e-5, row
    for nu, largest in ((0.2, 2.6e-4), (0.3, 6.3e-4), (0.5, 1.68e-3)):
        found = max(off for row, off in like if row["case"] == f"nu {nu:g}")
        assert found == pytest.approx(largest, rel=0.1)


def test_unlike_materials_are_within_the_bound(differences):
    """And the bound is not idle: the worst of each pair that couples uses a quarter of it."""
    pairs = [(row, off) for row, off in differences if row["label"] == "pair"]
    for row, off in pairs:
        assert abs(off) <= bound(row) + 1e-3, row
    for name in {row["case"] for row, _ in pairs}:
        shares = [abs(off) / bound(row) for row, off in pairs if row["case"] == name]
        assert max(shares) > 0.25, name


@pytest.mark.parametrize(
    "wanted", [("like", "nu 0.5", 1.0, "32"), ("pair", "alumina on glass", 1.0, "24")]
)
def test_rows_are_those_of_the_code(rows, wanted):
    """Computed again; only rounding and tolerances of the solvers may differ."""
    (row,) = (r for r in rows if (r["label"], r["case"], r["psi_1"], r["elements"]) == wanted)
    materials = Materials(row["kappa"], row["beta"], row["friction"])
    grid = Resolution(int(row["elements"]), int(row["steps"]))
    again = solve(row["psi_1"], row["chi"], materials, grid)
    assert again.psi_out == pytest.approx(row["psi_2"], abs=2e-5)
    assert again.restitution == pytest.approx(float(row["restitution"]), abs=1e-6)


def test_the_page_tells_what_the_table_holds():
    """Every row of the tables on docs/halfspace_study.md is computed from it."""
    sys.path.insert(0, str(TABLE.parent))
    import halfspace_tables as figures

    page = (TABLE.parents[1] / "docs/halfspace_study.md").read_text(encoding="utf-8")
    like = [f"nu {nu:g}" for nu in figures.RATIOS]
    tables = (
        figures.table("like", like),
        figures.table("control", like[1:]),
        figures.table("pair", list(figures.PAIRS)),
        figures.normal_table(),
        figures.slip_table(),
        figures.bound_table(),
    )
    lines = [line for table in tables for line in table]
    assert len(lines) > 70
    assert [line for line in lines if line not in page.splitlines()] == []
