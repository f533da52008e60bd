"""Reading and checking what users give: numbers, text with a unit, and clear refusals."""

import math
from collections.abc import Iterable
from difflib import get_close_matches
from functools import lru_cache
from numbers import Integral
from typing import Any

from carom.quantities.glossary import GLOSSARY

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
    "rad/s": "100 rad/s",
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
    if isinstance(value, str):
        result = _parsed(name, value, unit)
    elif isinstance(value, bool) or value is None:
        raise refusal(name, value, _expected(unit))
    else:
        try:
            result = float(value)
        except (TypeError, ValueError):
            raise refusal(name, value, _expected(unit)) from None
    if math.isnan(result):
        raise refusal(name, value, _expected(unit))
    return result


def without_units(name: str, given: Any) -> Any:
    """Return what is given, one value or a list, with text such as "5 mm" made SI numbers."""
    if isinstance(given, str):
        return number(name, given)
    if isinstance(given, list | tuple) and name in GLOSSARY:
        return [number(name, each) if isinstance(each, str) else each for each in given]
    return given


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
    """Return a hint at the known words that are nearest to one, or at all of them."""
    known = tuple(known)
    return nearest(str(word), known) or f"known are {', '.join(known)}"


def _example(name: str) -> str:
    return f"'{HINTS[GLOSSARY[name].unit]}'"


def _expected(unit: str) -> str:
    if unit == "1":
        return "give a number without a unit, e.g. 0.3"
    return f"give a number in {unit}, or text with a unit such as '{HINTS[unit]}'"


def _parsed(name: str, text: str, unit: str) -> float:
    try:
        return float(text)
    except ValueError:
        pass
    if "," in text:  # pint would drop it
        raise refusal(name, text, "numbers need a decimal point, not a comma")
    if "%" in text:
        raise refusal(name, text, "write a percentage as a number, 0.2 for 20 percent")
    import pint

    try:
        quantity = _registry().Quantity(text)
        if quantity.unitless:
            return float(quantity.magnitude)
        if quantity.dimensionless and unit == "1":
            raise refusal(name, text, f"it has a unit; {_expected(unit)}")
        if unit == "rad/s" and str(quantity.units) == "hertz":
            raise refusal(name, text, "a spin is not in Hz; write 'rpm' or 'rad/s'")
        return float(quantity.to("" if unit == "1" else unit).magnitude)
    except pint.UndefinedUnitError as error:
        unknown = error.unit_names if isinstance(error.unit_names, str) else error.unit_names[0]
        raise refusal(name, text, f"unit {unknown!r} is not known; {_expected(unit)}") from None
    except pint.DimensionalityError as error:
        kind = (
            f"that is in {error.units1}, not a value in {unit}" if unit != "1" else "it has a unit"
        )
        raise refusal(name, text, f"{kind}; {_expected(unit)}") from None
    except InputError:
        raise
    except Exception:  # pint lets errors of the tokenizer through
        raise refusal(name, text, _expected(unit)) from None


@lru_cache(maxsize=1)
def _registry() -> Any:
    import pint

    try:  # parsing the definitions anew takes longer than an impact
        return pint.UnitRegistry(cache_folder=":auto:")
    except Exception:  # a cache that cannot be used is no reason to fail
        return pint.UnitRegistry()
