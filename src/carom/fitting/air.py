"""Air: by how much its drag falsifies a restitution from heights, or from times of bounces."""

from collections.abc import Collection, Mapping

import numpy as np

from carom.bodies.pairs import Pair
from carom.fitting.bounces import AFTER, BEFORE, INTERVAL, TIME
from carom.impacts.validity import GRAVITY
from carom.io.user_table import UserTable
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError

DRAG, DENSITY, VISCOSITY = 0.45, 1.2, 1.5e-5  # at high speed; kg/m^3; kinematic, m^2/s
LARGEST_REYNOLDS = 1e5  # to which the drag coefficient of a sphere holds
MOST_TAKEN = 0.1  # part of a restitution, beyond which the first order in drag does not suffice
THIN = 2e-3  # part of a restitution that air may take unsaid


def taken_by_air(speeds: Mapping[str, Array], flown: Collection[str], pair: Pair) -> float:
    """Return by which part of itself a restitution from heights or times is too small.

    A flight that begins or ends at V loses the part f = (2/V^2) int a(v) v dv/g of its energy, to
    first order in the deceleration a by drag: speeds of a drop are V (1 - f/2), those of a rise
    V (1 + f/2), and e is larger by (f + f')/2; for heights as for times between bounces.
    """
    return 0.5 * sum(lost_in_flight(float(np.nanmedian(speeds[name])), pair) for name in flown)


def lost_in_flight(speed: float, pair: Pair) -> float:
    """Return f of a flight that begins or ends at this speed; drag by Schiller & Naumann (1935)."""
    v = np.linspace(0.0, speed, 201)[1:]
    area = np.pi * pair.first.radius**2
    number = reynolds(v, pair)
    coefficient = np.maximum(24.0 * (1.0 + 0.15 * number**0.687) / number, DRAG)
    drag = 0.5 * coefficient * DENSITY * area * v**2
    return float(2.0 * np.trapezoid(drag * v, v) / (pair.first.mass * GRAVITY * speed**2))


def reynolds(speed: Array, pair: Pair) -> Array:
    """Return the Reynolds numbers of a ball in air."""
    return 2.0 * pair.first.radius * speed / VISCOSITY


def about_air(rows: UserTable, named: set[str], pair: Pair) -> list[str]:
    """Return by how much air falsifies a restitution that comes from heights or times.

    Raises InputError for times where that is too much, or not known.
    """
    timed = bool({INTERVAL, TIME} & named)
    before = {BEFORE} if "drop_height" in named or (timed and BEFORE not in named) else set()
    after = {AFTER} if timed or "rebound_height" in named else set()
    flown = before | after
    if not flown or "normal_restitution" in rows.columns:
        return []
    fastest = max(float(np.nanmax(reynolds(rows[name], pair))) for name in flown)
    part = taken_by_air(rows.columns, flown, pair)
    doubt = ""
    if fastest > LARGEST_REYNOLDS:
        doubt = f"the Reynolds number reaches {fastest:.2g}, and drag is known to 1e5"
    elif part > MOST_TAKEN:
        doubt = f"drag takes more than {100.0 * MOST_TAKEN:g} % of the restitution"
    if doubt and timed:
        raise InputError(f"{INTERVAL}: {doubt}; measure speeds, normal_speed and normal_speed_out")
    if doubt:
        return [f"air: {doubt}, so that heights do not give it; measure the speeds"]
    if part < THIN:
        return []
    return [f"air: drag makes the restitution about {100.0 * part:.2g} % of its value too small"]
