"""Links that lead out of the manual, and the index of equations.

The pages are also read where the sources are kept, as they stand, so they hold no roles, only
links. What the manual needs besides is added here while it is read.
"""

import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx


def complete(app: Sphinx, page: str, source: list[str]) -> None:
    """Let links lead to what the manual shows, and add the index of equations to its page."""
    if page == "scripts":
        index = app.srcdir.parent / "examples" / "README.md"
        app.env.note_dependency(index)
        source[0] += equations(index)
    source[0] = led_to_gallery(source[0])


def equations(index: Path) -> str:
    """Return the part of the examples' index that leads from equations to scripts."""
    part = index.read_text(encoding="utf-8").partition("equations to the scripts\n")[2]
    part = part.partition("\nData:")[0]
    return re.sub(r"\]\((?!http)", "](../examples/", part).replace("../examples/../docs/", "")


def led_to_gallery(text: str) -> str:
    """Return Markdown whose links to examples lead to their pages, to other documents as files.

    >>> led_to_gallery("[A](../examples/kharaz.py) [b](../../examples/README.md) [c](x.csv)")
    '[A](/gallery/kharaz.rst) [b](/scripts.md) [c](x.csv)'
    >>> led_to_gallery("[cases](../../examples/lammps/README.md)")
    '{download}`cases <../../examples/lammps/README.md>`'
    """
    text = re.sub(r"\]\((?:\.\./)+examples/(\w+)\.py\)", r"](/gallery/\1.rst)", text)
    text = re.sub(r"\]\((?:\.\./)+examples/README\.md\)", "](/scripts.md)", text)
    return re.sub(r"\[([^]]+)\]\(((?:\.\./)+examples/[^)]+\.md)\)", r"{download}`\1 <\2>`", text)


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("source-read", complete)
    return {"parallel_read_safe": True}
