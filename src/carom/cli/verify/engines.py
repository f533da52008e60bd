"""`carom verify lammps`, `liggghts`, `yade`: DEM programs on the bench; `carom verify pack`."""

import json

import typer

import carom
from carom.cli.cases import stored, told_case
from carom.cli.options import described, file_option, whole_option
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
    as_json: bool = False,
) -> None:
    """Run the program that the command is named after, and print how it has done."""
    from carom.bodies.cases import pair_of
    from carom.io.paths import checked_output, replace_whole
    from carom.verify.engines.experiments import MOST_STEPS
    from carom.verify.entries import named

    count = whole("steps", steps, 10, MOST_STEPS)
    target = None if output is None else checked_output(output, (".csv",))
    if target is not None and law is None:
        raise InputError("output: it stores the results of one law; give --law, e.g. --law mindlin")
    engine = getattr(carom.verify, str(context.command.name).capitalize())
    found = carom.verify.bench(
        engine(program),
        named(law),
        pair=None if case is None else pair_of(told_case(case)),
        steps=count,
        time_limit=positive("time_limit", time_limit),
    )
    if target is not None and not found.failed:
        text = found.results()
        replace_whole(target, lambda file: file.write_text(text, encoding="utf-8", newline="\n"))
        stored(target)
    typer.echo(json.dumps(found.to_dict(), indent=2) if as_json else str(found))
    if found.failed:
        raise typer.Exit(1)


PACK = {
    "folder": typer.Argument(help="New or empty folder for the pack, e.g. bench."),
    "as_json": typer.Option("--json", help="Print JSON instead of a summary."),
}


@described(PACK)
def pack_command(folder: str, as_json: bool = False) -> None:
    """Write the benchmark pack for developers of DEM codes.

    Use this command to test a DEM code that you write. The pack holds reference impacts with error
    bars, and inputs of DEM codes for them. A version of the pack has the same numbers, to the last
    byte, wherever it is written.

    \b
    Example: carom verify pack bench
    """
    from carom.verify.pack import VERSION, write_pack

    files = write_pack(folder)
    if as_json:
        typer.echo(json.dumps({"version": VERSION, "folder": folder, "files": files}, indent=2))
        return
    typer.echo(
        f"Carom has written benchmark pack {VERSION}, {len(files)} files, into {folder}. "
        "Start with its README.md."
    )
