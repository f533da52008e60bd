"""Links that lead out of the manual, and the index of equations.

The pages are also read where the sources are kept, as they stand, so they hold no roles, only
links. What the manual needs besides is added here while it is read.
"""

import re
from os.path import relpath
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx


def add_equations(app: Sphinx, page: str, source: list[str]) -> None:
    """Give the page of the scripts the part of their index that leads from equations to them."""
    if page == "scripts":
        index = app.srcdir.parent / "examples" / "README.md"
        app.env.note_dependency(index)
        source[0] += equations(index)


def equations(index: Path) -> str:
    """Return the part of the examples' index that leads from equations to scripts."""
    part = index.read_text(encoding="utf-8").partition("equations to the scripts\n")[2]
    part = part.partition("\nData:")[0]
    return re.sub(r"\]\((?!http)", "](../examples/", part).replace("../examples/../docs/", "")


def lead_to_gallery(app: Sphinx, document: nodes.document) -> None:
    """Let links out of `docs` lead to the pages that show what is there, or to the file itself."""
    for link in list(document.findall(addnodes.download_reference)):
        follow(link, link["reftarget"])
    for link in list(document.findall(addnodes.pending_xref)):
        if link["reftype"] == "myst" and link["refdomain"] == "doc":
            target = Path(f"{link['reftarget']}.md")
            if target.is_absolute() and target.is_file():
                follow(link, relpath(target, Path(app.env.doc2path(app.env.docname)).parent))


def follow(link: nodes.Element, target: str) -> None:
    """Let a link lead to the page that shows a file outside `docs`, else to the file."""
    page = page_of(target)
    if page:
        kept = {"refdoc": link["refdoc"], "refdomain": "std", "refexplicit": True}
        new: nodes.Element = addnodes.pending_xref(
            "", reftype="doc", reftarget=page, refwarn=True, **kept
        )
    else:
        new = addnodes.download_reference("", reftarget=target, refdoc=link["refdoc"])
    new += nodes.inline("", link.astext(), classes=["std", "std-doc"])
    link.replace_self(new)


def page_of(target: str) -> str | None:
    """Return the page of the manual that shows a file outside it.

    >>> page_of("../examples/kharaz.py"), page_of("../examples/README.md"), page_of("x.csv")
    ('/gallery/kharaz', '/scripts', None)
    """
    folder, _, name = target.rpartition("/")
    if folder.endswith("examples"):
        if name == "README.md":
            return "/scripts"
        if name.endswith(".py"):
            return f"/gallery/{name.removesuffix('.py')}"
    return None


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("source-read", add_equations)
    app.connect("doctree-read", lead_to_gallery, priority=100)  # before downloads are collected
    return {"parallel_read_safe": True}
