"""`carom materials`: the catalogues of materials and of pairs, and where values come from."""

import json
from typing import Any

import typer

import carom
from carom.bodies.materials import VALUES
from carom.cli import completion
from carom.cli.options import checking, described
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import refusal
from carom.quantities.units import or_none

OPTIONS = {
    "name": typer.Argument(
        help="Material to show, with the source of every value.",
        autocompletion=completion.materials,
    ),
    "pairs": typer.Option(
        "--pairs", help="List measured restitution and friction of pairs of materials instead."
    ),
}


MEASURED = ("normal_restitution", "friction", "beta_0")
LEGEND = (
    "e: normal restitution, mu: friction, beta_0: tangential restitution of a contact that sticks;"
    " in brackets their errors, as published"
)
BELOW = """There is also the material rigid, which does not deform.
carom materials NAME shows the sources of the values, carom materials --pairs measured restitution \
and friction."""


@described(OPTIONS)
def materials_command(name: str | None = None, pairs: bool = False, as_json: bool = False) -> None:
    """List the materials that Carom knows by name.

    Use this command to find the name of a material, the values that Carom takes for it and where
    they come from, or measured restitution and friction of pairs of materials.

    \b
    Example: carom materials soda-lime-glass
    All materials: carom materials
    Measured pairs: carom materials --pairs
    """
    with checking() as faults:
        if pairs and name is not None:
            words = "it lists all pairs; leave the name out"
            faults.add(str(refusal("--pairs", name, words)))
        if name is not None:
            faults.trying(carom.material, name)
    if pairs:
        listed = _pairs()
        typer.echo(
            json.dumps(listed, indent=2, ensure_ascii=False) if as_json else _table_of_pairs(listed)
        )
        return
    names = list(carom.materials()) if name is None else [str(carom.material(name).name)]
    records = {key: _record(key) for key in names}
    if as_json:
        typer.echo(json.dumps(records, indent=2, ensure_ascii=False))
    elif name is not None:
        typer.echo(_details(carom.material(name)))
    else:
        typer.echo(f"{carom.materials()}\n{BELOW}")


def _pairs() -> list[dict[str, Any]]:
    """Return the published pairs as plain numbers and texts; what is not told is None."""
    dataset = carom.datasets.parameters()
    columns = {str(name): dataset[name].values.tolist() for name in dataset.variables}
    rows = zip(*columns.values(), strict=True)
    return [
        {name: or_none(cell) if isinstance(cell, float) else cell for name, cell in pair.items()}
        for pair in (dict(zip(columns, row, strict=True)) for row in rows)
    ]


def _table_of_pairs(pairs: list[dict[str, Any]]) -> str:
    head = f"{'sphere':19s}{'on':19s}{'2R (mm)':>8s} {'e':>14s} {'mu':>14s} {'beta_0':>14s}"
    references = list(dict.fromkeys(each["reference"] for each in pairs))
    lines = []
    for each in pairs:
        other = each["other"] + " plane" * (each["shape"] == "plane")
        values = (f"{each[key]:.3g} ({each[f'{key}_error']:.2g})" for key in MEASURED)
        numbers = " ".join(f"{value:>14s}" for value in values)
        mark = references.index(each["reference"]) + 1
        size = 1e3 * each["diameter"]
        lines.append(f"{each['body']:19s}{other:19s}{size:8.3g} {numbers} [{mark}]")
    sources = [f"[{place}] {text}" for place, text in enumerate(references, start=1)]
    return "\n".join([head, *lines, LEGEND, *sources])


def _record(name: str) -> dict[str, Any]:
    stuff = carom.material(name)
    values = {key: getattr(stuff, key) for key in VALUES}
    if stuff.is_rigid:
        values["young"] = None
    return values | {"sources": stuff.sources}


def _details(stuff: carom.Material) -> str:
    lines = [f"{stuff.name}{': does not deform' * stuff.is_rigid}"]
    for key in filter(stuff.sources.__contains__, VALUES):
        value = GLOSSARY[key].text(getattr(stuff, key))
        lines += [f"  {GLOSSARY[key].meaning:18s} {value}", f"      {stuff.sources[key]}"]
    return "\n".join(lines)
