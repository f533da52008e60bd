"""The first use of a symbol or term on a page leads to the glossary.

The glossary is a page of Markdown: the terms are the first cells of its last table, the symbols
stand at the ends of its headings. Titles, code and what is a link already stay as they are.
"""

import re
from typing import Any

from docutils import nodes
from docutils.nodes import make_id
from sphinx.application import Sphinx
from sphinx.util import relative_uri

PAGE = "glossary"
SYMBOLS = {r"\kappa": "stiffness-kappa", r"\psi": "direction-psi", r"\chi": "inertia-chi"}
STAY = (nodes.title, nodes.reference, nodes.literal, nodes.literal_block, nodes.raw)
FREE = ("glossary", "cheatsheet", "signs", "index", "reference/", "gallery/", "schema", "scripts")
TOO_COMMON = {"phase", "memory"}  # words that mostly mean something else


def terms(source: str) -> list[str]:
    """Return the terms that a glossary's table explains, the longest first.

    >>> terms("| term | meaning |\\n|---|---|\\n| slip | a |\\n| gross slip | b |\\n")
    ['gross slip', 'slip']
    """
    table = source.partition("| term | meaning |")[2]
    return sorted(re.findall(r"^\| ([^|$]*[^|$ ]) \|", table, re.MULTILINE), key=len, reverse=True)


def mark(app: Sphinx, document: nodes.document) -> None:
    """Give the rows of the glossary places to lead to; lead other pages there."""
    page = app.env.docname
    if page == PAGE:
        for row in document.findall(nodes.row):
            row["ids"].append(f"term-{make_id(row[0].astext())}")
    elif not page.startswith(FREE):
        link(document, relative_uri(app.builder.get_target_uri(page), "glossary.html"), app)


def link(document: nodes.document, glossary: str, app: Sphinx) -> None:
    """Turn first uses into links."""
    text = (app.srcdir / f"{PAGE}.md").read_text(encoding="utf-8")
    waiting = [term for term in terms(text) if term not in TOO_COMMON]
    symbols = dict(SYMBOLS)
    for node in list(document.findall(lambda node: isinstance(node, nodes.Text | nodes.math))):
        if inside(node, *STAY):
            continue
        if isinstance(node, nodes.math):
            formula = node.astext()
            said = [symbol for symbol in symbols if re.search(rf"\{symbol}(?![a-z])", formula)]
            if said:
                place = symbols.pop(said[0])
                node.replace_self(reference(f"{glossary}#{place}", node.deepcopy()))
        elif not inside(node, nodes.math, nodes.math_block, nodes.caption):
            link_term(node, glossary, waiting)


def inside(node: nodes.Node, *kinds: type[nodes.Node]) -> bool:
    """Return whether a node stands in one of these kinds."""
    while (node := node.parent) is not None:
        if isinstance(node, kinds):
            return True
    return False


def link_term(node: nodes.Text, glossary: str, waiting: list[str]) -> None:
    """Lead the first terms of a text to the glossary, and take them from those that wait."""
    parts, rest = [], node.astext()
    while found := min(
        (match for term in waiting if (match := re.search(rf"\b{term}s?\b", rest, re.IGNORECASE))),
        key=lambda match: (match.start(), -match.end()),
        default=None,
    ):
        term = next(one for one in waiting if re.fullmatch(rf"{one}s?", found[0], re.IGNORECASE))
        waiting.remove(term)
        target = f"{glossary}#term-{make_id(term)}"
        parts += [nodes.Text(rest[: found.start()]), reference(target, nodes.Text(found[0]))]
        rest = rest[found.end() :]
    if parts:
        node.parent.replace(node, [*parts, nodes.Text(rest)])


def reference(target: str, child: nodes.Node) -> nodes.reference:
    return nodes.reference("", "", child, refuri=target, internal=True, classes=["term"])


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("doctree-read", mark, priority=400)  # before names become links
    return {"parallel_read_safe": True}
