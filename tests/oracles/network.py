"""The shear modulus of a packing whose contacts are springs that do not slip."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve


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


def linear_modulus(place, side, radius, modulus, kappa, stiffness):
    """Return G/E of springs in place of the contacts, without slip, their pressure included."""
    gap = place[None] - place[:, None]
    gap -= side * np.round(gap / side)
    one, other = np.where(np.triu(np.linalg.norm(gap, axis=-1) < 1.0, 1))
    gap = gap[one, other]
    distance = np.linalg.norm(gap, axis=1)
    normal, overlap, count = gap / distance[:, None], 1.0 - distance, len(one)
    along = normal[:, :, None] * normal[:, None, :]
    aside = np.eye(3) - along
    normal_stiffness = 2.0 * modulus * np.sqrt(radius * overlap)
    force = 4.0 / 3.0 * modulus * np.sqrt(radius) * overlap**1.5
    unit, arm = np.broadcast_to(np.eye(3), along.shape), 0.5 * cross(normal)
    moved = [(3 * other, unit), (3 * one, -unit)]
    turned = [(3 * (len(place) + one), -arm), (3 * (len(place) + other), -arm)]
    middles, points = gather(count, len(place), *moved), gather(count, len(place), *moved, *turned)
    ahead = normal_stiffness[:, None, None] * along - (force / distance)[:, None, None] * aside
    sideways = (stiffness * kappa * normal_stiffness)[:, None, None] * aside
    ahead, sideways = (
        sp.block_diag([sp.csr_array(block) for block in blocks], format="csr")
        for blocks in (ahead, sideways)
    )
    affine = np.zeros((count, 3))
    affine[:, 0] = gap[:, 1]  # of a unit strain
    affine = affine.ravel()
    whole = points.T @ sideways @ points + middles.T @ ahead @ middles
    held = whole + 1e-10 * sp.eye(6 * len(place))
    pull = points.T @ (sideways @ affine) + middles.T @ (ahead @ affine)
    answer = spsolve(held.tocsc(), -pull)
    borne = sideways @ (points @ answer + affine) + ahead @ (middles @ answer + affine)
    return float(borne.reshape(-1, 3)[:, 0] @ gap[:, 1] / side**3)
