"""The page of `carom explore` as a static copy in the manual, at explore/index.html."""

from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

from carom.explorer.export import export

FOLDER = "explore"


def _add_copy(app: Sphinx, error: Exception | None) -> None:
    folder = Path(app.outdir) / FOLDER
    if error is None and app.builder.format == "html" and not folder.exists():
        export(folder)


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("build-finished", _add_copy)
    return {"parallel_read_safe": True}
