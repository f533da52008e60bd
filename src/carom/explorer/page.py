"""The page as HTML: what it is made from, its styles and its scripts in their order."""

import json
from html import escape
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

from carom.explorer.config import config
from carom.quantities.refusals import InputError

STYLES = (
    *("carom.css", "composition.css", "controls.css"),
    *("pictures.css", "reading.css", "laws.css", "fit.css"),
)
PICTURES = (
    *("config", "elements", "theme", "clock", "canvas", "contact", "view", "scene", "stage"),
    *("profile", "patch_layout", "patch", "told"),
)
CHARTS = (
    *("plotting", "bands", "keys", "chart_rebounds", "chart_histories", "charts", "cursor"),
    *("results", "laws"),
)
READER = (
    *("tips", "tabs", "files", "fit_charts", "fit_tables", "fit"),
    *("fields", "code", "presets", "beside", "link", "page"),
)
LIVE = ("server",)
COPY = (
    *("tables", "quantities", "rebound", "normal", "springs", "law"),
    *("pair", "paths", "answer", "copy"),
)


def page(*, static: bool = False) -> str:
    """Return the page, whose parts are at assets/...; a static one answers without a server."""
    scripts = (name for name in assets_of(static=static) if name not in STYLES)
    settings = json.dumps(config(static=static), ensure_ascii=False)
    parts = {
        "{styles}": "\n    ".join(
            f'<link rel="stylesheet" href="{_place(name)}">' for name in STYLES
        ),
        "{scripts}": "\n    ".join(
            f'<script src="{_place(name)}" defer></script>' for name in scripts
        ),
        "{config}": settings.replace("<", "\\u003c"),  # nothing in it ends the script
    }
    html = asset("page.html").decode()
    for place, text in parts.items():
        html = html.replace(place, text)
    return html


def assets_of(*, static: bool = False) -> tuple[str, ...]:
    """Return the names of the styles and scripts of the page, in their order."""
    source = COPY if static else LIVE
    return (*STYLES, *(f"{name}.js" for name in (*PICTURES, *CHARTS, *source, *READER)))


def asset(name: str) -> bytes:
    """Return a file of the page."""
    return files("carom.explorer").joinpath("assets", name).read_bytes()


def plotly_file() -> Path:
    """Return the file of plotly's JavaScript, without its package, which takes long to load."""
    package = find_spec("plotly")
    if package is None or package.origin is None:
        raise InputError("the explorer needs the package plotly; pip install 'carom[explore]'")
    return Path(package.origin).with_name("package_data") / "plotly.min.js"


def _place(name: str) -> str:
    return f"assets/{escape(name)}"
