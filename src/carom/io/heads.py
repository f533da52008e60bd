"""What the heads of columns mean: names, units, and what users say that they stand for."""

import json
import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from math import isclose, pi
from pathlib import Path
from typing import Any, NamedTuple

from carom.io.cells import Column
from carom.io.files import read_toml
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, checked_type, heading, hint, nearest, refusal
from carom.quantities.texts import LONGEST_TEXT, UNCHANGED, is_unit
from carom.quantities.units import factor_of, two_units

ALIASES = {"psi_1": "psi_in", "psi_2": "psi_out", "angle_deg": "angle [deg]"}
SPELLINGS = {name: alias for alias, name in ALIASES.items()}
HEAD = re.compile(r"\s*(.*?)\s*(?:/?\s*\[(.*)\]|/?\s*\((.*)\))?\s*", re.DOTALL)  # also v / (m/s)
SPOKEN = re.compile(r"(.*\S) in (\S+)")  # angle in deg
EXAMPLE = "{'omega': 'spin_out'}"


class TableFormat(NamedTuple):
    """How a table is to be read: what its heads stand for, its sheet, its decimal sign."""

    columns: Mapping[str, str]
    sheet: str = ""
    decimal: str = ""


def table_format(columns: Any, sheet: Any = None, decimal: Any = None) -> TableFormat:
    """Return how a table is to be read, or raise InputError; `columns` may name a TOML file."""
    own: dict[str, Any] = {}
    if isinstance(columns, str | Path):
        own = _stored(columns)
        columns = own.get("columns")
    names = {} if columns is None else columns
    told = names.values() if isinstance(names, Mapping) else [None]
    if not all(isinstance(name, str) and name.strip() for name in told):
        allowed = "must map heads of columns to names, or name a TOML file that does"
        raise refusal("columns", columns, f"{allowed}, e.g. {EXAMPLE}")
    texts = {"sheet": sheet, "decimal": decimal}
    for name, value in texts.items():
        texts[name] = own.get(name, "") if value is None else value
        checked_type(name, texts[name], str, "must be a text")
    if texts["decimal"] not in ("", ".", ","):
        raise refusal("decimal", texts["decimal"], "must be '.' or ','")
    return TableFormat({str(head): name for head, name in names.items()}, **texts)


def _stored(path: str | Path) -> dict[str, Any]:
    """Return what a TOML file says, or raise InputError."""
    remedy = '; it must have a table [columns], e.g. "omega [rpm]" = "spin_out"'
    read, _ = read_toml("columns", path, remedy)
    names = TableFormat._fields
    for key in filter(lambda key: key not in names, read):
        raise InputError(f"columns: {heading(key)!r} in {path} is unknown; {hint(key, names)}")
    return read


def as_toml(how: TableFormat) -> str:
    """Return the text of a TOML file that says how a table is read, with a table [columns]."""
    texts = ("sheet", how.sheet), ("decimal", how.decimal)
    own = [f"{name} = {_quoted(text)}\n" for name, text in texts if text]
    columns = [f"{_quoted(head)} = {_quoted(name)}\n" for head, name in how.columns.items()]
    return "".join([*own, *(["\n"] if own else []), "[columns]\n", *columns])


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def spelled(name: str) -> str:
    """Return how a user may call a column."""
    return SPELLINGS.get(name, name)


def renamed(
    columns: Iterable[Column], names: Mapping[str, str], what: str, wrong: list[str]
) -> list[tuple[str, Column]]:
    """Return names of columns, users' names replaced by Carom's, and these with their units.

    Adds to what is wrong names that no column has, and a unit that is told otherwise.
    """
    left, new = dict(names), list[tuple[str, Column]]()
    for column in columns:
        own, unit = parts_of(column.head)
        wanted = left.pop(column.head, None) or left.pop(own, None)
        words = (column.head if wanted is None else wanted).strip()
        name, new_unit = parts_of(ALIASES.get(words, words))
        name = ALIASES.get(name, name)
        try:
            if wanted is not None and not is_open(name, unit, new_unit):
                new_unit = one_unit(own, unit, new_unit)
            new_unit = one_unit(name, new_unit, column.unit)
        except InputError as error:
            wrong.append(str(error))
        new.append((name, column._replace(unit=new_unit)))
    heads = [column.head for _, column in new]
    for name in left:
        near = nearest(name, heads) or f"its columns are {', '.join(heads)}"
        wrong.append(str(refusal("columns", name, f"{what} has no column of that name; {near}")))
    return new


def parts_of(head: str) -> tuple[str, str]:
    """Return the name and the unit of a head: v [m/s], v (m/s), v / (m/s) or v in m/s."""
    match = HEAD.fullmatch(head) if len(head) <= LONGEST_TEXT else None
    if match is None or not match[1]:  # brackets alone are no unit of a name
        return head, ""
    unit = (match[2] or match[3] or "").strip()
    spoken = None if unit else SPOKEN.fullmatch(match[1])
    if spoken and (is_unit(spoken[2]) or spoken[2].startswith("1/")):
        return spoken[1], spoken[2]
    return match[1], unit


def is_open(name: str, own: str, said: str = "") -> bool:
    """Tell whether the unit in a head cannot be read, so that it must be said what it means.

    A frequency in the head of a spin may mean turns or radians, but no other unit than these.
    """
    quantity = name.removesuffix("_error")
    si = GLOSSARY[quantity].unit if quantity in GLOSSARY else ""
    if not own or not si:
        return False
    with suppress(InputError):
        factor_of(name, own, si)
        return False
    if si != "rad/s":
        return not is_unit(own)
    with suppress(InputError):
        radians = factor_of(name, own, "Hz").apply(1.0)
        spin = factor_of(name, said, si).apply(1.0) if said else radians
        return any(isclose(spin, each) for each in (radians, 2.0 * pi * radians))
    return not is_unit(own)


def one_unit(name: str, one: Any, other: Any) -> Any:
    """Return the unit that is told in one way or in two, or raise InputError if they differ."""
    if "" in (str(one), str(other)) or str(one) == str(other):
        return one if str(one) else other
    with suppress(InputError):
        if factor_of(name, other, str(one)) == UNCHANGED:
            return other
    raise two_units(name, one, other)
