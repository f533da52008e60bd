"""What commands share: flags over a case file, files that are asked for, interpreted kernels."""

import sys
from collections.abc import Mapping
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

import carom
from carom.quantities.units import refusal

if TYPE_CHECKING:
    from carom.bodies.cases import Case
    from carom.plots.result import Result

Json = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]
Plot = Annotated[str | None, typer.Option(help="Store a figure: .png, .pdf or .svg.")]


def whole_option(words: str) -> Any:
    """Return an option whose text `carom.quantities.units.whole` reads."""
    return typer.Option(help=words, metavar="INTEGER")


may_interpret = False  # in a process that runs one command


class Output(NamedTuple):
    """Files a case asks for."""

    plot: str | None
    animation: str | None
    data: str | None


def merged(case: "Case", flags: Mapping[str, Any]) -> "Case":
    """Return the case with what the flags give in place of what the file gives."""
    from carom.bodies.cases import LOSSES

    result = {key: dict(value) if isinstance(value, dict) else value for key, value in case.items()}
    given = {name for name, value in flags.items() if value is not None}
    polar, cartesian = {"speed", "angle"}, {"normal_speed", "tangential_speed"}
    for one, other in ((polar, cartesian), (cartesian, polar), (set(LOSSES), set(LOSSES))):
        if given & one:
            result = {name: value for name, value in result.items() if name not in other}
    for name in given:
        table, _, key = name.rpartition(".")
        (result.setdefault(table, {}) if table else result)[key] = flags[name]
    return result


def outputs(case: "Case") -> Output:
    """Return the files that a case asks for."""
    table = case.get("output", {})
    for name, value in table.items():
        if not isinstance(value, str):
            raise refusal(name, value, "must be the name of a file")
    return Output(*(table.get(name) for name in Output._fields))


def refuse_same(files: Mapping[str, str | Path | None]) -> None:
    """Raise InputError if two of the files, by what they are for, are one."""
    given = {name: Path(file).resolve() for name, file in files.items() if file is not None}
    for (one, path), (other, same) in combinations(given.items(), 2):
        if path == same:
            raise refusal(other, str(files[other]), f"it is the file of {one}; give another name")


def check_outputs(*files: tuple[str | None, tuple[str, ...]]) -> None:
    """Raise InputError if a file cannot be written or has another ending."""
    from carom.io.files import checked_output

    for path, endings in files:
        if path is not None:
            checked_output(path, endings)


def store(result: "Result", output: str | None, plot: str | None) -> None:
    """Store a result and its figure, where they are asked for."""
    if output is not None:
        stored(carom.save(result, output))
    if plot is not None:
        result.plot(plot)
        stored(plot)


def stored(path: str | Path) -> None:
    """Tell that a file was written."""
    typer.echo(f"stored {path}", err=True)


def interpret() -> None:
    """Let kernels run as Python in this process: one impact is done sooner than they are loaded."""
    if may_interpret and "carom.dimensionless.numerics.jit" not in sys.modules:
        import numba
        import numpy as np

        numba.config.DISABLE_JIT = True  # type: ignore[attr-defined]
        np.seterr(all="ignore")  # as in compiled code
