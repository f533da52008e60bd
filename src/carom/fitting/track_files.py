"""Files of tracks: what Tracker, DeepLabCut, SLEAP and hands write, as positions in frames."""

from collections.abc import Mapping
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom.io.files import read_text
from carom.io.tables import read_table
from carom.io.user_table import UserTable, column_in_si
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError, heading, refusal, refuse

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = ("x", "y", "mark_x", "mark_y")
CALLED = {"t": "time", "frame_idx": "frame"}
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


def read_track(
    source: Any, columns: Mapping[str, str] | None, rate: float | None, scale: float | None
) -> Frames:
    """Return the frames that show the ball, or raise InputError for what cannot be used.

    `rate` is in frames per second, `scale` in metres per pixel.
    """
    is_file = isinstance(source, str | Path)
    return _frames(_table(source, columns), rate, scale, bare=is_file)


def _table(source: Any, columns: Mapping[str, str] | None) -> UserTable:
    """Return the cells of a track by names; points of programs that track are named."""
    frame = _exported(source) if isinstance(source, str | Path) else source
    if getattr(getattr(frame, "columns", None), "nlevels", 1) > 1:
        frame = _flat(frame)
    table = read_table(frame, columns, what="track")
    points = [name.removesuffix(".x") for name in table.names if name.endswith(".x")]
    new = dict(CALLED)
    for names, mark in ((BALL, ""), (MARK, "mark_")):
        own = [p for p in points if p.lower() in names or (len(points) == 1 and not mark)]
        new |= {f"{p}.{axis}": f"{mark}{axis}" for p in own[:1] for axis in "xy"}
        new |= {f"{p}.{end}": f"{mark}score" for p in own[:1] for end in ("likelihood", "score")}
    cells = {
        new.get(n, n) if new.get(n) not in table.names else n: c for n, c in table.cells.items()
    }
    if not {"x", "y"} <= {*cells}:
        example = "columns={'HEAD': 'x', 'HEAD': 'y', 'HEAD': 'mark_x', 'HEAD': 'mark_y'}"
        listed = ", ".join(map(heading, table.names))
        raise InputError(
            f"x: column missing; the columns are {listed}; say which are the centre of the ball "
            f"and which a mark on it: {example}, or --column HEAD=x"
        )
    return UserTable(cells, table.rows, table.word)


def _exported(path: str | Path) -> "pd.DataFrame":
    """Return the columns of a file, with what Tracker, DeepLabCut and SLEAP write above them."""
    import pandas as pd

    try:
        lines = [line for line in read_text("track", path).splitlines() if line.strip()]
    except UnicodeDecodeError:
        raise refusal("track", str(path), "it is not text in UTF-8; export it as CSV") from None
    many = bool(lines) and lines[0].startswith("#multi")  # Tracker: names above x and y
    lines = [line for line in lines if not line.startswith("#") or line.startswith("#\t")]
    refuse(not lines and refusal("track", str(path), "it is empty"))
    separator = next((each for each in "\t;" if any(each in line for line in lines[:3])), ",")
    comma = separator != "," and not any("." in line for line in lines[3:])
    how: dict[str, Any] = {"sep": separator, "decimal": "," if comma else "."}
    if lines[0].startswith("scorer"):
        levels = 1 + next((i for i, t in enumerate(lines[:5]) if t.startswith("coords")), 2)
        how |= {"header": list(range(levels)), "index_col": 0}
    elif many:
        names, heads = (line.split(separator) for line in lines[:2])
        names = [
            next((n for n in reversed(names[: i + 1]) if n.strip()), "") for i in range(len(heads))
        ]
        heads = [
            f"{n.strip()}.{h.strip()}" if h.strip() in "xy" else h
            for n, h in zip(names, heads, strict=True)
        ]
        lines = [separator.join(heads), *lines[2:]]
    elif separator not in lines[0].strip(f"{separator} "):  # the name of Tracker's mass
        lines = lines[1:]
    try:
        frame = pd.read_csv(StringIO("\n".join(lines)), skipinitialspace=True, **how)
    except (ValueError, IndexError) as error:  # pandas' errors of parsing among them
        raise refusal("track", str(path), f"it is no table; {error}") from None
    if frame.columns.nlevels > 1:
        return _flat(frame)
    frame.columns = [str(name).strip() for name in frame.columns]
    return frame.loc[:, [name for name in frame.columns if not name.startswith("Unnamed")]]


def _flat(frame: "pd.DataFrame") -> "pd.DataFrame":
    """Return columns of DeepLabCut, of scorer, body part and coordinate, as point.coordinate."""
    flat = frame.copy()
    flat.columns = [".".join(map(str, names[-2:])) for names in frame.columns]
    flat.insert(0, "frame", frame.index)
    return flat.reset_index(drop=True)


def _frames(table: UserTable, rate: float | None, scale: float | None, *, bare: bool) -> Frames:
    refuse(len(table) > MOST_FRAMES and f"track: it has more than {MOST_FRAMES} frames; cut it")
    read: dict[str, Array] = {}
    faults: list[object] = []
    try:
        for name in filter(table.cells.__contains__, COLUMNS):
            read[name] = _position(table, name, scale, bare=bare)
    except InputError as fault:  # one for all positions
        faults.append(fault)
    counts = "frame" in table.cells and "time" not in table.cells
    if counts and rate is None:
        faults.append("frame_rate: missing; the track has frames, give e.g. '1000 Hz'")
    elif not counts and "time" not in table.cells:
        faults.append("time: column missing; give time, or frame with the frame rate")
    refuse(*faults)
    time = _column(table, "frame", "1") / (rate or 1.0) if counts else _column(table, "time", "s")
    mark = np.full(len(table), np.nan)
    if "mark_angle" in table.cells:
        mark = _column(table, "mark_angle", "rad")
    for name, points in (("score", ("x", "y")), ("mark_score", ("mark_x", "mark_y"))):
        if name in table.cells:
            unsure = ~(_column(table, name, "1") >= SURE)
            for each in filter(read.__contains__, points):
                read[each] = np.where(unsure, np.nan, read[each])
    seen = np.isfinite(time) & np.isfinite(read["x"]) & np.isfinite(read["y"])
    if {"mark_x", "mark_y"} <= {*read}:
        mark = np.stack([read["mark_x"] - read["x"], read["mark_y"] - read["y"]], axis=-1)
    for name, values in (("time", time), ("x", read["x"]), ("y", read["y"])):
        far = np.abs(np.nan_to_num(values)).max(initial=0.0) > LARGEST
        refuse(far and f"{name}: it is beyond {LARGEST:g} in SI units; check its unit")
    later = np.diff(time[seen])
    refuse(np.any(later <= 0.0) and "time: it does not grow from row to row; give one track a file")
    return Frames(*(each[seen] for each in (time, read["x"], read["y"], mark)))


def _position(table: UserTable, name: str, scale: float | None, *, bare: bool) -> Array:
    """Return positions in m: with a scale they are pixels, unless they have a unit."""
    unit = str(table.cells[name].unit).lower()
    in_pixels = unit in PIXELS or (not unit and scale is not None)
    if unit and not in_pixels and scale is not None:
        raise InputError(f"{name}: it is in {unit}; leave the scale of pixels out")
    if scale is None and (in_pixels or (bare and not unit)):
        lengths = f"; if it is a length, --column '{name}={name} [m]'" if not in_pixels else ""
        raise InputError(f"{name}: no unit; give pixels_per_mm or pixels_per_diameter{lengths}")
    if not in_pixels or scale is None:
        return _column(table, name, "m")
    plain = {**table.cells, name: table.cells[name]._replace(unit="")}
    return scale * _column(UserTable(plain, table.rows, table.word), name, "1")


def _column(table: UserTable, name: str, si: str) -> Array:
    """Return a column in SI units, NaN where it has no value."""
    column = table.column(name)
    values, reason = column_in_si(name, si, column.unit, column.cells)
    bad = ~np.isfinite(values) & ~column.missing
    refuse(bad.any() and f"{name}: not a number in {table.named(bad)}; {reason or 'correct it'}")
    return values
