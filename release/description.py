"""The description on a package index: README.md, with links and pictures that work there."""

import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

PICTURE = re.compile(r"!\[([^]]*)\]\((?!https?:)([^)]+)\)\n*")
LINK = re.compile(r"(?<!!)\[([^]]*)\]\((?!https?:|#)([^)]+)\)")
CODE = re.compile(r"(?s)(```.*?```|`[^`]*`)")
FORMULA = re.compile(r"\$([^$\n]+)\$")  # an index shows them as they are typed
SIGNS = {
    r"\psi": "ψ",
    r"\chi": "χ",
    r"\cdot": "·",
    r"\max": "max",
    r"\lvert": r"\|",
    r"\rvert": r"\|",
}
RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


class Description(MetadataHookInterface):
    """Gives the package its description, with the address of its sources if that is known."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set the description."""
        text = Path(self.root, "README.md").read_text(encoding="utf-8")
        source = metadata.get("urls", {}).get("Source")
        text = described(text, source and f"{source}/{{}}/v{metadata['version']}/")
        metadata["readme"] = {"content-type": "text/markdown", "text": text}


def described(text: str, files: str | None) -> str:
    """Return Markdown for an index; files is where those of the release are, with {} for how.

    Without it there are no pictures, and links are their text.
    """
    if files is None:
        text = LINK.sub(r"\1", PICTURE.sub("", text))
    else:
        text = PICTURE.sub(lambda a: f"![{a[1]}]({files.format('raw')}{a[2]})\n\n", text)
        text = LINK.sub(lambda a: f"[{a[1]}]({files.format('blob')}{a[2]})", text)
    words = CODE.split(text)
    words[::2] = (FORMULA.sub(lambda formula: plain(formula[1]), each) for each in words[::2])
    return "".join(words)


def plain(formula: str) -> str:
    r"""Return a short formula in plain letters: \psi_1 as ψ₁."""
    for sign, letter in SIGNS.items():
        formula = re.sub(rf"{re.escape(sign)}(?![a-z])", lambda _, to=letter: to, formula)
    formula = re.sub(r"\^(?:\{(-?\d+)\}|(\d))", lambda a: (a[1] or a[2]).translate(RAISED), formula)
    return re.sub(r"_(\d)", lambda a: a[1].translate(LOWERED), formula)
