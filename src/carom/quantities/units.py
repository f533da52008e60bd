"""Reading and checking what users give: numbers, text with a unit, and clear refusals."""

import math
from collections.abc import Iterable, Mapping
from decimal import Decimal
from difflib import get_close_matches
from numbers import Integral, Real
from typing import Any

from carom.quantities.glossary import GLOSSARY
from carom.quantities.symbols import meant, remark
from carom.quantities.texts import Factor, Unreadable, factor, read_text

Value = float | str  # a number in SI units, or text with a unit


class InputError(ValueError):
    """What was given cannot be used; the message names it, its value, and what is allowed."""

    __module__ = "carom"  # the name by which users know it


LONGEST = 120  # characters of a value that a refusal shows

HINTS = {
    "m": "5 mm",
    "Pa": "210 GPa",
    "kg/m^3": "7850 kg/m^3",
    "m/s": "2 m/s",
    "rad": "30 deg",
    "rad/s": "600 rpm",
    "s": "5 us",
    "N": "10 N",
    "1": "0.3",
}


def number(name: str, value: Any, unit: str | None = None) -> float:
    """Return a value in SI units: a number, or text with a unit such as "5 mm".

    Raises InputError for anything else, for an unknown unit and for a unit of another kind.

    Examples
    --------
    >>> import math
    >>> from carom.quantities.units import number
    >>> number("radius", "5 mm")
    0.005
    >>> number("angle", "90 deg") == math.pi / 2
    True
    """
    unit = unit or GLOSSARY[name].unit
    plain = in_si(name, value, unit)
    if isinstance(plain, str):
        return _of_text(name, plain, unit)
    known = isinstance(plain, Real | Decimal) or getattr(plain, "shape", None) == ()
    if not known or isinstance(plain, bool) or str(getattr(plain, "dtype", "")) == "bool":
        raise refusal(name, value, _expected(unit))
    try:
        result = float(plain)
    except (TypeError, ValueError):
        raise refusal(name, value, _expected(unit)) from None
    except OverflowError:
        raise refusal(name, value, "floating point cannot hold it") from None
    if math.isnan(result):
        raise refusal(name, value, _expected(unit))
    return result


def in_si(name: str, given: Any, unit: str) -> Any:
    """Return what is given as it is, or without its unit: pint's quantities, xarray's arrays.

    Raises InputError for a unit of another kind, and for quantities of other libraries.
    """
    if hasattr(given, "to_root_units"):
        return _of_pint(name, given, unit)
    attributes = getattr(given, "attrs", None)
    if isinstance(attributes, Mapping):
        own = attributes.get("units", unit)
        return given if own == unit else factor_of(name, str(own), unit).apply(given)
    if hasattr(given, "unit") or hasattr(given, "units"):
        raise refusal(name, given, f"give plain numbers in {unit}, or a quantity of pint's")
    return given


def factor_of(name: str, expression: str, unit: str) -> Factor:
    """Return how numbers with one unit become those of another, or raise InputError."""
    try:
        return factor(expression, unit)
    except Unreadable as error:
        raise refusal(name, expression, f"{error}; {_expected(unit)}") from None


def positive(name: str, value: Any) -> float:
    """Return a positive finite value in SI units, or raise InputError."""
    result = number(name, value)
    if not 0.0 < result < math.inf:
        raise refusal(name, value, f"must be positive and finite, e.g. {_example(name)}")
    return result


def not_negative(name: str, value: Any) -> float:
    """Return a finite value >= 0 in SI units, or raise InputError."""
    result = number(name, value)
    if not 0.0 <= result < math.inf:
        raise refusal(name, value, f"must be zero or positive and finite, e.g. {_example(name)}")
    return result


def finite(name: str, value: Any, unit: str | None = None) -> float:
    """Return a finite value in SI units, or raise InputError."""
    result = number(name, value, unit)
    if not math.isfinite(result):
        raise refusal(name, value, "must be finite")
    return result


def counted(name: str, value: Any, least: int) -> int:
    """Return a whole number that is large enough, or raise InputError."""
    if isinstance(value, bool) or not isinstance(value, Integral) or value < least:
        raise refusal(name, value, f"must be a whole number of at least {least}")
    return int(value)


def or_none(value: float) -> float | None:
    """Return a number as JSON can hold it: None if it is not finite.

    Examples
    --------
    >>> from carom.quantities.units import or_none
    >>> or_none(2), or_none(float("inf")), or_none(float("nan"))
    (2.0, None, None)
    """
    return float(value) if math.isfinite(value) else None


def refusal(name: str, value: Any, allowed: str) -> InputError:
    """Return the error that refuses a value."""
    shape = getattr(value, "shape", ())
    shown = f"an array of shape {shape}" if shape and isinstance(shape, tuple) else repr(value)
    if len(shown) > LONGEST:
        shown = f"{shown[:LONGEST]}..."
    return InputError(f"{name}: {' '.join(shown.split())} cannot be used; {allowed}")


def nearest(word: str, known: Iterable[str]) -> str:
    """Return a hint at the known words that are nearest to one."""
    found = get_close_matches(word, list(known), n=3, cutoff=0.5)
    return f"did you mean {' or '.join(repr(name) for name in found)}?" if found else ""


def hint(word: object, known: Iterable[str]) -> str:
    """Return a hint at the known word that one stands for, at the nearest, or at all of them."""
    known = tuple(known)
    if name := meant(str(word), known):
        return f"write {remark(str(word), name)}"
    return nearest(str(word), known) or f"known are {', '.join(known)}"


def _example(name: str) -> str:
    return f"'{HINTS[GLOSSARY[name].unit]}'"


def _expected(unit: str) -> str:
    if unit == "1":
        return "give a number, e.g. 0.3 or '30 %'"
    return f"give a number in {unit}, or text with a unit such as {HINTS.get(unit, f'3 {unit}')!r}"


def _of_text(name: str, text: str, unit: str) -> float:
    try:
        return read_text(text, unit)
    except Unreadable as error:
        expected = () if error.enough else (_expected(unit),)
        raise refusal(name, text, "; ".join(filter(None, (str(error), *expected)))) from None


def _of_pint(name: str, quantity: Any, unit: str) -> Any:
    """Return the magnitude of a quantity of pint's in a unit, or raise InputError."""
    wanted = type(quantity)(1.0, "" if unit == "1" else unit)
    kinds = (dict(each.to_root_units().unit_items()) for each in (quantity, wanted))
    try:
        if next(kinds) == next(kinds):
            return quantity.to(wanted.units).magnitude
    except Exception:  # pint raises what it likes at units with an offset
        pass
    raise refusal(name, quantity, f"that is not a value in {unit}; {_expected(unit)}") from None
