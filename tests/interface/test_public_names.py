"""What users import: each public name once, in the stub of its package, and nothing else shown."""

import inspect
import re
import subprocess
import sys
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import get_args

import pytest

import carom
from carom.names import GROUPS
from carom.quantities.glossary import GLOSSARY

BESIDE = {"carom": ["__version__"], "carom.plots": ["style"]}  # known to dir() alone
MODULES = (*GROUPS, "carom.plots.style")
REFERENCE = Path(__file__).parents[2] / "docs/reference"


def shown(thing):
    return [name for name in dir(thing) if not name.startswith("_")]


@pytest.mark.parametrize("package", GROUPS)
def test_dir_shows_the_public_names_and_nothing_else(package):
    module = import_module(package)
    assert sorted(dir(module)) == sorted([*module.__all__, *BESIDE.get(package, [])])
    assert all(getattr(module, name) is not None for name in dir(module))


@pytest.mark.parametrize("package", GROUPS)
def test_editors_see_each_name_as_it_is_called(package):
    stub = import_module(package).__file__ + "i"
    with open(stub, encoding="utf-8") as file:
        pairs = re.findall(r"(\w+) as (\w+)", file.read())
    names = [name for name, _ in pairs]
    assert all(name == shown for name, shown in pairs)
    assert sorted(names) == sorted(dir(import_module(package)))


def listed(package):
    """Return the names that the pages of the reference list of a module."""
    names = set()
    for page in REFERENCE.glob("*.rst"):
        parts = re.split(r"\.\. currentmodule:: (.*)\n", page.read_text(encoding="utf-8"))
        for module, text in zip(parts[1::2], parts[2::2], strict=True):
            names |= set(re.findall(r"(?m)^   (\w+)$", text)) if module == package else set()
    return names


@pytest.mark.parametrize("package", MODULES)
def test_the_reference_lists_what_dir_shows(package):
    module = import_module(package)
    things = {name: getattr(module, name) for name in shown(module)}
    modules = {name for name, thing in things.items() if inspect.ismodule(thing)}
    constants = {name for name in things if name.isupper()}
    assert listed(package) == set(things) - modules - constants
    assert {f"{package}.{name}" for name in modules} <= set(MODULES)
    assert all(inspect.getdoc(thing) for name, thing in things.items() if name not in constants)
    page = (REFERENCE / "figures.rst").read_text(encoding="utf-8")
    assert all(f"`{name}`" in page for name in constants)


def classes(annotation, module):
    """Yield the classes of Carom in an annotation; those of boundary elements are their own."""
    if isinstance(annotation, str):
        try:
            annotation = eval(annotation, dict(vars(sys.modules[module])))
        except NameError:  # for type checkers alone
            return
    home = annotation.__module__ if inspect.isclass(annotation) else ""
    if re.match(r"carom(?!\.halfspace)", home) and not hasattr(annotation, "_is_protocol"):
        yield annotation
    for part in get_args(annotation):
        yield from classes(part, module)


def given_by(thing):
    """Yield the classes that a function returns, or a class holds or its methods return."""
    functions = [inspect.unwrap(thing)] if inspect.isfunction(thing) else []
    for base in getattr(thing, "__mro__", ()):
        public = [(n, member) for n, member in vars(base).items() if not n.startswith("_")]
        for name, annotation in inspect.get_annotations(base).items():
            yield from () if name.startswith("_") else classes(annotation, base.__module__)
        inner = [getattr(one, "fget", getattr(one, "func", one)) for _, one in public]
        functions += [inspect.unwrap(one) for one in inner if inspect.isfunction(one)]
    for function in functions:
        returned = inspect.get_annotations(function).get("return")
        yield from classes(returned, function.__module__)


def reachable():
    """Return the classes that users make or get, by whatever way."""
    found, todo = [], [getattr(import_module(g), n) for g in GROUPS for n in dir(import_module(g))]
    while todo:
        thing = todo.pop()
        if thing not in found and (inspect.isclass(thing) or inspect.isfunction(thing)):
            found.append(thing)
            todo += given_by(thing)
    return sorted({thing for thing in found if inspect.isclass(thing)}, key=str)


CLASSES = reachable()


def test_what_users_get_is_found():
    names = {cls.__name__ for cls in CLASSES}
    assert names >= {"Impact", "Validity", "Contact", "UserTable", "Memory", "Standing", "LossFit"}


@pytest.mark.first_case
@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: f"{cls.__module__}.{cls.__name__}")
def test_what_dir_shows_of_a_class_is_documented(cls):
    """By a docstring of its own, by the class's, or as a quantity of the glossary."""
    own = [base for base in cls.__mro__ if base.__module__.startswith("carom")]
    others = {name for base in cls.__mro__ if base not in own for name in dir(base)}
    text = "\n".join((base.__doc__ or "").split("Examples\n")[0] for base in own)
    fields = {n for n in getattr(cls, "__dataclass_fields__", {}) if not n.startswith("_")}
    for name in {*shown(cls), *fields} - others:
        member = inspect.getattr_static(cls, name, None)
        if isinstance(member, (cls, property, cached_property, classmethod)):
            assert inspect.getdoc(member), name
        elif inspect.isfunction(member):
            assert inspect.getdoc(getattr(cls, name)), name
        else:
            words = rf"(?i)\b({name}|{name.replace('_', ' ')})\b"
            assert name in GLOSSARY or re.search(words, text), name


LINES = [
    "from carom.datasets import load; load('kharaz2001')",
    "import carom.classical; carom.classical.Obliquity(0.1, 0.2)",
    "from carom.verify import bench; assert callable(bench)",
    "import carom.verify.benchmark; assert callable(carom.verify.bench)",
    "from carom import plots; assert callable(plots.plot_curve)",
    "import carom; carom.plots.style.style()",
]
FORKS = """
import os, sys
import matplotlib.figure, numpy, pandas, pint, scipy.optimize, xarray
for line in sys.argv[1:]:
    if os.fork() == 0:
        exec(line)
        break
    assert os.wait()[1] == 0, line
"""


@pytest.mark.slow
def test_names_are_where_users_import_them():
    """Each in a process of its own: what was imported of Carom before must not matter."""
    subprocess.run([sys.executable, "-c", FORKS, *LINES], check=True)


@pytest.mark.parametrize(
    ("path", "hint"),
    [
        ("carom.Spehre", "did you mean carom.Sphere?"),
        ("carom.plot_curve", "it is carom.plots.plot_curve"),
        ("carom.dem.Reboundlaw", "did you mean carom.laws.ReboundLaw?"),
        ("carom.dem.ReboundLaw", "it is carom.laws.ReboundLaw"),
        ("carom.datasets.laod", "did you mean carom.datasets.load?"),
        ("carom.classical.cattaneo", "did you mean carom.classical.cattaneo_mindlin?"),
        ("carom.results.Sphere", "it is carom.Sphere"),
        ("carom.status.xyzzy", "dir(carom.status) lists its names"),
    ],
)
def test_a_name_that_is_none_is_told_where_it_is(path, hint):
    package, _, name = path.rpartition(".")
    with pytest.raises(AttributeError) as refused:
        getattr(import_module(package), name)
    assert str(refused.value) == f"{package} has no {name}; {hint}"


@pytest.mark.parametrize("group", ["results", "status", "classical"])
def test_a_group_leaves_no_name_elsewhere(group, monkeypatch):
    home = getattr(carom, group)
    name = home.__all__[0]
    for place in (carom, home):
        monkeypatch.delitem(vars(place), name, raising=False)
    assert getattr(home, name)
    assert name not in vars(carom)


def test_the_package_does_not_fetch_its_own_names_lazily():
    """What `from carom import dem` leads to import-linter does not see; commands are above all."""
    package = Path(carom.__file__).parent
    files = [path for path in package.rglob("*.py") if "cli" not in path.parts]
    lazy = [
        path for path in files if re.search(r"(?m)^ *(from carom )?import carom$", path.read_text())
    ]
    lazy += [path for path in files if re.search(r"(?m)^ *from carom import ", path.read_text())]
    assert not lazy
