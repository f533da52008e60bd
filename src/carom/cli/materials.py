"""`carom materials`: the catalogue of materials and where its values come from."""

import json
from typing import Annotated, Any

import typer

import carom
from carom.bodies.materials import VALUES
from carom.cli.cases import Json
from carom.quantities.glossary import GLOSSARY


def materials_command(
    name: Annotated[str | None, typer.Argument(help="Show one material with its sources.")] = None,
    as_json: Json = False,
) -> None:
    """List the materials that have a name, or one of them with the source of each value.

    Example: carom materials soda-lime-glass
    """
    names = list(carom.materials()) if name is None else [str(carom.material(name).name)]
    records = {key: _record(key) for key in names}
    if as_json:
        typer.echo(json.dumps(records, indent=2, ensure_ascii=False))
    elif name is not None:
        typer.echo(_details(records))
    else:
        typer.echo(_list(records))


def _record(name: str) -> dict[str, Any]:
    stuff = carom.material(name)
    values = {key: getattr(stuff, key) for key in VALUES}
    if stuff.is_rigid:
        values["young"] = None
    return values | {"sources": carom.material_sources(name)}


def _list(records: dict[str, dict[str, Any]]) -> str:
    head = f"{'name':22s} {'E (GPa)':>9s} {'nu':>6s} {'rho (kg/m^3)':>13s} {'Y (MPa)':>9s}"
    lines = [
        f"{name:22s} {r['young'] / 1e9:9.4g} {r['poisson']:6.3g} {r['density']:13.5g} "
        + (f"{r['yield_strength'] / 1e6:9.4g}" if r["yield_strength"] else f"{'-':>9s}")
        for name, r in records.items()
    ]
    return "\n".join([head, *lines, "and: rigid. Sources: carom materials NAME"])


def _details(records: dict[str, dict[str, Any]]) -> str:
    lines = []
    for name, record in records.items():
        lines.append(name if record["young"] else f"{name}: does not deform")
        for key in VALUES:
            if key in record["sources"]:
                unit = "" if GLOSSARY[key].unit == "1" else f" {GLOSSARY[key].unit}"
                lines.append(f"  {GLOSSARY[key].meaning:18s} {record[key]:.6g}{unit}")
                lines.append(f"      {record['sources'][key]}")
    return "\n".join(lines)
