"""Files of tracks: what Tracker, DeepLabCut, SLEAP and hands write, as positions in frames."""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from carom.io.heads import TableFormat
from carom.io.remedies import REMEDIES
from carom.io.tables import read_table
from carom.io.user_table import UserTable, read_column
from carom.quantities.arrays import Array
from carom.quantities.refusals import Faults, heading, refuse

POSITIONS = ("x", "y", "mark_x", "mark_y")
UNITS = dict.fromkeys(POSITIONS, "m") | {"mark_angle": "rad", "score": "1", "mark_score": "1"}
CALLED = {"t": "time", "frame_idx": "frame"}
CLOCKS = (".t", ".time")  # end the names of times that each point has
BALL, MARK = ("ball", "center", "centre"), ("mark", "marker", "spot")  # names of points
PIXELS = ("px", "pixel", "pixels")
SURE = 0.6  # likelihood below which a point is left out, as DeepLabCut does
MOST_FRAMES = 100_000
LARGEST = 1e6  # s and m, of times and positions


class Frames(NamedTuple):
    """Times and positions in SI units; the mark by its angle, or by where it is from the centre."""

    time: Array
    x: Array
    y: Array
    mark: Array
    notes: tuple[str, ...] = ()


def read_track(source: Any, how: TableFormat, rate: float | None, scale: float | None) -> Frames:
    """Return the frames that show the ball, or raise InputError for all that cannot be used.

    `rate` is in frames per second, `scale` in metres per pixel.
    """
    if getattr(getattr(source, "columns", None), "nlevels", 1) > 1:
        source = _flat(source)
    table = read_table(source, **how._asdict(), what="track", lenient=True)
    refuse(len(table) > MOST_FRAMES and f"track: it has more than {MOST_FRAMES} frames; cut it")
    with Faults() as faults:
        return _frames(_with_points(table.told(faults)), rate, scale)


def _flat(frame: Any) -> Any:
    """Return columns of DeepLabCut, of scorer, body part and coordinate, as point.coordinate."""
    flat = frame.copy()
    flat.columns = [".".join(map(str, names[-2:])) for names in frame.columns]
    flat.insert(0, "frame", frame.index)
    return flat.reset_index(drop=True)


def _with_points(table: UserTable) -> UserTable:
    """Return the table with the names of columns that programs which track call otherwise."""
    points, clocks = _points(table), [n for n in table.names if n.endswith(CLOCKS)]
    new = dict(CALLED) | dict.fromkeys(clocks[:1], "time")
    for names, mark in ((BALL, ""), (MARK, "mark_")):
        own = [p for p in points if p.lower() in names or (len(points) == 1 and not mark)]
        ends = {"x": "x", "y": "y", "likelihood": "score", "score": "score"}
        new |= {f"{p}.{end}": mark + name for p in own[:1] for end, name in ends.items()}
    if len({tuple(map(str, table.cells[name].cells)) for name in clocks}) > 1:
        words = "differ; give all points of a time in one row"
        table.faults.add(f"time: {' and '.join(clocks)} {words}")
    new = {old: name for old, name in new.items() if name not in table.names}
    return replace(table, cells={new.get(old, old): each for old, each in table.cells.items()})


def _points(table: UserTable) -> list[str]:
    """Return the names of points of which there are positions, as ball in ball.x."""
    parts = (name.rpartition(".") for name in table.names)
    return list(dict.fromkeys(point for point, _, end in parts if point and end in ("x", "y")))


def _frames(table: UserTable, rate: float | None, scale: float | None) -> Frames:
    """Return the frames that show the ball, and add to the faults what cannot be used."""
    faults = table.faults
    clock = "time" if "time" in table.cells else "frame"
    units = {clock: "s" if clock == "time" else "1", **UNITS}
    _check_scale(table, scale)
    _check_columns(table, rate, scale)
    read: dict[str, Array] = {}
    for name in filter(table.cells.__contains__, units):
        column, size, si = table.cells[name], 1.0, units[name]
        unit = str(column.unit).lower()
        if name in POSITIONS and (unit in PIXELS or (not unit and scale is not None)):
            column, size, si = column._replace(unit=""), scale or 1.0, "1"
        with faults.catching():
            read[name] = size * read_column(replace(table, cells={name: column}), name, si)
    faults.settle()
    for name in POSITIONS:
        score = "mark_score" if name.startswith("mark") else "score"
        if score in read and name in read:
            read[name] = np.where(read[score] >= SURE, read[name], np.nan)
    time, x, y = read[clock] / (1.0 if clock == "time" else rate or 1.0), read["x"], read["y"]
    mark = read.get("mark_angle", np.full(len(table), np.nan))
    if {"mark_x", "mark_y"} <= {*read}:
        mark = np.stack([read["mark_x"] - x, read["mark_y"] - y], axis=-1)
    for name, values in (("time", time), ("x", x), ("y", y)):
        if np.abs(np.nan_to_num(values)).max() > LARGEST:
            faults.add(f"{name}: it is beyond {LARGEST:g} in SI units; check its unit")
    seen = np.isfinite(time) & np.isfinite(x) & np.isfinite(y)
    if np.any(np.diff(time[seen]) <= 0.0):
        faults.add("time: it does not grow from row to row; give one track a file")
    return Frames(time[seen], x[seen], y[seen], mark[seen], table.notes)


def _check_columns(table: UserTable, rate: float | None, scale: float | None) -> None:
    """Add to the faults that positions, times or the frame rate are missing."""
    if not {"x", "y"} <= {*table.cells}:
        there = ", ".join(heading(column.head) for column in table.cells.values())
        listed = f"column missing; the columns are {there}"
        say = "say which are x and y of the ball, and mark_x and mark_y of a mark on it"
        own = [f"{point}.{axis}" for point in _points(table)[:2] for axis in ("x", "y")]
        columns = [table.cells[name] for name in own if name in table.cells]
        bare = ["" if scale or str(column.unit) else " [m]" for column in columns]
        named = zip(columns, POSITIONS, bare, strict=False)
        heads = {column.head: name + unit for column, name, unit in named}
        remedy = REMEDIES.get().columns(heads or {"HEAD": "x"})
        table.faults.add(f"x: {listed}; {say}: {remedy}")
    if not {"time", "frame"} & {*table.cells}:
        table.faults.add("time: column missing; give time, or frame with the frame rate")
    elif "time" not in table.cells and rate is None:
        table.faults.add("frame_rate: missing; the track has frames, give e.g. '1000 Hz'")


def _check_scale(table: UserTable, scale: float | None) -> None:
    """Add to the faults a scale of positions that need none, or its lack."""
    units = {n: str(table.cells[n].unit).lower() for n in POSITIONS if n in table.cells}
    for name, unit in units.items():
        if scale is not None and unit not in ("", *PIXELS):
            table.faults.add(f"{name}: it is in {unit}; leave the scale of pixels out")
            return
        if scale is None and (unit in PIXELS or (table.is_of_file and not unit)):
            heads = {table.cells[n].head: f"{n} [m]" for n in units if not units[n]}
            remedy = REMEDIES.get().columns(heads)
            lengths = "" if unit else f"; if it is a length, {remedy}, with its unit"
            say = f"no unit; give pixels_per_mm or pixels_per_diameter{lengths}"
            table.faults.add(f"{name}: {say}")
            return
