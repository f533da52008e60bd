"""Names of version 0.2: each works for this version, with one warning that gives the new name."""

from collections.abc import Callable, Container
from importlib import import_module
from typing import Any, TypeVar
from warnings import warn

LAWS_OF_CODES = (
    *("EdemHertzMindlin", "FunctionLaw", "FunctionRebound", "HardSphere", "HertzLinearHistory"),
    *("LammpsMindlin", "LiggghtsHertz", "LinearSpring", "StrongeLaw", "ThorntonLaw"),
    *("WaltonBraunLaw", "YadeMindlin"),
)
REBOUND_LAWS = ("ReboundLaw", "RoughLaw", "SmoothLaw", "WaltonLaw", "fit_walton")
RESULTS = ("Collisions", "Fit", "HalfspaceImpact", "Impact", "JudgedCollisions", "LoadPath")
STATUSES = ("CollisionStatus", "Judgement", "PointStatus", "Status")

NEW_NAMES = {
    **{f"carom.{name}": f"carom.dem.{name}" for name in LAWS_OF_CODES},
    **{f"carom.{name}": f"carom.laws.{name}" for name in REBOUND_LAWS},
    **{f"carom.{name}": f"carom.results.{name}" for name in (*RESULTS, "Solution", "WaltonFit")},
    **{f"carom.{name}": f"carom.status.{name}" for name in STATUSES},
    "carom.MemoryLaw": "carom.dem.ExactContactLaw",
    "carom.convert": "carom.convert_observables",
    "carom.strength": "carom.bearable_speeds",
    "carom.wear": "carom.wear_of_many",
    "carom.verify.damping": "carom.verify.damping_from_restitution",
    "carom.verify.restitution": "carom.verify.restitution_from_damping",
}
FINDERS: dict[str, Callable[[], Any]] = {  # of what a name alone no longer gives
    "carom.MixtureLaw": lambda: lambda low, high: _get("carom.laws.ReboundLaw")((low, high)),
    "carom.material_sources": lambda: lambda name: dict(_get("carom.material")(name).sources),
    "carom.verify.CATALOGUE": lambda: _get("carom.verify.catalogue")(),
}
NEW_PLACES = {
    **NEW_NAMES,
    "carom.MixtureLaw": "carom.laws.ReboundLaw((low, high))",
    "carom.material_sources": "carom.material(name).sources",
    "carom.verify.CATALOGUE": "carom.verify.catalogue()",
}
OLD_KEYWORDS = {"time": "at", "step": "at", "psi": "psi_1"}
OLD_FIELDS = {"psi": "psi_in", "told": "label"}

Record = TypeVar("Record")


def _get(path: str) -> Any:
    home, _, name = path.rpartition(".")
    return getattr(import_module(home), name)


def old_value(path: str) -> Any:
    """Return what a name of version 0.2 stands for, with a warning that gives the new name."""
    _warn(path, NEW_PLACES[path], stacklevel=4)
    return FINDERS[path]() if path in FINDERS else _get(NEW_NAMES[path])


def with_old_fields(record: type[Record]) -> type[Record]:
    """Let the fields of a record be read by their names of version 0.2, too."""

    def __getattr__(self: Record, name: str) -> Any:
        new = OLD_FIELDS.get(name)
        if new is None or not (hasattr(record, new) or new in record.__annotations__):
            raise AttributeError(f"{record.__name__} has no attribute {name!r}")
        _warn(f"{record.__name__}.{name}", new)
        return getattr(self, new)

    record.__getattr__ = __getattr__  # type: ignore[attr-defined]
    return record


def renamed(name: str, function: str, keywords: Container[str]) -> str:
    """Return the name of a keyword now, with a warning if it is one of version 0.2."""
    new = OLD_KEYWORDS.get(name, name)
    if name in keywords or new not in keywords:
        return name
    _warn(f"{name}=, a keyword of {function},", f"{new}=", stacklevel=4)
    return new


def _warn(old: str, new: str, stacklevel: int = 3) -> None:
    words = f"{old} is now {new}; the old name is gone from 0.4 on"
    warn(words, DeprecationWarning, stacklevel)
