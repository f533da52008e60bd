"""Cases: bodies, friction, motion and losses as a TOML file or a mapping gives them."""

import re
import tomllib
from collections.abc import Callable, Container, Iterable, Mapping
from inspect import signature
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.bodies import solids
from carom.bodies.case_materials import MATERIAL, material_values, read_material, unknown_keys
from carom.bodies.kinematics import READERS
from carom.bodies.pairs import Counterbody, Pair
from carom.bodies.shapes import Cup, HalfSpace, Sphere, describe
from carom.bodies.smooth_body import Body
from carom.io.files import read_dataset, read_text
from carom.io.paths import checked_path
from carom.quantities.refusals import Faults, InputError, checked_type, one_of, refusal, refuse
from carom.quantities.units import finite, finite_or_text, not_negative, number, positive

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
IN_SPACE = "in_space"
CYLINDER = ("length", "radius", "edge_radius", "angle", "inner_radius")
SHAPE_NUMBERS = ("length", "edge_radius", "curvature_radius", "mass", "inertia", "angle")
MADE: dict[str, tuple[Callable[..., Body], tuple[str, ...]]] = {  # bodies of other shapes
    "body": (Body, ("mass", "inertia", "contact", "curvature_radius", "curvatures")),
    "rod": (solids.rod, ("length", "radius", "angle", IN_SPACE)),
    "cylinder": (solids.cylinder, (*CYLINDER, IN_SPACE)),
    "ellipsoid": (solids.ellipsoid, ("semi_axes", "angle", IN_SPACE)),
    "clump": (solids.clump, ("centres", "radii", "angle", IN_SPACE)),
}
OF_SHAPES = tuple({n: None for _, names in MADE.values() for n in names if n not in SIZES})
OUTPUT = ("plot", "animation", "data", "spectrum")
SWEEP_TABLE = "sweep"  # which `carom.sweeps` reads
SWEPT = ("samples", "seed", "table", "columns", "sheet", "decimal", "outputs", "axes")
KINDS = ("half-space", "sphere", "cup")
OF_KINDS: dict[str, Iterable[str]] = {"half-space": PLATE, "sphere": SIZES, "cup": ("radius",)}
SHAPES = (HalfSpace, Sphere, Cup)
TABLES = {
    "first": ("kind", *BODY, *OF_SHAPES),
    "second": ("kind", *PLATE, *BODY, *OF_SHAPES),
    "output": OUTPUT,
    SWEEP_TABLE: SWEPT,
}
DEEP = re.compile(r"(?<![\w\"'-])(?:[\w\"'-]++\s*+\.\s*+){20}")  # a dotted key of that many tables


def read_case(path: str | Path, *, losses: bool = False) -> Case:
    """Return the content of a case file after checking its keys; `losses` as in `check_case`."""
    try:
        text = read_text("case file", path)
        if DEEP.search(text):  # which takes memory with the square of the depth
            raise RecursionError
        case = tomllib.loads(text, parse_float=finite_or_text)
    except InputError:
        raise
    except UnicodeDecodeError:
        raise InputError(f"case file: {str(path)!r} is not text; give a TOML file") from None
    except ValueError as error:  # of tomllib; for integers of many digits Python's own
        raise InputError(f"case file: {str(path)!r} is not TOML; {error}") from None
    except RecursionError:
        raise refusal("case file", str(path), "its tables are nested too deeply") from None

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
        check(case, ("friction", *MOTION, *LOSSES, RATIO, *TABLES), "")
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
        first = faults.trying(_first, case.get("first", {}))
        any_first = first or Sphere(radius=1.0, material="steel")  # to look at the second, too
        second = faults.trying(_second, case.get("second", {}), any_first)
    return Pair(first, second, friction)


def _first(table: Mapping[str, Any]) -> Sphere | Body:
    kind = one_of("kind", table.get("kind", "sphere"), ("sphere", *MADE))
    return _made(kind, table) if kind in MADE else _sphere("first", "", table, {})


def has_shapes(case: Mapping[str, Any]) -> bool:
    """Tell whether a body of a case is neither sphere nor half-space nor cup."""
    return any(_kind(case.get(body)) in MADE for body in ("first", "second"))


def _kind(table: Any) -> str:
    kind = table.get("kind") if isinstance(table, Mapping) else None
    return kind if isinstance(kind, str) else ""


def _made(kind: str, table: Mapping[str, Any]) -> Body:
    maker, allowed = MADE[kind]
    others = {*table} - {"kind", "material", *allowed}
    needed = [n for n, p in signature(maker).parameters.items() if p.default is p.empty]
    refuse(
        *(refusal(n, table[n], f"a {kind} has none; leave it out") for n in sorted(others)),
        *(f"{n}: missing for a {kind}; give it in its table" for n in needed if n not in table),
    )
    stuff = read_material(_needed(table, kind, "", "material", "steel"))
    return maker(**{name: table[name] for name in allowed if name in table}, material=stuff)


def case_of(pair: Pair) -> Case:
    """Return the case of a pair, plain numbers and words: what `pair_of` makes it from."""
    return {
        "friction": pair.friction,
        "first": {**_kind_of(pair.first, ()), **_body_of(pair.first)},
        "second": {**_kind_of(pair.second, SHAPES), **_body_of(pair.second)},
    }


def _kind_of(body: Counterbody, shapes: tuple[type, ...]) -> Case:
    if isinstance(body, Body):
        return {"kind": "body"}
    return {"kind": KINDS[shapes.index(type(body))]} if shapes else {}


def _body_of(body: Counterbody) -> Case:
    table = {name: value for name, value in describe(body).items() if name != "kind"}
    if body.material.is_rigid:
        table["material"]["young"] = body.material.young
    return table


def motion_of(case: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a case says about speeds and spins."""
    return {name: case[name] for name in MOTION if case.get(name) is not None}


def numbers_of(case: Mapping[str, Any]) -> dict[str, float]:
    """Return the numbers of a case of round bodies by name, or raise InputError with all faults."""
    read: dict[str, Any] = {}
    with Faults() as faults:
        for name, check in {"friction": not_negative, **MOTION}.items():
            if case.get(name) is not None:
                read[name] = faults.trying(check, name, case[name])
        for name in (*LOSSES, RATIO):
            if case.get(name) is not None:
                read[name] = faults.trying(read_loss, name, case[name])
        for body in ("first", "second"):
            table = case.get(body, {})
            sizes = SIZES if body == "first" else {**SIZES, **PLATE}
            for name in filter(lambda size: table.get(size) is not None, sizes):
                read[f"{body}.{name}"] = faults.trying(sizes[name], name, table[name])
            if table.get("material") is not None:
                known = faults.trying(material_values, table["material"]) or {}
                read |= {f"{body}.material.{name}": value for name, value in known.items()}
    return {name: value for name, value in read.items() if value is not None}


def losses_of(case: Mapping[str, Any]) -> "LossLaw | None":
    """Return the law by which the normal motion of a case loses energy, or None."""
    names = [name for name in LOSSES if case.get(name) is not None]
    there = [*names, *([RATIO] if case.get(RATIO) is not None else [])]
    with Faults() as faults:
        if len(names) > 1:
            faults.add(f"{names[1]}: give it or {names[0]}, not both; {ONE_LOSS}")
        faults.trying(refuse_half, there)
        for name in there:
            faults.trying(read_loss, name, case[name])
    if not names:
        return None
    ratio = case.get(RATIO, 1.0)
    return law_of(names[0], read_loss(names[0], case[names[0]]), ratio)


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


def _second(table: Mapping[str, Any], first: Sphere | Body) -> Counterbody | Body:
    kind = one_of("kind", table.get("kind", KINDS[0]), (*KINDS, *MADE))
    if kind in MADE:
        return _made(kind, {"material": first.material, **table})
    foreign = [n for n in (*PLATE, *reversed(SIZES)) if n in table and n not in OF_KINDS[kind]]
    with Faults() as faults:
        words = f"a {kind} has none; leave it out"
        faults.add(*(str(refusal(name, table[name], words)) for name in foreign))
        if kind == "sphere":
            same = {"material": first.material, "radius": getattr(first, "radius", None)}
            return _sphere("second", "second-", table, same)
        stuff = faults.trying(read_material, table.get("material", first.material))
        stuff = stuff or first.material
        if kind == "half-space":
            return HalfSpace(material=stuff, **{name: table.get(name) for name in PLATE})
        return Cup(radius=_needed(table, "second", "second-", "radius", "10 mm"), material=stuff)


def _sphere(name: str, prefix: str, table: Mapping[str, Any], default: Mapping[str, Any]) -> Sphere:
    values = {**default, **table}
    values.pop("kind", None)
    with Faults() as faults:
        faults.trying(_needed, values, name, prefix, "radius", "5 mm")
        with faults.catching():
            stuff = read_material(_needed(values, name, prefix, "material", "steel"))
    return Sphere(**{**values, "material": stuff})


def _needed(table: Mapping[str, Any], body: str, prefix: str, key: str, example: str) -> Any:
    """Return what a table must have, or raise InputError."""
    if table.get(key) is None:
        words = f"missing for the {body} body; give --{prefix}{key}, e.g. '{example}'"
        raise InputError(f"{key}: {words}")
    return table[key]


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
