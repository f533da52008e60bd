"""Which contact law the programs of the discrete element method have."""

from collections.abc import Callable, Sequence
from dataclasses import fields
from typing import Any, NamedTuple

from carom.dem.function import FunctionLaw
from carom.dem.hard import HardSphere
from carom.dem.memory import ExactContactLaw
from carom.dem.springs import (
    EdemHertzMindlin,
    HertzLinearHistory,
    LammpsMindlin,
    LiggghtsHertz,
    LinearSpring,
    StrongeLaw,
    ThorntonLaw,
    WaltonBraunLaw,
    YadeMindlin,
)
from carom.dimensionless.law import Law
from carom.quantities.refusals import nearest, refusal, refuse

LawOrFunction = Law | Callable[..., Any]  # the latter as a `FunctionLaw` takes it
STORABLE = float | int | str | None  # parameters that a file can hold


class Entry(NamedTuple):
    """A law with its parameters, and the programs that use it.

    Parameters
    ----------
    label : str
        Name of the law in tables.
    law : Law
        A contact law, e.g. `carom.dem.LinearSpring()`.
    used_by : str
        Programs that use the law, in a few words.

    Examples
    --------
    >>> stiff = carom.verify.Entry("stiff", carom.dem.LinearSpring(1.0), "nobody")
    >>> carom.verify.rank([stiff], psi_1=[1.0]).standings[0].entry.label
    'stiff'
    """

    label: str
    law: Law
    used_by: str


EXACT = "exact, 16 springs"
OF_PLATE = "laws are compared with impacts on thick walls; take a ReboundLaw without ZenerPlate"
SHORT_NAMES = {"carom": EXACT}  # as its styles in LAMMPS are called

CATALOGUE = (
    Entry("linear spring, k_t/k_n = kappa", LinearSpring(), "any code with this ratio"),
    Entry("linear spring, k_t/k_n = 2/7", LinearSpring(2.0 / 7.0), "LAMMPS gran/hooke by default"),
    Entry("linear spring, k_t/k_n = 1", LinearSpring(1.0), "LIGGGHTS hooke"),
    Entry("Hertz, linear history", HertzLinearHistory(), "LAMMPS hertz, linear_history"),
    Entry("mindlin", LammpsMindlin("mindlin"), "LAMMPS; MFiX Hertz"),
    Entry("mindlin/force", LammpsMindlin("mindlin/force"), "LAMMPS"),
    Entry("mindlin_rescale", LammpsMindlin("mindlin_rescale"), "LAMMPS"),
    Entry("mindlin_rescale/force", LammpsMindlin("mindlin_rescale/force"), "LAMMPS; Kratos Hertz"),
    Entry("mindlin, 2/3 of the stiffness", LammpsMindlin(stiffness=2.0 / 3.0), "MercuryDPM"),
    Entry("LIGGGHTS hertz, history", LiggghtsHertz(), "LIGGGHTS"),
    Entry("EDEM Hertz-Mindlin (no slip)", EdemHertzMindlin(), "EDEM"),
    Entry("YADE Mindlin", YadeMindlin(), "YADE"),
    Entry("Thornton, incremental", ThorntonLaw(), "Mindlin & Deresiewicz in increments"),
    Entry("Walton & Braun", WaltonBraunLaw(), "softening spring, K_0/K_1 = kappa"),
    Entry("Stronge, bilinear", StrongeLaw(), "bilinear compliance, k_t/k_n = kappa"),
    Entry("Walton's hard spheres, 0.4", HardSphere(0.4), "event-driven codes, beta_0 = 0.4"),
    Entry("rigid Coulomb", HardSphere(), "impulse-based codes"),
    Entry(EXACT, ExactContactLaw(), "LAMMPS, with pair_style carom; any code"),
)


def catalogue() -> tuple[Entry, ...]:
    """Return the contact laws that programs have, each with its parameters and its programs.

    Examples
    --------
    >>> carom.verify.catalogue()[0].label
    'linear spring, k_t/k_n = kappa'
    """
    return CATALOGUE


def called(law: Law) -> str:
    """Return what a law is called, its variant included."""
    return str(getattr(law, "variant", law.name))


def is_function(value: object) -> bool:
    """Return whether something may be a contact law that is written as a Python function."""
    return callable(value) and not isinstance(value, type | Law)


def as_law(law: object) -> Law:
    """Return a law as it is, a function as a contact law, or raise InputError."""
    if isinstance(law, Law):
        refuse(getattr(law, "inelasticity", 0.0) > 0.0 and refusal("law", law, OF_PLATE))
        return law
    if callable(law) and is_function(law):
        return FunctionLaw(law)
    raise refusal("law", law, "must be a contact law, e.g. carom.dem.LinearSpring()")


def as_entry(item: object) -> Entry:
    """Return an entry as it is, or one for a law; raise InputError for anything else."""
    if isinstance(item, Entry):
        return item._replace(law=as_law(item.law))
    law = as_law(item)
    return Entry(called(law), law, "")


def listed(name: str, laws: Any) -> Sequence[Any]:
    """Return one law or a sequence of laws as a sequence, unchecked; InputError for none."""
    if isinstance(laws, Law) or is_function(laws):
        return [laws]
    if isinstance(laws, list | tuple) and laws:
        return laws
    raise refusal(name, laws, "give at least one law, e.g. [carom.dem.LinearSpring()]")


def damped(law: Law, restitution: float) -> Law:
    """Return a law with the damping for a restitution, or raise InputError if it has none."""
    if not hasattr(law, "restitution"):
        raise refusal("restitution", restitution, f"{law.name} has no damping; leave it out")
    return law._damped(restitution)


def parameters(law: Law) -> dict[str, float | str | None]:
    """Return the parameters of a law by name, those that are numbers or texts, without its name."""
    values = {item.name: getattr(law, item.name) for item in fields(law) if item.name != "name"}
    return {name: value for name, value in values.items() if isinstance(value, STORABLE)}


def named(label: str | None) -> Sequence[Entry]:
    """Return the entry with this label, all without one; InputError offers the nearest."""
    if label is None:
        return CATALOGUE
    entries = [entry for entry in CATALOGUE if entry.label == SHORT_NAMES.get(label, label)]
    if not entries:
        labels = [entry.label for entry in CATALOGUE]
        alike = [text for text in labels if label.lower() in text.lower()] or labels
        hint = nearest(label, labels) if len(alike) == len(labels) else ""
        raise refusal("law", label, hint or f"must be one of: {'; '.join(alike)}")
    return entries
