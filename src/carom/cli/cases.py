"""What commands share: flags over a case file, files that are asked for."""

import os
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

import carom
from carom.io.paths import replace_whole
from carom.quantities.refusals import Faults, InputError, checked_type, refusal, refuse

if TYPE_CHECKING:
    from carom.bodies.cases import Case
    from carom.plots.result import Result


def named_values(option: str, texts: list[str] | None, example: str) -> dict[str, str]:
    """Return the values by name of texts like "restitution=0.98", or raise InputError."""
    values: dict[str, str] = {}
    faults: list[InputError] = []
    for text in texts or []:
        name, equals, value = (part.strip() for part in text.rpartition("="))
        if not (name and equals and value):
            faults.append(refusal(option, text, f"write a name and a value, e.g. {example}"))
        elif name in values:
            faults.append(refusal(option, text, f"{name} is given twice; leave one of them out"))
        values[name] = value
    refuse(*faults)
    return values


def merged(case: "Case", flags: Mapping[str, Any]) -> "Case":
    """Return the case with what the flags give in place of what the file gives."""
    from carom.bodies.cases import LOSSES, RATIO

    result = {key: dict(value) if isinstance(value, dict) else value for key, value in case.items()}
    changed = {name for name, value in flags.items() if value is not None}
    polar, cartesian = {"speed", "angle"}, {"normal_speed", "tangential_speed"}
    relaxing = {"relaxation_time"}  # whose ratio of moduli stays
    losses = (relaxing, {*LOSSES}), ({*LOSSES} - relaxing, {*LOSSES, RATIO})
    for one, other in ((polar, cartesian), (cartesian, polar), *losses):
        if changed & one:
            result = {name: value for name, value in result.items() if name not in other}
    for name in changed:
        table, _, key = name.rpartition(".")
        (result.setdefault(table, {}) if table else result)[key] = flags[name]
    return result


def tell(doubts: Iterable[str]) -> None:
    """Tell on stderr what is hardly meant, or left out."""
    for doubt in doubts:
        typer.echo(f"carom: {doubt}", err=True)


def require_some(solved: int, points: int) -> None:
    """Exit with 1, after a line, if fewer than one point in ten is solved."""
    if 10 * solved < points:
        tell([f"{solved} of {points} points are solved, the others are NaN; give other values"])
        raise typer.Exit(1)


def tell_sweep(case: "Case") -> None:
    """Tell that the table [sweep] of a case is left out, if there is one."""
    if "sweep" in case:
        tell(["the table [sweep] is ignored here; carom sweep computes what it describes"])


def read_case_file(path: str, *, losses: bool = False, swept: bool = False) -> "Case":
    """Return the content of a case file; what is hardly meant, or left out, is told on stderr."""
    from carom.bodies.cases import read_case
    from carom.bodies.plausibility import doubts_of_case

    case = read_case(path, losses=losses)
    tell(doubts_of_case(case))
    if not swept:
        tell_sweep(case)
    return case


def outputs(case: "Case") -> dict[str, str]:
    """Return the files that a case asks for, by what they hold."""
    table = case.get("output", {})
    return {n: checked_type(n, v, str, "must be the name of a file") for n, v in table.items()}


def check_outputs(outputs: Mapping[str, str | None], **inputs: str | Path | None) -> None:
    """Raise InputError if a file cannot be written, has another ending, or serves two purposes."""
    from carom.io.files import DOCUMENTS, FIGURES, TABLES
    from carom.io.paths import checked_output

    figures = {"plot": FIGURES, "posterior": (*TABLES, *FIGURES), "map": (*FIGURES, *TABLES)}
    figures["report"] = DOCUMENTS
    real: dict[str, str] = {}
    with Faults() as faults:
        for name, path in {**inputs, **outputs}.items():
            if path is None:
                continue
            if name in outputs:
                faults.trying(checked_output, path, figures.get(name, TABLES))
            with suppress(ValueError):  # no file can have such a name, as its reader says
                same = real.setdefault(os.path.realpath(path), name)
                words = f"this file is also that of {same}; give another name"
                faults.add(*([str(refusal(name, str(path), words))] if same != name else []))


def store(result: "Result", output: str | None, plot: str | None) -> None:
    """Store a result and its figure, where they are asked for."""
    if output is not None:
        stored(carom.save(result, output))
    if plot is not None:
        result.plot(plot)
        stored(plot)


def stored(path: str | Path) -> None:
    """Tell that a file was written."""
    typer.echo(f"Carom has stored {path}.", err=True)


def store_text(text: str, name: str) -> None:
    """Store a text in UTF-8, and tell that."""
    replace_whole(Path(name), lambda f: f.write_text(text, encoding="utf-8", newline="\n"))
    stored(name)
