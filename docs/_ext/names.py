"""Names in the text: those of the reference become links, all others must exist.

`carom.rebound` leads to its page; `carom.dimensionless.solution.Solution` has none, but must exist.
"""

import re
from contextlib import suppress
from dataclasses import fields, is_dataclass
from importlib import import_module
from pkgutil import resolve_name
from typing import Any

from docutils import nodes
from docutils.nodes import make_id
from samples import commands
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.logging import getLogger

from carom.names import GROUPS
from carom.quantities.glossary import GLOSSARY

NAME = re.compile(r"(carom(?:\.\w+)+)(\(.*\))?")
COMMAND = re.compile(r"carom(?: verify)? [a-z]+")
HOMES = {  # where public names are defined, and where they are offered
    f"{thing.__module__}.{thing.__qualname__}": f"{group}.{name}"
    for group, package in zip(GROUPS, map(import_module, GROUPS), strict=True)
    for name in package.__all__
    if hasattr(thing := getattr(package, name), "__qualname__")
}
PAGE = "reference/commands"
COMMANDS = {" ".join(("carom", *words)) for words in commands()}
MARK = "carom_name"


def refer(app: Sphinx, document: nodes.document) -> None:
    """Turn inline code that is a full name, or a command, into a reference."""
    for code in list(document.findall(nodes.literal)):
        name, command = NAME.fullmatch(code.astext()), COMMAND.match(code.astext())
        if isinstance(code.parent, nodes.reference | addnodes.pending_xref | nodes.title):
            continue
        if name:
            to_page(code, offered(name[1]), app.env.docname)
        elif command and command[0] in COMMANDS and app.env.docname != PAGE:
            place = f"{app.builder.get_relative_uri(app.env.docname, PAGE)}#{make_id(command[0])}"
            code.replace_self(nodes.reference("", "", code.deepcopy(), refuri=place, internal=True))
    for link in list(document.findall(addnodes.pending_xref)):  # words of "array_like, shape (n,)"
        if link["reftype"] == "class" and link["reftarget"].rpartition(".")[2].islower():
            link.replace_self(link.children)


def to_page(code: nodes.literal, name: str, page: str) -> None:
    """Put a reference to what has a page in the reference around inline code."""
    where = {"refdomain": "py", "reftype": "obj", "reftarget": name, "refdoc": page}
    unnamed: dict[str, Any] = {"py:module": None, "py:class": None, MARK: True}
    link = addnodes.pending_xref("", refwarn=False, refexplicit=True, **where, **unnamed)
    link.source, link.line = code.source, code.line
    code.replace_self(link)
    link += code


def offered(name: str) -> str:
    """Return a full name as it is offered to users, if it is.

    >>> offered("carom.bodies.pairs.Pair.chi"), offered("carom.dimensionless.rebounds")
    ('carom.Pair.chi', 'carom.dimensionless.rebounds')
    """
    if name in HOMES or name.count(".") < 2:
        return HOMES.get(name, name)
    home, _, field = name.rpartition(".")
    return f"{offered(home)}.{field}"


def exists(name: str) -> bool:
    """Return whether a dotted name leads to something.

    >>> exists("carom.dimensionless.rebounds"), exists("carom.dimensionless.stuck")
    (True, False)
    """
    home, _, field = name.rpartition(".")
    with suppress(ImportError, AttributeError):
        resolve_name(name)
        return True
    with suppress(ImportError, AttributeError):  # of a record, without a value of its own
        return field in getattr(resolve_name(home), "__annotations__", {})
    return False


def check(
    app: Sphinx, env: BuildEnvironment, node: addnodes.pending_xref, content: nodes.Element
) -> nodes.Element | None:
    """Leave a name without a page as it is, if there is such a thing."""
    if MARK not in node:
        return None
    if not exists(node["reftarget"]):
        getLogger(__name__).warning("there is no %s", node["reftarget"], location=node)
    return content


def describe(app: Sphinx, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Let the glossary describe the fields of records that say nothing themselves."""
    if what == "class" and is_dataclass(thing):
        said = "\n".join(lines)
        silent = [field.name for field in fields(thing) if f":param {field.name}" not in said]
        lines += [f":ivar {field}: {meaning(field)}" for field in silent if field in GLOSSARY]
    elif lines and lines[0].startswith("Alias for field"):
        field = name.rpartition(".")[2]
        lines[:] = [meaning(field)] if field in GLOSSARY else []


def meaning(name: str) -> str:
    """Return what the glossary says of a quantity, with its unit.

    >>> meaning("spin")
    'Spin of the first body, in rad/s.'
    """
    entry = GLOSSARY[name]
    unit = "" if entry.unit == "1" else f", in {entry.unit}"
    return f"{entry.meaning[0].upper()}{entry.meaning[1:]}{unit}."


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("doctree-read", refer)
    app.connect("missing-reference", check)
    app.connect("autodoc-process-docstring", describe, priority=900)  # after napoleon
    return {"parallel_read_safe": True}
