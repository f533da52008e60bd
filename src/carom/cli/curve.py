"""`carom curve`: psi_2 and restitution against psi_1."""

import json
from math import nan
from typing import TYPE_CHECKING, Any

import typer

import carom
from carom.cli.cases import check_outputs, require_some, store_text, stored
from carom.cli.options import checking, described, name_option, whole_option
from carom.io.paths import checked_output
from carom.quantities.refusals import Faults, one_of, refusal
from carom.quantities.units import finite, or_none, positive, whole

if TYPE_CHECKING:
    import xarray as xr

    from carom.bodies.losses import KelvinVoigt, ZenerPlate

PRINTED_ROWS = 17
MOST_POINTS = 100_000
HEADERS = (".h",)
LANGUAGES = ("c",)
COLUMNS = ("psi_in", "psi_out", "contact_restitution", "tangential_restitution")


OPTIONS = {
    "chi": "Ratio of inertia to stiffness, chi = (kappa/2)(m_n/m_t), positive, e.g. 1.44 for a "
    "steel ball on a steel plate. You can repeat this option.",
    "restitution": "Normal coefficient of restitution of a viscous (Kelvin-Voigt) contact, e.g. "
    "0.9 (default: elastic bodies).",
    "inelasticity": "Zener's inelasticity parameter of a plate that gives way, from 0 to 2.18 "
    "(default: a thick wall).",
    "start": typer.Option("--from", help="First incidence psi_1 = kappa V_x/(mu V_1)."),
    "stop": typer.Option(
        "--to", help="Last psi_1 (default: 4 chi + 1, where the contact slides throughout)."
    ),
    "points": whole_option("Number of values of psi_1, from 2 to 100,000."),
    "output": "Store the curve: .csv or .nc, or .h with --export c.",
    "export": name_option(
        "Print psi_2(psi_1) as source code instead of a table: 'c' gives a header for C and C++ "
        "with one function for each --chi.",
        LANGUAGES,
    ),
}


@described(OPTIONS)
def curve_command(
    chi: list[str],
    restitution: str | None = None,
    inelasticity: str | None = None,
    start: str = "0",
    stop: str | None = None,
    points: str = "401",
    as_json: bool = False,
    plot: str | None = None,
    output: str | None = None,
    export: str | None = None,
) -> None:
    """Tabulate the rebound psi_2 against the incidence psi_1.

    psi_1 and psi_2 are the dimensionless tangential velocities of the contact point before and
    after the impact, psi = kappa V_x/(mu V_1). The table also has both restitutions and the psi_1
    at which the regime changes. Use this command if you need the rebound at all incidences, as a
    figure, a table or source code.

    \b
    Example: carom curve --chi 1.44 --chi 2 --plot curve.png
    A viscous contact: carom curve --chi 1.44 --restitution 0.9
    A plate: carom curve --chi 1.44 --inelasticity 0.4
    A C header: carom curve --chi 1.44 --export c --output rebound.h
    """
    with checking() as faults:
        values = [faults.trying(positive, "chi", value) for value in chi or ()]
        losses = faults.trying(_losses, restitution, inelasticity)
        first = faults.trying(finite, "from", start, "1")
        last: Any = faults.if_given(finite, "to", stop, "1")
        count = faults.trying(whole, "points", points, 2, MOST_POINTS)
        if export is None:
            faults.trying(check_outputs, {"plot": plot, "output": output})
        else:
            table = {"--json": as_json, "--plot": plot, "--from": start != "0", "--to": stop}
            table["--points"] = points != "401"
            faults.trying(_check_export, export, output, table)
        if stop is None and None not in values:
            last = 4.0 * max(values, default=nan) + 1.0
        if None not in (first, last) and first >= last:
            faults.add(str(refusal("to", last, f"must be above --from, {first:g}")))
    if export is not None:
        from carom.many.laws.header import c_header

        text = c_header([carom.laws.ReboundLaw(value, losses=losses) for value in values])
        typer.echo(text, nl=False) if output is None else store_text(text, output)
        return
    import numpy as np

    dataset = carom.curve(values, np.linspace(first, last, count), losses=losses)
    if output is not None:
        stored(carom.save(dataset, output))
    if plot is not None:
        stored(carom.plots.save_figure(carom.plots.plot_curve(dataset), plot))
    records = _records(dataset)
    typer.echo(json.dumps(records, indent=2) if as_json else _table(records))
    restitutions = dataset["contact_restitution"]
    require_some(int(restitutions.count()), restitutions.size)


def _losses(restitution: str | None, inelasticity: str | None) -> "KelvinVoigt | ZenerPlate | None":
    with Faults() as faults:
        if None not in (restitution, inelasticity):
            twice = "give it or --restitution, not both; each of them sets the loss of energy"
            faults.add(f"inelasticity: {twice}")
        viscous = plate = None
        if restitution is not None:
            viscous = faults.trying(carom.KelvinVoigt, restitution=restitution)
        if inelasticity is not None:
            plate = faults.trying(carom.ZenerPlate, inelasticity=inelasticity)
    return viscous or plate


def _check_export(language: str, output: str | None, others: dict[str, Any]) -> None:
    with Faults() as faults:
        faults.trying(one_of, "export", language, LANGUAGES)
        unused = [name for name, value in others.items() if value]
        faults.add(*(f"{n}: has no effect with --export; leave one of them out" for n in unused))
        if output is not None:
            faults.trying(checked_output, output, HEADERS)


def _records(dataset: "xr.Dataset") -> list[dict[str, Any]]:
    rows = []
    for index, chi in enumerate(dataset["chi"].values):
        part = dataset.isel(chi=index)
        borders = zip(part["regime_border"].values, part["border"].values, strict=True)
        regimes = {str(name): float(psi) for name, psi in borders}
        columns = {name: list(map(or_none, part[name].values)) for name in COLUMNS}
        rows.append({"chi": float(chi), "borders": regimes, **columns})
    return rows


def _table(records: list[dict[str, Any]]) -> str:
    lines = []
    for each in records:
        lines.append(f"chi = {each['chi']:g}")
        lines += [f"  from psi_1 = {psi:<8.6g} {name}" for name, psi in each["borders"].items()]
        lines.append(f"  {'psi_1':>12s} {'psi_2':>14s} {'e contact':>12s} {'e centre*':>12s}")
        step = max(1, (len(each["psi_in"]) - 1) // (PRINTED_ROWS - 1))
        for row in [*zip(*(each[name] for name in COLUMNS), strict=True)][::step]:
            numbers = (nan if number is None else number for number in row)
            lines.append("  {:12.6g} {:14.9f} {:12.6f} {:12.6f}".format(*numbers))
    notes = (
        "e contact: tangential velocity of the contact point after the impact, over that before",
        "e centre*: the same of the centre of a solid sphere that strikes without spin",
    )
    return "\n".join([*lines, *notes])
