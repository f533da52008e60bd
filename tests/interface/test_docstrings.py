"""The docstrings of all that is public: what they say is there, in the sections of numpydoc."""

import inspect
import re
from enum import EnumType
from functools import cached_property

import pytest

import carom
import carom.classical
import carom.datasets
import carom.fitting
import carom.impacts.curves
import carom.plots
import carom.plots.style
import carom.verify
from carom.quantities.glossary import GLOSSARY

SECTIONS = ("Parameters", "Attributes", "Returns", "Raises", "Notes", "Examples")
MODULES = (carom, carom.verify, carom.plots, carom.fitting, carom.classical, carom.datasets)
BESIDE = {  # what users find in a module without a list of its own
    carom.impacts.curves: ("borders",),
    carom.plots.style: ("new_figure", "style"),
}
MADE = {  # by functions, which say what is in them
    *("Bench", "Collisions", "Estimate", "Fit", "HalfspaceImpact", "Impact", "LoadPath"),
    *("Obliquity", "Ranking", "Score", "Solution", "Tuning", "WaltonFit"),
}
WITHOUT_EXAMPLE = {"InputError", "EngineError", "Bench"}  # the last needs a program to be run
INNER = {  # what the parts of Carom say to each other
    *("coefficients", "command", "coords", "describe", "description", "executable", "files"),
    *("inputs", "loss", "outcomes", "rule", "scale_free", "supports", "version"),
}
NEVER_REFUSE = {
    *("CATALOGUE", "Entry", "names", "materials", "ThorntonLaw", "Lammps", "Liggghts", "Yade"),
    *("Pair.contact_scales", "Pair.psi", "Pair.scales", "Solution.phase_at"),
    *("Solution.slip_angles", "verify.Tuning.best", "Fit.cite"),
    *("curves.borders", "plots.style.new_figure"),
}
SOURCED = [  # what implements a formula of others
    *("BoundaryElements", "ElasticPlastic", "HalfspaceImpact", "HertzLinearHistory", "Impact"),
    *("KelvinVoigt", "LammpsMindlin", "LinearSpring", "LoadPath", "MixtureLaw", "Pair"),
    *("ReboundLaw", "RoughLaw", "Solution", "StrongeLaw", "ThorntonLaw", "WaltonBraunLaw"),
    *("WaltonLaw", "collide", "convert", "curve", "curves.borders", "fit", "fit_walton", "impact"),
    *("load_path", "rebound", "regime_map", "solve", "sweep"),
    *("Fit.advice", "Fit.posterior", "Impact.fields"),
    *("Impact.stress", "Pair.contact_scales", "Pair.scales", "Pair.lateral_ratio"),
    *("Solution.traction", "Solution.slip_angles", "classical.cattaneo_mindlin"),
    *("classical.critical_obliquity", "classical.loop_energy", "verify.damping"),
    *("verify.error_map", "verify.poisson_from_kappa", "verify.score", "verify.stiffnesses"),
]
WORKS = re.compile(r"[A-Z]\w+[^.;]*\b(18|19|20)\d\d\b", re.S)  # an author and a year


def functions(cls):
    """Yield the public methods and properties that a class of Carom has, by name."""
    for name, member in inspect.getmembers_static(cls):
        homes = [base for base in cls.__mro__ if name in vars(base)]
        if name.startswith("_") or not homes or not homes[0].__module__.startswith("carom"):
            continue
        if isinstance(member, property):
            yield name, member.fget
        elif isinstance(member, cached_property):
            yield name, member.func
        elif isinstance(member, classmethod | staticmethod):
            yield name, member.__func__
        elif inspect.isfunction(member):
            yield name, member


def public():
    """Return all that users call, by its name as they write it."""
    found = {}
    for module in (*MODULES, *BESIDE):
        here = BESIDE.get(module) or [
            name
            for name, value in vars(module).items()
            if inspect.isroutine(value) or inspect.isclass(value)
            if value.__module__ == module.__name__
        ]
        prefix = module.__name__.removeprefix("carom").lstrip(".")
        for name in getattr(module, "__all__", here):
            value = getattr(module, name)
            label = f"{prefix}.{name}".lstrip(".")
            if name.startswith("_") or not callable(value):
                continue
            found[label] = value
            if inspect.isclass(value) and not isinstance(value, EnumType):
                for member, function in functions(value):  # what is inherited counts once
                    if function not in found.values():
                        found[f"{label}.{member}"] = function
    return found


PUBLIC = public()


def is_property(label):
    owner, _, name = label.rpartition(".")
    cls = PUBLIC.get(owner)
    return inspect.isclass(cls) and isinstance(
        inspect.getattr_static(cls, name), property | cached_property
    )


PROPERTIES = [label for label in PUBLIC if is_property(label)]
DIMENSIONLESS = ("ReboundLaw", "Solution")
UNITS = {"curvature": "1/m", "mass": "kg", "shear_modulus": "Pa", "time_step": "s"}
KNOWN = {entry.unit for entry in GLOSSARY.values()} | set(UNITS.values())


def short(label):
    return label.rpartition(".")[2]


def parameters(label):
    """Return the parameters that a user gives."""
    value = PUBLIC[label]
    owner, _, name = label.rpartition(".")
    if label in PROPERTIES or (inspect.isclass(PUBLIC.get(owner)) and name in INNER):
        return []
    if inspect.isclass(value) and (
        short(label) in MADE or isinstance(value, EnumType) or issubclass(value, Exception)
    ):
        return []
    named = inspect.signature(value).parameters.values()
    return [
        one.name
        for one in named
        if one.name not in ("self", "cls") and one.kind is not one.VAR_KEYWORD
    ]


def sections(text):
    """Return the parts of a docstring by heading; what is before the first is ""."""
    lines, parts, name = text.split("\n"), {"": []}, ""
    for line, below in zip(lines, [*lines[1:], ""], strict=True):
        if re.fullmatch("-{3,}", below.strip()) and line.strip():
            name = line
            assert below == "-" * len(line), f"the line below {line} is not as long"
            parts[name] = []
        elif not re.fullmatch("-{3,}", line.strip()):
            parts[name].append(line)
    return parts


def documented(label):
    return sections(inspect.getdoc(PUBLIC[label]) or "")


CALLED = [label for label in PUBLIC if label not in PROPERTIES]
ASKED = [label for label in CALLED if parameters(label)]


def test_what_is_public_is_found():
    """The lists of this file hold nothing that is not there."""
    assert {"impact", "Impact.stress", "verify.rank", "plots.plot_cone", "Pair.chi"} <= set(PUBLIC)
    assert {"Pair.chi", "Fit.friction"} <= set(PROPERTIES)
    assert "Impact.stress" not in PROPERTIES
    last = {short(label) for label in PUBLIC}
    assert last >= INNER | MADE | WITHOUT_EXAMPLE
    assert set(PUBLIC) >= set(SOURCED)
    assert {*last, *PUBLIC, "CATALOGUE"} >= NEVER_REFUSE


@pytest.mark.parametrize("label", PUBLIC)
def test_it_begins_with_one_sentence(label):
    text = inspect.getdoc(PUBLIC[label])
    assert text, "no docstring"
    first, _, rest = text.partition("\n")
    assert first.endswith(".")
    assert len(first) <= 96
    assert first[0].isupper() or not first[0].isalpha() or "_" in first.split()[0]
    assert not rest or rest.startswith("\n"), "an empty line comes next"


@pytest.mark.parametrize("label", PUBLIC)
def test_sections_are_those_of_numpydoc_in_order(label):
    names = [name for name in documented(label) if name]
    assert names == [name for name in SECTIONS if name in names]
    for name, lines in documented(label).items():
        entries = [line for line in lines if line and not line.startswith(" ")]
        if name in ("Parameters", "Attributes"):
            assert all(re.match(r"^[\w, ]+ : \S", entry) for entry in entries), entries
        if name == "Raises":
            assert all(re.fullmatch(r"\w+", entry) for entry in entries), entries


@pytest.mark.parametrize("label", ASKED)
def test_every_parameter_is_described_in_order(label):
    lines = documented(label).get("Parameters", [])
    heads = [line.partition(" :")[0] for line in lines if line and not line.startswith(" ")]
    assert [name.strip() for head in heads for name in head.split(",")] == parameters(label)


@pytest.mark.parametrize("label", [name for name in ASKED if not inspect.isclass(PUBLIC[name])])
def test_what_comes_back_is_told(label):
    assert documented(label).get("Returns"), "no section Returns"


@pytest.mark.parametrize(
    "label", [name for name in ASKED if {name, short(name)}.isdisjoint(NEVER_REFUSE)]
)
def test_what_is_raised_is_told(label):
    assert documented(label).get("Raises"), "no section Raises"


@pytest.mark.parametrize(
    "label",
    [
        name
        for name in CALLED
        if short(name) not in WITHOUT_EXAMPLE
        and (name in ASKED or not PUBLIC[name].__qualname__.count("."))
    ],
)
def test_there_is_an_example(label):
    """`test_doctests` runs them; methods that take nothing may go without."""
    assert any(line.startswith(">>> ") for line in documented(label).get("Examples", []))


@pytest.mark.parametrize("label", SOURCED)
def test_a_formula_has_a_source(label):
    assert WORKS.search(inspect.getdoc(PUBLIC[label]))


QUANTITIES = [
    label
    for label in PROPERTIES
    if PUBLIC[label].__annotations__.get("return") in (float, "float")
    and not label.startswith(DIMENSIONLESS)
]


@pytest.mark.parametrize("label", QUANTITIES)
def test_a_quantity_tells_its_unit(label):
    """That of the glossary; what is in neither is a pure number."""
    name, text = short(label), inspect.getdoc(PUBLIC[label])
    unit = GLOSSARY[name].unit if name in GLOSSARY else UNITS.get(name, "1")
    told = re.findall(r"\bin (N s|[A-Za-z1]+(?:/[a-z]+)?)(?=[\s,.;:]|$)", text)
    assert [one for one in told if one in KNOWN] == ([] if unit == "1" else [unit])
