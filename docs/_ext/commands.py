"""A directive that shows what every command says of itself with `--help`."""

from collections.abc import Iterator
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from samples import help_of
from sphinx.application import Sphinx
from typer.main import get_command

from carom.cli import app


def commands(group: Any = None, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Yield the words of every command, groups first."""
    group = group or get_command(app)
    yield path
    for name, command in getattr(group, "commands", {}).items():
        yield from commands(command, (*path, name))


class Commands(Directive):
    """A section for every command."""

    def run(self) -> list[nodes.Node]:
        return [section(words, self.state.document) for words in commands()]


def section(words: tuple[str, ...], document: nodes.document) -> nodes.section:
    """Return the section on one command, which links can name."""
    name = " ".join(("carom", *words))
    text = nodes.literal_block(text=help_of(words), language="text")
    title = nodes.title(name, "", nodes.literal(text=name))
    part = nodes.section("", title, text, names=[name])
    document.note_explicit_target(part)
    return part


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("commands", Commands)
    return {"parallel_read_safe": True}
