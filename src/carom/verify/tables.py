"""Tables in reports: columns of numbers under their names."""

from collections.abc import Iterable, Sequence
from typing import Any


def text_table(columns: str, rows: Iterable[Sequence[Any]]) -> list[str]:
    """Return the lines of a table, its head first, from names and formats like "max:7.3f steps:6d".

    None is a dash, ~ in a name a space; a text that a row has beyond its columns follows them.
    """
    names, _, forms = zip(*(column.partition(":") for column in columns.split()), strict=True)
    lines = []
    for row in ([name.replace("~", " ") for name in names], *rows):
        cells = [_cell(value, form) for value, form in zip(row, forms, strict=False)]
        lines.append("  ".join(["  " + " ".join(cells), *row[len(forms) :]]))
    return lines


def _cell(value: Any, form: str) -> str:
    """Return a value as wide as its format says, numbers and their heads on the right."""
    if value is None or isinstance(value, str):
        width = form.partition(".")[0].strip("<>+sde")
        return f"{'-' if value is None else value:{'<' if form[0] == '<' else '>'}{width}s}"
    return format(value, form)
