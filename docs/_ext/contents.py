"""Links that lead out of the manual, the index of equations, and the sections of the Cookbook.

The pages are also read where the sources are kept, as they stand, so they hold no roles, only
links. What the manual needs besides is added here while it is read.
"""

import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

COOKBOOK = "gallery/index"


def complete(app: Sphinx, page: str, source: list[str]) -> None:
    """Let links lead to what the manual shows, and add the index of equations to its page."""
    index = app.srcdir.parent / "examples" / "README.md"
    if page in ("scripts", COOKBOOK):
        app.env.note_dependency(index)
    if page == "scripts":
        source[0] += equations(index)
    if page == COOKBOOK:  # its header alone, without the thumbnails below, which know no sections
        header = source[0].partition("\n.. raw:: html")[0]
        source[0] = header + cookbook(index.read_text(encoding="utf-8"))
    source[0] = led_to_gallery(source[0])


def equations(index: Path) -> str:
    """Return the part of the examples' index that leads from equations to scripts."""
    part = index.read_text(encoding="utf-8").partition("equations to the scripts\n")[2]
    part = part.partition("\nData:")[0]
    return re.sub(r"\]\((?!http)", "](../examples/", part).replace("../examples/../docs/", "")


def cookbook(index: str) -> str:
    """Return the sections of the examples' index with their scripts, in reStructuredText.

    >>> print(cookbook("# A\\n## B\\n| [c.py](c.py) | d |\\n| [e.py](e.py) | f |\\n## G\\nh"))
    <BLANKLINE>
    B
    -
    <BLANKLINE>
    .. minigallery:: ../examples/c.py ../examples/e.py
    <BLANKLINE>
    .. toctree::
       :hidden:
    <BLANKLINE>
       /gallery/c
       /gallery/e
    <BLANKLINE>
    """
    text, pages = "", []
    for section in index.split("\n## ")[1:]:
        title, _, rows = section.partition("\n")
        scripts = re.findall(r"^\| \[(\w+)\.py\]", rows, re.MULTILINE)
        pages += [f"   /gallery/{script}\n" for script in scripts]
        if scripts:
            paths = " ".join(f"../examples/{script}.py" for script in scripts)
            text += f"\n{title}\n{'-' * len(title)}\n\n.. minigallery:: {paths}\n"
    return f"{text}\n.. toctree::\n   :hidden:\n\n{''.join(pages)}"


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
