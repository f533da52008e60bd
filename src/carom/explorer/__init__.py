"""The page to explore impacts: `carom explore`. No physics here."""

from carom.io.extras import extra

extra("flask", "the explorer", "explore")  # in one line what else the imports below would say

from carom.explorer.serving import Explorer, explorer  # noqa: E402

__all__ = ["Explorer", "explorer"]
