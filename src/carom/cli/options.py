"""Commands and their options, and what is wrong with the words of a command line.

Options are given once, but for lists; typer takes the last. All faults of a line are told at once:
those of its words are collected here, and those of what they mean by the command (`checking`).
"""

import os
import shlex
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from contextvars import ContextVar
from difflib import get_close_matches
from inspect import Parameter, Signature, signature
from typing import Annotated, Any, TypeVar, get_origin

import typer
from typer.core import TyperCommand, TyperGroup, TyperOption

from carom.quantities.glossary import meant, remark
from carom.quantities.refusals import Faults, InputError, clipped, nearest
from carom.quantities.texts import is_unit

Command = TypeVar("Command", bound=Callable[..., None])
Names = Iterable[str] | Callable[[], Iterable[str]]

ARGUMENTS = "carom.arguments"  # of a command as they were given, in `meta` of its context
FAULTS = "carom.faults"  # of these arguments, there as well
VALUELESS = "carom.valueless"  # names of the options that lack their value
MISSPELT = 0.8  # how similar a word is to the one it stands for

_line: ContextVar[tuple[str, ...]] = ContextVar("line", default=())  # its faults so far


def file_option(words: str) -> Any:
    """Return the option of a file that is read; it is a text, as "" is a folder for `Path`."""
    return typer.Option(help=words, metavar="FILE")


COMMON: dict[str, Any] = {
    "as_json": typer.Option("--json", help="Print JSON instead of text."),
    "plot": "Store a figure of the result: .png, .pdf or .svg.",
}


class Interrupted(Exception):
    """A command was interrupted, as by Ctrl-C; typer drops what such an exception says."""


def checking() -> Faults:
    """Return what collects the faults of a command line, with those of its words."""
    return Faults(*_line.get())


class Quick:
    """What commands and groups of them do without waiting for pydantic and rich."""

    def get_help_option(self, ctx: Any) -> Any:
        """Return the option --help; typer has pydantic look at what is neither true nor false."""
        option = super().get_help_option(ctx)  # type: ignore[misc]
        option.default = False
        return option

    def shell_complete(self, ctx: Any, incomplete: str) -> list[Any]:
        """Return what a word may become, without help, which rich would wrap into words."""
        items: list[Any] = super().shell_complete(ctx, incomplete)  # type: ignore[misc]
        for item in items:
            item.help = None
        return items


class Group(Quick, TyperGroup):
    """A group of commands."""


class Once(Quick, TyperCommand):
    """A command that refuses an option given twice, unless it is one of several values."""

    def __init__(self, *given: Any, **named: Any) -> None:
        """Make the command, whose help names no types of Python."""
        super().__init__(*given, **named)
        for param in self.params:
            word = "VALUE" if isinstance(param, TyperOption) else ""
            vars(param)["display_type"] = lambda _, word=word: word

    def invoke(self, ctx: Any) -> Any:
        """Run the command; raises Interrupted for a KeyboardInterrupt."""
        token = _line.set(ctx.meta[FAULTS])
        try:
            return super().invoke(ctx)
        except InputError as error:  # a value that is missing is told once
            twice = [f"{name}: missing" for name in ctx.meta[VALUELESS]]
            told = (each for each in error.faults if not any(one in each for one in twice))
            raise InputError(*told) from None
        except KeyboardInterrupt as error:
            raise Interrupted(*error.args) from None
        finally:
            _line.reset(token)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Keep the arguments, their values, which are texts or flags, and what is wrong with them.

        Typer has pydantic look at them, which takes longer than most commands.
        """
        ctx.meta[ARGUMENTS] = tuple(args)
        faults: list[str] = []
        ctx.meta[VALUELESS] = set[str]()
        given, rest, order = self._parsed(ctx, list(args), faults)
        for option, count in Counter(order).items():
            if count > 1 and isinstance(option, TyperOption) and not option.multiple:
                names = "/".join((*option.opts, *option.secondary_opts))
                faults.append(f"{names}: it is given {count} times; leave all but one out")
        for param in sorted(self.get_params(ctx), key=lambda each: not each.is_eager):
            if param.is_eager:  # --help, which ends the command
                param.handle_parse_result(ctx, given, rest)
                continue
            value, source = param.consume_value(ctx, given)
            ctx.set_parameter_source(param.name, source)
            ctx.params[param.name] = list(value) if isinstance(value, tuple) else value
            if param.required and param.value_is_missing(value):
                what = param.opts[0] if isinstance(param, TyperOption) else param.metavar
                faults.append(f"{param.name}: missing; give {what}")
        if rest:
            advice = "put a value with blanks into quotes, e.g. '30 deg'"
            if any(map(os.path.exists, rest)):
                advice = f"see {ctx.command_path} --help for the files that it takes"
            faults.append(f"{clipped(shlex.join(rest))}: not expected; {advice}")
        ctx.meta[FAULTS], ctx.args = tuple(faults), rest
        return list(rest)

    def _parsed(self, ctx: Any, words: list[str], faults: list[str]) -> Any:
        """Return values by name, words left over and the order of parameters; collect faults."""
        while True:
            words = self._with_values(ctx, words, faults)
            left = list(words)
            try:
                return self.make_parser(ctx).parse_args(left)
            except typer.TyperException as error:
                place = len(words) - len(left) - 1
                near, known = option_meant(error)
                known = None if known in words else known
                faults.append(f"{(error.message if near else error.format_message()).rstrip('.')}")
                faults[-1] += f"; {near}" * bool(near)
                value = left[:1] if known is None and _is_value(words[place], left) else []
                instead = [] if known is None else [known, *words[place].split("=", 1)[1:]]
                words[place : place + 1 + len(value)] = instead

    def _with_values(self, ctx: Any, words: list[str], faults: list[str]) -> list[str]:
        """Return the words without options whose value is missing, units joined to their numbers.

        Both are faults, which it collects.
        """
        options = (each for each in self.get_params(ctx) if isinstance(each, TyperOption))
        wanting = {n: str(each.help) for each in options if not each.is_flag for n in each.opts}
        kept = ["", ""]
        for word, after in zip(words, [*words, "--"][1:], strict=True):
            option, value = kept[-2:]
            if word in wanting and after.startswith("--"):
                faults.append(f"{word}: its value is missing; {wanting[word].rstrip('.')}")
                ctx.meta[VALUELESS].add(word.strip("-").replace("-", "_"))
            elif option in wanting and is_unit(word) and not os.path.exists(word):
                kept[-1] = f"{value} {word}"
                faults.append(f"{option}: write '{kept[-1]}' in quotes")
            else:
                kept.append(word)
        return kept[2:]


def _is_value(option: str, after: list[str]) -> bool:
    """Tell whether the word after an unknown option is probably its value, and no file."""
    word = after[0] if after else "-"
    return "=" not in option and not word.startswith("-") and not os.path.exists(word)


def option_meant(error: typer.TyperException) -> tuple[str, str | None]:
    """Return a hint at the option that one stands for, and its name if there is hardly a doubt."""
    word = str(getattr(error, "option_name", "")).strip("-").replace("-", "_")
    context = getattr(error, "ctx", None)
    if not word or context is None or type(error).__name__ != "NoSuchOption":
        return "", None
    arguments = [each for each in context.command.params if not isinstance(each, TyperOption)]
    if there := [each.metavar or each.name for each in arguments if each.name == word]:
        return f"give {there[0]} alone", None
    options = [name for each in context.command.params for name in each.opts if name[0] == "-"]
    names = {name.strip("-").replace("-", "_"): name for name in options}
    name = meant(word, names)
    if name:
        return f"write {names[name]}{remark(word, name).removeprefix(name)}", names[name]
    plain = f"--{word.replace('_', '-')}"
    sure = get_close_matches(plain, options, n=1, cutoff=MISSPELT)
    return nearest(plain, options), next(iter(sure), None)


class Commands(typer.Typer):
    """Commands of this kind, with help as plain text, which comes where no command is given."""

    def __init__(self, name: str, words: str, kind: type[Group] = Group) -> None:
        plain: dict[str, Any] = {"rich_markup_mode": None, "pretty_exceptions_enable": False}
        plain |= {"no_args_is_help": True, "add_completion": False, "cls": kind}
        plain |= {"context_settings": {"help_option_names": ["--help", "-h"]}}
        super().__init__(name=name, help=words, **plain)

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


def _with_help(parameter: Parameter, option: Any) -> Parameter:
    if get_origin(option) is not Annotated:
        told = typer.Option(help=option) if isinstance(option, str) else option
        option = Annotated[parameter.annotation, told]
    return parameter.replace(kind=Parameter.KEYWORD_ONLY, annotation=option)


def file_argument(words: str) -> Any:
    """Return the argument of a file that is read."""
    return typer.Argument(help=words, metavar="FILE")


def name_option(words: str, names: Names) -> Any:
    """Return the option of a name; shells complete those that there are."""
    return typer.Option(help=words, autocompletion=names if callable(names) else lambda: names)


def whole_option(words: str) -> Any:
    """Return an option whose text `carom.quantities.units.whole` reads."""
    return typer.Option(help=words, metavar="INTEGER")
