"""The docstrings of all that is public: what they say is there, in the sections of numpydoc.

numpydoc's own validation sees to sections, their order, and parameters against the signature;
ruff's pydocstyle rules see to style. Here is what neither can: that refusals and examples are told
where there are some, that formulas have a source, and that quantities have their unit.
"""

import inspect
import re
import sys
from enum import Enum
from functools import cached_property
from importlib import import_module
from pathlib import Path
from pkgutil import resolve_name

import pytest
from numpydoc.docscrape import NumpyDocString
from numpydoc.validate import validate

import carom
import carom.lab.fitting
from carom.quantities.glossary import GLOSSARY

DOCS = Path(__file__).parents[2] / "docs"
sys.path.insert(0, str(DOCS / "_ext"))
convert = import_module("formulas").convert
GREEK = "alpha|beta|chi|delta|epsilon|eta|gamma|kappa|mu|nu|omega|phi|psi|rho|sigma|tau|theta"
PLAIN = re.compile(  # formulas that are not set as such
    rf"\b(?:{GREEK})\b(?:_\w+)?|\b(?:{GREEK})_\w+\b|\b[A-Za-z]{{1,2}}_(?:\w|max|min|in|out)\b"
    r"|\b(?:sqrt|exp|sin|cos|tan)\(|[\w)]\^[\d({-]|\b[EGR]\*"
)
NO_PROSE = (  # mathematics, code, heads of parameters, texts that a user gives
    r"(?m)^ *>>> .*(?:\n.+)*",
    r"(?m)^ *\.\. math::\n\n(?: *\n| {3,}.*\n)*",
    r":math:`[^`]*`",
    r"(`+)[^`]+\1",
    r"(?m)^[\w*]+(?:, [\w*]+)* : .*$",
    r"\"[^\"\n]*\"",
)
MODULES = (carom, *filter(inspect.ismodule, (getattr(carom, name) for name in carom.__all__)))
BESIDE = ("impacts.curves.borders", "plots.style.new_figure", "plots.style.style")
WAIVED = {
    *("ES01", "SA01"),  # what a summary tells in full, and what has no kin
    *("PR08", "RT04"),  # descriptions may go on where the name or the type ends
    "EX01",  # asked for below, with lines that run
}
ALSO = {
    "Pair.normal_mass": {"SS02"},  # a symbol comes first
    "Pair.tangential_mass": {"SS02"},
    "plots.style.new_figure": {"PR01"},  # what it hands on to matplotlib
    "plots.style.style": {"YD01"},  # `with` yields nothing
}
MADE = {  # by functions, which say what is in them
    *("Bench", "Collisions", "Contact", "ContactStep", "Estimate", "Fit", "HalfspaceImpact"),
    *("Impact", "JudgedCollisions", "LoadPath", "Obliquity", "Ranking", "Score", "Solution"),
    *(
        "AdhesiveImpact",
        "BodyImpact",
        "JointFit",
        "Tuning",
        "Validity",
        "ViscoelasticSolution",
        "WaltonFit",
    ),
}
WITHOUT_EXAMPLE = {"InputError", "EngineError", "Bench"}  # the last needs a program to be run
INNER = {  # what the parts of Carom say to each other
    *("command", "executable", "files", "inputs", "outcomes", "rule", "supports", "version"),
    *("contact_at", "friction_work", "pressed", "slip_rate", "touched"),
}
NEVER_REFUSE = {
    "gives_way",
    *("catalogue", "Entry", "names", "materials", "ThorntonLaw", "Lammps", "Liggghts", "Yade"),
    *(
        "Pair.contact_scales",
        "Pair.plate_give",
        "Pair.psi",
        "Pair.scales",
        "results.Solution.phase_at",
    ),
    *(
        "results.Solution.slip_angles",
        "verify.Tuning.best",
        "results.Fit.cite",
        "results.JointFit.cite",
    ),
    *("impacts.curves.borders", "plots.style.new_figure"),
}
FORMULAS = """
BoundaryElements ElasticPlastic KelvinVoigt StandardLinearSolid Pair Pair.contact_scales Pair.scales
Pair.lateral_ratio dem.HertzLinearHistory dem.LammpsMindlin dem.LinearSpring dem.StrongeLaw
dem.ThorntonLaw dem.WaltonBraunLaw laws.ReboundLaw laws.RoughLaw laws.WaltonLaw
laws.fit_walton results.HalfspaceImpact results.Impact results.BodyImpact.fields
results.BodyImpact.stress results.BodyImpact.wear results.LoadPath results.Solution
results.Solution.traction results.Solution.slip_angles results.Fit.advice results.Fit.posterior
collide convert_observables
curve impacts.curves.borders fit impact load_path rebound regime_map solve sweep wear_of_many
classical.adhesive_impact classical.cattaneo_mindlin classical.critical_obliquity
classical.loop_energy
verify.damping_from_restitution verify.error_map verify.poisson_from_kappa verify.score
verify.stiffnesses
"""
SOURCED = FORMULAS.split()  # what implements a formula of others
WORKS = re.compile(r"[A-Z]\w+[^.;]*\b(18|19|20)\d\d\b", re.S)  # an author and a year


def members(cls):
    """Yield the public methods and properties that a class of Carom has, by name."""
    for name, member in inspect.getmembers_static(cls):
        home = next((base for base in cls.__mro__ if name in vars(base)), object)
        if name.startswith("_") or not home.__module__.startswith("carom"):
            continue
        member = getattr(member, "__func__", member)  # of a class method
        if isinstance(member, property | cached_property) or inspect.isfunction(member):
            yield name, member


def public():
    """Return all that users call, each once, by its name as they write it after `carom.`."""
    names = [f"{module.__name__}.{name}" for module in MODULES for name in module.__all__]
    by_name = {}
    for label in (*(name.removeprefix("carom.") for name in names), *BESIDE):
        value = resolve_name(f"carom.{label}")
        if inspect.ismodule(value) or not callable(value) or value in by_name.values():
            continue
        by_name[label] = value
        if inspect.isclass(value) and not issubclass(value, Enum):
            for name, member in members(value):  # what is inherited counts once
                if member not in by_name.values():
                    by_name[f"{label}.{name}"] = member
    return by_name


PUBLIC = public()
PROPERTIES = [label for label in PUBLIC if isinstance(PUBLIC[label], property | cached_property)]
CALLED = [label for label in PUBLIC if label not in PROPERTIES]
DIMENSIONLESS = ("laws.ReboundLaw", "results.Solution")
UNITS = {
    **{"curvature": "1/m", "mass": "kg", "shear_modulus": "Pa", "time_step": "s"},
    **{"compressional_speed": "m/s", "echo_time": "s"},
}
KNOWN = {entry.unit for entry in GLOSSARY.values()} | set(UNITS.values())


def short(label):
    return label.rpartition(".")[2]


def is_asked(label):
    """Return whether a user calls it with something."""
    value, owner = PUBLIC[label], PUBLIC.get(label.rpartition(".")[0])
    if short(label) in (INNER if inspect.isclass(owner) else MADE):
        return False
    if inspect.isclass(value) and issubclass(value, Enum | Exception):
        return False
    return bool(set(inspect.signature(value).parameters) - {"self", "cls"})


ASKED = [label for label in CALLED if is_asked(label)]


def documented(label):
    return NumpyDocString(inspect.getdoc(PUBLIC[label]))


def written_at(label):
    """Return the full name under which the docstring stands: a method may inherit it."""
    owner, _, name = label.rpartition(".")
    if not inspect.isclass(PUBLIC.get(owner)):
        return f"carom.{label}"
    homes = (base for base in PUBLIC[owner].__mro__ if name in vars(base))
    home = next(base for base in homes if vars(base)[name].__doc__)
    return f"{home.__module__}.{home.__qualname__}.{name}"


def test_what_is_public_is_found():
    """The lists of this file hold nothing that is not there."""
    some = {"impact", "results.BodyImpact.stress", "verify.rank", "plots.plot_cone", "Pair.chi"}
    assert some <= set(PUBLIC)
    assert {"Pair.chi", "results.Fit.friction"} <= set(PROPERTIES)
    assert "results.BodyImpact.stress" not in PROPERTIES
    last = {short(label) for label in PUBLIC}
    assert last >= INNER | MADE | WITHOUT_EXAMPLE
    assert set(PUBLIC) >= {*SOURCED, *ALSO}
    assert {*last, *PUBLIC} >= NEVER_REFUSE


@pytest.mark.parametrize("label", PUBLIC)
def test_numpydoc_finds_no_fault(label):
    waived = WAIVED | ALSO.get(label, set())
    if label not in ASKED:
        waived |= {"PR01", "RT01"}
    faults = validate(written_at(label))["errors"]
    assert [said for code, said in faults if code not in waived] == []


@pytest.mark.parametrize("label", PUBLIC)
def test_attributes_have_a_type_and_errors_are_names(label):
    actual = documented(label)
    assert all(one.name and one.type for one in actual["Attributes"])
    assert all(re.fullmatch(r"\w+", one.type) for one in actual["Raises"])


REFUSING = [name for name in ASKED if {name, short(name)}.isdisjoint(NEVER_REFUSE)]


@pytest.mark.parametrize("label", REFUSING)
def test_what_is_raised_is_told(label):
    assert documented(label)["Raises"], "no section Raises"


def is_shown(label):
    """Return whether it has an example: methods that take nothing may go without."""
    inner = PUBLIC[label].__qualname__.count(".") > 0
    return short(label) not in WITHOUT_EXAMPLE and (label in ASKED or not inner)


@pytest.mark.parametrize("label", [*filter(is_shown, CALLED)])
def test_there_is_an_example(label):
    """`test_doctests` runs them."""
    assert any(line.startswith(">>> ") for line in documented(label)["Examples"])


@pytest.mark.parametrize("label", SOURCED)
def test_a_formula_has_a_source(label):
    assert WORKS.search(inspect.getdoc(PUBLIC[label]))


@pytest.mark.parametrize("label", PUBLIC)
def test_the_manual_shows_every_formula_as_mathematics(label):
    """What is left holds none in plain text; braces close, so that it can be typeset."""
    text = "\n".join(convert(inspect.getdoc(PUBLIC[label]).splitlines()))
    for tex in re.findall(r":math:`([^`]*)`", text):
        assert tex.count("{") == tex.count("}"), tex
    for pattern in NO_PROSE:
        text = re.sub(pattern, "", text)
    assert PLAIN.findall(text) == []


@pytest.mark.parametrize("label", PROPERTIES)
def test_no_colon_in_the_first_line_of_a_property(label):
    """The manual would take what stands before it for a type."""
    assert not re.search(r":(\s|$)", inspect.getdoc(PUBLIC[label]).splitlines()[0])


def is_quantity(label):
    """Return whether a property is one number with a unit."""
    member = PUBLIC[label]
    function = member.fget if isinstance(member, property) else member.func
    return function.__annotations__.get("return") in (float, "float")


QUANTITIES = [name for name in PROPERTIES if is_quantity(name)]


@pytest.mark.parametrize("label", [n for n in QUANTITIES if not n.startswith(DIMENSIONLESS)])
def test_a_quantity_tells_its_unit(label):
    """That of the glossary; what is in neither is a pure number."""
    name, text = short(label), inspect.getdoc(PUBLIC[label])
    unit = GLOSSARY[name].unit if name in GLOSSARY else UNITS.get(name, "1")
    matches = re.findall(r"\bin (N s|[A-Za-z1]+(?:/[a-z]+)?)(?=[\s,.;:]|$)", text)
    assert [one for one in matches if one in KNOWN] == ([] if unit == "1" else [unit])
