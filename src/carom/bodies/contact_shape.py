"""Two bodies at their contact: how curved they are together, and how light."""

from typing import Any

import numpy as np

from carom.bodies.smooth_body import Body
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal, refuse

PARTS = "the surfaces must part on all sides: both must be positive"
ALIKE = "give both bodies in a plane, or both in space, with inertias of 3 x 3"
SPACE = "in a plane of symmetry one axis of the contact is along x; give bodies in space"


def check_shapes(first: Any, second: Any) -> None:
    """Raise InputError if two bodies do not touch in an ellipse, or one moves in a plane alone."""
    bodies = [body for body in (first, second) if isinstance(body, Body)]
    free = [body for body in bodies if body.mass is not None]
    whole = curvatures_of(first, second)
    one, other = np.linalg.eigvalsh(whole).tolist()
    shown, planar = f"{one:.3g} and {other:.3g} 1/m together", all(b.is_planar for b in bodies)
    mixed = len({body.is_planar for body in free}) > 1
    refuse(
        not one > 0.0 and refusal("curvatures", shown, PARTS),
        mixed and refusal("inertia", free[0].inertia, ALIKE),
        planar and whole[0, 1] != 0.0 and refusal("curvatures", str(whole.tolist()), SPACE),
    )


def curvatures_of(first: Any, second: Any) -> Array:
    """Return the sum of both bodies' curvatures along x and y, in 1/m."""
    return np.sum(
        [b.curvatures if isinstance(b, Body) else b.curvature * np.eye(2) for b in (first, second)],
        axis=0,
    )


def axes_of(curvatures: Array) -> tuple[tuple[float, float], Array]:
    """Return both curvatures along the axes of a contact, and these as rows, the first near x."""
    if curvatures[0, 1] == 0.0:
        return (float(curvatures[0, 0]), float(curvatures[1, 1])), np.eye(2)
    values, vectors = np.linalg.eigh(curvatures)
    order = [0, 1] if abs(vectors[0, 0]) >= abs(vectors[0, 1]) else [1, 0]
    along = vectors[:, order[0]] * np.copysign(1.0, vectors[0, order[0]])
    return tuple(values[order].tolist()), np.array([along, [-along[1], along[0]]])


def inverse_mass_of(body: Any) -> Array:
    """Return the inverse mass of a body at its contact along x, y and the normal, in 1/kg."""
    if isinstance(body, Body):
        return body.inverse_mass
    tangential = (1.0 + 1.0 / body.gyration_ratio) / body.mass
    return np.diag([tangential, tangential, 1.0 / body.mass])
