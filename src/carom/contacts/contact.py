"""A contact at one instant, with units: what fields and stresses are made from."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import isnan, nan
from typing import Any

import numpy as np

from carom.bodies.pairs import ContactScales, Pair, Scales
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.solution import Solution
from carom.dimensionless.states import now_at
from carom.quantities.arrays import Array
from carom.quantities.glossary import listed
from carom.quantities.prefixes import Printed

TIME_ROUNDING = 8.0 * np.finfo(np.float64).eps  # of a time that has passed through seconds


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
