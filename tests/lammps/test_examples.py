"""The inputs that `carom lammps examples` writes, small: what they print is what physics says."""

import re

import numpy as np
import pytest

import carom
from carom.adapters.lammps import EXAMPLES

pytestmark = pytest.mark.engine
STEEL = carom.Material(young=210e9, poisson=0.3, density=7850.0)


def printed(lammps, name, pattern, **small):
    """Run an input with smaller variables; return the numbers in the line that it prints."""
    values = "".join(f"variable {key} index {value}\n" for key, value in small.items())
    text = lammps(values + (EXAMPLES / name).read_text())
    match = re.search(f"^{pattern}", text, re.MULTILINE)
    assert match, text[-800:]
    return [float(number) for number in match.groups()]


def test_impact(lammps):
    """The exact angle, to the digits shown."""
    ball = carom.Sphere(radius=5e-3, material=STEEL)
    hit = carom.impact(carom.Pair(ball, ball, friction=0.2), speed=1e-4, angle="10 deg")
    (angle,) = printed(lammps, "in.impact", r"the balls part at (\S+) degrees")
    assert angle == pytest.approx(np.degrees(hit.rebound_angle), abs=0.006)


def test_settling(lammps):
    """The floor bears the weight, once nothing moves."""
    (borne,) = printed(lammps, "in.settling", r"the floor bears (\S+) of", count=40)
    assert borne == pytest.approx(1.0, abs=0.03)


def test_shear(lammps):
    """The wall's work is what friction and viscosity took, but for what is still stored."""
    line = r"work of the wall (\S+) mJ, lost (\S+) mJ"
    work, lost = printed(lammps, "in.shear", line, layers=5, time=0.15)
    assert 0.7 < work < 1.0  # 0.84 with 64 springs
    assert lost == pytest.approx(work, rel=0.02)


def test_hopper(lammps):
    """Most run through; none is lost on the way."""
    line = r"(\d+) of (\d+) spheres are through in (\S+) s"
    through, count, time = printed(lammps, "in.hopper", line, count=60)
    assert 48 < through <= count == 60
    assert 0.1 < time < 0.4
