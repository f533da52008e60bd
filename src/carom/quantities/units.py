"""Reading and checking numbers that users give, bare or with a unit."""

import math
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from decimal import Decimal
from numbers import Integral, Real
from typing import Any

from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, heading, refusal, refuse
from carom.quantities.texts import (
    CANNOT_HOLD,
    UNCHANGED,
    Factor,
    Unreadable,
    as_factor,
    factor,
    read_text,
)

Value = float | str  # a number in SI units, or text with a unit


MOST_COUNTED = 1_000_000
MOST_THREADS = 1024
WHOLE_NUMBER = re.compile(r"[+-]?[0-9]{1,40}")
REAL_KINDS = "iuf"  # of NumPy's types
UNIT_ATTRIBUTES = ("unit", "units", "Units", "dimension", "dimensionality")
PACKING_ATTRIBUTES = ("scale_factor", "add_offset")  # of files: their numbers are to change
APPROACH = ": the bodies must approach"
WHY_POSITIVE = dict.fromkeys(("speed", "normal_speed"), APPROACH)
PURE_UNITS = ("1", "-", "dimensionless")  # how tables and attributes call the unit of pure numbers

EXAMPLES = {
    "m": "5 mm",
    "Pa": "210 GPa",
    "kg/m^3": "7850 kg/m^3",
    "m/s": "2 m/s",
    "rad": "30 deg",
    "rad/s": "600 rpm",
    "s": "5 us",
    "N": "10 N",
    "Hz": "100 kHz",
    "m^2": "20 cm^2",
    "m^2/N": "1e-13 m^2/N",
    "Pa m^0.5": "0.75 MPa m^0.5",
    "1": "0.3",
}


def number(name: str, value: Any, unit: str | None = None, bare: Factor = UNCHANGED) -> float:
    """Return a value in SI units, a number or text with a unit ("5 mm"), or raise InputError.

    `bare` is how a number without a unit comes to be in SI units.
    """
    unit = unit or GLOSSARY[name].unit
    plain, own_unit = without_unit(name, value, unit)
    reason, enough = "", False
    try:
        if isinstance(plain, str):
            if own_unit is None:
                return read_text(plain, unit, bare)
            reason = f"it is a text, and has the unit {own_unit}, too"
        elif is_real(plain) and not math.isnan(real := as_float(name, plain)):
            return (bare if own_unit is None else factor_of(name, own_unit, unit)).apply(real)
    except Unreadable as error:
        reason, enough = str(error), error.enough
    words = filter(None, (reason, "" if enough else _expected(unit)))
    raise refusal(name, plain if isinstance(plain, str) else value, "; ".join(words))


def pure_number(name: str, value: Any, allowed: str = "give one number") -> float:
    """Return a number without a unit, perhaps NaN or infinite, or raise InputError."""
    plain, own_unit = without_unit(name, value, "1")
    if not is_real(plain):
        raise refusal(name, value, allowed)
    own = UNCHANGED if own_unit is None else factor_of(name, own_unit, "1")
    real = as_float(name, plain)
    return real if math.isnan(real) else number(name, real, "1", own)


def is_real(value: Any) -> bool:
    """Tell whether this is one real number: no truth value, no bytes, no array of one or more."""
    if getattr(value, "shape", None) == () and not getattr(value, "mask", False):
        kind = getattr(getattr(value, "dtype", None), "kind", None)  # other libraries have no kinds
        return (
            kind in REAL_KINDS if kind else "float" in str(value.dtype) or "int" in str(value.dtype)
        )
    return isinstance(value, Real | Decimal) and not isinstance(value, bool)


def as_float(name: str, value: Any) -> float:
    """Return one real number as a float, or raise InputError."""
    try:
        real = float(value)
        held = math.isfinite(real) or bool(value != value or value == real)
    except OverflowError:
        held = False
    except Exception:  # whatever other libraries raise, and Decimal("sNaN")
        raise refusal(name, value, "give one real number") from None
    refuse(not held and refusal(name, value, CANNOT_HOLD))
    return real


def finite_or_text(text: str) -> float | str:
    """Return a number of TOML or JSON, as a text if it is not finite, which no quantity is then."""
    return float(text) if math.isfinite(float(text)) else text


def without_unit(name: str, value: Any, unit: str = "") -> tuple[Any, Any]:
    """Return a value without its unit, and that unit, an object of pint's or a text, or None.

    Raises InputError for quantities of other libraries; `unit` is the one that is wanted.
    """
    if hasattr(value, "to_root_units"):
        return value.magnitude, value.units
    attributes = getattr(value, "attrs", None)
    if isinstance(attributes, Mapping):
        own, within = _unit_of_attributes(name, attributes), getattr(value, "data", None)
        if hasattr(within, "to_root_units"):
            if own:
                raise two_units(name, own, within.units)  # type: ignore[union-attr]
            return within.magnitude, within.units  # type: ignore[union-attr]
        if own:
            return (value.values if hasattr(value, "values") else value[()]), own
    elif bears_unit(value):
        plain = f"plain numbers in {unit}" if unit not in ("", "1") else "plain numbers"
        raise refusal(name, value, f"give {plain}, or a quantity of pint's")
    return value, None


def bears_unit(value: Any) -> bool:
    """Tell whether this is a quantity of some library: its bare numbers may be in any unit."""
    dimensions = getattr(value, "dimensions", ())  # of files they are the names of axes
    return any(hasattr(value, name) for name in UNIT_ATTRIBUTES) or not isinstance(
        dimensions, tuple
    )


def _unit_of_attributes(name: str, attributes: Mapping[Any, Any]) -> str:
    """Return the unit in the attributes of an array, or raise InputError for two."""
    values = [v for key, v in attributes.items() if str(key).lower() in ("unit", "units")]
    texts = [value.decode() if isinstance(value, bytes) else str(value) for value in values]
    units = list(dict.fromkeys(filter(None, texts)))
    if len(units) > 1:
        raise two_units(name, *units[:2])
    for key in PACKING_ATTRIBUTES:
        if key in attributes:
            allowed = "its numbers are packed; unpack them, e.g. by xarray.decode_cf"
            raise refusal(name, f"an array with the attribute {key}", allowed)
    return units[0] if units else ""


def two_units(name: str, one: Any, other: Any) -> InputError:
    """Return the error that refuses what has two units."""
    return InputError(f"{heading(name)}: it has two units, {one} and {other}; leave one out")


def factor_of(name: str, own: Any, unit: str) -> Factor:
    """Return how a unit, a text or pint's, becomes another; InputError for none or another kind."""
    try:
        if isinstance(own, str):
            return factor("" if own in PURE_UNITS else own, unit)
        return _of_pint(own, unit)
    except Unreadable as error:
        raise refusal(name, str(own), f"{error}; {_expected(unit)}") from None


def positive(name: str, value: Any, unit: str | None = None) -> float:
    """Return a positive finite value in SI units, or raise InputError."""
    allowed = f"must be positive and finite{WHY_POSITIVE.get(name, '')}"
    return _checked(name, value, unit, lambda x: x > 0.0, allowed)


def not_negative(name: str, value: Any, unit: str | None = None) -> float:
    """Return a finite value >= 0 in SI units, or raise InputError."""
    return _checked(name, value, unit, lambda x: x >= 0.0, "must be zero or positive and finite")


def finite(name: str, value: Any, unit: str | None = None) -> float:
    """Return a finite value in SI units, or raise InputError."""
    return _checked(name, value, unit, math.isfinite, "must be finite")


def within(name: str, value: Any, least: float, most: float, unit: str | None = None) -> float:
    """Return a value in SI units that is from `least` to `most`, or raise InputError."""
    unit = unit or GLOSSARY[name].unit
    result = number(name, value, unit)
    if least <= result <= most:
        return result
    in_unit = "" if unit == "1" else f" {unit}; check its unit"
    raise refusal(name, value, f"must be from {least:g} to {most:g}{in_unit}")


def _checked(
    name: str, value: Any, unit: str | None, is_allowed: Callable[[float], bool], allowed: str
) -> float:
    unit = unit or GLOSSARY[name].unit
    result = number(name, value, unit)
    if math.isfinite(result) and is_allowed(result):
        return result
    raise refusal(name, value, f"{allowed}, e.g. {_example(unit)}")


def _example(unit: str) -> str:
    return repr(EXAMPLES.get(unit, f"3 {unit}"))


def counted(name: str, value: Any, least: int, most: int = MOST_COUNTED) -> int:
    """Return a whole number that is large enough and not too large, or raise InputError."""
    count = int(value) if isinstance(value, Integral) and is_real(value) else None
    return _within(name, value, count, least, most)


def whole(name: str, text: str, least: int, most: int = MOST_COUNTED) -> int:
    """Return the whole number in a text of ASCII digits, or raise InputError."""
    plain = text.strip()
    return _within(name, text, int(plain) if WHOLE_NUMBER.fullmatch(plain) else None, least, most)


def _within(name: str, value: Any, count: int | None, least: int, most: int) -> int:
    if count is None or not least <= count <= most:
        few = count is None or count < least
        reach = f"of at least {least}" if few else f"from {least} to {most}"
        raise refusal(name, value, f"must be a whole number {reach}")
    return count


def threads_or_none(threads: Any) -> int | None:
    """Return how many threads are wanted, None for all cores, or raise InputError."""
    return None if threads is None else counted("threads", threads, 1, MOST_THREADS)


def or_none(value: float) -> float | None:
    """Return a number as JSON can hold it: None if it is not finite."""
    return float(value) if math.isfinite(value) else None


def _expected(unit: str) -> str:
    if unit == "1":
        return "give a number, e.g. 0.3 or '30 %'"
    return f"give a number in {unit}, or text with a unit such as {_example(unit)}"


def _of_pint(own: Any, unit: str) -> Factor:
    """Return how numbers in a unit of pint's become those in another, or raise Unreadable."""
    with suppress(Exception):  # pint raises what it likes at units with an offset
        quantity = type(1 * own)
        wanted = quantity(1, "" if unit == "1" else unit)
        kinds = (dict(each.to_root_units().unit_items()) for each in (quantity(1, own), wanted))
        if next(kinds) == next(kinds):
            nothing, one = (quantity(n, own).to(wanted.units).magnitude for n in (0, 1))
            if nothing == 0:  # no offset, no logarithm
                return as_factor(float(one))
    raise Unreadable(f"that is not a {'pure number' if unit == '1' else f'value in {unit}'}")
