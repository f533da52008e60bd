"""`carom sweep`: many impacts from a case file with a table [sweep]."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from math import degrees, isnan
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import carom
from carom.cli.cases import (
    Column,
    Json,
    check_outputs,
    file_argument,
    named_values,
    outputs,
    stored,
    tell,
    told_case,
    whole_option,
)
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import refusal
from carom.quantities.units import or_none, whole

if TYPE_CHECKING:
    from carom.bodies.cases import Case
    from carom.sweeps.summaries import Summary


def sweep_command(
    case: Annotated[Path, file_argument("Case file with a table [sweep].")],
    column: Column = None,
    store: Annotated[
        str | None, typer.Option(help="Store block by block in a Zarr folder, e.g. sweep.zarr.")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue what the store has of this sweep.")
    ] = False,
    quantities: Annotated[
        str | None, typer.Option(help="What to compute, e.g. 'rebound_angle, yield_speed_second'.")
    ] = None,
    output: Annotated[str | None, typer.Option(help="Store at the end: .nc or .csv.")] = None,
    scheduler: Annotated[
        str | None, typer.Option(help="Use a dask cluster, e.g. tcp://host:8786.")
    ] = None,
    workers: Annotated[str | None, whole_option("Threads (default: all cores).")] = None,
    as_json: Json = False,
    progress: Annotated[
        bool | None,
        typer.Option("--progress/--no-progress", help="Show a bar (default: on a terminal)."),
    ] = None,
) -> None:
    """Solve the impacts of a grid, a Latin hypercube or a table of cases.

    Example: carom sweep examples/sweep.toml --output sweep.nc

    One that may be killed: carom sweep examples/sweep.toml --store sweep.zarr --resume

    From which speed on the bodies yield: the same with --quantities yield_speed_second
    """
    from carom.io.files import TABLES
    from carom.sweeps.plans import plan
    from carom.sweeps.summaries import summary

    content = told_case(case, losses=True, swept=True)
    file = _file(content) if output is None else output
    check_outputs((file, TABLES))
    design, chosen = plan(content, case, named_values("column", column, "omega=spin"))
    if quantities is not None:
        chosen = [name.strip() for name in quantities.split(",")]
    tell(design.doubts())
    with _stopping():
        threads = None if workers is None else whole("workers", workers, 1)
        how: dict[str, Any] = {"scheduler": scheduler, "workers": threads, "progress": progress}
        dataset = carom.sweep(content, design, outputs=chosen, store=store, resume=resume, **how)
    if file is not None:
        carom.save(dataset, file)
    result = summary(dataset, chosen)
    typer.echo(json.dumps(_record(result, store, file), indent=2) if as_json else _table(result))
    for path in filter(None, (store, file)):
        stored(path)
    if store is None and file is None:
        typer.echo("not stored; --store sweep.zarr or --output sweep.nc keeps it", err=True)


def _file(content: "Case") -> str | None:
    """Return the file that the case asks for; figures and spectra are of one impact."""
    files = outputs(content)
    for name, verb in (("plot", "draws"), ("animation", "draws"), ("spectrum", "computes")):
        if (path := getattr(files, name)) is not None:
            raise refusal(name, path, f"a sweep {verb} none; leave it out")
    return files.data


@contextmanager
def _stopping() -> Iterator[None]:
    """If a sweep stops, say in one line why and what is safe, and exit with 1."""
    from carom.sweeps.records import SweepStopped

    try:
        yield
    except (SweepStopped, KeyboardInterrupt) as error:
        stopped = "stopped; " if isinstance(error, KeyboardInterrupt) else ""
        typer.echo(f"carom: {stopped}{error}", err=True)
        raise typer.Exit(1) from None


def _record(result: "Summary", store: str | None, output: str | None) -> dict[str, Any]:
    """Return the summary as what JSON can hold; what is not a number becomes null."""
    ranges = {
        name: {"min": or_none(low), "max": or_none(high), "units": GLOSSARY[name].unit}
        for name, (low, high) in result.ranges.items()
    }
    return {
        "points": result.points,
        "sizes": result.sizes,
        "status": result.statuses,
        "ranges": ranges,
        "store": store,
        "output": output,
    }


def _table(result: "Summary") -> str:
    along = ", ".join(f"{name} ({size})" for name, size in result.sizes.items())
    statuses = [f"  {meaning:58s} {count:13d}" for meaning, count in result.statuses.items()]
    head = f"  {'':58s} {'from':>13s} {'to':>13s}"
    ranges = [_range(name, *span) for name, span in result.ranges.items()]
    return "\n".join([f"{result.points} points along {along}", *statuses, head, *ranges])


def _range(name: str, low: float, high: float) -> str:
    unit = GLOSSARY[name].unit
    if unit == "rad":
        low, high, unit = degrees(low), degrees(high), "deg"
    values = " ".join("-".rjust(13) if isnan(x) else f"{x:13.6g}" for x in (low, high))
    return f"  {GLOSSARY[name].meaning:58s} {values}{'' if unit == '1' else f' {unit}'}"
