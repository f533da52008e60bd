"""What the page is made from: its fields, materials, laws, symbols, examples; as JSON holds it."""

from dataclasses import fields
from math import isinf
from typing import Any

from carom.bodies.materials import material
from carom.datasets import names as dataset_names, path
from carom.explorer.knobs import CHOICES, KNOBS, OPTIONS, OWN, WORDS, label
from carom.explorer.limits import LARGEST_UPLOAD, LONGEST_LINK
from carom.explorer.presets import PRESETS
from carom.explorer.scenes import ENERGIES, OF_CONTACT
from carom.explorer.symbols import SYMBOLS
from carom.explorer.tables import RESTITUTIONS
from carom.explorer.views import LAWS, PAGE_ONLY, View
from carom.impacts.curves import REGIMES as LONG
from carom.io.tables import read_table
from carom.io.version import __version__
from carom.verify.catalogue import CATALOGUE

REGIMES = ("stick", "gross slip, stick", "gross slip, slip", "gross slip only")  # as in figures


def config(*, static: bool = False) -> dict[str, Any]:
    """Return what the page reads once, before anything is asked; a static one has no server."""
    return {
        "version": __version__,
        "static": static,
        "page_only": PAGE_ONLY,
        "longest_link": LONGEST_LINK,
        "largest_upload": LARGEST_UPLOAD,
        "fields": _fields() | (_of_copy() if static else {}),
        "materials": {name: _material(name) for name in CHOICES["second_material"] if name != OWN},
        "laws": [{"label": entry.label, "used_by": entry.used_by} for entry in CATALOGUE],
        "regimes": [{"name": name, "long": long} for name, long in zip(REGIMES, LONG, strict=True)],
        "symbols": SYMBOLS,
        "energies": ENERGIES | OF_CONTACT,
        "presets": [preset._asdict() for preset in PRESETS],
        "datasets": [{"name": name, "title": _title(name)} for name in dataset_names()],
    }


def _fields() -> dict[str, dict[str, Any]]:
    choices = CHOICES | {"law": LAWS}
    found = {}
    for field in fields(View):
        knob, words = KNOBS.get(field.name), WORDS[field.name]
        options = [[value, OPTIONS.get(value, value)] for value in choices.get(field.name, ())]
        default = list(field.default) if isinstance(field.default, tuple) else field.default
        found[field.name] = {
            "label": label(field.name),
            "unit": knob.unit.replace("^3", "³") if knob else "",
            "symbol": words.symbol,
            "hint": words.hint,
            "least": knob.least if knob else None,
            "most": knob.most if knob else None,
            "slider": knob.slider if knob else None,
            "choices": options or None,
            "default": default,
        }
    return found


def _of_copy() -> dict[str, dict[str, Any]]:
    """Return the fields that differ in a copy without a server, which has tables and no units."""
    held = [[f"{e:g}", OPTIONS.get(f"{e:g}", f"{e:g}")] for e in RESTITUTIONS]
    known = _fields()
    chosen = {"slider": None, "choices": held, "default": f"{View.restitution:g}"}
    plain = {"hint": ""}  # its numbers are read in the unit of the field alone
    return {"restitution": known["restitution"] | chosen, "radius": known["radius"] | plain}


def _material(name: str) -> dict[str, float | None]:
    stuff = material(name)
    young = None if isinf(stuff.young) else stuff.young
    return {"young": young, "poisson": stuff.poisson, "density": stuff.density}


def _title(name: str) -> str:
    return str(read_table(path(name)).comments["title"])
