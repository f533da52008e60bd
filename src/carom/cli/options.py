"""Commands and their options, which are given once, but for lists; typer takes the last."""

from collections import Counter
from collections.abc import Callable, Mapping
from inspect import Parameter, Signature, signature
from typing import TYPE_CHECKING, Annotated, Any, TypeVar, get_origin

import typer
from typer.core import TyperCommand, TyperOption

from carom.cli.cases import named_values, stored
from carom.io.paths import checked_output, replace_whole
from carom.quantities.refusals import InputError

if TYPE_CHECKING:
    from carom.io.heads import TableFormat

Command = TypeVar("Command", bound=Callable[..., None])

ARGUMENTS = "carom.arguments"  # of a command as they were given, in `meta` of its context


def file_option(words: str) -> Any:
    """Return the option of a file that is read; it is a text, as "" is a folder for `Path`."""
    return typer.Option(help=words, metavar="FILE")


COMMON: dict[str, Any] = {
    "as_json": typer.Option("--json", help="Print JSON instead of a table."),
    "plot": "Store a figure of the result: .png, .pdf or .svg.",
}
TABLE: dict[str, Any] = {  # how a user's table is read
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


class Interrupted(Exception):
    """A command was interrupted, as by Ctrl-C; typer drops what such an exception says."""


class Once(TyperCommand):
    """A command that refuses an option given twice, unless it is one of several values."""

    def invoke(self, ctx: Any) -> Any:
        """Run the command; raises Interrupted for a KeyboardInterrupt."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt as error:
            raise Interrupted(*error.args) from None

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Keep the arguments and read them, after a look at how often each option is there."""
        ctx.meta[ARGUMENTS] = tuple(args)
        order = self.make_parser(ctx).parse_args(list(args))[2]
        for option, count in Counter(order).items():
            if count > 1 and isinstance(option, TyperOption) and not option.multiple:
                names = "/".join((*option.opts, *option.secondary_opts))
                raise InputError(f"{names}: it is given {count} times; leave all but one out")
        return super().parse_args(ctx, args)


class Commands(typer.Typer):
    """Commands of this kind, with help as plain text, which comes where no command is given."""

    def __init__(self, name: str, words: str) -> None:
        plain: dict[str, Any] = {"rich_markup_mode": None, "pretty_exceptions_enable": False}
        super().__init__(name=name, help=words, no_args_is_help=True, add_completion=False, **plain)

    def command(self, name: str | None = None, **more: Any) -> Callable[..., Any]:
        """Return what registers a function as a command."""
        return super().command(name, cls=Once, **more)


def described(options: Mapping[str, Any]) -> Callable[[Command], Command]:
    """Return a decorator that gives the parameters of a command their help, or option of typer.

    Help lists them in the order of the options. A command with `**given` gets those options there
    that it does not name: texts, or None, unless they say another type.
    """

    def decorate(command: Command) -> Command:
        own = dict(signature(command).parameters)
        if own.pop("given", None):
            text = Parameter("given", Parameter.KEYWORD_ONLY, default=None, annotation=str | None)
            own |= {name: text for name in options if name not in own}
        told = ((n, option) for n, option in {**options, **COMMON, **options}.items() if n in own)
        shown = [_with_help(own.pop(name).replace(name=name), option) for name, option in told]
        command.__signature__ = Signature([*own.values(), *shown])  # type: ignore[attr-defined]
        return command

    return decorate


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


def _with_help(parameter: Parameter, option: Any) -> Parameter:
    if get_origin(option) is not Annotated:
        told = typer.Option(help=option) if isinstance(option, str) else option
        option = Annotated[parameter.annotation, told]
    return parameter.replace(kind=Parameter.KEYWORD_ONLY, annotation=option)


def file_argument(words: str) -> Any:
    """Return the argument of a file that is read."""
    return typer.Argument(help=words, metavar="FILE")


def whole_option(words: str) -> Any:
    """Return an option whose text `carom.quantities.units.whole` reads."""
    return typer.Option(help=words, metavar="INTEGER")
