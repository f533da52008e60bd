"""`carom verify lammps`, `liggghts`, `yade`: DEM programs against the exact impact."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from carom.verify.benchmark import Bench
    from carom.verify.engines.running import Engine

CaseFile = Annotated[
    Path | None, typer.Option(help="Case file as for `carom impact`: the bodies (steel, 1.4412).")
]
Steps = Annotated[int, typer.Option(help="Time steps per duration of Hertz's contact.")]
Limit = Annotated[str, typer.Option(help="Time limit of each run, e.g. '60 s'.")]
Program = Annotated[str | None, typer.Option(help="Where the program is (searched for).")]
Output = Annotated[
    str | None, typer.Option(help="Store the results of one --law: .csv, for carom verify score.")
]
OneLaw = Annotated[str | None, typer.Option(help="Only this law, named as by `carom verify laws`.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]


def lammps_command(
    case: CaseFile = None,
    law: OneLaw = None,
    steps: Steps = 2000,
    time_limit: Limit = "120 s",
    program: Program = None,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Run LAMMPS through impacts with each of its laws and rank them by their error in psi_2.

    Example: carom verify lammps

    To a verdict: carom verify lammps --law mindlin --output results.csv, and carom verify score
    """
    from carom.verify.engines.lammps import Lammps

    _run(Lammps(program), case, law, steps, time_limit, output, as_json)


def liggghts_command(
    case: CaseFile = None,
    law: OneLaw = None,
    steps: Steps = 2000,
    time_limit: Limit = "120 s",
    program: Program = None,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Run LIGGGHTS through impacts with each of its laws and rank them by their error in psi_2.

    Example: carom verify liggghts
    """
    from carom.verify.engines.liggghts import Liggghts

    _run(Liggghts(program), case, law, steps, time_limit, output, as_json)


def yade_command(
    case: CaseFile = None,
    law: OneLaw = None,
    steps: Steps = 2000,
    time_limit: Limit = "120 s",
    program: Program = None,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Run YADE through impacts with each of its laws and rank them by their error in psi_2.

    Example: carom verify yade
    """
    from carom.verify.engines.yade import Yade

    _run(Yade(program), case, law, steps, time_limit, output, as_json)


def _run(
    engine: "Engine",
    case: Path | None,
    law: str | None,
    steps: int,
    time_limit: str,
    output: str | None,
    as_json: bool,
) -> None:
    from carom.bodies.cases import pair_of, read_case
    from carom.io.files import checked_output
    from carom.quantities.units import InputError, positive
    from carom.verify.benchmark import bench
    from carom.verify.catalogue import named

    if output is not None:
        checked_output(output, (".csv",))
        if law is None:
            raise InputError("output: needs one --law, e.g. --law mindlin: results are of one")
    found = bench(
        engine,
        named(law),
        pair=None if case is None else pair_of(read_case(case)),
        steps=steps,
        time_limit=positive("time_limit", time_limit),
    )
    if output is not None and not found.failed:
        _store(found, output)
    typer.echo(json.dumps(found.as_record(), indent=2) if as_json else str(found))
    if found.failed:
        raise typer.Exit(1)


def _store(found: "Bench", output: str) -> None:
    """Store results as the scorer reads them."""
    from carom.io.files import checked_output, replace_whole

    text = found.results()
    target = checked_output(output, (".csv",))
    replace_whole(target, lambda where: where.write_text(text, encoding="utf-8", newline="\n"))
    typer.echo(f"stored {output}", err=True)
