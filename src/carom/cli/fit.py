"""`carom fit`: friction, stiffness and restitution from measured rebounds."""

import json
import shlex
from collections.abc import Mapping, Sequence
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

import carom
from carom.cli import completion
from carom.cli.cases import check_outputs, named_values, read_case_file, store, stored
from carom.cli.options import (
    ARGUMENTS,
    checking,
    described,
    file_argument,
    file_option,
    name_option,
    whole_option,
)
from carom.cli.tables import TABLE, store_format, table_format_of
from carom.quantities.refusals import Faults, InputError, refusal, refuse
from carom.quantities.units import whole

if TYPE_CHECKING:
    from carom.bodies.pairs import Pair
    from carom.io.heads import TableFormat
    from carom.io.user_table import UserTable
    from carom.lab.fitting import Fit, JointFit
    from carom.lab.fitting.advice import Advice

    Measured = tuple[UserTable, Pair | None]

ONE_SET = "it is of one set of data; give one file"
OPTIONS = {
    "data": file_argument(
        "CSV file or spreadsheet with one impact per row and units in its head, e.g. 'angle "
        "[deg]'. Of several files the parameters are compared."
    ),
    "dataset": name_option(
        "Published measurements that come with Carom, e.g. kharaz2001, instead.",
        completion.datasets,
    ),
    "case": file_option(
        "Case file, as for carom impact, with the bodies; needed if the data hold none. For "
        "several files give one for all, or repeat this option for one after the other."
    ),
    "share": "Parameters, separated by commas, that are the same in several files.",
    "thickness": "Thickness of the plate that is struck, e.g. '3 mm' [m], in place of that of the "
    "case; where it is fitted, that to begin with.",
    "vary": "Parameters to fit, separated by commas, of friction, kappa (or chi), restitution, "
    "spin_offset and, on a plate, thickness instead of restitution (default: the first three, or "
    "restitution or thickness for vertical drops).",
    "fix": "A parameter that you know, with its value, e.g. restitution=0.98. You can repeat this "
    "option.",
    "confidence": "Confidence level of the intervals.",
    **TABLE,
    "squares": typer.Option("--squares", help="Use least squares, in which outliers count fully."),
    "template": typer.Option("--template", help="Print an empty table to fill in, and exit."),
    "advice": whole_option("Number of further measurements to plan: print their best angles."),
    "about": typer.Option(
        "--for",
        help="Parameter that --advice shall make more certain (default: the least certain).",
    ),
    "posterior": "Sample the posterior with emcee, and store the samples (.nc or .csv) or a "
    "corner plot (.png, .pdf or .svg).",
    "steps": whole_option("Number of steps for --posterior."),
    "seed": whole_option("Seed of the random numbers for --posterior."),
    "report": "Write a report to read and to print: .html or .pdf. It holds the figure, and says "
    "what the uncertainty comes from and what was neglected.",
    "output": "Store data, fit and curves: .csv or .nc.",
}


@described(OPTIONS)
def fit_command(
    context: typer.Context,
    data: list[str] | None = None,
    dataset: str | None = None,
    case: list[str] | None = None,
    thickness: str | None = None,
    vary: str | None = None,
    share: str | None = None,
    fix: list[str] | None = None,
    confidence: str = "0.95",
    squares: bool = False,
    template: bool = False,
    advice: str | None = None,
    about: str | None = None,
    posterior: str | None = None,
    steps: str = "1000",
    seed: str = "0",
    plot: str | None = None,
    report: str | None = None,
    output: str | None = None,
    as_json: bool = False,
    **given: Any,
) -> None:
    """Fit friction, stiffness and restitution to measured rebounds.

    Use this command after a drop test. It prints each parameter with its confidence interval, says
    which parameters the data do not determine, and compares the exact theory with rigid spheres.

    The motion before an impact is in the columns angle and speed; or normal_speed and
    tangential_speed; or angle, contact_angle or psi_in alone if no speed is needed. The columns
    spin and spin2 may be added. Of the motion after the impact give any of normal_restitution,
    normal_speed_out, tangential_restitution, tangential_speed_out, rebound_speed, rebound_angle,
    spin_out, contact_restitution, contact_beta, contact_rebound_angle, impulse_ratio and psi_out;
    on a plate also duration, the contact time. A column thickness holds those of many plates.
    surface_angle and surface_angle_out are angles from the surface, spin_out_magnitude is a spin
    without sign. Of vertical drops give drop_height or normal_speed, and rebound_height,
    normal_speed_out or normal_restitution; or times, bounce_interval or bounce_time. Further
    bounces of a drop are in rebound_height_2, rebound_height_3 and so on. A column group tells
    which rows repeat one setting.
    Leave a cell blank, or write '-', where nothing was measured. Standard deviations are in columns
    such as spin_out_error and angle_error.

    \b
    Example: carom fit --dataset kharaz2001 --plot kharaz.png
    Your own data: carom fit rebounds.csv --case ball.toml --fix restitution=0.98 --advice 5
    A sheet with names of your own: carom fit "lab.xlsx:Run 2" --column "Drehzahl [U/min]=spin_out"
    Two materials compared: carom fit steel.csv brass.csv --case ball.toml --share friction
    A report of it: carom fit rebounds.csv --case ball.toml --report report.html
    A plate of unknown thickness: carom fit drops.csv --case ball.toml --thickness "3 mm"
    An empty table: carom fit --template > rebounds.csv
    """
    from carom.lab.fitting.options import checked_confidence

    if template:
        _tell_template(data[0] if data else dataset, as_json)
        return
    with checking() as faults:
        sources, cases = faults.trying(_sources, data, dataset) or [], case or []
        numbers = faults.trying(_checked_numbers, advice, about, steps, seed)
        outputs = {"plot": plot, "output": output, "posterior": posterior, "report": report}
        inputs = _numbered("data", sources) | _numbered("case", cases)
        faults.trying(check_outputs, outputs, **inputs)
        how = faults.trying(table_format_of, given)
        options: dict[str, Any] = {"robust": not squares}
        options["vary"] = None if vary is None else _names(vary)
        options["fixed"] = faults.trying(named_values, "fix", fix, "restitution=0.98")
        options["confidence"] = faults.trying(checked_confidence, confidence)
        alone = {"advice": advice, "posterior": posterior}
        faults.trying(_check_count, len(sources), cases, share, alone)
        read = how and faults.trying(_read, sources, cases, thickness, how, options)
        faults.settle()
        fit = _fitted(read, _names(share or ""), options)
        count, sampling = numbers
        advised = None if count is None else fit.advice(count, about)
    store_format(how, given["save_columns"])
    store(fit, output, plot)
    if report is not None:
        command = shlex.join(["carom", "fit", *context.meta[ARGUMENTS]])
        names = " and ".join(Path(source).name for source in sources)
        stored(fit.report(report, f"Rebounds of {names}", command))
    if posterior is not None:
        stored(_sampled(fit, posterior, *sampling))
    _print(fit, advised, as_json)


def _checked_numbers(
    advice: str | None, about: str | None, steps: str, seed: str
) -> tuple[int | None, tuple[int, int]]:
    """Return how many measurements are advised; and steps and seed of the posterior."""
    from carom.lab.fitting.advice import MOST_LISTED
    from carom.lab.fitting.datasets import FEWEST_STEPS, MOST_SEED, MOST_STEPS

    with Faults() as faults:
        if about is not None and advice is None:
            words = "it has no effect without --advice; give that, too"
            faults.add(str(refusal("for", about, words)))
        count = faults.if_given(whole, "advice", advice, 1, MOST_LISTED)
        length = faults.trying(whole, "steps", steps, FEWEST_STEPS, MOST_STEPS)
        start = faults.trying(whole, "seed", seed, 0, MOST_SEED)
    return count, (length, start)


def _print(fit: "Fit | JointFit", advised: "Advice | None", as_json: bool) -> None:
    if as_json:
        extra = {} if advised is None else {"advice": advised.to_dict()}
        typer.echo(json.dumps(fit.to_dict() | extra, indent=2))
    else:
        typer.echo("\n".join(str(part) for part in (fit, advised) if part is not None))


def _names(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]


def _numbered(name: str, paths: Sequence[str | Path]) -> dict[str, str | Path]:
    """Return files, each once, by names: data, data 2, data 3."""
    own = dict.fromkeys(paths)
    return {name if place == 1 else f"{name} {place}": path for place, path in enumerate(own, 1)}


def _check_count(
    files: int, cases: Sequence[str], share: str | None, alone: Mapping[str, str | None]
) -> None:
    """Raise InputError for what only one file has, or only several of them."""
    many = "of one file; give several files, or leave it out"
    few = f"case: {len(cases)} for {files} files; give one for all, or one for each"
    if files > 1:
        single = (text and refusal(name, text, ONE_SET) for name, text in alone.items())
        refuse(*single, len(cases) not in (0, 1, files) and few)
    else:
        refuse(share and refusal("share", share, many), cases[1:] and f"case: {many}")


def _read(
    sources: Sequence[str | Path],
    cases: Sequence[str],
    thickness: str | None,
    how: "TableFormat",
    options: Mapping[str, Any],
) -> "dict[str, Measured]":
    """Return what was measured of which bodies, by the names of the files, if it can be fitted."""
    from carom.lab.fitting.joint_result import named_sets
    from carom.lab.fitting.options import read_options
    from carom.lab.fitting.reading import read_problem, read_rebounds

    names = [*named_sets(sources)] if len(sources) > 1 else [""][: len(sources)]
    own: list[str | None] = [*cases] or [None]
    own = own if len(own) == len(sources) else own[:1] * len(sources)
    read = {}
    with Faults() as faults:
        for name, source, case in zip(names, sources, own, strict=True):
            with faults.catching(name), Faults() as both:
                table = both.trying(read_rebounds, source, **how._asdict())
                pair = both.trying(_pair, case, thickness, table)
                both.settle()
                problem, fixed = read_problem(table, pair), options["fixed"]
                if fixed is not None:  # which could be read
                    read_options(problem, options["vary"], fixed)
                read[name] = table, pair
    return read


def _fitted(
    read: "Mapping[str, Measured]", share: Sequence[str], options: Mapping[str, Any]
) -> Any:
    tables, pairs = zip(*read.values(), strict=True)
    if len(read) == 1:
        return carom.fit(tables[0], pair=pairs[0], **options)
    sets = dict(zip(read, tables, strict=True))
    return carom.joint_fit(sets, share=share, pair=pairs, **options)


def _tell_template(source: str | None, as_json: bool) -> None:
    from carom.lab.fitting.template import TEMPLATE

    with checking() as faults:
        if source is not None:
            allowed = "it prints an empty table; give it no data"
            faults.add(str(refusal("template", source, allowed)))
    typer.echo(json.dumps({"template": TEMPLATE}) if as_json else TEMPLATE, nl=as_json)


def _sources(data: Sequence[str] | None, dataset: str | None) -> Sequence[str | Path]:
    names = carom.datasets.names()
    if bool(data) == (dataset is not None):
        both = f"{' and '.join(data)} and --dataset are given; " if data else ""
        listed = ", ".join(names)
        raise InputError(f"data: {both}give a file, or --dataset with one of {listed}")
    shipped = [name for name in data or () if name in names and not Path(name).exists()]
    refuse(*(f"data: {name} comes with Carom; write --dataset {name}" for name in shipped))
    return data or [carom.datasets.path(str(dataset))]


def _pair(case: str | None, thickness: str | None, table: Any) -> "Pair | None":
    """Return the bodies of a case file, or of the data if these get another thickness."""
    from carom.bodies.cases import LOSSES, RATIO, pair_of
    from carom.lab.fitting.reading import START_FRICTION, case_of_data

    if case is None and (thickness is None or table is None):
        return None
    content = case_of_data(table) if case is None else read_case_file(case, losses=True)
    if thickness is not None:
        content = {**content, "second": {**content.get("second", {}), "thickness": thickness}}
    hint = "a fit finds the restitution; if you know it, leave it out of the case and give --fix, "
    hint += "e.g. --fix restitution=0.98"
    if "thickness" in content.get("second", {}):
        hint = "bodies on a plate are elastic so far; leave losses or thickness out"
    for name in filter(content.__contains__, (*LOSSES, RATIO)):
        raise refusal(name, content[name], hint)
    friction = 0.0 if case is None else START_FRICTION  # in the data none is one that is not known
    return pair_of({"friction": friction, **content})


def _sampled(fit: "Fit", target: str, steps: int, seed: int) -> Path:
    from carom.io.files import FIGURES

    samples = fit.posterior(steps, seed)
    if not samples.attrs["converged"]:
        time = samples.attrs["autocorrelation_time"]
        chain = f"it has {steps} steps, and its autocorrelation time is {time:.0f} steps"
        typer.echo(f"The chain is short: {chain}. Use --steps {50 * ceil(time):d}.", err=True)
    if Path(target).suffix.lower() not in FIGURES:
        return carom.save(samples, target)
    from carom.plots.fits import plot_corner

    return carom.plots.save_figure(plot_corner(samples), target)
