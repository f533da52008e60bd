"""How a command reads a user's table: what its columns mean, its sheet, its decimal sign."""

from typing import TYPE_CHECKING

from carom.cli.cases import named_values, stored
from carom.io.paths import checked_output, replace_whole

if TYPE_CHECKING:
    from carom.io.heads import TableFormat


def table_format_of(
    column: list[str] | None,
    columns: str | None,
    sheet: str | None,
    decimal: str | None,
    save_columns: str | None,
    example: str = "omega=spin_out",
) -> "TableFormat":
    """Return how a table is to be read by the options of a command; it is stored if asked for."""
    from carom.io.heads import as_toml, table_format

    target = None if save_columns is None else checked_output(save_columns, (".toml",))
    own = table_format(columns, sheet, decimal)
    how = own._replace(columns={**own.columns, **named_values("column", column, example)})
    if target is not None:
        text = as_toml(how)
        replace_whole(target, lambda file: file.write_text(text, encoding="utf-8", newline="\n"))
        stored(target)
    return how
