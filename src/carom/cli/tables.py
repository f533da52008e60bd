"""How a command reads a user's table: what its columns mean, its sheet, its decimal sign."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from carom.cli.cases import named_values, stored
from carom.io.paths import checked_output, replace_whole

if TYPE_CHECKING:
    from carom.io.heads import TableFormat


def table_format_of(given: Mapping[str, Any], example: str = "omega=spin_out") -> "TableFormat":
    """Return how a table is to be read by the options `TABLE`; it is stored if asked for."""
    from carom.io.heads import as_toml, table_format

    stored_as = given["save_columns"]
    target = None if stored_as is None else checked_output(stored_as, (".toml",))
    own = table_format(given["columns"], given["sheet"], given["decimal"])
    names = named_values("column", given["column"], example)
    how = own._replace(columns={**own.columns, **names})
    if target is not None:
        text = as_toml(how)
        replace_whole(target, lambda file: file.write_text(text, encoding="utf-8", newline="\n"))
        stored(target)
    return how
