"""The inputs that `carom lammps examples` writes, small: what they print is what physics says."""

import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import carom
from carom.adapters.lammps import EXAMPLES

pytestmark = pytest.mark.engine
STEEL = carom.Material(young=210e9, poisson=0.3, density=7850.0)
BULK_RATIO, BULK_SLOPE = 0.403, 29.8  # friction 0.5, I = 0.1; friction 0.5: docs/bulk_study.md


def printed(lammps, name, pattern, **small):
    """Run an input with smaller variables; return the numbers in the line that it prints.

    It draws something, too: a picture that is neither empty nor full.
    """
    values = "".join(f"variable {key} index {value}\n" for key, value in small.items())
    text = lammps(values + (EXAMPLES / name).read_text())
    with Image.open(lammps.folder / f"{name.removeprefix('in.')}.jpg") as picture:
        drawn = np.asarray(picture.convert("L")) < 200
    assert drawn.shape == (600, 600)
    assert 0.01 < drawn.mean() < 0.6
    match = re.search(f"^{pattern}", text, re.MULTILINE)
    assert match, text[-800:]
    return [float(number) for number in match.groups()]


def test_impact(lammps):
    """The exact angle, to the digits shown."""
    ball = carom.Sphere(radius=5e-3, material=STEEL)
    hit = carom.impact(carom.Pair(ball, ball, friction=0.2), speed=1e-4, angle="10 deg")
    (angle,) = printed(lammps, "in.impact", r"the balls part at (\S+) degrees")
    assert angle == pytest.approx(np.degrees(hit.rebound_angle), abs=0.006)


def test_lines_of_the_manual_before_and_after(lammps):
    """LAMMPS' own law leaves the ball at another angle, and with the share of spin that is said."""
    page = Path(__file__).parents[2] / "docs" / "how-to" / "lammps.md"
    text = page.read_text(encoding="utf-8")
    own, ours = (block.split("```")[0] for block in text.split("```none\n")[1:3])
    assert tuple(lines.split()[1] for lines in (own, ours)) == ("granular", "carom")
    impact = (EXAMPLES / "in.impact").read_text().split("# a minute later")[0]
    angles = []
    for lines in (own, ours):
        given = re.sub(r"pair_style .*\npair_coeff .*\n", lines, impact)
        found = re.search(r"^the balls part at (\S+) degrees", lammps(given), re.MULTILINE)
        angles.append(found[1])
        assert f"{found[1]}°" in text
    braked = np.tan(np.radians(10.0)) - np.tan(np.radians(np.array(angles, dtype=float)))
    assert f"{braked[0] / braked[1]:.0%}".replace("%", " %") in text  # both give spin in proportion


def test_settling(lammps):
    """The floor bears the weight, once nothing moves."""
    (borne,) = printed(lammps, "in.settling", r"the floor bears (\S+) of", count=40)
    assert borne == pytest.approx(1.0, abs=0.03)


@pytest.mark.slow
def test_shear(lammps):
    """The stress ratio is that of a large periodic box, and the work of the lid is what is lost."""
    line = (
        r"stress ratio (\S+) at the inertial number (\S+)\nwork of the lid (\S+) mJ, lost (\S+) mJ"
    )
    ratio, inertia, work, lost = printed(lammps, "in.shear", line, count=300, strain=3)
    assert ratio == pytest.approx(BULK_RATIO, abs=0.025)  # it is 0.37 with friction 0.3
    assert inertia == pytest.approx(0.1, abs=0.03)
    assert lost == pytest.approx(work, rel=0.02)


def test_hopper(lammps):
    """Most run through; none is lost on the way."""
    line = r"(\d+) of (\d+) spheres are through in (\S+) s"
    through, count, time = printed(lammps, "in.hopper", line, count=60)
    assert 48 < through <= count == 60
    assert 0.1 < time < 0.4


@pytest.mark.slow
def test_drum(lammps):
    """A rough drum has a slope near that of the larger study."""
    (slope,) = printed(lammps, "in.drum", r"the slope is (\S+) degrees", slices=2, radians=0.4)
    assert slope == pytest.approx(BULK_SLOPE, abs=4.0)


HEAP = r"the slope is (\S+) degrees, (\S+) degrees"


@pytest.mark.slow
def test_heap(lammps):
    """It keeps its shape once the gate is gone and the spheres have come to rest."""
    slope, before = printed(lammps, "in.heap", HEAP, slices=2)
    assert slope == pytest.approx(before, abs=0.3)
    assert slope > 22.0


@pytest.mark.slow
def test_cohesion_makes_a_heap_steeper(lammps):
    steep, flat = (printed(lammps, "in.heap", HEAP, cohesion=value)[0] for value in (0.2, 0.0))
    assert flat == pytest.approx(23.0, abs=4.0)
    assert steep - flat > 6.0
