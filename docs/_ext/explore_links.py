"""Links that open a state of the page, {explore}`10° from the normal <angle=10>`, and its copy.

They go to the copy of the page in the manual, and to the live page on the reader's own machine if
they ask for contact laws or data, which only that has. `example=ID` stands for an example, and
`story=ID.N` for a step of a story; all else shows the whole page.
"""

from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, quote

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import ReferenceRole

from carom.page.export import export
from carom.page.page import presets

LIVE = "http://127.0.0.1:8050/"
COPY = "explore/index.html"
ONLY_LIVE = {"law", "data"}
EXAMPLES = {preset["id"]: preset["query"] for preset in presets()}


def opened(target: str) -> tuple[str, str]:
    """Return which page a link opens, the live one where only that has it, and with what."""
    name, _, example = target.partition("=")
    query = f"{EXAMPLES[example]}&preset={example}" if name == "example" else target
    query = query if name == "story" else f"level=full&{query}"
    live = ONLY_LIVE & parse_qs(query, keep_blank_values=True).keys()
    return LIVE if live else COPY, quote(query, safe="=&+%-._")


class Explore(ReferenceRole):
    """The role `explore`: a title, and in angle brackets the query of the link."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        if not self.has_explicit_title:
            raise ValueError(f"explore: {self.text!r} is no title with a query in <...>")
        place, query = opened(self.target)
        uri = "../" * self.env.docname.count("/") * (place == COPY) + f"{place}?{query}"
        return [nodes.reference(self.rawtext, self.title, refuri=uri, internal=False)], []


def add_copy(app: Sphinx, error: Exception | None) -> None:
    """Add the page as a static copy to the manual."""
    folder = (Path(app.outdir) / COPY).parent
    if error is None and app.builder.format == "html" and not folder.exists():
        export(folder)


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("build-finished", add_copy)
    app.add_role("explore", Explore())
    return {"parallel_read_safe": True}
