"""Options that say how a user's table is read."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.cases import named_values, store_text
from carom.cli.options import file_option
from carom.io.paths import checked_output
from carom.quantities.refusals import Faults

if TYPE_CHECKING:
    from carom.io.heads import TableFormat

TABLE: dict[str, Any] = {
    "column": Annotated[
        list[str] | None,
        typer.Option(
            help="The quantity in a column of your table that has another name, e.g. omega=spin, "
            "or 'w=spin [rpm]' with its unit. You can repeat this option."
        ),
    ],
    "columns": file_option(
        "TOML file that says it for many columns, in a table [columns], as --save-columns writes."
    ),
    "sheet": "The sheet of a spreadsheet; FILE:SHEET says it, too.",
    "decimal": "Decimal sign of the numbers in the file, ',' or '.', where they leave it open.",
    "save_columns": file_option("Store --column, --sheet and --decimal for --columns: .toml."),
}


def table_format_of(given: Mapping[str, Any], example: str = "omega=spin_out") -> "TableFormat":
    """Return how a table is to be read by the options `TABLE`, or raise InputError."""
    from carom.io.heads import table_format

    with Faults() as faults:
        if given["save_columns"] is not None:
            faults.trying(checked_output, given["save_columns"], (".toml",))
        own = faults.trying(table_format, given["columns"], given["sheet"], given["decimal"])
        names = faults.trying(named_values, "column", given["column"], example)
    how: TableFormat = own._replace(columns={**own.columns, **names})
    return how


def store_format(how: "TableFormat", name: str | None) -> None:
    """Store how a table is read, if that is asked for."""
    from carom.io.heads import as_toml

    if name is not None:
        store_text(as_toml(how), name)
