"""The table [sweep] of a case file, made into a design.

[sweep]                       # a grid of all axes, unless samples or a table are given
samples = 1000                # a Latin hypercube in the ranges of the axes
seed = 1
table = "cases.csv"           # or the cases themselves, one a row
columns = {omega = "spin"}    # what heads of the table stand for, if they are your own
outputs = ["rebound_angle"]   # all by default

[sweep.axes]
angle = {from = "0 deg", to = "85 deg", points = 86}
friction = [0.1, 0.2]
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from carom.bodies.cases import SWEEP, Case
from carom.quantities.refusals import InputError, clipped, refusal
from carom.sweeps.designs import Design, Grid, LatinHypercube
from carom.sweeps.tables import Table

EXAMPLE = 'angle = {from = "0 deg", to = "85 deg", points = 86}'


def plan(
    case: Case, path: Path, columns: Mapping[str, str] | None = None
) -> tuple[Design, list[str] | None]:
    """Return the design and the outputs that a case file asks for."""
    given = case.get(SWEEP)
    if not isinstance(given, Mapping):
        raise InputError(f"{SWEEP}: missing in {path}; add [sweep.axes] with {EXAMPLE}")
    outputs = given.get("outputs")
    if "outputs" in given and not isinstance(outputs, list):
        raise refusal("outputs", outputs, 'must be a list of names, e.g. ["rebound_angle"]')
    return _design(given, path, columns or {}), outputs


def _design(given: Mapping[str, Any], path: Path, columns: Mapping[str, str]) -> Design:
    if "table" in given:
        _refuse(given, ("samples", "seed", "axes"), "a table of cases")
        if not isinstance(given["table"], str):
            raise refusal("table", given["table"], "must be the name of a CSV file")
        own = given.get("columns", {})
        if not isinstance(own, Mapping):
            raise refusal("columns", own, 'must be a table, e.g. {omega = "spin"}')
        return Table(path.parent / given["table"], {**own, **columns})
    if columns or "columns" in given:
        shown = columns or given["columns"]
        raise refusal("columns", shown, "they are those of a table of cases; leave them out")
    axes = given.get("axes")
    if not isinstance(axes, Mapping):
        raise refusal("axes", axes, f"must be a table, [sweep.axes], with {EXAMPLE}")
    if "samples" in given:
        return LatinHypercube(_flat(axes), samples=given["samples"], seed=given.get("seed", 0))
    _refuse(given, ("seed",), "a grid")
    return Grid(_flat(axes))


def _refuse(given: Mapping[str, Any], names: Iterable[str], kind: str) -> None:
    for name in names:
        if name in given:
            raise refusal(name, given[name], f"{kind} has none; leave it out")


def _flat(axes: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return axes by dotted names; first.radius without quotes is a table in a table for TOML."""
    flat: dict[str, Any] = {}
    for name, axis in axes.items():
        nested = isinstance(axis, Mapping) and axis and not axis.keys() & {"from", "to", "points"}
        found = _flat(axis, f"{prefix}{name}.") if nested else {prefix + name: axis}
        for twice in flat.keys() & found.keys():
            words = "it is given twice in [sweep.axes]; leave one of them out"
            raise InputError(f"{clipped(twice)}: {words}")
        flat |= found
    return flat
