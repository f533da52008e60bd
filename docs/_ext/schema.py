"""Directives that say what results hold and what commands answer, from those of now."""

import json
from typing import Any

from docutils import nodes
from samples import COMMANDS, DATASETS, SETUP, commands, datasets, help_of, printed
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from carom.quantities import glossary
from carom.quantities.glossary import GLOSSARY

LONGEST = 60  # characters of an attribute's value


class Glossary(SphinxDirective):
    """The table of all quantities: name, symbol, unit, meaning."""

    def run(self) -> list[nodes.Node]:
        self.env.note_dependency(glossary.__file__)
        rows = [
            [code(name), words(entry.symbol), entry.unit, words(entry.meaning)]
            for name, entry in GLOSSARY.items()
        ]
        return [table(["name", "symbol", "unit", "meaning"], rows)]


class Datasets(SphinxDirective):
    """A section for every kind of dataset, and how those shown were made."""

    def run(self) -> list[nodes.Node]:
        made = datasets()
        return [
            nodes.literal_block(text=SETUP.strip(), language="python"),
            *(part(nodes.Text(it), self.state.document, *told(it, made[it])) for it in made),
        ]


class Printed(SphinxDirective):
    """A section for every command that prints JSON."""

    def run(self) -> list[nodes.Node]:
        return [
            part(
                nodes.Text(f"{command} --json"),
                self.state.document,
                nodes.literal_block(text=json.dumps(printed(command), indent=1), language="json"),
            )
            for command in COMMANDS
        ]


class Commands(SphinxDirective):
    """A section for every command: what it says of itself with `--help`."""

    def run(self) -> list[nodes.Node]:
        return [
            part(
                nodes.literal(text=" ".join(("carom", *words))),
                self.state.document,
                nodes.literal_block(text=help_of(words), language="text"),
            )
            for words in commands()
        ]


def told(title: str, dataset: Any) -> list[nodes.Node]:
    """Return the dimensions, variables and attributes of a dataset."""
    sizes = ", ".join(f"{name}: {size}" for name, size in dataset.sizes.items())
    made = nodes.paragraph("", "", code(DATASETS[title]), nodes.Text(f" has dimensions {sizes}."))
    rows = [
        [code(name), ", ".join(array.dims), kind(array), *meaning(array)]
        for name, array in (*dataset.coords.items(), *dataset.data_vars.items())
    ]
    variables = table(["name", "dimensions", "type", "unit", "meaning"], rows)
    attributes = [[code(name), shortened(value)] for name, value in dataset.attrs.items()]
    return [made, variables, table(["attribute", "here"], attributes)]


def kind(array: Any) -> str:
    """Return the type of an array in a word."""
    return "text" if array.dtype.kind in "OUT" else str(array.dtype)


def meaning(array: Any) -> list[Any]:
    """Return the unit and the meaning of an array, its flags among it."""
    said = str(array.attrs.get("long_name", ""))
    flags = array.attrs.get("flag_meanings")
    if flags:
        pairs = zip(array.attrs["flag_values"], flags.split(), strict=True)
        named = ", ".join(f"{value} {word.replace('_', ' ')}" for value, word in pairs)
        said = f"{said}: {named}" if said else named
    return [str(array.attrs.get("units", "")), words(said)]


def shortened(value: Any) -> str:
    """Return an attribute as one short line."""
    text = " ".join(str(value).split())
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."


def words(text: str) -> nodes.paragraph:
    """Return a text with $formulas$ as nodes."""
    whole = nodes.paragraph()
    for number, piece in enumerate(text.split("$")):
        if piece:
            whole += nodes.math(piece, piece) if number % 2 else nodes.Text(piece)
    return whole


def code(text: str) -> nodes.literal:
    return nodes.literal(text=str(text))


def part(heading: nodes.Node, document: nodes.document, *content: nodes.Node) -> nodes.section:
    """Return a section that links can name."""
    title = heading.astext()
    section = nodes.section("", nodes.title(title, "", heading), *content, names=[title.lower()])
    document.note_explicit_target(section)
    return section


def table(head: list[str], rows: list[list[Any]]) -> nodes.table:
    """Return a table of texts and nodes."""
    group = nodes.tgroup("", cols=len(head))
    group += [nodes.colspec(colwidth=1) for _ in head]
    group += nodes.thead("", row(head))
    group += nodes.tbody("", *(row(cells) for cells in rows))
    return nodes.table("", group, classes=["colwidths-auto"])


def row(cells: list[Any]) -> nodes.row:
    entries = []
    for cell in cells:
        if isinstance(cell, nodes.paragraph):
            entries.append(nodes.entry("", cell))
        else:
            shown = cell if isinstance(cell, nodes.Node) else nodes.Text(cell)
            entries.append(nodes.entry("", nodes.paragraph("", "", shown)))
    return nodes.row("", *entries)


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("quantities", Glossary)
    app.add_directive("datasets", Datasets)
    app.add_directive("printed", Printed)
    app.add_directive("commands", Commands)
    return {"parallel_read_safe": True}
