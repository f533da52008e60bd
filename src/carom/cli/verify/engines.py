"""`carom verify lammps`, `liggghts`, `yade`: DEM programs against the exact impact."""

import json

import typer

import carom
from carom.cli.cases import (
    Json,
    check_outputs,
    described,
    file_option,
    stored,
    told_case,
    whole_option,
)
from carom.quantities.refusals import InputError
from carom.quantities.units import positive, whole

PURPOSE = """\
Run {0} and rank its contact laws by their error.

Use this command to see how far the rebound in {0} is from the exact impact, with each contact law
that the program has. The error is that of psi_2, the dimensionless tangential velocity of the
contact point after the impact. {0} must be installed.

\b
Example: carom verify {1}
"""
VERDICT = """\
Results of one law, and a verdict on them:
  carom verify lammps --law mindlin --output results.csv
  carom verify score results.csv
"""
COMMANDS = {
    name.lower(): PURPOSE.format(name, name.lower()) for name in ("LAMMPS", "LIGGGHTS", "YADE")
}
COMMANDS["lammps"] += VERDICT


OPTIONS = {
    "case": file_option(
        "Case file, as for carom impact, with the bodies (default: a steel ball on a steel "
        "plate, chi = 1.4412)."
    ),
    "law": "Run only this law, by its name in carom verify laws.",
    "steps": whole_option("Time steps per duration of Hertz's contact."),
    "time_limit": "Time limit of each run, e.g. '60 s'.",
    "program": "Path of the executable (default: Carom looks for it).",
    "output": "Store the results of the one --law as .csv, for carom verify score.",
}


@described(OPTIONS)
def engine_command(
    context: typer.Context,
    case: str | None = None,
    law: str | None = None,
    steps: str = "2000",
    time_limit: str = "120 s",
    program: str | None = None,
    output: str | None = None,
    as_json: Json = False,
) -> None:
    """Run the program that the command is named after, and print how it has done."""
    from carom.bodies.cases import pair_of
    from carom.io.paths import checked_output, replace_whole
    from carom.verify.engines.experiments import MOST_STEPS
    from carom.verify.entries import named

    count = whole("steps", steps, 10, MOST_STEPS)
    check_outputs({"output": (output, (".csv",))})
    if output is not None and law is None:
        raise InputError("output: it stores the results of one law; give --law, e.g. --law mindlin")
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
