"""Conversion between published observables of a rebound, such as angles, spins and impulses."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import nan, pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.checks import checked_pair
from carom.bodies.kinematics import Rebound, Tangential, components, inertia
from carom.bodies.pairs import Pair
from carom.bodies.shapes import Sphere
from carom.quantities.arrays import Array, along_the_same, numbers, refuse_where, together
from carom.quantities.refusals import checked_type, heading, hint, known_keywords, refusal, refuse

Quantities = Mapping[str, Any]  # arrays by name

INCIDENCE = ("tangential_speed", "angle", "contact_angle", "psi_in")
BEFORE = ("speed", "normal_speed", *INCIDENCE, "spin", "spin2")
NORMAL = ("normal_restitution", "normal_speed_out")
IMPULSE: dict[str, Callable[[Rebound, Array], Any]] = {  # J_t, from what is known of after
    "tangential_speed_out": lambda r, x: r.pair.normal_mass * (r.tangential_speed - x),
    "tangential_restitution": lambda r, x: r.pair.normal_mass * r.tangential_speed * (1.0 - x),
    "rebound_angle": lambda r, x: (
        r.pair.normal_mass * (r.tangential_speed - np.tan(x) * r.normal_speed_out)
    ),
    "spin_out": lambda r, x: _turning(r.pair.first, r.spin - x),
    "spin2_out": lambda r, x: _turning(r.pair.second, r.spin2 - x),
    "contact_restitution": lambda r, x: r.pair.tangential_mass * r.contact_velocity * (1.0 - x),
    "contact_beta": lambda r, x: r.pair.tangential_mass * r.contact_velocity * (1.0 + x),
    "contact_rebound_angle": lambda r, x: (
        r.pair.tangential_mass * (r.contact_velocity - np.tan(x) * r.normal_speed_out)
    ),
    "impulse_ratio": lambda r, x: x * r.normal_impulse,
    "psi_out": lambda r, x: (
        r.pair.tangential_mass * (r.contact_velocity - x * _psi_unit(r.pair, r.normal_speed))
    ),
}
SPEED = "rebound_speed"  # of both parts of the motion after
OBSERVABLES = (*NORMAL, *IMPULSE, SPEED)
NAMES = (*BEFORE, *OBSERVABLES)
SPEED_TOLERANCE = 1e-9  # relative
SLOWEST, FASTEST = 1e-12, 1e9  # normal speeds in m/s that measurements and programs may have
SCALED = {name for name in NAMES if "spin" in name or "speed" in name}  # not a ratio or an angle
RECEDING = (  # these need e
    *("rebound_angle", "contact_rebound_angle", "impulse_ratio", SPEED, *NORMAL),
)
RELATIVE = {  # these say nothing where there was nothing before
    "tangential_restitution": "tangential_speed",
    "contact_restitution": "contact_velocity",
    "contact_beta": "contact_velocity",
}


@known_keywords
def convert_observables(pair: Pair, *, known: Mapping[str, ArrayLike], wanted: str) -> Any:
    """Return one quantity of a rebound from others that determine it.

        J_t = m_n (v_t - v_t') = m_t (V_x - V_x')
        J_t = I_1 (omega - omega')/R_1 = I_2 (omega_2 - omega_2')/R_2

    One tangential observable after the impact, with the normal restitution where it is needed,
    gives the tangential impulse J_t, from which all others follow. psi = kappa V_x/(mu V_1) is the
    dimensionless velocity of Maw, Barber & Fawcett (1976).

    Parameters
    ----------
    pair : Pair
        The bodies. Their friction and stiffness matter only for psi.
    known : mapping
        Numbers or arrays that broadcast, by name, in SI units or with a unit; masked values and NaN
        give NaN. Before the impact: speed and angle, or normal_speed and one of tangential_speed,
        angle, contact_angle, psi_in; and spin and spin2, by default zero. No speed is needed to
        convert between ratios and angles.
        After the impact: normal_restitution or normal_speed_out, and one of tangential_speed_out,
        spin_out, spin2_out, rebound_angle (of the centre), contact_rebound_angle (of the contact
        point), tangential_restitution (v_t'/v_t), contact_restitution (V_x'/V_x), contact_beta
        (-V_x'/V_x), impulse_ratio (J_t/J_n), psi_out. The rebound_speed V' of the centre suffices
        if only one sign of v_t' is possible, 0 <= J_t <= 2 m_t V_x, or with rebound_angle.
    wanted : str
        One of these names.

    Returns
    -------
    float or numpy.ndarray
        The wanted quantity in SI units, angles in rad, of the broadcast shape; a number if all
        known values are numbers.

    Raises
    ------
    InputError
        If a name is unknown, a value is out of range, or the known values do not determine the
        wanted quantity or determine it twice.

    Examples
    --------
    >>> ball = carom.Sphere(radius="2.5 mm", material="alumina")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="soda-lime-glass"), friction=0.092)
    >>> known = {"speed": 3.9, "angle": ["20 deg", "40 deg"], "tangential_restitution": [0.6, 0.78]}
    >>> carom.convert_observables(pair, known=known, wanted="spin_out").round(1)
    array([-533.6, -551.5])
    """
    checked_pair(pair, plates=True)
    checked_type("known", known, Mapping, "must be values by name, e.g. {'speed': 2, 'angle': 0.5}")
    quantities = {name: _values(name, value) for name, value in known.items()}
    along_the_same(**{str(name): value for name, value in known.items()})
    _check_name("wanted", wanted)
    _check_bodies(pair, {*quantities, wanted})
    shape = together(quantities)
    with np.errstate(all="ignore"):
        result = np.asarray(getattr(_rebound(pair, quantities, wanted), wanted))
    large = "known: the results are too large for floating point; check the units"
    refuse(np.isinf(result).any() and large)
    return np.broadcast_to(result, shape).copy() if shape else result.item()


def _check_name(where: str, name: Any) -> None:
    text = name if isinstance(name, str) else ""
    if text not in NAMES:
        words = f"unknown quantity; {hint(text, NAMES)}"
        refuse(f"{heading(text)}: {words}" if text.strip() else refusal(where, name, words))


def _values(name: str, value: Any) -> Array:
    """Return the values of one quantity, or raise InputError."""
    _check_name("known", name)
    values = numbers(name, value, "must be numbers, or text with a unit", gaps=True)
    if "angle" in name:
        refuse_where(name, values, abs(values) >= 0.5 * pi, "must be below pi/2, '90 deg'")
    elif name in ("speed", "normal_speed", SPEED, *NORMAL):
        refuse_where(name, values, values <= 0.0, "must be positive")
    refuse_where(name, values, np.isinf(values), "must be finite")
    return values


def _check_bodies(pair: Pair, names: set[str]) -> None:
    """Raise InputError for quantities that such bodies do not have."""
    spins = names & {"spin2", "spin2_out"} if not isinstance(pair.second, Sphere) else set()
    psis = names & {"psi_in", "psi_out"} if pair.friction == 0.0 else set()
    refuse(
        *(f"{each}: only a second sphere can spin; leave it out" for each in sorted(spins)),
        *(f"{n}: it is infinite without friction; give the pair a friction" for n in sorted(psis)),
    )


def _resolved(quantities: Quantities) -> Quantities:
    """Return speed and angle after as the two velocities that they are."""
    both = (SPEED, "rebound_angle")
    if not quantities.keys() >= set(both):
        return quantities
    twice = [name for name in OBSERVABLES if name in quantities and name not in both]
    ends = f"known: {' and '.join(both)} determine the rebound"
    refuse(twice and f"{ends}; leave {' and '.join(twice)} out")
    normal, tangential = components(*(quantities[name] for name in both))
    others = {name: value for name, value in quantities.items() if name not in both}
    return {**others, "normal_speed_out": normal, "tangential_speed_out": tangential}


def _rebound(pair: Pair, quantities: Quantities, wanted: str) -> Rebound:
    """Return the rebound, with NaN for what is not known of it and not wanted."""
    normal, before = _before(pair, quantities, wanted)
    quantities = _resolved(quantities)
    start = Rebound(pair, normal, *before, _restitution(normal, quantities), 0.0)
    if wanted in BEFORE:
        return start
    ways = _one_of("the rebound", quantities, (*IMPULSE, SPEED)) if wanted not in NORMAL else ""
    needing = [name for name in (ways, wanted) if name in RECEDING]
    lacking = needing and not quantities.keys() & set(NORMAL)
    nothing = ways in RELATIVE and np.any(np.asarray(getattr(start, RELATIVE[ways])) == 0.0)
    refuse(
        lacking and f"normal_restitution: missing; {needing[0]} needs it, e.g. 0.98",
        nothing
        and f"{ways}: it is undefined where {RELATIVE[ways]} is zero; give another, e.g. spin_out",
    )
    if not ways:
        return start
    if ways == SPEED:
        return replace(start, impulse=_slowing(start, quantities[SPEED]))
    return replace(start, impulse=IMPULSE[ways](start, quantities[ways]))


def _slowing(start: Rebound, speed: Array) -> Any:
    """Return the tangential impulse that leaves this speed of the centre, v_t' = +-sqrt(...).

    Of the two signs friction allows one that opposes the sliding and does not more than turn it,
    0 <= J_t <= 2 m_t V_x, to which scatter may come near from outside.
    """
    normal, before = start.normal_speed_out, start.tangential_speed
    slow = speed < normal * (1.0 - SPEED_TOLERANCE)
    refuse_where(SPEED, speed, slow, "it is below the normal speed after")
    along = np.sqrt(np.maximum((speed - normal) * (speed + normal), 0.0))
    ratio = start.pair.tangential_mass / start.pair.normal_mass
    ends = before, before - 2.0 * (ratio * start.contact_velocity)
    low, high = np.minimum(*ends), np.maximum(*ends)
    on, back = (np.maximum(low - x, x - high) for x in (along, -along))  # how far outside
    unsure = (np.maximum(on, back) <= 0.0) & (along > SPEED_TOLERANCE * speed)
    refuse_where(SPEED, speed, unsure, "the centre may go on or turn back; give rebound_angle, too")
    return start.pair.normal_mass * (before - np.where(on <= back, along, -along))


def _one_of(what: str, quantities: Quantities, names: tuple[str, ...]) -> str:
    """Return the one of some names that is given, or raise InputError."""
    there = [name for name in names if name in quantities]
    problem = f"determined by {' and '.join(there)}" if there else "not determined"
    refuse(len(there) != 1 and f"known: {what} is {problem}; give one of {', '.join(names)}")
    return there[0]


def _before(pair: Pair, quantities: Quantities, wanted: str) -> tuple[Any, Tangential]:
    """Return the normal speed and the tangential motion before."""
    spins = (quantities.get("spin", np.zeros(())), quantities.get("spin2", np.zeros(())))
    way = _one_of("the tangential motion before", quantities, INCIDENCE)
    if "speed" in quantities:
        mixed = way != "angle" or "normal_speed" in quantities
        refuse(mixed and "speed: give it with angle alone, or give normal_speed instead")
        normal, tangential = components(quantities["speed"], quantities["angle"])
        return normal, Tangential(tangential, *spins)
    scaled = sorted(SCALED & {*quantities, wanted})
    lacking = scaled and "normal_speed" not in quantities
    refuse(lacking and f"speed: missing; {scaled[0]} needs speed and angle, or normal_speed")
    normal = quantities.get("normal_speed", np.ones(()))
    moved = quantities[way]
    if way != "tangential_speed":
        moved = moved * _psi_unit(pair, normal) if way == "psi_in" else normal * np.tan(moved)
    if way in ("contact_angle", "psi_in"):
        moved = moved - Tangential(0.0, *spins).contact_velocity(pair)
    return normal, Tangential(moved, *spins)


def _restitution(normal: Any, quantities: Quantities) -> Any:
    """Return the normal restitution, NaN if nothing is known of it."""
    both = quantities.keys() >= set(NORMAL)
    refuse(both and f"known: {' and '.join(NORMAL)} mean the same; give one of them")
    if "normal_speed_out" in quantities:
        return quantities["normal_speed_out"] / normal
    return quantities.get("normal_restitution", nan)


def _turning(body: Any, change: Any) -> Any:
    """Return the tangential impulse that changes the spin of a body by this."""
    return inertia(body) * change / body.radius


def _psi_unit(pair: Pair, normal_speed: Any) -> Any:
    """Return the velocity of the contact point at psi = 1."""
    return pair.scales(normal_speed).tangential_speed
