"""Which contact law the programs of the discrete element method have."""

from collections.abc import Sequence
from typing import NamedTuple

from carom import dem
from carom.dem.base import Law
from carom.quantities.refusals import nearest, refusal
from carom.verify.errors import as_law


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
    >>> import carom
    >>> stiff = carom.verify.Entry("stiff", carom.dem.LinearSpring(1.0), "nobody")
    >>> carom.verify.rank([stiff], psi=[1.0]).standings[0].entry.label
    'stiff'
    """

    label: str
    law: Law
    used_by: str


EXACT = "exact, 32 springs"
SHORT = {"carom": EXACT}  # as its styles in LAMMPS are called

CATALOGUE = (
    Entry("linear spring, k_t/k_n = kappa", dem.LinearSpring(), "any code with this ratio"),
    Entry(
        "linear spring, k_t/k_n = 2/7", dem.LinearSpring(2.0 / 7.0), "LAMMPS gran/hooke by default"
    ),
    Entry("linear spring, k_t/k_n = 1", dem.LinearSpring(1.0), "LIGGGHTS hooke"),
    Entry("Hertz, linear history", dem.HertzLinearHistory(), "LAMMPS hertz, linear_history"),
    Entry("mindlin", dem.LammpsMindlin("mindlin"), "LAMMPS; MFiX Hertz"),
    Entry("mindlin/force", dem.LammpsMindlin("mindlin/force"), "LAMMPS"),
    Entry("mindlin_rescale", dem.LammpsMindlin("mindlin_rescale"), "LAMMPS"),
    Entry(
        "mindlin_rescale/force", dem.LammpsMindlin("mindlin_rescale/force"), "LAMMPS; Kratos Hertz"
    ),
    Entry("mindlin, 2/3 of the stiffness", dem.LammpsMindlin(stiffness=2.0 / 3.0), "MercuryDPM"),
    Entry("LIGGGHTS hertz, history", dem.LiggghtsHertz(), "LIGGGHTS"),
    Entry("EDEM Hertz-Mindlin (no slip)", dem.EdemHertzMindlin(), "EDEM"),
    Entry("YADE Mindlin", dem.YadeMindlin(), "YADE"),
    Entry("Thornton, incremental", dem.ThorntonLaw(), "Mindlin & Deresiewicz in increments"),
    Entry("Walton & Braun", dem.WaltonBraunLaw(), "softening spring, K_0/K_1 = kappa"),
    Entry("Stronge, bilinear", dem.StrongeLaw(), "bilinear compliance, k_t/k_n = kappa"),
    Entry("Walton's hard spheres, 0.4", dem.HardSphere(0.4), "event-driven codes, beta_0 = 0.4"),
    Entry("rigid Coulomb", dem.HardSphere(), "impulse-based codes"),
    Entry(EXACT, dem.ExactContactLaw(32), "LAMMPS, with pair_style carom; any code"),
)


def catalogue() -> tuple[Entry, ...]:
    """Return the contact laws that programs have, each with its parameters and its programs.

    Returns
    -------
    tuple of Entry
        In the order of the tables.

    Examples
    --------
    >>> import carom
    >>> carom.verify.catalogue()[0].label
    'linear spring, k_t/k_n = kappa'
    """
    return CATALOGUE


def called(law: Law) -> str:
    """Return what a law is called, its variant included."""
    return str(getattr(law, "variant", law.name))


def as_entry(given: object) -> Entry:
    """Return an entry as it is, or one for a law; raise InputError for anything else."""
    if isinstance(given, Entry):
        return given._replace(law=as_law(given.law))
    law = as_law(given)
    return Entry(called(law), law, "")


def named(label: str | None) -> Sequence[Entry]:
    """Return the entry with this label, all without one; InputError offers the nearest."""
    if label is None:
        return CATALOGUE
    found = [entry for entry in CATALOGUE if entry.label == SHORT.get(label, label)]
    if not found:
        labels = [entry.label for entry in CATALOGUE]
        alike = [text for text in labels if label.lower() in text.lower()] or labels
        hint = nearest(label, labels) if len(alike) == len(labels) else ""
        raise refusal("law", label, hint or f"must be one of: {'; '.join(alike)}")
    return found
