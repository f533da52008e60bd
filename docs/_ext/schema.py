"""Directives that say what results hold and what commands answer, from those of now."""

import json
from collections.abc import Callable, Iterable
from typing import Any

from docutils import nodes
from samples import COMMANDS, DATASETS, SETUP, commands, datasets, help_of, printed
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from carom.quantities import glossary
from carom.quantities.glossary import GLOSSARY

LONGEST = 60  # characters of an attribute's value


def quantities() -> str:
    """Return the table of all quantities: name, symbol, unit, meaning."""
    rows = ((f"`{name}`", it.symbol, it.unit, it.meaning) for name, it in GLOSSARY.items())
    return table("name symbol unit meaning", rows)


def made_datasets() -> str:
    """Return a section for every kind of dataset."""
    return "\n".join(described(title, dataset) for title, dataset in datasets().items())


def printed_json() -> str:
    """Return a section for every command that prints JSON."""
    shown = {command: json.dumps(printed(command), indent=1) for command in COMMANDS}
    return "\n".join(f"### {name} --json\n\n{block(text, 'json')}" for name, text in shown.items())


def answered_help() -> str:
    """Return a section for every command: what it says of itself with `--help`."""
    shown = {" ".join(("carom", *words)): help_of(words) for words in commands()}
    return "\n".join(f"## `{name}`\n\n{block(text, 'text')}" for name, text in shown.items())


def described(title: str, dataset: Any) -> str:
    """Return the dimensions, variables and attributes of a dataset, as a section."""
    sizes = ", ".join(f"{name}: {size}" for name, size in dataset.sizes.items())
    arrays = (*dataset.coords.items(), *dataset.data_vars.items())
    rows = (variable(name, array) for name, array in arrays)
    variables = table("name dimensions type unit meaning", rows)
    attributes = ((f"`{name}`", shortened(value)) for name, value in dataset.attrs.items())
    head = f"### {title}\n\n`{DATASETS[title]}` has dimensions {sizes}.\n"
    return "\n".join([head, variables, table("attribute here", attributes)])


def variable(name: str, array: Any) -> tuple[str, ...]:
    """Return name, dimensions, type, unit and meaning of an array, its flags among it."""
    kind = "text" if array.dtype.kind in "OUT" else str(array.dtype)
    meaning = [str(array.attrs["long_name"])] if "long_name" in array.attrs else []
    if flags := array.attrs.get("flag_meanings"):
        pairs = zip(array.attrs["flag_values"], flags.split(), strict=True)
        meaning.append(", ".join(f"{value} {word.replace('_', ' ')}" for value, word in pairs))
    unit = array.attrs.get("units", "")
    return f"`{name}`", ", ".join(array.dims), kind, unit, ": ".join(meaning)


def shortened(value: Any) -> str:
    """Return an attribute as one short line, as it stands."""
    text = " ".join(str(value).split())
    text = text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."
    return "".join(f"\\{letter}" if letter in "\\`*_[]{}<>$#" else letter for letter in text)


def block(text: str, language: str) -> str:
    return f"```{language}\n{text}\n```\n"


def table(head: str, rows: Iterable[Iterable[str]]) -> str:
    """Return a table of Markdown."""
    names = head.split()
    lines = (" | ".join(cell.replace("|", "\\|") for cell in row) for row in rows)
    return "\n".join([" | ".join(names), "|".join("---" for _ in names), *lines, ""])


def directive(text: Callable[[], str]) -> type[SphinxDirective]:
    """Return a directive that puts a text of Markdown where it stands."""

    class Made(SphinxDirective):
        def run(self) -> list[nodes.Node]:
            self.env.note_dependency(str(glossary.FILE))
            return self.parse_text_to_nodes(text(), allow_section_headings=True)

    return Made


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("quantities", directive(quantities))
    app.add_directive("setup", directive(lambda: block(SETUP.strip(), "python")))
    app.add_directive("datasets", directive(made_datasets))
    app.add_directive("printed", directive(printed_json))
    app.add_directive("commands", directive(answered_help))
    return {"parallel_read_safe": True}
