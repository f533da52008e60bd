"""Stress below the surface of either body of a contact."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from carom.contacts.contact import Contact
from carom.dimensionless.fields.extremes import Largest, largest, principal_stresses, von_mises
from carom.dimensionless.fields.peaks import TENSION, VON_MISES
from carom.dimensionless.fields.subsurface import COMPONENTS, stresses
from carom.io.labels import labelled_dataset
from carom.quantities.arrays import Array, places
from carom.quantities.prefixes import text
from carom.quantities.refusals import one_of, refusal

if TYPE_CHECKING:
    import xarray as xr


ALONG, DOWN = 101, 61  # points along x and z where none are asked for
REACH = 2.0  # of that grid, in contact radii
FAR = 1e300  # dimensionless; nothing is left there
BODIES = ("first", "second")
SHALLOW = 0.02  # depth, in contact radii, from which on stresses are told if those at the edge are
# infinite: while viscous bodies are loaded


def stress_dataset(
    contact: Contact,
    *,
    x: ArrayLike | None = None,
    z: ArrayLike | None = None,
    points: ArrayLike | None = None,
    body: str = "second",
) -> "xr.Dataset":
    """Return the stress in one body, on a grid in the plane y = 0 or at points.

    Arguments, result and errors are those of `InContact.stress`.
    """
    friction, poisson = _of_body(contact, body)
    reach = REACH * (contact.radius or contact.scales.radius)
    top = SHALLOW * contact.radius if contact.rim else 0.0
    default = {"x": np.linspace(-reach, reach, ALONG), "z": np.linspace(top, reach, DOWN)}
    dims, coords, at = places("xyz", {"x": x, "z": z}, default, points)
    _refuse_outside("z" if points is None else "points", at[..., 2], top)

    given: Any = {"friction": friction, "poisson": poisson, "rim": contact.rim}
    with np.errstate(over="ignore"):
        where = np.clip(at.reshape(-1, 3) / contact.scales.radius, -FAR, FAR)
    stress = contact.scales.pressure * stresses(where, contact.profile, **given)
    columns = {name: (dims, v.reshape(at.shape[:-1])) for name, v in _columns(stress).items()}
    shallow = SHALLOW if contact.rim else 0.0
    mises = largest(VON_MISES, contact.profile, **given, shallow=shallow)
    numbers = _entries(contact, "max_von_mises", mises)
    if not contact.rim:
        tension = largest(TENSION, contact.profile, **given, deepest=0.0)
        numbers |= _entries(contact, "max_tension", tension)
    return labelled_dataset(
        {**columns, **numbers, **contact.numbers(), "poisson": poisson},
        coords,
        {"title": f"stress in the {body} body", "body": body, **contact.attributes},
    )


def _columns(stress: Array) -> dict[str, Array]:
    principal = principal_stresses(stress)
    columns = {f"sigma_{name}": stress[:, i] for i, name in enumerate(COMPONENTS)}
    columns |= {f"principal_{i + 1}": principal[:, i] for i in range(3)}
    columns["von_mises"] = von_mises(stress)
    columns["max_shear"] = 0.5 * (principal[:, 0] - principal[:, 2])
    return columns


def _entries(contact: Contact, name: str, found: Largest) -> dict[str, float]:
    place = {f"{name}_{c}": getattr(found, c) * contact.scales.radius for c in "xyz"}
    return {name: found.value * contact.scales.pressure, **place}


def _of_body(contact: Contact, body: str) -> tuple[float, float]:
    """Return friction, positive where it pulls the body along +x, and Poisson's ratio."""
    one_of("body", body, BODIES)
    material = getattr(contact.pair, body).material
    if material.is_rigid:
        other = BODIES[1 - BODIES.index(body)]
        raise refusal("body", body, f"it is rigid and has no stress; ask for the {other} body")
    pull = 1.0 if body == "second" else -1.0
    return pull * contact.pair.friction, material.poisson


def _refuse_outside(name: str, depth: Array, top: float) -> None:
    if top and np.any(depth < top):
        z, what = float(depth.min()), "stresses are infinite at the edge while the load grows"
        raise refusal(name, f"z = {text(z, 'm')}", f"{what}; give z from {text(top, 'm', 3)} on")
    if np.any(depth < 0.0):
        z = float(depth.min())
        allowed = "z is the depth in the body and must not be negative"
        raise refusal(name, f"z = {text(z, 'm')}", allowed)
