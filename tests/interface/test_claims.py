"""Every number that README claims is computed again, and is the same on all pages and in the paper.

Numbers are found beside key words; README has to make the claims of `MADE`.
"""

import csv
import re
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.dimensionless.lossy.layout import PSI_OUT
from carom.dimensionless.lossy.springs.march import marched
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "studies"))

import halfspace_differences as study  # noqa: E402
from accuracy import impacts  # noqa: E402
from speed import PAIR, exact_error  # noqa: E402

PAGES = (ROOT / "README.md", ROOT / "paper/paper.md", *sorted((ROOT / "docs").rglob("*.md")))
N = r"\[?(\d[\d,]*(?:\.\d+)?(?:e-?\d+)?)"  # the number that is claimed
POWER = r"\$(?:([\d.]+) \\cdot )?10\^\{(-?\d+)\}\$"
TO = r"(?:°| degrees)? instead of "


@cache
def text(page):
    """Return the words of a page, with powers of ten as 4e-13."""
    words = " ".join(page.read_text(encoding="utf-8").split())
    return re.sub(POWER, lambda found: f"{found[1] or 1}e{found[2]}", words)


@cache
def fits():
    """Return kinds of data, sets of each, and how many percent of the intervals hold the truth."""
    lines = (ROOT / "studies/fit_coverage.csv").read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if line[0] != "#")
    return [(row["design"], row["sets"], float(row["coverage [%]"])) for row in rows]


def largest(*labels):
    """Return the largest difference of the full contact from the theory in psi_2."""
    return max(abs(study.difference(case).value) for one in labels for case in study.cases(one))


@cache
def ball(wanted):
    """Return what a steel ball that strikes at 10 degrees does with `mindlin`, and exactly."""
    hit = carom.impact(PAIR, speed=1.0, angle="10 deg")
    known = {"speed": 1.0, "angle": np.radians(10.0), "normal_restitution": 1.0}
    known["psi_out"] = carom.dem.LammpsMindlin().rebound(hit.psi_in, PAIR.chi, kappa=PAIR.kappa)
    return carom.convert_observables(PAIR, known=known, wanted=wanted), getattr(hit, wanted)


def programs():
    """Return the largest difference of DEM programs from Carom's record of their laws."""
    (rows,) = re.findall(r"begin: engines -->(.*?)<!-- end", "".join(map(text, PAGES)))
    return max(map(float, re.findall(r"\| (\de-\d+) ", rows)))


def whole():
    """Return the largest difference from annuli and steps, extrapolated, in 300 random impacts."""
    rng = np.random.default_rng(1976)
    psi, chi = rng.uniform(0.0, 6.0, 300), rng.uniform(1.1, 1.8, 300)
    off = []
    for one in ((psi[i], chi[i]) for i in (47, 199, 195)):  # the worst: all need minutes
        rough, fine = (marched(one[0], Inertia(one[1]), ELASTIC, n)[PSI_OUT] for n in (2000, 4000))
        off.append(abs(fine + (fine - rough) / 3.0 - carom.rebound(*one)))
    return max(off)


# What the number is computed from, and the words around it. It is rounded, ...
CLAIMS = {
    "impacts": (lambda: len(impacts()[0]), rf"{N} impacts[^|]{{0,60}}30 digits"),
    "angle": (lambda: np.degrees(ball("rebound_angle")[0]), rf"{N}{TO}7\.[23]"),
    "exact": (lambda: np.degrees(ball("rebound_angle")[1]), rf"9\.5{TO}{N}"),
    "spin": (lambda: np.divide(*ball("spin_out")) * 100, rf"instead of 7\.3\D{{0,20}}with {N} %"),
    "least": (lambda: min(held for *_, held in fits()), rf"{N} to 98\.5 %"),
    "most": (lambda: max(held for *_, held in fits()), rf"92 to {N} %"),
    "kinds": (lambda: len({one[0] for one in fits()}), rf"synthetic \w+ of {N} kinds"),
    "designs": (lambda: len({d for d, n, _ in fits() if n == "500"}), rf"each of {N} designs"),
    "solid": (lambda: largest("solid"), rf"{N} for solid spheres of like"),
    "like": (lambda: largest("like", "apart like"), rf"{N} for other bodies of like"),
    "pairs": (lambda: largest("pair"), rf"{N} for five real pairs"),
    "unlike": (lambda: largest("unlike", "apart unlike"), rf"{N} for any unlike"),
}
BOUNDS = {  # ... or not below what is computed and at most three times as large
    "psi_2": (exact_error, rf"47 impacts[^|]*30 digits[^|]*\| {N}"),
    "annuli": (whole, rf"(?:annuli and|Fawcett)[^|]*extrapolated[^|]*\| {N}"),
    "programs": (programs, rf"LAMMPS, LIGGGHTS(?:,| and) YADE[^|]*\| {N}"),
}
MADE = {*CLAIMS, *BOUNDS} - {"designs", "annuli"}


def claimed(name, pattern):
    """Return where the number stands, and the number."""
    found = [(page, one) for page in PAGES for one in re.finditer(pattern, text(page))]
    assert PAGES[0] in dict(found) if name in MADE else found, "README, or any page, has it"
    return [(f"{page.name}: {one[0]}", one[1].replace(",", "")) for page, one in found]


@pytest.mark.parametrize("name", CLAIMS)
def test_number_is_what_is_computed(name):
    value = CLAIMS[name][0]()
    for place, number in claimed(name, CLAIMS[name][1]):
        assert f"{value:.{len(number.partition('.')[2])}f}" == number, place


@pytest.mark.parametrize("name", BOUNDS)
def test_bound_holds_and_is_near(name):
    for place, number in claimed(name, BOUNDS[name][1]):
        assert 0.3 < BOUNDS[name][0]() / float(number) <= 1.0, place
