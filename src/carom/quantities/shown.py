"""What users see of an object: its names by tab completion, its text in a notebook."""

from collections.abc import Iterable
from html import escape

WORDS = """
arguments before builder called coefficients command coords describe description doubts
executable files greeting inputs largest_chi loss most_steps outcomes remedy result rule
sampled scale_free statuses supports symmetric versions written
"""
INNER = frozenset(WORDS.split())  # what the parts of Carom say to each other


class Shown:
    """An object of which `dir` shows neither private names nor those of `INNER`."""

    def __dir__(self) -> Iterable[str]:
        names = super().__dir__()
        return [n for n in names if n not in INNER and (n[0] != "_" or n.startswith("__"))]


class Printed:
    """An object that a notebook shows as `print` does."""

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"
