"""Materials as case files and options give them: by name, as a table, or as a text of values."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from typing import Any

from carom.bodies.materials import VALUES, Material, as_material, material
from carom.quantities import refusals
from carom.quantities.refusals import InputError, hint, refusal, refuse

MATERIAL = (*VALUES, "name")
TWICE = "it is given twice in the material; leave one of them out"


def unknown_keys(
    table: Mapping[str, Any], allowed: Iterable[str], words: Callable[[str], str]
) -> Iterator[str]:
    """Yield what is to be said of keys that are not allowed."""
    unknown = [key for key in table if key not in allowed]
    for place, key in enumerate(unknown):
        told = place < refusals.MOST_LISTED  # the others are counted
        name = refusals.heading(str(key)) if told else key
        yield f"{name}: {words(key)}; {hint(key, allowed)}" if told else f"{name}: unknown"


def read_material(value: Any) -> Material:
    """Return a material from a name, a table, or text like "young=210 GPa, poisson=0.3"."""
    table = _as_table(value)
    if not isinstance(table, Mapping):
        return as_material(table)
    if _adds_to_catalogue(table):
        return material(**table)
    needed = [key for key in ("young", "poisson") if key not in table]
    refuse(*(f"{n}: missing in the material; give young, poisson and density" for n in needed))
    return Material(**table)


def _adds_to_catalogue(table: Mapping[str, Any]) -> bool:
    """Tell whether a table names a material of the catalogue instead of elastic constants."""
    return isinstance(table.get("name"), str) and not {"young", "poisson"} & set(table)


def material_values(value: Any) -> dict[str, float]:
    """Return what is known of a material, in SI units; a table may leave values out."""
    table = _as_table(value)
    if isinstance(table, Mapping) and _adds_to_catalogue(table):
        with suppress(InputError):  # the name may be one's own, for what the case leaves out
            table = material(**table)
    if isinstance(table, Mapping):
        stuff = Material(**{"young": 1.0, "poisson": 0.0, **table})
        return {name: getattr(stuff, name) for name in VALUES if table.get(name) is not None}
    stuff = as_material(table)
    return {name: getattr(stuff, name) for name in VALUES if getattr(stuff, name) is not None}


def _as_table(value: Any) -> Any:
    """Return text like "young=210 GPa, poisson=0.3" as a table, anything else as it is."""
    if isinstance(value, str) and "=" in value:
        entries = [_entry(part) for part in value.split(",")]
        value = dict(entries)
        for key, count in Counter(name for name, _ in entries).items():
            if count > 1:
                texts = (text for name, text in entries if name == key)
                raise refusal(key, " and ".join(texts), TWICE)
    if isinstance(value, Mapping):
        refuse(*unknown_keys(value, MATERIAL, lambda _: "unknown in a material"))
    return value


def _entry(part: str) -> tuple[str, str]:
    key, equals, text = part.partition("=")
    if not equals:
        example = "write e.g. young=210 GPa, poisson=0.3, density=7850 with decimal points"
        raise refusal("material", part.strip(), example)
    return key.strip(), text.strip()
