"""`carom fit`: friction, stiffness and restitution from measured rebounds."""

import json
import shlex
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

import typer

import carom
from carom.cli.cases import check_outputs, named_values, read_case_file, store, stored
from carom.cli.options import ARGUMENTS, described, file_argument, file_option, whole_option
from carom.cli.tables import table_format_of
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import whole

if TYPE_CHECKING:
    from carom.bodies.pairs import Pair
    from carom.fitting import Fit
    from carom.io.user_table import UserTable


OPTIONS = {
    "data": file_argument(
        "CSV file or spreadsheet with one impact per row and units in its head, e.g. 'angle [deg]'."
    ),
    "dataset": "Published measurements that come with Carom, e.g. kharaz2001, instead.",
    "case": file_option(
        "Case file, as for carom impact, with the bodies; needed if the data hold none."
    ),
    "thickness": "Thickness of the plate that is struck, e.g. '3 mm' [m], in place of that of the "
    "case; where it is fitted, that to begin with.",
    "vary": "Parameters to fit, separated by commas, of friction, kappa (or chi), restitution, "
    "spin_offset and, on a plate, thickness instead of restitution (default: the first three, or "
    "restitution or thickness for vertical drops).",
    "fix": "A parameter that you know, with its value, e.g. restitution=0.98. You can repeat this "
    "option.",
    "confidence": "Confidence level of the intervals.",
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
    data: str | None = None,
    dataset: str | None = None,
    case: str | None = None,
    thickness: str | None = None,
    vary: str | None = None,
    fix: list[str] | None = None,
    confidence: str = "0.95",
    column: list[str] | None = None,
    columns: str | None = None,
    sheet: str | None = None,
    decimal: str | None = None,
    save_columns: str | None = None,
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
    A report of it: carom fit rebounds.csv --case ball.toml --report report.html
    A plate of unknown thickness: carom fit drops.csv --case ball.toml --thickness "3 mm"
    An empty table: carom fit --template > rebounds.csv
    """
    if template:
        _tell_template(data or dataset, as_json)
        return
    from carom.fitting.advice import MOST_LISTED
    from carom.fitting.datasets import FEWEST_STEPS, MOST_SEED, MOST_STEPS
    from carom.fitting.reading import read_rebounds

    source = _source(data, dataset)
    if about is not None and advice is None:
        raise refusal("for", about, "it has no effect without --advice; give that, too")
    count = None if advice is None else whole("advice", advice, 1, MOST_LISTED)
    sampling = whole("steps", steps, FEWEST_STEPS, MOST_STEPS), whole("seed", seed, 0, MOST_SEED)
    outputs = {"plot": plot, "output": output, "posterior": posterior, "report": report}
    check_outputs(outputs, data=source, case=case)
    how = table_format_of(column, columns, sheet, decimal, save_columns)
    table = read_rebounds(source, **how._asdict())
    fit = carom.fit(
        table,
        pair=_pair(case, thickness, table),
        vary=None if vary is None else [name.strip() for name in vary.split(",")],
        fixed=named_values("fix", fix, "restitution=0.98"),
        robust=not squares,
        confidence=confidence,
    )
    advised = None if count is None else fit.advice(count, about)
    store(fit, output, plot)
    if report is not None:
        command = shlex.join(["carom", "fit", *context.meta[ARGUMENTS]])
        stored(fit.report(report, f"Rebounds of {Path(source).name}", command))
    if posterior is not None:
        stored(_sampled(fit, posterior, *sampling))
    if as_json:
        extra = {} if advised is None else {"advice": advised.to_dict()}
        typer.echo(json.dumps(fit.to_dict() | extra, indent=2))
    else:
        typer.echo("\n".join(str(part) for part in (fit, advised) if part is not None))


def _tell_template(source: str | None, as_json: bool) -> None:
    from carom.fitting.template import TEMPLATE

    if source is not None:
        raise refusal("template", source, "it prints an empty table; give it no data")
    typer.echo(json.dumps({"template": TEMPLATE}) if as_json else TEMPLATE, nl=as_json)


def _source(data: str | None, dataset: str | None) -> str | Path:
    if (data is None) == (dataset is None):
        names = ", ".join(carom.datasets.names())
        raise InputError(f"data: give a file, or --dataset with one of {names}")
    return data if data is not None else carom.datasets.path(str(dataset))


def _pair(case: str | None, thickness: str | None, table: "UserTable") -> "Pair | None":
    """Return the bodies of a case file, or of the data if these get another thickness."""
    from carom.bodies.cases import LOSSES, RATIO, pair_of
    from carom.fitting.reading import START_FRICTION, case_of_data

    if case is None and thickness is None:
        return None
    content = case_of_data(table) if case is None else read_case_file(case, losses=True)
    if thickness is not None:
        content = {**content, "second": {**content.get("second", {}), "thickness": thickness}}
    hint = "a fit finds the restitution; if you know it, leave it out of the case and give --fix, "
    hint += "e.g. --fix restitution=0.98"
    if "thickness" in content.get("second", {}):
        hint = "bodies on a plate are elastic so far; leave losses or thickness out"
    for name in (*LOSSES, RATIO):
        if name in content:
            raise refusal(name, content[name], hint)
    friction = 0.0 if case is None else START_FRICTION  # in the data none is one that is not known
    return pair_of({"friction": friction, **content})


def _sampled(fit: "Fit", target: str, steps: int, seed: int) -> Path:
    from carom.io.files import FIGURES

    samples = fit.posterior(steps, seed)
    if not samples.attrs["converged"]:
        time = samples.attrs["autocorrelation_time"]
        typer.echo(
            f"The chain is short: it has {steps} steps, and its autocorrelation time is {time:.0f} "
            f"steps. Use --steps {50 * ceil(time):d}.",
            err=True,
        )
    if Path(target).suffix.lower() not in FIGURES:
        return carom.save(samples, target)
    from carom.plots.fits import plot_corner

    return carom.plots.save_figure(plot_corner(samples), target)
