"""`carom sweep`: many impacts from a case file with a table [sweep]."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

import carom
from carom.cli.cases import check_outputs, outputs, read_case_file, require_some, stored, tell
from carom.cli.options import checking, described, file_argument, whole_option
from carom.cli.tables import TABLE, store_format, table_format_of
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import shared
from carom.quantities.refusals import refusal
from carom.quantities.units import or_none, whole

if TYPE_CHECKING:
    from carom.bodies.cases import Case
    from carom.many.sweeps.records import Summary


OPTIONS = {
    "case": file_argument("Case file with a table [sweep], which says what to vary."),
    **TABLE,
    "store": "Store the results in a Zarr folder while they are computed, e.g. sweep.zarr.",
    "resume": typer.Option("--resume", help="Continue the sweep in --store, or begin it."),
    "quantities": "Quantities to compute, separated by commas, e.g. 'rebound_angle, "
    "yield_speed_second' (default: those that the case file names, or all).",
    "output": "Store the results at the end: .nc or .csv.",
    "scheduler": "Address of a dask cluster to use, e.g. tcp://host:8786.",
    "workers": whole_option("Number of threads (default: one for each core)."),
    "progress": typer.Option(
        "--progress/--no-progress",
        help="Show progress (default): a bar on a terminal, elsewhere a line every ten seconds.",
    ),
}


@described(OPTIONS)
def sweep_command(
    case: str,
    store: str | None = None,
    resume: bool = False,
    quantities: str | None = None,
    output: str | None = None,
    scheduler: str | None = None,
    workers: str | None = None,
    as_json: bool = False,
    progress: bool | None = None,
    **given: Any,
) -> None:
    """Solve many impacts: a grid, a Latin hypercube or a table.

    Use this command to see how the rebound depends on angle, friction, material or any other input.
    The table [sweep] of the case file says what is varied. Every point has a status that says
    whether it was solved, and if not, why.

    \b
    Example: carom sweep examples/sweep.toml --output sweep.nc
    A long sweep that you can stop and continue:
      carom sweep examples/sweep.toml --store sweep.zarr --resume
    The speeds above which the second body yields:
      carom sweep examples/sweep.toml --quantities yield_speed_second
    """
    from carom.many.sweeps.any_shape import problem_of
    from carom.many.sweeps.records import summary
    from carom.many.sweeps.tables import plan

    with checking() as faults:
        threads = faults.if_given(whole, "workers", workers, 1)
        file, table = output, faults.trying(table_format_of, given, "omega=spin")
        content = None
        if case is not None:
            content = faults.trying(read_case_file, case, losses=True, swept=True)
        if content is not None:
            own = faults.trying(_file, content)
            file = own if output is None else output
        faults.trying(check_outputs, {"output": file})
        if content is not None:
            design, chosen = plan(content, Path(case), table)
            if quantities is not None:
                chosen = [name.strip() for name in quantities.split(",")]
            problem_of(content, design, chosen)
    store_format(table, given["save_columns"])
    tell(design._doubts())
    with _stopping():
        how: dict[str, Any] = {"scheduler": scheduler, "workers": threads, "progress": progress}
        dataset = carom.sweep(content, design, outputs=chosen, store=store, resume=resume, **how)
    if file is not None:
        carom.save(dataset, file)
    result = summary(dataset, chosen)
    typer.echo(json.dumps(_record(result, store, file), indent=2) if as_json else _table(result))
    for path in filter(None, (store, file)):
        stored(path)
    if store is None and file is None:
        advice = "add --output sweep.nc or --store sweep.zarr to keep them"
        typer.echo(f"Carom has not stored the results; {advice}.", err=True)
    require_some(result.solved, result.points)


def _file(content: "Case") -> str | None:
    """Return the file that the case asks for; figures and spectra are of one impact."""
    files = outputs(content)
    for name, verb in (("plot", "draws"), ("animation", "draws"), ("spectrum", "computes")):
        if name in files:
            words = f"carom sweep {verb} none, carom impact does; leave it out"
            raise refusal(name, files[name], words)
    return files.get("data")


@contextmanager
def _stopping() -> Iterator[None]:
    """If a sweep stops, say in one line why and what is safe; exit with 1 if it cannot go on."""
    from carom.many.sweeps.records import SweepStopped

    try:
        yield
    except SweepStopped as error:
        typer.echo(f"carom: {error}", err=True)
        raise typer.Exit(1) from None
    except KeyboardInterrupt as error:
        safe = f"; {error}" if error.args else ""
        raise KeyboardInterrupt(f"the sweep was stopped{safe}") from None


def _record(result: "Summary", store: str | None, output: str | None) -> dict[str, Any]:
    ranges = {
        name: {"min": or_none(low), "max": or_none(high), "units": GLOSSARY[name].unit}
        for name, (low, high) in result.ranges.items()
    }
    numbers = {"points": result.points, "sizes": result.sizes, "status": result.statuses}
    return {**numbers, "ranges": ranges, "store": store, "output": output}


def _table(result: "Summary") -> str:
    along = ", ".join(f"{name} ({size})" for name, size in result.sizes.items())
    statuses = [f"  {meaning:58s} {count:13d}" for meaning, count in result.statuses.items()]
    head = f"  {'':58s} {'from':>13s} {'to':>13s}"
    ranges = [_range(name, *span) for name, span in result.ranges.items()]
    return "\n".join([f"{result.points} points along {along}", *statuses, head, *ranges])


def _range(name: str, low: float, high: float) -> str:
    ends, unit = shared((low, high), GLOSSARY[name].unit)
    after = "" if unit == "1" else f" {unit}"
    if unit == "rad":
        after = f" deg ({' to '.join(ends)} rad)"
        ends, _ = shared((degrees(low), degrees(high)), "deg")
    values = " ".join(f"{end:>13s}" for end in ends)
    return f"  {GLOSSARY[name].meaning:58s} {values}{after}"
