"""The page to explore impacts: `carom explore`. No physics here."""

from carom.io.extras import extra

for name in ("flask", "waitress"):  # in one line what else the imports below would say
    extra(name, "the explorer", "explore")

from carom.explorer.serving import Explorer, explorer  # noqa: E402

__all__ = ["Explorer", "explorer"]
