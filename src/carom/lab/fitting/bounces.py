"""Bounces of a ball that is dropped: heights, times between them, several in a row; air drag."""

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace

import numpy as np

from carom.bodies.pairs import Pair
from carom.impacts.validity import GRAVITY
from carom.io.user_table import ERROR, UserTable, in_units
from carom.quantities.arrays import Array
from carom.quantities.refusals import Faults, InputError

HEIGHTS = {"drop_height": "normal_speed", "rebound_height": "normal_speed_out"}
INTERVAL, TIME = "bounce_interval", "bounce_time"
BOUNCES = (*HEIGHTS, INTERVAL, TIME)
BEFORE, AFTER = HEIGHTS.values()
AFTERWARDS = ("rebound_height", INTERVAL, AFTER)  # each tells the speed after a bounce
NUMBERED = re.compile(rf"({'|'.join(AFTERWARDS)})_([2-9]|[1-9]\d)({ERROR})?")
SHORT = re.compile(rf"h(\d|[1-9]\d)({ERROR})?")  # h0, h1, h2: successive heights
PLACE = "place of a bounce"  # column of whole numbers: the next bounce of a drop has the next one
TWICE = ("speed", "angle", "tangential_speed", "contact_angle", "psi_in")  # besides heights
MOST_RESTITUTION = 1.5  # that scatter may reach; beyond it is a percentage, or another unit
MOST_GROWTH = 1.1  # of an interval over the one before it: beyond, a bounce was missed
HIGHEST, LONGEST = 10.0, 3.0  # m and s, beyond which a unit is asked about
DRAG, DENSITY, VISCOSITY = 0.45, 1.2, 1.5e-5  # at high speed; kg/m^3; kinematic, m^2/s
LARGEST_REYNOLDS = 1e5  # to which the drag coefficient of a sphere holds
MOST_TAKEN = 0.1  # part of a restitution, beyond which the first order in drag does not suffice
THIN = 2e-3  # part of a restitution that air may take unsaid


def base(name: str) -> str:
    """Return the quantity in a column of a later bounce, as rebound_height in rebound_height_2."""
    match = NUMBERED.fullmatch(_long(name))
    return match[1] + (match[3] or "") if match else _long(name)


def _long(name: str) -> str:
    """Return the full name of h0, h1, h2: heights of a drop and of the rebounds that follow."""
    match = SHORT.fullmatch(name)
    if not match:
        return name
    ends = {"0": "drop_height", "1": "rebound_height"}
    return ends.get(match[1], f"rebound_height_{match[1]}") + (match[2] or "")


def parted(table: UserTable) -> tuple[UserTable, Mapping[str, Array]]:
    """Return the table without the columns of later bounces, and these in SI units."""
    short = {name: _long(name) for name in table.names}
    if {"drop_height", "rebound_height"} <= {*short.values()} - {*table.names}:
        table = replace(table, cells={short[name]: cells for name, cells in table.cells.items()})
    later = {}
    for name in filter(NUMBERED.fullmatch, table.names):
        first, whole = base(name), name.removesuffix(ERROR)
        if whole not in table.names:
            table.faults.add(f"{name}: its column {whole!r} is missing")
            continue
        both = {first.removesuffix(ERROR): table.cells[whole], first: table.cells[name]}
        try:
            alone = replace(table, cells=both, faults=Faults())
            later[name] = in_units(alone, (first,), gaps=AFTERWARDS, whole=True)[first]
        except InputError as fault:
            table.faults.add(str(fault).replace(first, name))
    kept = {name: cells for name, cells in table.cells.items() if not NUMBERED.fullmatch(name)}
    return replace(table, cells=kept), later


def with_speeds(rows: UserTable, later: Mapping[str, Array]) -> tuple[UserTable, list[str]]:
    """Return the columns with the normal speeds that bounces tell, and what is to be said of it.

    V = sqrt(2 g h) of heights, V = g T/2 of the time T from one bounce to the next. Of several
    bounces in a row of the table each has a row of its own.
    """
    rows = _with_intervals(rows)
    columns = {**rows.columns, **later}
    there = [name for name in (*BOUNCES, *later) if name in columns]
    if not there:
        return rows, []
    ways = [name for name in AFTERWARDS if name in rows.columns]
    _refuse_twice(rows, there, ways)
    _check_units(replace(rows, columns=columns))
    way = ways[0] if ways else ""
    series = sorted((n for n in later if not n.endswith(ERROR)), key=_number)
    if any(base(name) != way for name in series) or (TIME in rows.columns and series):
        only = f"give {base(series[0])}, too, and no other series of bounces"
        raise InputError(f"{series[0]}: {only}")
    if [*map(_number, series)] != [*range(2, len(series) + 2)]:
        raise InputError(f"{series[0]}: columns of later bounces are numbered from 2 on")
    first = [name for name in ("drop_height", BEFORE) if name in columns][:1]
    if not first and way != INTERVAL:
        rows.require("drop_height")
        return rows, []
    speeds, errors = _speeds(columns, (*first, *ways, *series))
    if not first and not series:
        return _down_the_rows(rows, speeds, errors)
    if not ways:  # a drop height with another quantity after
        own = {**rows.columns, BEFORE: speeds[:, 0], "tangential_speed": np.zeros(len(rows))}
        if np.isfinite(errors).any():
            own[BEFORE + ERROR] = errors[:, 0]
        return replace(rows, columns=own), []
    remark = f"{way}: up to {len(series) + 1} bounces in a row of the table, each with its speed"
    return _unfolded(rows, way, speeds, errors), [remark] if series else []


def _number(name: str) -> int:
    return int(name.rpartition("_")[2])


def _with_intervals(rows: UserTable) -> UserTable:
    """Return the columns with the intervals between times of bounces; another drop begins anew."""
    if TIME not in rows.columns:
        return rows
    for other in filter(rows.columns.__contains__, (INTERVAL, "drop_height", BEFORE, AFTER)):
        raise InputError(f"{TIME}: it needs no {other}; leave one of them out")
    gone = np.diff(rows[TIME], prepend=np.nan)
    columns = {**rows.columns, INTERVAL: np.where(gone > 0.0, gone, np.nan)}
    if (error := columns.get(TIME + ERROR)) is not None:
        columns[INTERVAL + ERROR] = np.hypot(error, np.roll(error, 1))
    return replace(rows, columns=columns)


def _refuse_twice(rows: UserTable, there: list[str], ways: list[str]) -> None:
    oblique = [name for name in TWICE if name in rows.columns]
    before = [name for name in ("drop_height", BEFORE) if name in rows.columns]
    after = [*ways, *(n for n in ("normal_restitution",) if n in rows.columns and ways)]
    for same in (([there[0], *oblique] if oblique else []), before, after):
        if len(same) > 1:
            raise InputError(f"{same[0]}: it gives the same as {same[1]}; leave one of them out")


def _check_units(rows: UserTable) -> None:
    """Add to the faults heights and times that drops in a laboratory do not have."""
    for name in (n for n in rows.columns if base(n) in (*HEIGHTS, INTERVAL)):
        rows.refuse(name, rows[name] <= 0.0, "must be positive")
        largest = float(np.max(np.nan_to_num(rows[name]), initial=0.0))
        bare = name in rows.cells and not str(rows.cells[name].unit)  # asked for already
        if base(name) in HEIGHTS and largest > HIGHEST and not bare:
            fast = np.sqrt(2.0 * GRAVITY * largest)
            rows.faults.add(
                f"{name}: {largest:.3g} m is {fast:.3g} m/s at the plate; is the unit cm or mm? If "
                "it is right, give normal_speed and normal_speed_out"
            )
        elif base(name) == INTERVAL and largest > LONGEST:
            height, head = GRAVITY * largest**2 / 8.0, TIME if TIME in rows.columns else name
            rows.faults.add(
                f"{head}: {largest:.3g} s is a bounce {height:.3g} m high; is the unit ms, "
                f"'{head} [ms]'?"
            )


def _speeds(columns: Mapping[str, Array], names: Iterable[str]) -> tuple[Array, Array]:
    """Return the speeds of flights by columns, and their errors, NaN where none are given."""
    speeds, errors = [], []
    for name in names:
        values, error = columns[name], columns.get(name + ERROR, np.nan * columns[name])
        if base(name) in HEIGHTS:
            speeds.append(np.sqrt(2.0 * GRAVITY * np.where(values > 0.0, values, np.nan)))
            errors.append(GRAVITY * error / speeds[-1])
        else:
            factor = 0.5 * GRAVITY if base(name) == INTERVAL else 1.0
            speeds.append(factor * values)
            errors.append(factor * error)
    return np.stack(speeds, axis=-1), np.stack(errors, axis=-1)


def _down_the_rows(rows: UserTable, speeds: Array, errors: Array) -> tuple[UserTable, list[str]]:
    """Return one row for each bounce whose intervals before and after stand in successive rows."""
    two, both = (np.hstack([each[:-1], each[1:]]) for each in (speeds, errors))
    places = np.arange(len(rows), dtype=np.float64)
    kept = replace(rows, columns={**rows.columns, PLACE: places}).kept(places > 0)
    drops = int((~np.isfinite(two[:, 1]) & np.isfinite(two[:, 0])).sum()) + 1
    way = TIME if TIME in rows.columns else INTERVAL
    remark = f"{way}: rows are successive bounces" + f" of {drops} drops" * (drops > 1)
    unfolded = _unfolded(kept, INTERVAL, two, both)
    return unfolded.kept(np.isfinite(unfolded[AFTER])), [remark]


def _repeated(rows: UserTable, count: int) -> UserTable:
    places = np.repeat(np.arange(len(rows)), count)
    cells = {
        name: column._replace(cells=[column.cells[i] for i in places if not column.fault])
        for name, column in rows.cells.items()
    }
    columns = {name: values[places] for name, values in rows.columns.items()}
    in_series = np.arange(len(places)) + 2.0 * places  # a gap parts drops
    return replace(rows, cells=cells, columns={**columns, PLACE: in_series}, rows=rows.rows[places])


def _unfolded(rows: UserTable, way: str, speeds: Array, errors: Array) -> UserTable:
    """Return one row for each bounce: the speed after one is that before the next."""
    count = speeds.shape[1] - 1
    before, after = speeds[:, :-1].ravel(), speeds[:, 1:].ravel()
    whole = rows if count == 1 else _repeated(rows, count)
    lost = np.isfinite(after) & ~np.isfinite(before)
    if count > 1 and lost.any():
        rows.faults.add(f"{way}: one is missing before a later one in {whole.named(lost)}")
    moving = {BEFORE: before, AFTER: after, "tangential_speed": np.zeros(len(before))}
    columns = {**whole.columns, **moving}
    if np.isfinite(errors[:, :-1]).any():
        columns[BEFORE + ERROR] = np.nan_to_num(errors[:, :-1]).ravel()
    if np.isfinite(errors[:, 1:]).any():
        columns[AFTER + ERROR] = errors[:, 1:].ravel()
    if way == "rebound_height":
        fallen = {"drop_height": before, way: after} if "drop_height" in columns else {way: after}
        columns |= {name: speed**2 / (2.0 * GRAVITY) for name, speed in fallen.items()}
    elif way == INTERVAL:
        columns[way] = 2.0 * after / GRAVITY
    result = replace(whole, columns=columns)
    if way == "rebound_height":
        allowed = "must, apart from scatter, be no larger than the height before"
        result.refuse(way, after > MOST_RESTITUTION * before, allowed)
    elif way != AFTER:
        cause = "it is longer than the flight before; a bounce was missed or another sound counted"
        result.refuse(way, after > MOST_GROWTH * before, cause)
    there = np.isfinite(before) & (np.isfinite(after) | (count == 1))
    return result.kept(there)


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
