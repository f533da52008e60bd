"""The grammar of a quantity in a text: a number, then at most one unit expression.

    number = [sign] digits [. digits] [e [sign] digits], or with a cross and 10^[sign] digits
    unit   = term {product term} [/ term],  term = name [power]

Digits are ASCII, a sign is +, - or the minus U+2212, a product is a space, *, a raised dot or a
full stop between names, a power is ^2, **2 or raised digits, -2 at the end of a name, as in the CF
conventions, or 2 or 3 at the end of a length. Whatever else stands in a text makes it unreadable,
so that pint, which multiplies and drops what it does not understand, is asked for the names of
units alone. The table of spellings in docs/input.md is what tests try.
"""

import re
from functools import lru_cache
from math import inf, isinf, log10, pi
from typing import Any, NamedTuple

LONGEST_TEXT = 200  # characters of a text
MOST_TERMS = 4  # of a unit expression
CANNOT_HOLD = "floating point cannot hold it"

BLANKS = " \t\u00a0\u2009\u202f"  # no-break and thin spaces, too
MINUS = "\u2212"
CROSS = "\u00d7"  # of powers of ten
SIGN = rf"[+\-{MINUS}]?"
LOWERED = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹" + MINUS, "+-0123456789-")
RAISED_DIGITS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
MANTISSA = rf"{SIGN}(?:[0-9]+\.?[0-9]*|\.[0-9]+)"
TIMES = rf"[{BLANKS}]*{CROSS}[{BLANKS}]*10(?:\^({SIGN}[0-9]+)|([⁺⁻]?[{RAISED_DIGITS}]+))"
NUMBER = re.compile(rf"({MANTISSA})(?:[eE]({SIGN}[0-9]+)|{TIMES})?")
OTHER_TIMES = re.compile(  # without raised digits it may have lost them
    rf"[{BLANKS}]*(?:[{CROSS}·⋅*][{BLANKS}]*10|x[{BLANKS}]*10[⁺⁻^{RAISED_DIGITS}])"
)
LENGTH_END = r"(?:(?<=m)|(?<=in)|(?<=ft))"
NAME = rf"[^\W\d{RAISED_DIGITS}]+|[%‰°˚]"
SPACED = rf"[{BLANKS}]*(?:\^|\*\*)[{BLANKS}]*({SIGN}[1-9])"  # pint writes blanks around **
CF = rf"(?<=[^\W\d_])([{MINUS}-][1-9])"
POWER = rf"{SPACED}|([⁺⁻]?[{RAISED_DIGITS[1:]}])|{CF}|{LENGTH_END}([23])"
TERM = re.compile(rf"({NAME})(?:{POWER})?(?![0-9{RAISED_DIGITS}^])")
PRODUCT = re.compile(rf"[{BLANKS}]*[*·⋅][{BLANKS}]*|[{BLANKS}]+|\.(?=[^\W\d_])")
SLASH = re.compile(rf"[{BLANKS}]*/[{BLANKS}]*")
SPELT = {"rev": "turn", "revs": "turn", "U": "turn", "RPM": "rpm", **dict.fromkeys("°º˚", "degree")}
OTHER_KIND = {
    "1": "it has a unit, but a pure number is needed",
    "rad/s": "a spin is not in {0}; write rad/s or rpm",
}
LENGTHS = "meter inch foot yard mile thou micron angstrom nautical_mile"
MASSES = "gram pound ounce metric_ton slug liter cubic_centimeter"
TIMES = "second minute hour day hertz becquerel"
FORCES = "newton dyne force_kilogram force_gram force_pound kip joule"
PRESSURES = "pascal bar pound_force_per_square_inch kip_per_square_inch standard_atmosphere torr"
ANGLES = "radian degree arcminute arcsecond turn grade"
SPINS = "revolutions_per_minute revolutions_per_second"
SPEEDS = "knot mile_per_hour kilometer_per_hour meter_per_second foot_per_second"
RATIOS = "percent permille ppm"
KINDS = (LENGTHS, MASSES, TIMES, FORCES, PRESSURES, ANGLES, SPINS, SPEEDS, RATIOS)
PINT_NAMES = frozenset(" ".join(KINDS).split())  # pint's whole names; constants of nature are none
COMMON = {  # of most texts: for these pint, which takes a quarter of a second, is not loaded
    "m": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9},
    "m/s": {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3},
    "rad": {"rad": 1.0, "deg": pi / 180.0, "°": pi / 180.0},
    "rad/s": {"rad/s": 1.0, "rpm": pi / 30.0},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6},
    "N": {"N": 1.0, "mN": 1e-3, "kN": 1e3},
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/mm^2": 1e6},
    "Hz": {"Hz": 1.0, "kHz": 1e3, "MHz": 1e6},
    "kg/m^3": {"kg/m^3": 1.0, "g/cm^3": 1e3},
    "1": {"%": 1e-2},
    "Pa m^0.5": {"Pa m^0.5": 1.0, "MPa m^0.5": 1e6},
    "m^2/N": {"m^2/N": 1.0, "mm^3/(N m)": 1e-9},
}
TOUGHNESS = "Pa m^0.5"  # the only unit with half a power: read as it is usually written, no other
WEAR_COEFFICIENT = "m^2/N"
CURVATURE = "1/m"
PER_LENGTH = {"1/m": 1.0, "1/cm": 1e2, "1/mm": 1e3, "m^-1": 1.0, "cm^-1": 1e2, "mm^-1": 1e3}
ROOT = r"(?:m(?:\^0\.5|\^\(1/2\)|\^1/2|1/2|½|\*\*0\.5)|sqrt\(m\)|√m)"
SPELT_OUT = {  # as people write them, which the grammar has no words for; sizes by what is captured
    TOUGHNESS: (re.compile(rf"([kM]?)Pa(?:[ *·.]{ROOT}|√m)"), {"": 1.0, "k": 1e3, "M": 1e6}),
    WEAR_COEFFICIENT: (
        re.compile(r"(m?m)(?:\^3|³|3)/(?:\(N[ *·.]?m\)|N/?m)|(1/[MG]?Pa)"),
        {"mm": 1e-9, "m": 1.0, "1/Pa": 1.0, "1/MPa": 1e-6, "1/GPa": 1e-9},
    ),
    CURVATURE: (re.compile(r"(1/[mc]?m|[mc]?m\^-1)"), PER_LENGTH),
}
FOLDED = str.maketrans("", "", BLANKS + "^*·⋅.(){}")


DATE = re.compile(r"[0-9]{4}(-|/)[0-9]{1,2}\1[0-9]|[0-9]{1,2}(-|/|\.)[0-9]{1,2}\2[0-9]{2}")


class Unreadable(ValueError):
    """A text is no quantity, or of another kind; `enough` if the message says what to do, too."""

    def __init__(self, reason: str = "", *, enough: bool = False) -> None:
        super().__init__(reason)
        self.enough = enough


class Factor(NamedTuple):
    """What numbers are multiplied and divided by to be in another unit; one of both is 1.

    Powers of ten divide where they can, so that 5 um is the float nearest to 5e-6.
    """

    times: float
    over: float

    def apply(self, number: float) -> float:
        """Return a float in the other unit, or raise Unreadable if it overflows."""
        converted = number * self.times / self.over
        if isinf(converted) and not isinf(number):
            raise Unreadable(CANNOT_HOLD, enough=True)
        return converted


UNCHANGED = Factor(1.0, 1.0)


def as_factor(ratio: float) -> Factor:
    """Return the factor that is this ratio, powers of ten exactly, or raise Unreadable."""
    if not 0.0 < ratio < inf:
        raise Unreadable(CANNOT_HOLD)
    decades = round(log10(ratio))
    if abs(ratio - 10.0**decades) > 1e-12 * ratio:
        return Factor(ratio, 1.0)
    return Factor(10.0 ** max(decades, 0), 10.0 ** max(-decades, 0))


def read_text(text: str, unit: str, bare: Factor = UNCHANGED) -> float:
    """Return the quantity in a text, in a unit; `bare` is how a bare number comes to be in it."""
    value, expression = split(text)
    return (factor(expression, unit) if expression else bare).apply(value)


def split(text: str) -> tuple[float, str]:
    """Return the number in a text and its unit, perhaps empty; Unreadable if no float holds it."""
    if len(text) > LONGEST_TEXT:
        raise Unreadable(f"it is longer than {LONGEST_TEXT} characters", enough=True)
    plain = text.strip(BLANKS)
    match = NUMBER.match(plain)
    if DATE.match(plain):
        raise Unreadable("it is a date, as spreadsheets make of 3.4; write the number", enough=True)
    if match is None:
        raise Unreadable() if plain else Unreadable("it is empty")
    mantissa = match[1].replace(MINUS, "-")
    value = float(f"{mantissa}e{(match[2] or match[3] or match[4] or '0').translate(LOWERED)}")
    if isinf(value) or (value == 0.0 and re.search("[1-9]", mantissa)):
        raise Unreadable(CANNOT_HOLD, enough=True)
    rest = plain[match.end() :]
    if rest.startswith(","):
        raise Unreadable("numbers need a decimal point, not a comma", enough=True)
    if OTHER_TIMES.match(rest):
        raise Unreadable(f"write powers of ten as in 5e3 or 5{CROSS}10^3", enough=True)
    return value, rest.strip(BLANKS)


def factor(expression: str, unit: str) -> Factor:
    """Return how a unit becomes another; Unreadable for another kind, of which angles are one."""
    result = _factor(expression, unit)
    if isinstance(result, Unreadable):
        raise Unreadable(str(result), enough=result.enough)
    return result


def is_unit(expression: str) -> bool:
    """Tell whether a text is a unit, of whatever quantity."""
    try:
        _root(_terms(expression))
    except (Unreadable, ArithmeticError):
        return False
    return bool(expression)


@lru_cache(maxsize=4096)
def _factor(expression: str, unit: str) -> Factor | Unreadable:
    if expression in COMMON.get(unit, {}):
        return as_factor(COMMON[unit][expression])
    pattern, sizes = SPELT_OUT.get(unit, (NUMBER, {}))
    if sizes and (spelt := pattern.fullmatch(expression)):
        return as_factor(sizes[spelt[spelt.lastindex or 0]])
    if unit == TOUGHNESS:
        return Unreadable(f"{expression!r} is not a unit of fracture toughness")
    try:
        terms = _terms(expression)
        own, wanted = _root(terms), _root(_terms("" if unit == "1" else unit))
        if own[1] == wanted[1]:
            ratio = as_factor(own[0] / wanted[0])
            _refuse_doubled(terms)
            return ratio
    except Unreadable as error:
        plain = expression.lower().translate(LOWERED).translate(FOLDED)
        common = (each for each in COMMON.get(unit, ()) if each.lower().translate(FOLDED) == plain)
        meant = next(common, "")  # a common unit in other letters
        return Unreadable(f"{error}; write {meant!r}", enough=True) if meant else error
    except ArithmeticError:
        return Unreadable(CANNOT_HOLD)
    words = OTHER_KIND.get(unit, "that is not a value in {1}")
    return Unreadable(words.format(expression or "1", unit))


def _terms(expression: str) -> tuple[tuple[str, int], ...]:
    """Return names of units and their powers, or raise Unreadable."""
    if not expression:  # that of pure numbers
        return ()
    terms: list[tuple[str, int]] = []
    place, sign = 0, 1
    while True:
        match = TERM.match(expression, place)
        if match is None or len(terms) == MOST_TERMS:
            raise Unreadable(f"{expression!r} is not a unit")
        power = next(filter(None, match.groups()[1:]), "1").translate(LOWERED)
        terms.append((match[1], sign * int(power)))
        place = match.end()
        if place == len(expression):
            return tuple(terms)
        slash = SLASH.match(expression, place)
        step = slash or PRODUCT.match(expression, place)
        if step is None:
            raise Unreadable(f"{expression!r} is not a unit")
        if sign < 0:  # what a second slash, or a product after one, divides is not sure
            raise Unreadable(f"{expression!r} is not a unit; one unit may follow '/', as in kg/m^3")
        place, sign = step.end(), -1 if slash else 1


def _root(terms: tuple[tuple[str, int], ...]) -> tuple[float, Any]:
    """Return the factor and the basic units of a product of powers."""
    registry = _registry()
    powers: dict[str, int] = {}
    for name, power in terms:
        whole = _whole_name(name)
        powers[whole] = powers.get(whole, 0) + power
    root = registry.get_root_units(registry.Unit(registry.UnitsContainer(powers)))
    return float(root[0]), root[1]


def _refuse_doubled(terms: tuple[tuple[str, int], ...]) -> None:
    """Raise Unreadable for a unit that is repeated, and for a ratio beside another unit."""
    sides = [(_whole_name(name), power > 0) for name, power in terms]
    for (name, _), (whole, above) in zip(terms, sides, strict=True):
        if whole in RATIOS.split() and terms != ((name, 1),):
            raise Unreadable(f"{name!r} stands alone, without another unit and without a power")
        if sides.count((whole, above)) > 1:
            raise Unreadable(f"unit {name!r} is given twice; leave one out, or write a power")


@lru_cache(maxsize=1024)
def _whole_name(name: str) -> str:
    """Return pint's name of a unit, in small letters if written out, or raise Unreadable."""
    parse, small = _registry().parse_unit_name, name.lower()
    if small == "grad":
        raise Unreadable(f"{name!r} may be degrees or gon; write deg or gon", enough=True)
    for each, ends in ((SPELT.get(name, name), ()), (small, (small, small.removesuffix("s")))):
        for prefix, unit, _ in parse(each)[:1]:
            if unit in PINT_NAMES and prefix + unit in (ends or (prefix + unit,)):
                return str(prefix + unit)
    raise Unreadable(f"unit {name!r} is not known")


@lru_cache(maxsize=1)
def _registry() -> Any:
    import pint

    try:  # parsing the definitions anew takes longer than an impact
        return pint.UnitRegistry(cache_folder=":auto:")
    except Exception:  # a cache that cannot be used is no reason to fail
        return pint.UnitRegistry()
