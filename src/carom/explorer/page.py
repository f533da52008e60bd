"""The page as HTML, and what it reads once.

That is its fields, materials, laws, symbols and examples, as JSON holds them.
"""

import json
import re
import tomllib
from dataclasses import fields
from importlib.resources import files
from importlib.util import find_spec
from math import isinf
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import urlencode

from carom.bodies.materials import material
from carom.datasets import names as dataset_names, path
from carom.explorer.limits import LARGEST_UPLOAD, LONGEST_LINK
from carom.explorer.tables import RESTITUTIONS
from carom.explorer.views import CHOICES, FIELDS, OWN, PAGE, PAGE_ONLY, View
from carom.impacts.curves import REGIMES as LONG
from carom.io.tables import read_table
from carom.io.version import __version__
from carom.quantities.refusals import InputError
from carom.verify.entries import CATALOGUE

ASSETS = "assets"  # the folder of the styles and scripts
REGIMES = ("stick", "gross slip, stick", "gross slip, slip", "gross slip only")  # as in figures
SYMBOLS: dict[str, str] = PAGE["symbols"]
ONLY_THICK = "this copy has thick walls only; the program takes plates"
OPTIONS: dict[str, str] = PAGE["choices"]


def page(*, static: bool = False) -> str:
    """Return the page, whose parts are at assets/...; a static one answers without a server."""
    settings = json.dumps(config(static=static), ensure_ascii=False)
    left_out = 'data-in="live"' if static else 'data-in="copy"'
    lines = asset("page.html").decode().splitlines(keepends=True)
    html = "".join(line for line in lines if left_out not in line)
    return html.replace("{config}", settings.replace("<", "\\u003c"))  # nothing ends the script


def assets_in(html: str) -> tuple[str, ...]:
    """Return the names of the styles and scripts of a page, in their order."""
    return tuple(re.findall(rf'"{ASSETS}/([^"]+)"', html))


def asset(name: str) -> bytes:
    """Return a file of the page."""
    return files("carom.explorer").joinpath(ASSETS, name).read_bytes()


def plotly_file() -> Path:
    """Return the file of plotly's JavaScript, without its package, which takes long to load."""
    package = find_spec("plotly")
    if package is None or package.origin is None:
        raise InputError("the explorer needs the package plotly; pip install 'carom[explore]'")
    return Path(package.origin).with_name("package_data") / "plotly.min.js"


class Preset(NamedTuple):
    """An example for a class: its link's query, and what there is to see in it.

    `sources` say of each number where it was published or that it is assumed, `caution` where the
    theory of elastic spheres is stretched.
    """

    id: str
    title: str
    story: str
    query: str
    sources: tuple[str, ...]
    caution: str = ""


def _presets() -> tuple[Preset, ...]:
    content = tomllib.loads(files("carom").joinpath("data/presets.toml").read_text("utf-8"))
    texts = content["sources"]
    return tuple(
        Preset(name, each["title"], each["story"], urlencode(each["impact"]), sources, caution)
        for name, each in content["presets"].items()
        for sources in [tuple(texts.get(source, source) for source in each["sources"])]
        for caution in [each.get("caution", "")]
    )


PRESETS = _presets()


def config(*, static: bool = False) -> dict[str, Any]:
    """Return what the page reads once, before anything is asked; a static one has no server."""
    return {
        "version": __version__,
        "static": static,
        "page_only": PAGE_ONLY,
        "longest_link": LONGEST_LINK,
        "largest_upload": LARGEST_UPLOAD,
        "fields": _fields() | (_fields_of_copy() if static else {}),
        "materials": {name: _material(name) for name in CHOICES["second_material"] if name != OWN},
        "laws": [{"label": entry.label, "used_by": entry.used_by} for entry in CATALOGUE],
        "regimes": [{"name": name, "long": long} for name, long in zip(REGIMES, LONG, strict=True)],
        "symbols": SYMBOLS,
        "energies": PAGE["energies"] | PAGE["energies_of_contact"],
        "presets": [preset._asdict() for preset in PRESETS],
        "datasets": [
            {"name": name, "title": read_table(path(name)).comments["title"]}
            for name in dataset_names()
        ],
    }


def _fields() -> dict[str, dict[str, Any]]:
    return {default.name: _field(default.name, default.default) for default in fields(View)}


def _field(name: str, default: Any) -> dict[str, Any]:
    field, choices = FIELDS[name], CHOICES.get(name, ())
    return {
        **field._asdict(),
        "unit": field.unit.replace("^3", "³"),
        "least": field.least if field.is_number else None,
        "most": field.most if field.is_number else None,
        "choices": [[value, OPTIONS.get(value, value)] for value in choices] or None,
        "default": list(default) if isinstance(default, tuple) else field.otherwise or default,
    }


def _fields_of_copy() -> dict[str, dict[str, Any]]:
    """Return the fields that differ in a copy without a server, which has tables and no units."""
    tabulated = [[f"{e:g}", OPTIONS.get(f"{e:g}", f"{e:g}")] for e in RESTITUTIONS]
    chosen = {"slider": None, "choices": tabulated, "default": f"{View.restitution:g}"}
    plain = {"hint": ""}  # its numbers are read in the unit of the field alone
    own, plates = _fields(), {"thickness": "thick", "inelasticity": "0"}  # all that it has
    no_plate = {"slider": None, "least": None, "most": None, "hint": ONLY_THICK}
    return {
        "restitution": own["restitution"] | chosen,
        "radius": own["radius"] | plain,
        **{
            name: own[name] | no_plate | {"choices": [[only, only]], "default": only}
            for name, only in plates.items()
        },
    }


def _material(name: str) -> dict[str, float | None]:
    stuff = material(name)
    young = None if isinf(stuff.young) else stuff.young
    return {"young": young, "poisson": stuff.poisson, "density": stuff.density}
