"""Cases: bodies, friction, motion and losses as a TOML file or a mapping gives them."""

import re
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from inspect import signature
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.bodies import solids
from carom.bodies.case_materials import MATERIAL, material_values, read_material, unknown_keys
from carom.bodies.kinematics import READERS
from carom.bodies.pairs import OF_BOTH, Counterbody, Pair
from carom.bodies.shapes import Cup, HalfSpace, Sphere, describe
from carom.bodies.smooth_body import Body
from carom.io.files import read_dataset, read_toml
from carom.io.paths import checked_path
from carom.quantities.refusals import Faults, InputError, checked_type, one_of, refusal
from carom.quantities.units import finite, not_negative, number, positive

if TYPE_CHECKING:
    import xarray as xr

    from carom.bodies.losses import LossLaw

Case = dict[str, Any]

MOTION = {**READERS, "spin": finite, "spin2": finite}
# What tells the loss, one at most.
LOSSES = ("restitution", "loss_time", "yield_velocity", "flow_stress", "relaxation_time")
RATIO = "modulus_ratio"  # goes with a relaxation time
ONE_LOSS = "each of them sets the loss of energy"
FROM_STRENGTH = "material"  # what the yield strengths give
OF_STRENGTH = {"yield_velocity": "a speed, e.g. '0.1 m/s'", "flow_stress": "a stress, e.g. '1 GPa'"}
SIZES: dict[str, Callable[[str, Any], float]] = {
    "radius": positive,
    "gyration_radius": positive,
    "inner_radius": not_negative,
}
BODY = (*SIZES, "material")
PLATE: dict[str, Callable[[str, Any], float]] = {"thickness": positive, "width": positive}
SHAPE_NUMBERS = ("length", "edge_radius", "curvature_radius", "mass", "inertia", "angle")
MADE: dict[str, Callable[..., Any]] = {  # by what bodies are made
    "half-space": HalfSpace,
    "sphere": Sphere,
    "cup": Cup,
    "body": Body,
    "rod": solids.rod,
    "cylinder": solids.cylinder,
    "ellipsoid": solids.ellipsoid,
    "clump": solids.clump,
}
ONLY_IN_PYTHON = ("orientation", "name")
IS_NEEDED = {  # by kind and by what it is made from
    kind: {
        n: p.default is p.empty
        for n, p in signature(maker).parameters.items()
        if n not in ONLY_IN_PYTHON
    }
    for kind, maker in MADE.items()
}
CALLED = {maker: kind for kind, maker in MADE.items()}
KINDS = (*MADE,)[:3]  # round ones
SHAPES = (*MADE,)[3:]
OF_SHAPES = {n: None for kind in SHAPES for n in IS_NEEDED[kind] if n not in BODY}
EXAMPLES = {"radius": "5 mm", "material": "steel"}  # of what has an option
OUTPUT = ("plot", "animation", "data", "spectrum")
SWEEP_TABLE = "sweep"  # which `carom.many.sweeps` reads
SWEPT = ("samples", "seed", "table", "columns", "sheet", "decimal", "outputs", "axes")
TABLES = {
    "first": ("kind", *BODY, *OF_SHAPES),
    "second": ("kind", *PLATE, *BODY, *OF_SHAPES),
    "output": OUTPUT,
    SWEEP_TABLE: SWEPT,
}


def read_case(path: str | Path, *, losses: bool = False) -> Case:
    """Return the content of a case file after checking its keys; `losses` as in `check_case`."""
    case, text = read_toml("case file", path)

    def place(key: str, table: str) -> str:
        return f" in {path}, line {line_of(key, text, table)}"

    check_case(case, place, losses=losses)
    return case


def check_case(
    case: Mapping[str, Any],
    place: Callable[[str, str], str] = lambda *_: "",
    *,
    losses: bool = False,
) -> None:
    """Raise InputError for all unknown keys, and for losses unless the caller supports them."""

    def check(table: Mapping[str, Any], allowed: Iterable[str], name: str) -> None:
        faults.add(*unknown_keys(table, allowed, lambda key: f"unknown key{place(key, name)}"))

    checked_type("case", case, Mapping, "must be a mapping with friction, speeds, first and second")
    with Faults() as faults:
        for key in () if losses else (*LOSSES, RATIO):
            if key in case:
                where = place(key, "")
                faults.add(f"{key}: not used{where}; this is for elastic impacts, leave it out")
        check(case, (*OF_BOTH, *MOTION, *LOSSES, RATIO, *TABLES), "")
        for name, allowed in TABLES.items():
            table = case.get(name, {})
            words = f"must be a table, [{name}], with {', '.join(allowed)}"
            checked_type(name, table, Mapping, words)
            check(table, allowed, name)
            if isinstance(table.get("material"), Mapping):
                check(table["material"], MATERIAL, name)


def line_of(key: str, text: str, table: str) -> int:
    """Return the line of a key, searched from the header of its table on."""
    word = re.escape(key)
    outer = rf"(?:{table}\s*+\.\s*+)?" if table else ""
    pattern = re.compile(rf"^\s*+\[?+\s*+{outer}[\"']?{word}[\"']?\s*[=\].]|[{{,]\s*{word}\s*=")
    header = re.compile(rf"^\s*+\[?+\s*+{table}\b") if table else re.compile("")
    inside = False
    for row, line in enumerate(text.splitlines(), 1):
        inside = inside or bool(header.match(line))
        if inside and pattern.search(line):
            return row
    return 1


def pair_of(case: Mapping[str, Any]) -> Pair:
    """Return the bodies of a case with their friction, or raise InputError with all faults."""
    friction: Any = case.get("friction")
    with Faults() as faults:
        if friction is None:
            faults.add("friction: missing; give --friction, e.g. 0.2 (0 for none)")
        else:
            faults.trying(not_negative, "friction", friction)
        roughness = faults.if_given(not_negative, "roughness", case.get("roughness"))
        first = faults.trying(_made, "first", ("sphere", *SHAPES), case.get("first", {}), {})
        any_first = first or Sphere(radius=1.0, material="steel")  # to look at the second, too
        same = {name: getattr(any_first, name, None) for name in ("material", "radius")}
        second = faults.trying(_made, "second", (*MADE,), case.get("second", {}), same)
    return Pair(first, second, friction, roughness=roughness)


def _made(
    name: str, kinds: Sequence[str], table: Mapping[str, Any], first: Mapping[str, Any]
) -> Any:
    """Return a body, of the material of the first and for a sphere its radius if none is told."""
    kind = one_of("kind", table.get("kind", kinds[0]), kinds)
    needed = IS_NEEDED[kind]
    values = {n: first[n] for n in first if n == "material" or kind == "sphere"}
    values |= {n: value for n, value in table.items() if value is not None}
    others = sorted({*values} - {"kind", *needed})
    missing = [n for n in needed if needed[n] and values.get(n) is None]
    with Faults() as faults:
        faults.add(*(str(refusal(n, table[n], f"a {kind} has none; leave it out")) for n in others))
        faults.add(*(f"{n}: missing for {_where(name, kind, n)}" for n in missing))
        if "material" not in missing:
            values["material"] = faults.trying(read_material, values["material"]) or "steel"
        given = {n: values[n] for n in needed if n in values}
        return None if missing else faults.trying(MADE[kind], **given)


def _where(name: str, kind: str, key: str) -> str:
    """Return for what a value is missing, and how to give it."""
    if kind not in KINDS and key != "material":
        return f"a {kind}; give it in its table"
    option = f"--second-{key}" if name == "second" else f"--{key}"
    return f"the {name} body; give {option}, e.g. '{EXAMPLES[key]}'"


def has_shapes(case: Mapping[str, Any]) -> bool:
    """Tell whether a body of a case is neither sphere nor half-space nor cup."""
    tables = [case.get(body) for body in ("first", "second")]
    return any(isinstance(table, Mapping) and table.get("kind") in SHAPES for table in tables)


def case_of(pair: Pair) -> Case:
    """Return the case of a pair, plain numbers and words: what `pair_of` makes it from."""
    first, second = _table_of(pair.first), _table_of(pair.second)
    if isinstance(pair.first, Sphere):
        del first["kind"]
    rough = {} if pair.roughness is None else {"roughness": pair.roughness}
    return {"friction": pair.friction, **rough, "first": first, "second": second}


def _table_of(body: Counterbody) -> Case:
    table = describe(body) | {"kind": CALLED[type(body)]}
    if body.material.is_rigid:
        table["material"]["young"] = body.material.young
    return table


def motion_of(case: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a case says about speeds and spins."""
    return {name: case[name] for name in MOTION if case.get(name) is not None}


def numbers_of(case: Mapping[str, Any]) -> dict[str, float]:
    """Return the numbers of a case of round bodies by name, or raise InputError with all faults."""
    losses = dict.fromkeys((*LOSSES, RATIO), read_loss)
    with Faults() as faults:
        readers = {**dict.fromkeys(OF_BOTH, not_negative), **MOTION, **losses}
        read = {n: faults.if_given(check, n, case.get(n)) for n, check in readers.items()}
        for body, sizes in (("first", SIZES), ("second", {**SIZES, **PLATE})):
            table = case.get(body, {})
            for name, check in sizes.items():
                read[f"{body}.{name}"] = faults.if_given(check, name, table.get(name))
            if table.get("material") is not None:
                known = faults.trying(material_values, table["material"]) or {}
                read |= {f"{body}.material.{name}": value for name, value in known.items()}
    return {name: value for name, value in read.items() if value is not None}


def losses_of(case: Mapping[str, Any]) -> "LossLaw | None":
    """Return the law by which the normal motion of a case loses energy, or None."""
    there = [name for name in (*LOSSES, RATIO) if case.get(name) is not None]
    names = [name for name in there if name != RATIO]
    with Faults() as faults:
        if len(names) > 1:
            faults.add(f"{names[1]}: give it or {names[0]}, not both; {ONE_LOSS}")
        faults.trying(refuse_half, there)
        read = {name: faults.trying(read_loss, name, case[name]) for name in there}
    return law_of(names[0], read[names[0]], read.get(RATIO, 1.0)) if names else None


def law_of(name: str, value: Any, ratio: Any = 1.0) -> "LossLaw":
    """Return the law of a loss; its value is a number, an array, or None for the strengths."""
    from carom.bodies import losses  # compiled code: not for all cases

    if name == "relaxation_time":
        return losses.StandardLinearSolid(ratio, value)
    if name == "yield_velocity":
        return losses.ElasticPlastic(value)
    if name == "flow_stress":
        return losses.Metal(value)
    return losses.KelvinVoigt(**{name: value})


def refuse_half(names: Container[str]) -> None:
    """Raise InputError if a relaxation time comes without the ratio of moduli, or this alone."""
    if ("relaxation_time" in names) != (RATIO in names):
        missing, there = ("relaxation_time", RATIO)[:: 1 if RATIO in names else -1]
        raise InputError(f"{missing}: missing; give it together with {there}")


def read_loss(name: str, value: Any) -> float | None:
    """Return the value of a loss or ratio in SI units, None for that of the strengths."""
    if name == RATIO:
        law_of("relaxation_time", 0.0, value)
        return number(RATIO, value)
    if name in OF_STRENGTH and isinstance(value, str) and value.strip().isalpha():
        if value.strip() == FROM_STRENGTH:
            return None
        allowed = f"give {OF_STRENGTH[name]}, or '{FROM_STRENGTH}' to use the yield strengths"
        raise refusal(name, value, allowed)
    read = number(name, value)
    law_of(name, read)
    return read


def read(path: str | Path) -> "xr.Dataset | dict[str, Any]":
    """Return a dataset that Carom stored as .nc or .zarr, or the case of a .toml file.

    Parameters
    ----------
    path : str or Path
        A NetCDF file (.nc) that `save` or the option `--output` of a command has written, the store
        of a sweep (.zarr), whose values are read only when they are used, or a case file (.toml).

    Returns
    -------
    xarray.Dataset or dict
        Variables and coordinates exactly as they were stored, with units and meanings as
        attributes. For a case file, its content as `sweep` accepts it.

    Raises
    ------
    InputError
        If the file is missing, damaged, changed or not stored by Carom, or a case has an unknown
        key.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     stored = carom.save(carom.curve(1.44, [0.5, 2.0]), folder + "/curve.nc")
    ...     carom.read(stored).psi_out.values.round(4)
    array([[ 0.0471, -0.839 ]])
    """
    source = checked_path("file", path)
    if source.suffix.lower() == ".toml":
        return read_case(source, losses=True)
    return read_dataset(source)
