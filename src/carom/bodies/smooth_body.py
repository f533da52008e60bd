"""Any smooth body: mass and inertia, where it is touched, how curved it and its contact are."""

from dataclasses import dataclass
from types import NoneType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.materials import Material, as_material, set_fields, unchecked
from carom.bodies.shapes import Shape, Sphere
from carom.quantities.arrays import Array, numbers
from carom.quantities.prefixes import text
from carom.quantities.refusals import Faults, checked_type, known_keywords, refusal, refuse
from carom.quantities.units import Value, positive

INERTIAS = "must be a positive number in kg m^2, or in space a symmetric 3 x 3 matrix of them"
HEAVY = "of no body: each principal moment is at most the sum of both others"
PLACE = "must be finite, x and z in m from the centre of mass, or in space x, y and z"
CURVED = "must be two numbers in 1/m, along x and y, or a symmetric 2 x 2 matrix of them"
ROUNDING = 1e-9  # of the largest moment, by which moments may miss the inequality of triangles
SYMMETRIC = 1e-12
PARTS = "the surfaces must part on all sides: both must be positive"
ALIKE = "give both bodies in a plane, or both in space, with inertias of 3 x 3"
SPACE = "in a plane of symmetry one axis of the contact is along x; give bodies in space"


@dataclass(frozen=True, init=False)
class Body(Shape):
    """A rigid body of any smooth shape, which is touched at one place, perhaps off its centre.

        V = v + omega x r, B = (1/M) 1 - [r] I^-1 [r]

    B is the inverse mass at the contact, r its place (Stronge 2000, section 3.1). The wall is
    across z, which points from the second body to the first. With an inertia about y alone the body
    is struck in a plane of symmetry, that of x and z. A body without a mass does not move: a wall
    that is curved, such as a rail along y with curvatures 1/R and 0, or a groove with -1/R and 0.

    Parameters
    ----------
    material : Material or str
        Material of the body, or the name of a material of the catalogue.
    mass : float or str, optional
        Mass M in kg.
    inertia : float or array_like, shape (3, 3), optional
        Moment of inertia about y through the centre of mass in kg m^2, or the tensor of inertia.
    contact : array_like, shape (2,) or (3,), optional
        Place (x, z) of the contact from the centre of mass in m, z < 0 for a contact below; in
        space (x, y, z).
    curvature_radius : float or str, optional
        Radius of curvature at the contact in m.
    curvatures : array_like, shape (2,) or (2, 2), optional
        Curvatures there along x and y in 1/m instead, negative where the body is hollow; or the
        matrix of them, if its axes are others.
    name : str, optional
        What it is, as "club", in results.

    Raises
    ------
    InputError
        If mass or inertia are missing or not positive, or not those of a body, numbers have a wrong
        shape, or the curvature is given in two ways or in none.

    Examples
    --------
    >>> size = {"mass": "10 g", "inertia": 8.3e-6, "curvature_radius": "3 mm"}
    >>> rod = carom.Body(**size, contact=(0.03, -0.04), material="steel")
    >>> round(float(rod.inverse_mass[0, 2]), 1)  # b_nt
    -144.6
    """

    material: Material
    mass: float | None
    inertia: float | tuple[tuple[float, ...], ...] | None
    contact: tuple[float, ...] | None
    curvatures: tuple[tuple[float, float], tuple[float, float]]
    name: str | None

    @known_keywords
    def __init__(
        self,
        *,
        material: Material | str,
        mass: Value | None = None,
        inertia: Value | ArrayLike | None = None,
        contact: ArrayLike | None = None,
        curvature_radius: Value | None = None,
        curvatures: ArrayLike | None = None,
        name: str | None = None,
    ) -> None:
        of_motion = {"mass": mass, "inertia": inertia, "contact": contact}
        missing = [name for name, value in of_motion.items() if value is None]
        readers: dict[str, Any] = {"mass": positive, "inertia": _inertia, "contact": _place}
        with Faults() as faults:
            stuff = faults.trying(as_material, material)
            bent = faults.trying(_curvatures, curvature_radius, curvatures)
            for key in missing if len(missing) < len(of_motion) else ():
                faults.add(f"{key}: missing; a body that moves has mass, inertia and contact")
            read = {key: faults.if_given(readers[key], key, of_motion[key]) for key in of_motion}
            faults.trying(checked_type, "name", name, (str, NoneType), "must be a text")
            if read["inertia"] is not None and read["contact"] is not None:
                planar = isinstance(read["inertia"], float)
                if planar != (len(read["contact"]) == 2):
                    faults.add(f"contact: {PLACE}, with an inertia of 3 x 3")
                if planar and bent and bent[0][1]:
                    faults.add("curvatures: in a plane of symmetry one of them is along x")
        set_fields(self, **read, material=stuff, curvatures=bent, name=name)

    @property
    def is_planar(self) -> bool:
        """Whether it moves in a plane of symmetry, or not at all."""
        return self.inertia is None or isinstance(self.inertia, float)

    @property
    def place(self) -> Array:
        """Place (x, y, z) of the contact from the centre of mass, in m."""
        x, *y, z = self.contact or (0.0, 0.0)
        return np.array([x, *(y or [0.0]), z])

    @property
    def reach(self) -> float:
        """Distance of the contact from the centre of mass, in m."""
        return float(np.linalg.norm(self.place))

    @property
    def slenderness(self) -> float:
        """Largest radius of gyration over the smallest radius of curvature at the contact."""
        sharpest = np.abs(np.linalg.eigvalsh(self.curvatures)).max()
        return float(np.sqrt(np.linalg.eigvalsh(self.tensor).max() / (self.mass or 1.0)) * sharpest)

    @property
    def tensor(self) -> Array:
        """Tensor of inertia, in kg m^2; about y alone in a plane."""
        moments = np.asarray(self.inertia or 0.0, dtype=np.float64)
        return moments if moments.ndim else np.diag([0.0, float(moments), 0.0])

    @property
    def turning(self) -> Array:
        """Inverse of the tensor of inertia, in 1/(kg m^2); about y alone in a plane."""
        if self.inertia is None:
            return np.zeros((3, 3))
        if isinstance(self.inertia, float):
            return np.diag([0.0, 1.0 / self.inertia, 0.0])
        return np.asarray(np.linalg.inv(self.inertia))

    @property
    def inverse_mass(self) -> Array:
        """Inverse mass B at the contact along x, y and the normal into the wall, in 1/kg."""
        if self.mass is None:
            return np.zeros((3, 3))
        x, y, z = self.place
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        into = np.diag([1.0, 1.0, -1.0])
        return np.asarray(into @ (np.eye(3) / self.mass - cross @ self.turning @ cross) @ into)

    def __str__(self) -> str:
        stuff = self.material.name or f"E = {text(self.material.young, 'Pa')}"
        if self.mass is None:
            return f"{self.name or 'curved wall'} ({stuff})"
        return f"{self.name or 'body'} ({stuff}, M = {text(self.mass, 'kg')})"


def _inertia(name: str, value: Any) -> float | tuple[tuple[float, ...], ...]:
    tensor = numbers(name, value, INERTIAS)
    if tensor.ndim == 0:
        return positive(name, value)
    scale = float(np.abs(tensor).max()) if tensor.shape == (3, 3) else 0.0
    if not 0.0 < scale < np.inf or np.abs(tensor - tensor.T).max() > SYMMETRIC * scale:
        raise refusal(name, value, INERTIAS)
    moments = np.linalg.eigvalsh(tensor)
    if not moments[0] > 0.0:
        raise refusal(name, value, f"{INERTIAS}; its principal moments must be positive")
    if moments[2] > (1.0 + ROUNDING) * (moments[0] + moments[1]):
        raise refusal(name, value, HEAVY)
    return tuple(map(tuple, tensor.tolist()))


def _place(name: str, value: Any) -> tuple[float, ...]:
    values = numbers(name, value, PLACE)
    if values.shape not in ((2,), (3,)) or not np.all(np.isfinite(values)):
        raise refusal(name, value, PLACE)
    return tuple(values.tolist())


def _curvatures(radius: Any, curvatures: Any) -> tuple[tuple[float, float], tuple[float, float]]:
    if (radius is None) == (curvatures is None):
        raise refusal("curvature_radius", radius, "give it, or curvatures, and not both")
    if radius is not None:
        sharp = 1.0 / positive("curvature_radius", radius)
        return (sharp, 0.0), (0.0, sharp)
    values = numbers("curvatures", curvatures, CURVED)
    tensor = np.diag(values) if values.shape == (2,) else values
    if tensor.shape != (2, 2) or not np.all(np.isfinite(tensor)) or tensor[0, 1] != tensor[1, 0]:
        raise refusal("curvatures", curvatures, CURVED)
    (xx, xy), (_, yy) = tensor.tolist()
    return (xx, xy), (xy, yy)


def as_body(shape: Shape, side: float) -> Body:
    """Return any shape as a body in space, touched below its centre (side -1) or above it."""
    if isinstance(shape, Body):
        return shape
    mass = inertia = contact = None
    if isinstance(shape, Sphere):
        mass, contact = shape.mass, (0.0, 0.0, side * shape.radius)
        moment = mass * shape.gyration_ratio * shape.radius**2
        inertia = tuple(map(tuple, (moment * np.eye(3)).tolist()))
    (xx, xy), (yx, yy) = (getattr(shape, "curvature", 0.0) * np.eye(2)).tolist()
    given = {"mass": mass, "inertia": inertia, "contact": contact, "name": None}
    return unchecked(Body, material=shape.material, curvatures=((xx, xy), (yx, yy)), **given)


def check_shapes(first: Any, second: Any, curvatures: Array) -> None:
    """Raise InputError if two bodies do not touch in an ellipse, or one moves in a plane alone."""
    bodies = [body for body in (first, second) if isinstance(body, Body)]
    free = [body for body in bodies if body.mass is not None]
    one, other = np.linalg.eigvalsh(curvatures).tolist()
    shown, planar = f"{one:.3g} and {other:.3g} 1/m together", all(b.is_planar for b in bodies)
    slanted, mixed = curvatures[0, 1] != 0.0, len({body.is_planar for body in free}) > 1
    refuse(
        not one > 0.0 and refusal("curvatures", shown, PARTS),
        mixed and refusal("inertia", free[0].inertia, ALIKE),
        planar and slanted and refusal("curvatures", str(curvatures.tolist()), SPACE),
    )


def axes_of(curvatures: Array) -> tuple[tuple[float, float], Array]:
    """Return both curvatures along the axes of a contact, and these as rows, the first near x."""
    if curvatures[0, 1] == 0.0:
        return (float(curvatures[0, 0]), float(curvatures[1, 1])), np.eye(2)
    values, vectors = np.linalg.eigh(curvatures)
    order = [0, 1] if abs(vectors[0, 0]) >= abs(vectors[0, 1]) else [1, 0]
    along = vectors[:, order[0]] * np.copysign(1.0, vectors[0, order[0]])
    return tuple(values[order].tolist()), np.array([along, [-along[1], along[0]]])
