"""The manual names everything that is public: names, commands, examples, pages."""

import ast
import doctest
import inspect
import re
import sys
from importlib import import_module
from pathlib import Path

import pytest

import carom

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
sys.path.insert(0, str(DOCS / "_ext"))
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
MODULES = [carom, *filter(inspect.ismodule, (getattr(carom, name) for name in carom.__all__))]
APART = {"explore", "lammps", "liggghts", "yade", "build"}  # they serve, or run a program of others


def listed():
    """Return every name in the tables of the reference, with the module that it is taken from."""
    entries = []
    for page in DOCS.glob("reference/*.rst"):
        module, table = "", False
        for line in page.read_text(encoding="utf-8").splitlines():
            if line.startswith(".. currentmodule:: "):
                module = line.split()[-1]
            table = line.startswith(".. autosummary::") or (table and line[:1] in ("", " "))
            if table and re.fullmatch(r"   \w+", line):
                entries.append(f"{module}.{line.strip()}")
    return entries


def test_reference_has_every_public_name_once():
    names = [
        f"{module.__name__}.{name}"
        for module in (*MODULES, carom.plots.style)
        for name in module.__all__
        if not (inspect.ismodule(getattr(module, name)) or name.isupper())  # a constant
    ]
    assert sorted(listed()) == sorted(names)


@pytest.mark.parametrize("script", EXAMPLES, ids=lambda script: script.stem)
def test_example_has_a_title(script):
    """The gallery shows it under the picture: short, underlined, and no other's."""
    words = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8")))
    title, line, blank, *text = words.splitlines()
    assert line == "=" * len(title)
    assert len(title) <= 50
    assert (blank, bool(text)) == ("", True)


def test_titles_of_examples_differ():
    titles = [script.read_text(encoding="utf-8").partition("\n")[0] for script in EXAMPLES]
    assert len(set(titles)) == len(titles) > 20


def test_every_page_is_in_a_section():
    made = ("_build", "_templates", "gallery", "api")
    pages = {
        str(path.relative_to(DOCS).with_suffix(""))
        for path in (*DOCS.rglob("*.md"), *DOCS.rglob("*.rst"))
        if not set(made) & set(path.relative_to(DOCS).parts)
    }
    listed = re.findall(r"(?:root|file): (\S+)", (DOCS / "_toc.yml").read_text(encoding="utf-8"))
    assert len(pages) > 20
    assert sorted(listed) == sorted(pages | {"gallery/index"})


@pytest.mark.parametrize("extension", ["contents", "names", "samples"])
def test_examples_in_the_extensions_hold(extension):
    if extension in ("contents", "names"):
        pytest.importorskip("sphinx", reason="with the extra [docs]")
    outcome = doctest.testmod(import_module(extension))
    assert (outcome.failed, outcome.attempted > 0) == (0, True)


def test_page_of_json_has_every_command_that_prints_it():
    from samples import COMMANDS, commands, help_of

    printing = {" ".join(words) for words in commands() if "--json" in help_of(words)}
    shown = {
        word for word in printing for line in COMMANDS if f"{line} ".startswith(f"carom {word} ")
    }
    assert {word for word in printing - shown if word.split()[-1] not in APART} == set()
    assert len(shown) == len(COMMANDS)


def test_first_uses_of_symbols_and_terms_lead_to_the_glossary():
    """Those on a page, once; not in titles and code; the longest term that is there."""
    pytest.importorskip("sphinx")
    from types import SimpleNamespace

    from docutils import nodes
    from docutils.core import publish_doctree
    from glossary_links import SYMBOLS, link, terms

    text = (
        "Gross slip\n==========\n\nTwo gross slips, ``regime``, :math:`\\psi_1`.\n\n"
        "Regimes of gross slip, :math:`\\psi_2`, :math:`2 \\chi`.\n"
    )
    page = publish_doctree(text)
    link(page, "g.html", SimpleNamespace(srcdir=DOCS))
    assert [(one.astext(), one["refuri"]) for one in page.findall(nodes.reference)] == [
        ("gross slips", "g.html#term-gross-slip"),
        (r"\psi_1", "g.html#direction-psi"),
        ("Regimes", "g.html#term-regime"),
        (r"2 \chi", "g.html#inertia-chi"),
    ]
    glossary = (DOCS / "glossary.md").read_text(encoding="utf-8")
    assert len(terms(glossary)) > 15
    heads = re.findall(r"(?m)^## (\w+): \$\\(\w+)\$", glossary)
    assert {f"{word}-{symbol}".lower() for word, symbol in heads} == set(SYMBOLS.values())
