"""`carom verify lammps`, `liggghts`, `yade`: DEM programs against the exact impact."""

import json
from pathlib import Path
from typing import Annotated

import typer

import carom
from carom.cli.cases import Json, check_outputs, file_option, stored, told_case, whole_option
from carom.quantities.refusals import InputError
from carom.quantities.units import positive, whole

PURPOSE = """\
Run {} through impacts with each of its laws and rank them by their error in psi_2.

Example: carom verify {}
"""
VERDICT = """
To a verdict: carom verify lammps --law mindlin --output results.csv, and carom verify score
"""
COMMANDS = {
    name.lower(): PURPOSE.format(name, name.lower()) for name in ("LAMMPS", "LIGGGHTS", "YADE")
}
COMMANDS["lammps"] += VERDICT


def engine_command(
    context: typer.Context,
    case: Annotated[
        Path | None, file_option("Case file as for `carom impact`: the bodies (steel, 1.4412).")
    ] = None,
    law: Annotated[
        str | None, typer.Option(help="Only this law, named as by `carom verify laws`.")
    ] = None,
    steps: Annotated[str, whole_option("Time steps per duration of Hertz's contact.")] = "2000",
    time_limit: Annotated[str, typer.Option(help="Time limit of each run, e.g. '60 s'.")] = "120 s",
    program: Annotated[
        str | None, typer.Option(help="Where the program is (searched for).")
    ] = None,
    output: Annotated[
        str | None,
        typer.Option(help="Store the results of one --law: .csv, for carom verify score."),
    ] = None,
    as_json: Json = False,
) -> None:
    """Run the program that the command is named after, and print how it has done."""
    from carom.bodies.cases import pair_of
    from carom.io.paths import checked_output, replace_whole
    from carom.verify.catalogue import named
    from carom.verify.engines.experiments import MOST_STEPS

    count = whole("steps", steps, 10, MOST_STEPS)
    check_outputs((output, (".csv",)))
    if output is not None and law is None:
        raise InputError("output: needs one --law, e.g. --law mindlin: results are of one")
    engine = getattr(carom.verify, str(context.command.name).capitalize())
    found = carom.verify.bench(
        engine(program),
        named(law),
        pair=None if case is None else pair_of(told_case(case)),
        steps=count,
        time_limit=positive("time_limit", time_limit),
    )
    if output is not None and not found.failed:
        target, text = checked_output(output, (".csv",)), found.results()
        replace_whole(target, lambda file: file.write_text(text, encoding="utf-8", newline="\n"))
        stored(output)
    typer.echo(json.dumps(found.to_dict(), indent=2) if as_json else str(found))
    if found.failed:
        raise typer.Exit(1)
