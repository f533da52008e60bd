"""`carom fit`: friction, stiffness and restitution from measured rebounds."""

import json
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import carom
from carom.cli.cases import (
    Column,
    Json,
    Plot,
    check_outputs,
    file_argument,
    file_option,
    named_values,
    refuse_same,
    store,
    stored,
    told_case,
    whole_option,
)
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import whole

if TYPE_CHECKING:
    from carom.bodies.pairs import Pair
    from carom.fitting import Fit


def fit_command(
    data: Annotated[
        Path | None, file_argument("CSV file: a row an impact; units in the head, 'angle [deg]'.")
    ] = None,
    dataset: Annotated[
        str | None, typer.Option(help="Instead of a file, measured data that come with Carom.")
    ] = None,
    case: Annotated[
        Path | None,
        file_option("Case file as for `carom impact`: the bodies, unless the data tell them."),
    ] = None,
    vary: Annotated[
        str | None, typer.Option(help="Of friction, kappa (or chi), restitution, spin_offset.")
    ] = None,
    fix: Annotated[
        list[str] | None, typer.Option(help="A parameter that is known, e.g. restitution=0.98.")
    ] = None,
    confidence: Annotated[str, typer.Option(help="Confidence of the intervals.")] = "0.95",
    column: Column = None,
    squares: Annotated[
        bool, typer.Option("--squares", help="Least squares: outliers count like all others.")
    ] = False,
    template: Annotated[
        bool, typer.Option("--template", help="Print an empty table to fill in, and stop.")
    ] = False,
    advice: Annotated[
        str | None, whole_option("Tell that many incidences to measure next.")
    ] = None,
    about: Annotated[
        str | None, typer.Option("--for", help="Parameter of the advice; else the least certain.")
    ] = None,
    posterior: Annotated[
        str | None,
        typer.Option(
            help="Sample by emcee; store samples (.nc, .csv) or a corner plot (.png ...)."
        ),
    ] = None,
    steps: Annotated[str, whole_option("Steps of the sampling.")] = "1000",
    seed: Annotated[str, whole_option("Seed of the sampling.")] = "0",
    plot: Plot = None,
    output: Annotated[str | None, typer.Option(help="Store the fit: .csv or .nc.")] = None,
    as_json: Json = False,
) -> None:
    """Find friction, stiffness ratio and normal restitution from measured rebounds.

    Columns before: angle and speed; normal_speed and tangential_speed; or angle, contact_angle,
    psi_in alone where no speed is needed; spin, spin2. After, any of: normal_restitution,
    normal_speed_out, tangential_restitution, tangential_speed_out, rebound_speed, rebound_angle,
    spin_out, contact_restitution, contact_beta, contact_rebound_angle, impulse_ratio, psi_out; '-'
    where nothing was measured. Standard deviations: spin_out_error, angle_error and so on.

    Example: carom fit --dataset kharaz2001 --plot kharaz.png

    Own data: carom fit rebounds.csv --case ball.toml --fix restitution=0.98 --advice 5

    An empty table: carom fit --template > rebounds.csv
    """
    if template:
        _tell_template(data or dataset, as_json)
        return
    from carom.fitting.advice import PLAN
    from carom.fitting.posterior import FEWEST_STEPS, MOST_SEED, MOST_STEPS
    from carom.io.files import FIGURES, TABLES

    source = _source(data, dataset)
    if about is not None and advice is None:
        raise refusal("for", about, "it is the parameter of --advice; give that, too")
    count = None if advice is None else whole("advice", advice, 1, PLAN)
    sampling = whole("steps", steps, FEWEST_STEPS, MOST_STEPS), whole("seed", seed, 0, MOST_SEED)
    files = {"data": source, "case": case, "plot": plot, "output": output, "posterior": posterior}
    refuse_same(files)
    check_outputs((plot, FIGURES), (output, TABLES), (posterior, (*TABLES, *FIGURES)))
    found = carom.fit(
        source,
        pair=_pair(case),
        vary=None if vary is None else [name.strip() for name in vary.split(",")],
        fixed=named_values("fix", fix, "restitution=0.98"),
        robust=not squares,
        confidence=confidence,
        columns=named_values("column", column, "omega=spin_out"),
    )
    advised = None if count is None else found.advice(count, about)
    store(found, output, plot)
    if posterior is not None:
        stored(_sampled(found, posterior, *sampling))
    if as_json:
        extra = {} if advised is None else {"advice": advised.to_dict()}
        typer.echo(json.dumps(found.to_dict() | extra, indent=2))
    else:
        typer.echo("\n".join(str(part) for part in (found, advised) if part is not None))


def _tell_template(source: Path | str | None, as_json: bool) -> None:
    """Print an empty table."""
    from carom.fitting.template import TEMPLATE

    if source is not None:
        raise refusal("template", source, "it prints an empty table; give it no data")
    typer.echo(json.dumps({"template": TEMPLATE}) if as_json else TEMPLATE, nl=as_json)


def _source(data: Path | None, dataset: str | None) -> Path:
    """Return the file of the data, or raise InputError."""
    if (data is None) == (dataset is None):
        known = ", ".join(carom.datasets.names())
        raise InputError(f"data: give a CSV file, or --dataset with one of {known}")
    return data if data is not None else carom.datasets.path(str(dataset))


def _pair(case: Path | None) -> "Pair | None":
    """Return the bodies of a case file, whose friction may be left out."""
    from carom.bodies.cases import pair_of
    from carom.fitting.reading import START

    return None if case is None else pair_of({"friction": START, **told_case(case)})


def _sampled(found: "Fit", target: str, steps: int, seed: int) -> Path:
    """Store samples of the posterior, or a corner plot of them, and return the file."""
    from carom.io.files import FIGURES

    samples = found.posterior(steps, seed)
    if not samples.attrs["converged"]:
        time = samples.attrs["autocorrelation_time"]
        typer.echo(
            f"the chain is short, {steps} steps for an autocorrelation time of {time:.0f}:"
            f" --steps {50 * ceil(time):d} is better",
            err=True,
        )
    if Path(target).suffix.lower() not in FIGURES:
        return carom.save(samples, target)
    from carom.plots.fits import plot_corner

    return carom.plots.save_figure(plot_corner(samples), target)
