"""Numbers for reading: SI values in units with a prefix, so that most of them are 1 to 1000.

Commands, notebooks and the page print numbers by `text`; files, JSON and datasets stay SI. Prefixes
stand only where people write them: areas and volumes go in steps of whole units (mm^3, cm^3), and
masses in grams; rad/s, densities and coefficients of wear keep their unit.
"""

import sys
from collections.abc import Iterable, Mapping
from decimal import Decimal
from functools import lru_cache
from html import escape
from math import degrees, isfinite, isnan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

DIGITS = 6
PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
MOST_DECADES, FEWEST_DECADES = 5, -4  # above and below 1 which numbers are written without "e"


def _with_prefixes(unit: str, least: int = -12, most: int = 12) -> dict[int, str]:
    return {power: k + unit for power, k in PREFIXES.items() if least <= power <= most}


READ: Mapping[str, Mapping[int, str]] = {  # units by the power of ten that they are of the SI unit
    **{unit: _with_prefixes(unit) for unit in ("N", "N s", "N m", "N m s", "J", "J/m^2")},
    **{unit: _with_prefixes(unit) for unit in ("Pa", "Hz")},
    **{unit: _with_prefixes(unit, most=3) for unit in ("m", "m/s")},
    "s": _with_prefixes("s", most=0),
    "kg": {**{power - 3: k + "g" for power, k in PREFIXES.items() if power <= 0}, 0: "kg"},
    "Pa m^0.5": _with_prefixes("Pa m^0.5", 0, 6),
    "m^2": {-12: "µm^2", -6: "mm^2", -4: "cm^2", 0: "m^2"},
    "m^3": {-18: "µm^3", -9: "mm^3", -6: "cm^3", 0: "m^3"},
}


def text(value: float, unit: str, digits: int = DIGITS) -> str:
    """Return an SI value with a unit, to read; angles in degrees and in radians, NaN as a dash."""
    return span(value, value, unit, digits)


def span(low: float, high: float, unit: str, digits: int = DIGITS) -> str:
    """Return from where to where SI values go, in one unit, to read."""
    if isnan(low) or isnan(high):
        return "-"
    if unit == "rad":
        in_degrees = span(degrees(low), degrees(high), "deg", digits)
        ends = dict.fromkeys(_number(end, 0, digits) for end in (low, high))
        return f"{in_degrees} ({' to '.join(ends)} rad)"
    numbers, shown = shared((low, high), unit, digits)
    return " to ".join(dict.fromkeys(numbers)) + ("" if shown == "1" else f" {shown}")


def shared(values: Iterable[float], unit: str, digits: int = DIGITS) -> tuple[tuple[str, ...], str]:
    """Return SI values as numbers in one unit, which suits the largest, and that unit."""
    numbers = tuple(values)
    power, name = _suited(numbers, unit, digits)
    return tuple(_number(value, power, digits) for value in numbers), printable(name)


def column(values: Iterable[float], unit: str, digits: int = DIGITS) -> tuple[tuple[str, ...], str]:
    """Return the cells of a column, all with as many decimals, and the unit for its head."""
    numbers = tuple(values)
    power, name = _suited(numbers, unit, digits)
    decades = _exponent(_largest(numbers), digits) - power
    plain = FEWEST_DECADES <= decades <= MOST_DECADES
    form = f".{max(digits - 1 - decades, 0)}f" if plain else f".{digits - 1}e"
    scaled = (Decimal(value).scaleb(-power) if plain else value for value in numbers)
    cells = (f"{each:{form}}" if isfinite(each) else _number(float(each)) for each in scaled)
    return tuple(cells), printable(name)


def prefixed(values: "ArrayLike", unit: str) -> tuple[float, str]:
    """Return by what to multiply SI values, and the unit that they are in then, for a figure."""
    import numpy as np  # what only prints does without

    numbers = np.abs(np.asarray(values, dtype=np.float64))
    largest = np.max(numbers, initial=0.0, where=np.isfinite(numbers))
    power, name = _suited((float(largest),), unit, DIGITS)
    return 10.0**-power, name


def printable(unit: str) -> str:
    """Return a unit as it can be printed: with "u" where standard output has no micro sign."""
    return unit if _has_micro(getattr(sys.stdout, "encoding", None)) else unit.replace("µ", "u")


@lru_cache
def _has_micro(encoding: str | None) -> bool:
    try:
        return bool("µ".encode(encoding or "utf-8"))
    except (ValueError, LookupError):
        return False


def _suited(values: Iterable[float], unit: str, digits: int) -> tuple[int, str]:
    """Return the power of ten of the unit that suits the largest of the values, and its name."""
    units, largest = READ.get(unit, {0: unit}), _largest(values)
    if largest == 0.0:
        return 0, unit
    decades = {power: _exponent(largest, digits) - power for power in sorted(units, reverse=True)}
    above = (power for power, n in decades.items() if 0 <= n <= MOST_DECADES)
    below = (power for power, n in reversed(decades.items()) if FEWEST_DECADES <= n < 0)
    power = next(above, next(below, 0))
    return power, units[power]


def _largest(values: Iterable[float]) -> float:
    return max((abs(value) for value in values if isfinite(value)), default=0.0)


def _exponent(value: float, digits: int) -> int:
    """Return the power of ten of the first digit of a number, rounded to so many digits."""
    return int(f"{value:.{digits - 1}e}".partition("e")[2])


def _number(value: float, power: int = 0, digits: int = DIGITS) -> str:
    """Return value/10^power, rounded as a decimal number; -0 as 0."""
    if not isfinite(value):
        return "-" if isnan(value) else f"{value:g}"
    mantissa, _, exponent = f"{value + 0.0:.{digits - 1}e}".partition("e")
    decades = int(exponent) - power
    places = max(digits, decades + 1) if decades <= MOST_DECADES else digits  # 750, not 7.5e+02
    return f"{float(f'{mantissa}e{decades}'):.{places}g}"


class Printed:
    """An object that a notebook shows as `print` does."""

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"
