"""A directive that shows what every command says of itself with `--help`."""

from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from samples import commands, help_of
from schema import part
from sphinx.application import Sphinx


class Commands(Directive):
    """A section for every command."""

    def run(self) -> list[nodes.Node]:
        return [
            part(
                nodes.literal(text=" ".join(("carom", *words))),
                self.state.document,
                nodes.literal_block(text=help_of(words), language="text"),
            )
            for words in commands()
        ]


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("commands", Commands)
    return {"parallel_read_safe": True}
