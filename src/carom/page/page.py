"""The page as HTML, and what it reads once.

That is its fields, materials, laws, symbols and examples, as JSON holds them.
"""

import json
import re
import tomllib
from base64 import b64encode
from dataclasses import fields
from functools import cache
from hashlib import sha256
from importlib.util import find_spec
from math import isinf
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import numpy as np

from carom.bodies.materials import material
from carom.dimensionless.numerics.shared_library import BROWSER, BROWSER_CONTENTS, FOLDER, digest
from carom.folder import DATA, PACKAGE
from carom.impacts.curves import REGIMES as LONG
from carom.io.tables import read_table
from carom.lab.datasets.shipped import names as dataset_names, path
from carom.page.limits import LARGEST_UPLOAD, LONGEST_LINK
from carom.page.views import CHOICES, FIELDS, OWN, PAGE, PAGE_ONLY, UNDAMPED, View
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import READ
from carom.quantities.refusals import InputError
from carom.verify.entries import CATALOGUE, Entry, named

ASSETS = "assets"  # the folder of the styles and scripts
KERNELS = "wasm.js"  # a script among them: the solver, compiled for browsers
REGIMES = ("stick", "gross slip, stick", "gross slip, slip", "gross slip only")  # as in figures
SYMBOLS: dict[str, str] = PAGE["symbols"]
OPTIONS: dict[str, str] = PAGE["choices"]
POINTS = 241  # of the curve of a law
PREFIXED = ("s", "N", "J", "m", "m/s")  # units of results


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
    return Path(__file__).with_name(ASSETS).joinpath(name).read_bytes()


def plotly_file() -> Path:
    """Return the file of plotly's JavaScript, without its package, which takes long to load."""
    package = find_spec("plotly")
    if package is None or package.origin is None:
        raise InputError("the explorer needs the package plotly; pip install 'carom[explore]'")
    return Path(package.origin).with_name("package_data") / "plotly.min.js"


@cache
def kernels() -> bytes:
    """Return the script of the solver for browsers, or raise InputError."""
    try:
        contents = json.loads((FOLDER / BROWSER_CONTENTS).read_text(encoding="utf-8"))
        module = (FOLDER / BROWSER).read_bytes()
        made_from = digest(PACKAGE / name for name in contents.pop("files"))
        fits = made_from == contents.pop("sources")
        fits = fits and sha256(module).hexdigest() == contents.pop("sha256")
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        fits = False
    if not fits:
        raise InputError("the explorer needs the kernels for browsers; install carom again")
    contents["code"] = b64encode(module).decode()
    return f"Carom.wasm = {json.dumps(contents, separators=(',', ':'))};\n".encode()


def presets() -> list[dict[str, Any]]:
    """Return the examples for a class: a link's query each, and what there is to see in it."""
    content = _content("presets")
    return [
        {
            "id": name,
            **{key: each.get(key, "") for key in ("title", "story", "caution", "short")},
            "query": urlencode(each["impact"]),
            "sources": [content["sources"].get(source, source) for source in each["sources"]],
        }
        for name, each in content["presets"].items()
    ]


def stories() -> list[dict[str, Any]]:
    """Return the stories of the page: steps with a question each, their impacts as queries."""
    return [
        {
            "id": name,
            "title": each["title"],
            "steps": [
                {**step, "query": urlencode(each["impact"] | step["impact"], doseq=True)}
                for step in each["steps"]
            ],
        }
        for name, each in _content("stories").items()
    ]


def _content(name: str) -> dict[str, Any]:
    return tomllib.loads((DATA / f"{name}.toml").read_text("utf-8"))


def _laws_of_stories() -> list[dict[str, Any]]:
    """Return the curves of contact laws that stories need, for a copy that solves none."""
    views = [View.of(step["query"]) for story in stories() for step in story["steps"]]
    curves = {}
    for view in views:
        for label in view.law:
            chi, kappa = view.pair.chi, view.pair.kappa
            psi = np.linspace(0.0, 4.0 * chi, POINTS)
            out, _ = named(label)[0].law.rebound(psi, chi, kappa=kappa, return_status=True)
            told = {"label": label, "chi": chi, "psi": psi.tolist(), "out": out.tolist()}
            curves[label, chi, kappa] = told
    return list(curves.values())


def config(*, static: bool = False) -> dict[str, Any]:
    """Return what the page reads once, before anything is asked; a static one has no server."""
    return {
        "page_only": PAGE_ONLY,
        "longest_link": LONGEST_LINK,
        "largest_upload": LARGEST_UPLOAD,
        "fields": _fields(static),
        "materials": {name: _material(name) for name in CHOICES["second_material"] if name != OWN},
        "laws": [_law(entry) for entry in CATALOGUE],
        "rows": {name: _row(name, sign) for name, sign in PAGE["signs"].items()},
        "lossy": {name: _row(name, sign) for name, sign in PAGE["signs_of_losses"].items()},
        "prefixes": {unit: sorted(READ[unit].items()) for unit in PREFIXED},
        "regimes": [{"name": name, "long": long} for name, long in zip(REGIMES, LONG, strict=True)],
        "symbols": SYMBOLS,
        "lost": PAGE["lost"],
        "energies": PAGE["energies"] | PAGE["energies_of_contact"],
        "presets": presets(),
        "stories": stories(),
        "story_laws": _laws_of_stories() if static else [],
        "datasets": [
            {"name": name, "title": read_table(path(name)).comments["title"]}
            for name in dataset_names()
        ],
    }


def _fields(static: bool) -> dict[str, dict[str, Any]]:
    described = {default.name: _field(default.name, default.default) for default in fields(View)}
    if static:  # it has no program that reads other units
        described["radius"]["hint"] = ""
    return described


def _law(entry: Entry) -> dict[str, Any]:
    damped = entry.label not in UNDAMPED
    return {"label": entry.label, "used_by": entry.used_by, "damped": damped}


def _row(name: str, sign: str) -> dict[str, str]:
    return {"symbol": sign, "meaning": GLOSSARY[name].meaning, "unit": GLOSSARY[name].unit}


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


def _material(name: str) -> dict[str, float | None]:
    stuff = material(name)
    young = None if isinf(stuff.young) else stuff.young
    return {"young": young, "poisson": stuff.poisson, "density": stuff.density}
