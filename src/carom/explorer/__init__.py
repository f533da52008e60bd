"""The page to explore impacts: `carom explore`. No physics here."""

from carom.explorer.serving import Explorer, explorer

__all__ = ["Explorer", "explorer"]
