"""Links that open a state of the page, {explore}`10° from the normal <angle=10>`, and its copy.

They go to the copy of the page in the manual, and to the live page on the reader's own machine if
they ask for contact laws or data, which only that has. `example=ID` stands for an example.
"""

from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, quote

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import ReferenceRole

from carom.explorer.export import export
from carom.explorer.page import PRESETS

LIVE = "http://127.0.0.1:8050/"
COPY = "explore/index.html"
ONLY_LIVE = {"law", "data"}
EXAMPLES = {preset.id: preset.query for preset in PRESETS}


def opened(query: str) -> str:
    """Return what the page is opened with."""
    name, _, example = query.partition("=")
    found = f"{EXAMPLES[example]}&preset={example}" if name == "example" else query
    return quote(found, safe="=&+%-._")


def is_live(query: str) -> bool:
    """Return whether the live page is needed."""
    return bool(ONLY_LIVE & set(parse_qs(query, keep_blank_values=True)))


class Explore(ReferenceRole):
    """The role `explore`: a title, and in angle brackets the query of the link."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        if not self.has_explicit_title:
            raise ValueError(f"explore: {self.text!r} is no title with a query in <...>")
        query, up = opened(self.target), "../" * self.env.docname.count("/")
        place = LIVE if is_live(query) else f"{up}{COPY}"
        link = nodes.reference(self.rawtext, self.title, refuri=f"{place}?{query}", internal=False)
        return [link], []


def add_copy(app: Sphinx, error: Exception | None) -> None:
    """Add the page as a static copy to the manual."""
    folder = (Path(app.outdir) / COPY).parent
    if error is None and app.builder.format == "html" and not folder.exists():
        export(folder)


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("build-finished", add_copy)
    app.add_role("explore", Explore())
    return {"parallel_read_safe": True}
