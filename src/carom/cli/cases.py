"""Cases: what a user gives in a TOML file or as flags, made into bodies and velocities."""

import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from carom.bodies import VALUES, Cup, HalfSpace, Material, Sphere, as_material
from carom.impacts import Impact, impact
from carom.pairs import Counterbody, Pair
from carom.quantities import InputError, nearest, refusal

Case = dict[str, Any]

MOTION = ("speed", "angle", "normal_speed", "tangential_speed", "spin", "spin2")
BODY = ("radius", "material", "gyration_radius", "inner_radius")
MATERIAL = (*VALUES, "name")
OUTPUT = ("plot", "animation", "data")
KINDS = ("half-space", "sphere", "cup")


class Output(NamedTuple):
    """Files a case asks for."""

    plot: str | None
    animation: str | None
    data: str | None


def read_case(path: Path) -> Case:
    """Return the content of a case file, its keys checked."""
    try:
        text = path.read_text(encoding="utf-8-sig")
        case = tomllib.loads(text)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"case file: {str(path)!r} cannot be read; {reason}") from None
    except UnicodeDecodeError:
        raise InputError(f"case file: {str(path)!r} is not text; give a TOML file") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"case file: {str(path)!r} is not TOML; {error}") from None
    tables = {"first": BODY, "second": ("kind", *BODY), "output": OUTPUT}
    _check_keys(case, ("friction", *MOTION, *tables), text, path, "")
    for name, allowed in tables.items():
        table = case.setdefault(name, {})
        if not isinstance(table, dict):
            raise refusal(name, table, f"must be a table, [{name}], with {', '.join(allowed)}")
        _check_keys(table, allowed, text, path, name)
        if isinstance(table.get("material"), dict):
            _check_keys(table["material"], MATERIAL, text, path, name)
    return case


def _check_keys(
    table: Mapping[str, Any], allowed: Iterable[str], text: str, path: Path, name: str
) -> None:
    for key in table:
        if key not in allowed:
            hint = nearest(key, allowed) or f"known are {', '.join(allowed)}"
            raise InputError(f"{key}: unknown key in {path}, line {_line(key, text, name)}; {hint}")


def _line(key: str, text: str, table: str) -> int:
    """Return the line of a key, searched from the header of its table on."""
    word = re.escape(key)
    pattern = re.compile(rf"^\s*\[?\s*[\"']?{word}[\"']?\s*[=\].]|[{{,]\s*{word}\s*=")
    header = re.compile(rf"^\s*\[?\s*{table}\b") if table else re.compile("")
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        inside = inside or bool(header.match(line))
        if inside and pattern.search(line):
            return number
    return 1


def merged(case: Case, flags: Mapping[str, Any]) -> Case:
    """Return the case with what the flags give in place of what the file gives."""
    result = {key: dict(value) if isinstance(value, dict) else value for key, value in case.items()}
    given = {name for name, value in flags.items() if value is not None}
    if given & {"speed", "angle"}:
        result.pop("normal_speed", None), result.pop("tangential_speed", None)
    if given & {"normal_speed", "tangential_speed"}:
        result.pop("speed", None), result.pop("angle", None)
    for name in given:
        table, _, key = name.rpartition(".")
        if table:
            result.setdefault(table, {})[key] = flags[name]
        else:
            result[name] = flags[name]
    return result


def solve_case(case: Case) -> Impact:
    """Solve the impact that a case describes."""
    if "friction" not in case:
        raise InputError("friction: missing; give --friction, e.g. 0.2 (0 for none)")
    first = _sphere("first", "", case.get("first", {}), {})
    second = _second(case.get("second", {}), first)
    motion = {name: case[name] for name in MOTION if case.get(name) is not None}
    return impact(Pair(first, second, case["friction"]), **motion)


def outputs(case: Case) -> Output:
    """Return the files that a case asks for."""
    table = case.get("output", {})
    for name, value in table.items():
        if not isinstance(value, str):
            raise refusal(name, value, "must be the name of a file")
    return Output(*(table.get(name) for name in OUTPUT))


def _second(table: Mapping[str, Any], first: Sphere) -> Counterbody:
    kind = table.get("kind", "half-space")
    if kind not in KINDS:
        raise refusal("kind", kind, f"must be {', '.join(KINDS[:-1])} or {KINDS[-1]}")
    same = {"material": first.material, "radius": first.radius}
    if kind == "sphere":
        return _sphere("second", "second-", table, same)
    stuff = _material(table.get("material", first.material))
    for name in ("gyration_radius", "inner_radius"):
        if name in table:
            raise refusal(name, table[name], f"a {kind} has none; it belongs to a sphere")
    if kind == "cup":
        if "radius" not in table:
            raise InputError("radius: missing for the cup; give --second-radius, e.g. '10 mm'")
        return Cup(radius=table["radius"], material=stuff)
    if "radius" in table:
        raise refusal("radius", table["radius"], "a half-space has none; set kind to sphere or cup")
    return HalfSpace(material=stuff)


def _sphere(name: str, prefix: str, table: Mapping[str, Any], default: Mapping[str, Any]) -> Sphere:
    values = {**default, **table}
    values.pop("kind", None)
    for key, example in (("radius", "5 mm"), ("material", "steel")):
        if values.get(key) is None:
            raise InputError(
                f"{key}: missing for the {name} body; give --{prefix}{key}, e.g. '{example}'"
            )
    return Sphere(**{**values, "material": _material(values["material"])})


def _material(value: Any) -> Material:
    """Return a material from a name, a table, or text like "young=210 GPa, poisson=0.3"."""
    if isinstance(value, str) and "=" in value:
        pairs = (part.partition("=") for part in value.split(","))
        value = {key.strip(): text.strip() for key, _, text in pairs}
    if not isinstance(value, dict):
        return as_material(value)
    for key in value:
        if key not in MATERIAL:
            raise InputError(f"{key}: unknown in a material; {nearest(key, MATERIAL) or MATERIAL}")
    for key in ("young", "poisson"):
        if key not in value:
            raise InputError(f"{key}: missing in the material; give young, poisson and density")
    return Material(**value)
