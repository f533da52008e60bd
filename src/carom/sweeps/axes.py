"""Values along an axis: lists of numbers or of texts with units, and ranges."""

from collections.abc import Mapping
from math import inf, isfinite, pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.quantities.arrays import Array, numbers
from carom.quantities.refusals import InputError, one_of, refusal
from carom.quantities.units import counted, number, told_unit
from carom.sweeps.inputs import leaf

SPACINGS = ("linear", "log")
RANGE = ("from", "to", "spacing")
MOST = 10**8  # values of an axis, which is in memory


class Range(NamedTuple):
    """From where to where, and whether evenly in the logarithm."""

    start: float
    stop: float
    log: bool

    def at(self, fraction: Array) -> Array:
        """Return the values at fractions of the way, 0 to 1."""
        if self.log:
            return np.asarray(self.start * (self.stop / self.start) ** fraction)
        return np.asarray(self.start + (self.stop - self.start) * fraction)


def read_values(name: str, given: ArrayLike) -> Array:
    """Return the values of an axis in SI units, or raise InputError."""
    key, allowed = leaf(name), "must be a list of finite numbers or texts with units"
    values = np.atleast_1d(numbers(key, given, allowed))
    if values.ndim != 1 or values.size == 0:
        raise refusal(name, given, f"{allowed}, at least one")
    fits = np.isfinite(values) | ((key == "young") & (values == np.inf))
    if not np.all(fits):
        raise refusal(name, float(values[~fits][0]), allowed)
    if key == "angle" and np.abs(values).max() > pi and not _has_text(given):
        raise refusal(name, given, "bare angles are in radians; write '30 deg'")
    return values


def _has_text(given: Any) -> bool:
    return isinstance(given, str) or any(isinstance(value, str) for value in np.atleast_1d(given))


def read_axis(name: str, given: Any) -> Array:
    """Return the values of an axis from a list, or from a range with its number of points."""
    if not isinstance(given, Mapping):
        return read_values(name, given)
    points = counted(f"{name}.points", given.get("points"), 1, MOST)
    ends = {key: value for key, value in given.items() if key != "points"}
    reach = read_range(name, ends, apart=points > 1)
    values = reach.at(np.linspace(0.0, 1.0, points))
    if points > 1:
        values[-1] = reach.stop
    return values


def read_range(name: str, given: Any, *, apart: bool = True) -> Range:
    """Return a range from (first, last), or from a mapping with from, to and spacing.

    Raises InputError if it is neither, not finite, has no positive ends for a logarithm, or ends
    where it starts although it should not.
    """
    whole = _as_table(name, given)
    start, stop = _end(name, "from", whole.get("from")), _end(name, "to", whole.get("to"))
    spacing = whole.get("spacing", SPACINGS[0])
    one_of(f"{name}.spacing", spacing, SPACINGS)
    if apart and start == stop:
        raise refusal(name, start, "a range must not end where it starts")
    if spacing == "log" and min(start, stop) <= 0.0:
        raise refusal(name, min(start, stop), "logarithmic spacing needs positive ends")
    log = spacing == "log"
    if not isfinite(stop - start) or (log and not 0.0 < stop / start < inf):
        raise refusal(name, [start, stop], "these ends are too far apart for floating point")
    return Range(start, stop, log)


def _as_table(name: str, given: Any) -> Mapping[str, Any]:
    ends = np.atleast_1d(told_unit(name, given)[0]) if isinstance(given, np.ndarray) else given
    ends = ends.tolist() if isinstance(ends, np.ndarray) else ends
    if isinstance(ends, list | tuple) and len(ends) == 2:
        return dict(zip(RANGE, ends, strict=False))
    if not isinstance(given, Mapping):
        raise refusal(name, given, "must be a range: (first, last), or {from, to, spacing}")
    for key in given:
        if key not in RANGE:
            allowed = f"a range has {', '.join(RANGE)} and, on a grid, points"
            raise InputError(f"{name}.{key}: unknown; {allowed}")
    return given


def _end(name: str, which: str, value: Any) -> float:
    if value is None:
        raise InputError(f"{name}.{which}: missing; a range needs from and to")
    result = number(leaf(name), value)
    if not isfinite(result):
        raise refusal(f"{name}.{which}", value, "must be finite")
    if leaf(name) == "angle" and abs(result) > pi and not isinstance(value, str):
        allowed = f"a bare angle is in radians; write '{value} deg'"
        raise refusal(f"{name}.{which}", value, allowed)
    return result
