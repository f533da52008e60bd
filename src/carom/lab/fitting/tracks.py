"""Tracks of a camera: the motion of a ball before and after an impact, with standard errors.

A parabola is fitted to each side; where the two meet is the impact. A mark gives the spins.
"""

import json
from collections.abc import Mapping, Sequence
from math import hypot, nan
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.special import fdtrc

from carom.impacts.validity import GRAVITY
from carom.io.heads import table_format
from carom.io.labels import labelled_dataset
from carom.io.user_table import ERROR
from carom.lab.fitting.intervals import significant
from carom.lab.fitting.track_files import Frames, read_track
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import text
from carom.quantities.refusals import Faults, InputError, flag, known_keywords, refusal, refuse
from carom.quantities.units import Value, finite, or_none, positive, within

if TYPE_CHECKING:
    import xarray as xr

SPEEDS = ("normal_speed", "tangential_speed", "normal_speed_out", "tangential_speed_out")
SPINS = ("spin", "spin_out")
FEWEST = 3  # frames on each side
NEAR = 3  # frames from the lowest one at which the paths may part
SHARP = 1e-4  # probability below which paths are no parabolas
DOUBTFUL = 0.8 * np.pi  # turn from frame to frame, beyond which the sense of a spin may be wrong
FITTED = "fit"
SURE = 4.0  # standard deviations by which both change
GRAVITIES, RATES, SCALES = (-1e3, 1e3), (1e-3, 1e9), (1e-6, 1e6)  # that are accepted
AS_GRAVITY, SIGMAS = 0.02, 4.0  # by which a fitted gravity may differ unsaid, both


class Motion(NamedTuple):
    """Parabolas x, v_x before, after, y, v_y before, after, and gravity, with their covariance.

    Times count from `origin`; the first frame after the impact is `split`.
    """

    numbers: Array
    covariance: Array
    origin: float
    split: int
    squares: float
    freedom: int


@known_keywords
def track(
    source: Any,
    *,
    frame_rate: Value | None = None,
    pixels_per_mm: Value | None = None,
    pixels_per_diameter: Value | None = None,
    radius: Value | None = None,
    plate_angle: Value = 0.0,
    gravity: Value = GRAVITY,
    y_down: bool | None = None,
    columns: Mapping[str, str] | str | Path | None = None,
    sheet: str | None = None,
    decimal: str | None = None,
) -> "xr.Dataset":
    """Return the motion before and after an impact from positions in a video, for `carom.fit`.

    Straight lines in x and parabolas in y are fitted to the frames before and after the impact by
    least squares, which is where the parabolas meet; velocities and spins hold at that time.
    Standard errors follow from the residuals, which count as independent and equally large.

    Parameters
    ----------
    source : str, mapping, data frame or list of these
        A file, CSV or a spreadsheet, or columns by name: x and y of the centre, time or frame, and
        for spins mark_x and mark_y of a mark, or mark_angle, counterclockwise. Exports of Tracker,
        and of DeepLabCut and SLEAP with points ball and mark, are read as they are. Frames without
        a position are left out. Of a list each is an impact.
    frame_rate : float or str, optional
        Frames per second, where the frames are counted: "1000 Hz".
    pixels_per_mm, pixels_per_diameter : float, optional
        Scale of positions in pixels; the latter with the radius of the ball.
    radius : float or str, optional
        Radius of the ball.
    plate_angle : float or str
        Angle of the plate from the horizontal, counterclockwise in the picture.
    gravity : float, str or "fit"
        Acceleration downwards in the picture; "fit" finds it from the paths, 0 makes them straight.
    y_down : bool, optional
        Whether y is counted downwards, as in pixels; by default as the ball flies.
    columns : mapping or str, optional
        Names by the heads of columns that have other ones, e.g. {"t (s)": "time"}; or a TOML file
        with them in a table [columns].
    sheet : str, optional
        The sheet of a spreadsheet, if several could be meant.
    decimal : str, optional
        "," or ".", the decimal sign of a file where numbers such as 1,234 leave it open.

    Returns
    -------
    xarray.Dataset
        Along `track`: normal_speed, tangential_speed, normal_speed_out, tangential_speed_out in m/s
        and, with a mark, spin and spin_out in rad/s, each with its `_error`. The attribute `tracks`
        has, as JSON, time and frames of each impact, the scatter of positions, and notes.

    Raises
    ------
    InputError
        If a column, the scale or the frame rate is missing, or there is no impact.

    Examples
    --------
    >>> time = [-0.03, -0.02, -0.01, 0.01, 0.02, 0.03]
    >>> path = {"time": time, "x": [0.5 * t for t in time],
    ...         "y": [abs(t) - 4.903325 * t * t + 1e-5 * (-1) ** i for i, t in enumerate(time)]}
    >>> carom.track(path).normal_speed.values.round(3)
    array([1.])
    """
    many = isinstance(source, Sequence) and not isinstance(source, str | bytes)
    sources = list(source) if many else [source]
    names = [str(e if isinstance(e, str | Path) else i) for i, e in enumerate(sources)]
    found = []
    with Faults() as faults:
        if not sources:
            faults.add("data: missing; give a file with a track, or columns by name")
        steepest = faults.trying(_tilt, plate_angle)
        is_fitted = isinstance(gravity, str) and gravity == FITTED
        downwards = None if is_fitted else faults.trying(within, "gravity", gravity, *GRAVITIES)
        down = faults.if_given(flag, "y_down", y_down)
        scale = faults.trying(_metres_per_pixel, pixels_per_mm, pixels_per_diameter, radius)
        rate = faults.if_given(within, "frame_rate", frame_rate, *RATES)
        how = faults.trying(table_format, columns, sheet, decimal)
        faults.settle()
        for name, each in zip(names, sources, strict=True):
            with faults.catching(f"track {name}" if len(names) > 1 else ""):
                frames = read_track(each, how, rate, scale)
                found.append(_measured(frames, steepest, downwards, down))
    return _dataset(names, found)


def _tilt(plate_angle: Value) -> float:
    angle = finite("plate_angle", plate_angle)
    refuse(abs(angle) >= 0.5 * np.pi and refusal("plate_angle", plate_angle, "below 90 deg"))
    return angle


def _metres_per_pixel(
    per_mm: Value | None, per_diameter: Value | None, radius: Value | None
) -> float | None:
    with Faults() as faults:
        flat = faults.if_given(within, "pixels_per_mm", per_mm, *SCALES)
        across = faults.if_given(within, "pixels_per_diameter", per_diameter, *SCALES)
        if per_mm is not None and per_diameter is not None:
            faults.add("pixels_per_mm: it gives the same as pixels_per_diameter; leave one out")
        if per_diameter is not None and radius is None:
            faults.add("radius: missing; pixels_per_diameter needs it, e.g. '5 mm'")
        size = faults.if_given(positive, "radius", radius)
    if flat is not None:
        return 1e-3 / float(flat)
    if across is None or size is None:
        return None
    return 2.0 * float(size) / float(across)


def _measured(
    frames: Frames, tilt: float, gravity: float | None, down: bool | None
) -> tuple[dict[str, float], dict[str, Any]]:
    """Return speeds and spins with their errors, and what else is to be known of a track."""
    motions = {}
    for sign in (1.0, -1.0) if down is None else (-1.0 if down else 1.0,):
        if motion := parted(frames._replace(y=sign * frames.y), tilt, gravity):
            motions[sign] = motion
    if not motions:
        raise InputError(
            f"track: no impact is seen, with at least {FEWEST} frames before and after, at which "
            "the ball turns back from the plate; cut the track to one impact, or check plate_angle"
        )
    sign = min(motions, key=lambda each: motions[each].squares)
    motion, upright = motions[sign], frames._replace(y=sign * frames.y)
    values, errors, instant = at_impact(motion, tilt)
    struck, (before, after) = motion.origin + instant, frames.time[motion.split - 1 :][:2].tolist()
    seen = f"meet at {struck:.6g} s, but part between {before:.6g} and {after:.6g} s"
    cure = "leave out frames in contact and wrong positions, or check gravity, the scale and the "
    fault = f"track: the paths before and after {seen}; {cure}frame rate"
    refuse(abs(struck - 0.5 * (before + after)) > after - before and fault)
    forwards = -1.0 if values[1] < 0.0 else 1.0
    values[[1, 3]] *= forwards
    row = dict(zip(SPEEDS, values.tolist(), strict=True))
    row |= {n + ERROR: e for n, e in zip(SPEEDS, errors.tolist(), strict=True)}
    spins, notes = _spins(upright, motion.split, sign)
    row |= {name: forwards * value for name, (value, _) in spins.items()}
    row |= {name + ERROR: error for name, (_, error) in spins.items()}
    about = {
        "time": struck,
        "frames": [motion.split, len(frames.time) - motion.split],
        "position_error": float(np.sqrt(motion.squares / motion.freedom)),
        "notes": [*frames.notes, *_doubts(upright, motion, gravity), *notes, *_opposed(row)],
    }
    return row, about


def _spins(
    frames: Frames, split: int, sign: float
) -> tuple[dict[str, tuple[float, float]], list[str]]:
    """Return spins with their errors from straight lines through the angles of the mark."""
    mark = frames.mark
    if mark.ndim > 1:
        mark = np.arctan2(sign * mark[:, 1], mark[:, 0])
    seen = np.isfinite(mark)
    first = np.arange(len(mark)) < split
    if min((seen & first).sum(), (seen & ~first).sum()) < FEWEST:
        few = "in too few frames" if seen.any() else "at all"
        return {}, [f"spin: no mark is seen {few}; a fit takes the spin before as zero"]
    sides = [(frames.time[side], np.unwrap(mark[side])) for side in (seen & first, seen & ~first)]
    fits = [np.polyfit(t - t.mean(), angle, 1, full=True)[:2] for t, angle in sides]
    sigma = np.sqrt(np.sum([squares for _, squares in fits]) / (seen.sum() - 4))
    spins = {}
    for name, (t, _), (line, _) in zip(SPINS, sides, fits, strict=True):
        spins[name] = float(line[0]), float(sigma / np.linalg.norm(t - t.mean()))
    largest = max(float(np.abs(np.diff(angle)).max()) for _, angle in sides)
    step = max(float(np.diff(t).max()) for t, _ in sides)
    limit = GLOSSARY["spin"].text(np.pi / step, 3)
    if largest <= DOUBTFUL:
        return spins, [f"spin: right below {limit}, half a turn of the mark from frame to frame"]
    words = "so that its sense may be the other one; take more frames per second"
    turned = GLOSSARY["angle"].text(largest, 3)
    return spins, [f"spin: the mark turns by {turned} from frame to frame, {words}"]


def _opposed(row: dict[str, float]) -> list[str]:
    """Return a note if speed and spin change against each other: one force changes both."""
    changes = []
    for name in ("tangential_speed", "spin"):
        ends = name, f"{name}_out"
        if not set(ends) <= row.keys():
            return []
        error = hypot(*(row[end + ERROR] for end in ends))
        changes.append((row[ends[1]] - row[ends[0]]) / error if error else nan)
    if not (min(map(abs, changes)) > SURE and changes[0] * changes[1] < 0.0):
        return []
    cure = "check plate_angle and its sign, which counts counterclockwise, and the mark"
    return [f"speed and spin change against each other, which no friction does; {cure}"]


def _doubts(frames: Frames, motion: Motion, gravity: float | None) -> list[str]:
    """Return whether the paths are bent otherwise than by gravity (F test), or gravity is odd."""
    notes = []
    bent = parabolas(frames, motion.split, gravity, bent=True)
    more = motion.freedom - bent.freedom
    if bent.freedom > 0 and more > 0 and bent.squares > 0.0:
        ratio = (motion.squares - bent.squares) / more / (bent.squares / bent.freedom)
        if fdtrc(more, bent.freedom, max(ratio, 0.0)) < SHARP:
            cure = "check scale, frame rate and gravity, or that the track has one impact"
            notes.append(f"path: it is bent otherwise than by gravity; {cure}")
    if gravity is None:
        value, error = float(motion.numbers[8]), float(np.sqrt(motion.covariance[8, 8]))
        off = abs(value - GRAVITY)
        said = f"gravity: the paths give {value:.4g} +- {error:.2g} m/s^2"
        odd = off > SIGMAS * error and off > AS_GRAVITY * GRAVITY
        notes.append(f"{said}; check the scale and the frame rate" if odd else said)
    return notes


def _dataset(
    names: list[str], found: list[tuple[dict[str, float], dict[str, Any]]]
) -> "xr.Dataset":
    variables: dict[str, Any] = {}
    for name in dict.fromkeys(name for row, _ in found for name in row):
        values = np.array([row.get(name, np.nan) for row, _ in found])
        entry = GLOSSARY[name.removesuffix(ERROR)]
        words = "standard deviation of the " * name.endswith(ERROR) + entry.meaning
        variables[name] = ("track", values, {"units": entry.unit, "long_name": words})
    about = [{"track": name, **details} for name, (_, details) in zip(names, found, strict=True)]
    attrs = {"title": "motion before and after impacts, from tracks", "tracks": json.dumps(about)}
    return labelled_dataset(variables, {"track": ("track", names, {"long_name": "track"})}, attrs)


def as_records(motions: "xr.Dataset") -> list[dict[str, Any]]:
    """Return tracks as plain numbers, texts and lists; what was not measured is None."""
    details = json.loads(motions.attrs["tracks"])
    values = {str(name): motions[name].values.tolist() for name in motions.data_vars}
    for i, about in enumerate(details):
        about |= {key: or_none(column[i]) for key, column in values.items()}
    return list(details)


def as_text(motions: "xr.Dataset") -> str:
    """Return tracks to read: each speed and spin with its standard error."""
    lines = []
    for each in as_records(motions):
        before, after = each["frames"]
        time, error = text(each["time"], "s"), text(each["position_error"], "m", 2)
        lines.append(
            f"{each['track']}: {before} frames before and {after} after the impact at {time}; "
            f"positions scatter by {error}"
        )
        for name in (n for n in (*SPEEDS, *SPINS) if each.get(n) is not None):
            unit, deviation = GLOSSARY[name].unit, each[name + ERROR]
            value = text(each[name], unit, significant(each[name], 4.0 * deviation))
            lines.append(f"  {name:20s} {value} +- {text(deviation, unit, 2)}")
        lines += [f"  note: {note}" for note in each["notes"]]
    return "\n".join(lines)


def parted(frames: Frames, tilt: float, gravity: float | None) -> Motion | None:
    """Return the parabolas with the least squares among those that part near the lowest frame."""
    height = frames.y * np.cos(tilt) - frames.x * np.sin(tilt)
    lowest, count = int(np.argmin(height)), len(height)
    splits = range(max(lowest - NEAR, FEWEST), min(lowest + NEAR + 1, count - FEWEST) + 1)
    motions = (parabolas(frames, split, gravity) for split in splits)
    turned = [motion for motion in motions if _turns(motion, tilt)]
    return min(turned, key=lambda motion: motion.squares, default=None)


def _turns(motion: Motion, tilt: float) -> bool:
    normal = motion.numbers[[5, 7]] * np.cos(tilt) - motion.numbers[[1, 3]] * np.sin(tilt)
    return bool(normal[0] < 0.0 < normal[1])


def parabolas(frames: Frames, split: int, gravity: float | None, *, bent: bool = False) -> Motion:
    """Return the least squares of parabolas that part at a frame; `bent` frees all curvatures."""
    origin = 0.5 * float(frames.time[split - 1] + frames.time[split])
    t = frames.time - origin
    before = np.arange(len(t)) < split
    sides = [side * power for side in (before, ~before) for power in (np.ones_like(t), t)]
    curves = [side * t**2 for side in (before, ~before)] if bent else []
    line, none = np.stack([*sides, *curves], axis=-1), np.zeros((len(t), len(sides) + len(curves)))
    fallen = -0.5 * t**2
    design = np.block([[line, none], [none, line]])
    free = np.concatenate([np.zeros_like(t), fallen])[:, np.newaxis]
    place = np.concatenate([frames.x, frames.y - (0.0 if gravity is None else gravity * fallen)])
    if gravity is None and not bent:
        design = np.hstack([design, free])
    sizes = np.maximum(np.linalg.norm(design, axis=0), 1e-300)
    inverse = np.linalg.pinv(design / sizes) / sizes[:, np.newaxis]
    numbers = inverse @ place
    freedom = len(place) - int(np.linalg.matrix_rank(design / sizes))
    squares = float(np.square(place - design @ numbers).sum())
    covariance = squares / max(freedom, 1) * inverse @ inverse.T
    if gravity is not None and not bent:
        numbers = np.append(numbers, gravity)
        covariance = np.pad(covariance, (0, 1))
    return Motion(numbers, covariance, origin, split, squares, freedom)


def at_impact(motion: Motion, tilt: float) -> tuple[Array, Array, float]:
    """Return normal and tangential speeds before and after, their errors, the time of impact."""
    cosine, sine = np.cos(tilt), np.sin(tilt)

    def of(numbers: Any) -> tuple[Any, Any]:
        x, y = numbers[:4].reshape(2, 2), numbers[4:8].reshape(2, 2)  # (side, power)
        normal, along = y * cosine - x * sine, x * cosine + y * sine
        time = (normal[0, 0] - normal[1, 0]) / (normal[1, 1] - normal[0, 1])
        fallen = numbers[8] * time
        away, onwards = normal[:, 1] - fallen * cosine, along[:, 1] - fallen * sine
        return np.array([-away[0], onwards[0], away[1], onwards[1]]), time

    values, time = of(motion.numbers)
    into = 1e-30j * np.eye(len(motion.numbers))  # the complex plane: no digit is lost in slopes
    slopes = np.stack([of(motion.numbers + step)[0].imag for step in into], axis=-1) / 1e-30
    errors = np.sqrt(np.einsum("ij,jk,ik->i", slopes, motion.covariance, slopes))
    return values, errors, float(time)
