"""A contact at one instant, with units: what happens at its surface, and the stress below it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import isnan, nan
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies.pairs import ContactScales, Pair, Scales
from carom.dimensionless.fields import peaks, surface
from carom.dimensionless.fields.profile import NO_PANELS, Profile, borne
from carom.dimensionless.fields.subsurface import COMPONENTS, stresses
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.numerics.chebyshev import evaluate
from carom.dimensionless.solution import Solution
from carom.dimensionless.states import now_at
from carom.io.labels import flags, labelled_dataset
from carom.quantities.arrays import Array, places
from carom.quantities.glossary import listed
from carom.quantities.prefixes import Printed, text
from carom.quantities.refusals import one_of, refusal, refuse

if TYPE_CHECKING:
    import xarray as xr

GRID_POINTS, GRID_REACH = 101, 1.5  # along x and y where none are asked for; in contact radii
STRESS_POINTS, STRESS_REACH = (101, 61), 2.0  # the same along x and z
FARTHEST, DEEPEST = 1e50, 1e300  # dimensionless; nothing changes beyond
TIME_ROUNDING = 8.0 * np.finfo(np.float64).eps  # of a time that has passed through seconds
RADIUS_ROUNDING = 8.0 * np.finfo(np.float64).eps
OUTSIDE, STICK, SLIP = 0, 1, 2
ZONES = {"long_name": "zone of the contact", **flags(("outside", "stick", "slip"))}
BODIES = ("first", "second")
BELOW_EDGE = 0.02  # contact radii: where stresses begin if those at the edge are infinite
NOTHING = Profile(np.zeros(1), NO_PANELS, NO_PANELS)  # of a contact that is a point
Places = ArrayLike | None


@dataclass(frozen=True, eq=False)
class Contact(Printed):
    """The contact of a pair at one instant, of an impact or on a load path; made by `contact`.

    `penetration`, `displacement`, `stick_radius` and `profile` are dimensionless; `scales` gives
    them units. `attributes` hold the phase and the inputs.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> path = carom.load_path(pair, normal_force="10 N", tangential_force=1.0)
    >>> round(1e6 * path.contact().radius, 1)  # in micrometres
    68.8
    """

    pair: Pair
    scales: ContactScales
    penetration: float
    displacement: float
    stick_radius: float
    profile: Profile = field(repr=False)
    _slid: Callable[[Array], Array] = field(repr=False)  # in m, radial functions of radii
    _slipping: Callable[[Array], Array] | None = field(default=None, repr=False)  # in m/s
    _edge: float = field(default=nan, repr=False)  # its radius, and the pressure's density there
    _rim: float = field(default=0.0, repr=False)
    _viscous: bool = field(default=False, repr=False)  # surfaces have moved by what acted before
    _scalars: Mapping[str, float] = field(default_factory=dict, repr=False)
    attributes: Mapping[str, Any] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        if isnan(self._edge):  # that of elastic bodies
            object.__setattr__(self, "_edge", float(np.sqrt(self.penetration)))

    @property
    def radius(self) -> float:
        """Radius of the contact, in m."""
        return self._edge * self.scales.radius

    def numbers(self) -> dict[str, float]:
        """Return the numbers that describe the contact by name, in SI units."""
        return {
            "friction": self.pair.friction,
            "penetration": self.penetration * self.scales.length,
            "displacement": self.displacement * self.scales.tangential_length,
            "contact_radius": self.radius,
            "stick_radius": self.stick_radius * self.scales.radius,
            **self._scalars,
        }

    def __str__(self) -> str:
        phase = f"{self.attributes['phase_kind']} {' +-'[self.attributes['phase_sign']]}"
        return "\n".join([f"Contact, {phase}".rstrip(), *listed(self.numbers())])


def contact_in_impact(
    pair: Pair,
    scales: Scales,
    drift: float,
    solution: Solution | LossySolution,
    time: float,
    attributes: Mapping[str, Any],
) -> Contact:
    """Return the contact at a time in s of an impact; `drift` is V_x where no friction acts."""
    instant = _at_change(time / scales.time, solution)
    phase = solution.phase_at(instant)
    kind, sign = ("gross slip", int(np.sign(drift))) if drift else (phase.kind, phase.sign)
    now, state = now_at(solution.at(instant)), solution.contact_at(instant)
    # At the first touch and at separation nothing is pressed, whatever rounding leaves of it.
    if not 0.0 < instant < solution.duration:
        state = state._replace(radius=0.0, rim=0.0, profile=NOTHING)

    def slid(radii: Array) -> Array:
        if drift:
            return freely_slid(radii)
        return state.slid(radii) * scales.tangential_length

    def freely_slid(radii: Array) -> Array:
        inside = radii <= state.radius
        slip = drift * (instant - solution.touched(radii * inside)) * scales.time * inside
        return np.column_stack((slip, np.zeros(radii.size)))

    def slipping(radii: Array) -> Array:
        if drift:
            return np.column_stack((np.full(radii.size, drift), np.zeros(radii.size)))
        return state.slipping(radii) * scales.tangential_speed

    return Contact(
        pair,
        scales,
        penetration=now["penetration"],
        displacement=now["displacement"],
        stick_radius=0.0 if drift else now["stick_radius"],
        profile=state.profile,
        _slid=slid,
        _slipping=slipping,
        _edge=state.radius,
        _rim=state.rim,
        _viscous=isinstance(solution, LossySolution),
        _scalars={
            "time": time,
            "displacement": now["displacement"] * scales.tangential_length + drift * time,
            "normal_force": now["normal_force"] * scales.force,
            "tangential_force": now["force"] * scales.tangential_force,
        },
        attributes={"phase_kind": kind, "phase_sign": sign, **attributes},
    )


def _at_change(instant: float, solution: Solution | LossySolution) -> float:
    """Return the instant, or that of a change of phase that differs only by rounding."""
    for change in (*(phase.start for phase in solution.phases), solution.duration):
        if abs(instant - change) <= TIME_ROUNDING * change:
            return change
    return instant


def surface_fields(
    contact: Contact, x: Places = None, y: Places = None, points: Places = None
) -> "xr.Dataset":
    """Return what `InContact.fields` does, of any contact."""
    reach = GRID_REACH * (contact.radius or contact.scales.radius)
    side = np.linspace(-reach, reach, GRID_POINTS)
    dims, coords, at = places("xy", {"x": x, "y": y}, {"x": side, "y": side}, points)
    px, py = np.moveaxis(at, -1, 0)
    r = _distances(contact, px, py)
    unique, back = np.unique(r, return_inverse=True)
    radial = _radial(contact, unique)[back.reshape(r.shape)]
    angle = 2.0 * np.arctan2(py, px)
    columns = _columns(contact, r, radial, np.cos(angle), np.sin(angle))
    variables = {name: (dims, values) for name, values in columns.items()}
    zone = (dims, _zones(contact, r), ZONES)
    attrs = {"title": "contact seen from above", **contact.attributes}
    return labelled_dataset({**variables, "zone": zone, **contact.numbers()}, coords, attrs)


def radial_fields(contact: Contact, n: int = 401) -> "xr.Dataset":
    """Return pressure, traction and memory at n distances from the centre of the contact."""
    r = np.linspace(0.0, contact._edge, n)
    values, memory = _radial(contact, r), _memory(contact, r)
    limit = contact.pair.friction * contact.scales.pressure
    deflection = contact.scales.tangential_length
    columns = {
        "pressure": values[:, 0] * contact.scales.pressure,
        "friction_limit": values[:, 0] * limit if limit else np.zeros(n),  # not 0 times infinity
        "traction_x": values[:, 1] * limit,
        "memory_g": memory[:, 0],
        "memory_q": memory[:, 1] * deflection,
        "memory_limit": (borne(contact.profile, r) + contact._rim) * deflection,
    }
    variables: dict[str, Any] = {name: ("distance", value) for name, value in columns.items()}
    return labelled_dataset(
        {**variables, "zone": ("distance", _zones(contact, r), ZONES), **contact.numbers()},
        {"distance": r * contact.scales.radius},
        {"title": "contact along a radius", **contact.attributes},
    )


def _distances(contact: Contact, px: Array, py: Array) -> Array:
    """Return dimensionless distances from the centre, those at the edge freed from rounding."""
    with np.errstate(over="ignore"):
        r = np.minimum(np.hypot(px, py) / contact.scales.radius, FARTHEST)
    edge = contact._edge
    return np.where(np.abs(r - edge) <= RADIUS_ROUNDING * edge, edge, r)


def _radial(contact: Contact, r: Array) -> Array:
    """Return pressure, traction, u_z, u_0, u_2, w_0, w_2 for dimensionless radii."""
    out = np.empty((r.size, 5))
    d = contact.penetration
    square = contact._edge**2 if contact._viscous or not contact._edge else d
    surface.sample(contact.profile, d, square, contact._rim, r, out)
    return np.hstack((out, contact._slid(r)))


def _memory(contact: Contact, r: Array) -> Array:
    edges, q, g = contact.profile[:3]
    if len(g) == 0:
        return np.zeros((r.size, 2))
    panels = np.clip(np.searchsorted(edges, r) - 1, 0, len(g) - 1)
    rows = (
        [evaluate(row[i], edges[i], edges[i + 1], at) for row in (g, q)]
        for i, at in zip(panels, r, strict=True)
    )
    return np.array(list(rows))


def _columns(contact: Contact, r: Array, radial: Array, cos: Array, sin: Array) -> dict[str, Array]:
    pair, scales = contact.pair, contact.scales
    p, f, u_z, u_0, u_2, w_0, w_2 = np.moveaxis(radial, -1, 0)
    lateral, unit = pair.lateral_ratio, scales.tangential_length
    columns = {
        "pressure": p * scales.pressure,
        "traction_x": f * pair.friction * scales.pressure,
        "slip_x": w_0 - lateral * w_2 * cos,
        "slip_y": -lateral * w_2 * sin,
    }
    if not contact._viscous:
        columns["displacement_x"] = unit * (u_0 + lateral * u_2 * cos)
        columns["displacement_y"] = unit * lateral * u_2 * sin
        columns["displacement_z"] = u_z * scales.length
    if contact._slipping is not None:
        v_0, v_2 = np.moveaxis(_within(contact, r, contact._slipping), -1, 0)
        columns["slip_velocity_x"] = v_0 - lateral * v_2 * cos
        columns["slip_velocity_y"] = -lateral * v_2 * sin
    return columns


def _within(contact: Contact, r: Array, radial: Callable[[Array], Array]) -> Array:
    """Return radial functions at distances, each asked for once, zero outside the contact."""
    unique, back = np.unique(r, return_inverse=True)
    inside = _in_contact(contact, unique)[:, np.newaxis]
    return np.asarray((radial(unique) * inside)[back.ravel()].reshape(*r.shape, 2))


def _zones(contact: Contact, r: Array) -> NDArray[np.int8]:
    a = contact.stick_radius
    zones = np.where((r <= a) & (a > 0.0), STICK, SLIP)
    return np.where(_in_contact(contact, r), zones, OUTSIDE).astype(np.int8)


def _in_contact(contact: Contact, r: Array) -> NDArray[np.bool_]:
    return np.asarray((r <= contact._edge) & (contact._edge > 0.0))


def stress_dataset(
    contact: Contact, x: Places, z: Places, points: Places, body: str
) -> "xr.Dataset":
    """Return what `InContact.stress` does, of any contact."""
    friction, poisson = _of_body(contact, body)
    reach = STRESS_REACH * (contact.radius or contact.scales.radius)
    top = BELOW_EDGE * contact.radius if contact._rim else 0.0
    default = {
        "x": np.linspace(-reach, reach, STRESS_POINTS[0]),
        "z": np.linspace(top, reach, STRESS_POINTS[1]),
    }
    dims, coords, at = places("xyz", {"x": x, "z": z}, default, points)
    _refuse_outside("z" if points is None else "points", at[..., 2], top)

    of_body: Any = {"friction": friction, "poisson": poisson, "rim": contact._rim}
    with np.errstate(over="ignore"):
        where = np.clip(at.reshape(-1, 3) / contact.scales.radius, -DEEPEST, DEEPEST)
    stress = contact.scales.pressure * stresses(where, contact.profile, **of_body)
    columns = {
        name: (dims, v.reshape(at.shape[:-1])) for name, v in _stress_columns(stress).items()
    }
    shallow = BELOW_EDGE if contact._rim else 0.0
    mises = peaks.largest(peaks.VON_MISES, contact.profile, **of_body, shallow=shallow)
    numbers = _entries(contact, "max_von_mises", mises)
    if not contact._rim:
        tension = peaks.largest(peaks.TENSION, contact.profile, **of_body, deepest=0.0)
        numbers |= _entries(contact, "max_tension", tension)
    return labelled_dataset(
        {**columns, **numbers, **contact.numbers(), "poisson": poisson},
        coords,
        {"title": f"stress in the {body} body", "body": body, **contact.attributes},
    )


def _stress_columns(stress: Array) -> dict[str, Array]:
    principal = peaks.principal_stresses(stress)
    columns = {f"sigma_{name}": stress[:, i] for i, name in enumerate(COMPONENTS)}
    columns |= {f"principal_{i + 1}": principal[:, i] for i in range(3)}
    columns["von_mises"] = peaks.von_mises(stress)
    columns["max_shear"] = 0.5 * (principal[:, 0] - principal[:, 2])
    return columns


def _entries(contact: Contact, name: str, peak: peaks.Largest) -> dict[str, float]:
    place = {f"{name}_{c}": getattr(peak, c) * contact.scales.radius for c in "xyz"}
    return {name: peak.value * contact.scales.pressure, **place}


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
    lowest = float(depth.min(initial=np.inf))
    allowed = "z is the depth in the body and must not be negative"
    if top:
        what = "stresses are infinite at the edge while the load grows"
        allowed = f"{what}; give z from {text(top, 'm', 3)} on"
    refuse(lowest < max(top, 0.0) and refusal(name, f"z = {text(lowest, 'm')}", allowed))
