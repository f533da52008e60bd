"""Commands whose options are given once, but for those that are lists; typer takes the last."""

from collections import Counter
from collections.abc import Callable
from typing import Any

import typer
from typer.core import TyperCommand, TyperOption

from carom.quantities.refusals import InputError


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
        """Read the arguments, after a look at how often each option is among them."""
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
