"""Carom: how an elastic sphere leaves an oblique impact, and what happens inside the contact.

Names are loaded when they are first used, so that `import carom` costs nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from carom.lazy import loader

if TYPE_CHECKING:
    from carom import classical, datasets, plots, verify
    from carom.bodies import (
        Cup,
        HalfSpace,
        Material,
        Sphere,
        material,
        material_sources,
        materials,
    )
    from carom.collisions import Collisions, CollisionStatus, collide
    from carom.curves import curve, regime_map
    from carom.dimensionless.phases import Status
    from carom.dimensionless.rebounds import rebound
    from carom.dimensionless.solution import Solution, solve
    from carom.exact_impacts import Impact
    from carom.fitting import Fit, fit
    from carom.halfspace_impacts import BoundaryElements, HalfspaceImpact
    from carom.impacts import impact
    from carom.laws.dem import (
        EdemHertzMindlin,
        HardSphere,
        HertzLinearHistory,
        LammpsMindlin,
        LiggghtsHertz,
        LinearSpring,
        StrongeLaw,
        ThorntonLaw,
        WaltonBraunLaw,
        YadeMindlin,
    )
    from carom.laws.exact import ReboundLaw
    from carom.laws.fitting import WaltonFit, fit_walton
    from carom.laws.mixture import MixtureLaw
    from carom.laws.rigid import RoughLaw, SmoothLaw, WaltonLaw
    from carom.loading import LoadPath, load_path
    from carom.normals import ElasticPlastic, KelvinVoigt
    from carom.observables import convert
    from carom.pairs import Pair
    from carom.quantities import InputError
    from carom.storage import read, save
    from carom.sweeps import sweep
    from carom.sweeps.designs import Grid, LatinHypercube, Table
    from carom.sweeps.evaluation import PointStatus

_HOMES = {
    "carom.bodies": (
        "Cup",
        "HalfSpace",
        "Material",
        "Sphere",
        "material",
        "material_sources",
        "materials",
    ),
    "carom.collisions": ("CollisionStatus", "Collisions", "collide"),
    "carom.curves": ("curve", "regime_map"),
    "carom.laws.dem": (
        "EdemHertzMindlin",
        "HardSphere",
        "HertzLinearHistory",
        "LammpsMindlin",
        "LiggghtsHertz",
        "LinearSpring",
        "StrongeLaw",
        "ThorntonLaw",
        "WaltonBraunLaw",
        "YadeMindlin",
    ),
    "carom.laws.exact": ("ReboundLaw",),
    "carom.laws.fitting": ("WaltonFit", "fit_walton"),
    "carom.laws.mixture": ("MixtureLaw",),
    "carom.laws.rigid": ("RoughLaw", "SmoothLaw", "WaltonLaw"),
    "carom.pairs": ("Pair",),
    "carom.quantities": ("InputError",),
    "carom.halfspace_impacts": ("BoundaryElements", "HalfspaceImpact"),
    "carom.exact_impacts": ("Impact",),
    "carom.impacts": ("impact",),
    "carom.loading": ("LoadPath", "load_path"),
    "carom.normals": ("ElasticPlastic", "KelvinVoigt"),
    "carom.observables": ("convert",),
    "carom.fitting": ("Fit", "fit"),
    "carom.storage": ("read", "save"),
    "carom.sweeps": ("sweep",),
    "carom.sweeps.designs": ("Grid", "LatinHypercube", "Table"),
    "carom.sweeps.evaluation": ("PointStatus",),
    "carom.dimensionless.phases": ("Status",),
    "carom.dimensionless.rebounds": ("rebound",),
    "carom.dimensionless.solution": ("Solution", "solve"),
}
_MODULES = ("classical", "datasets", "plots", "verify")
_named = loader(__name__, _HOMES)

__all__ = [
    "BoundaryElements",
    "CollisionStatus",
    "Collisions",
    "Cup",
    "EdemHertzMindlin",
    "ElasticPlastic",
    "Fit",
    "Grid",
    "HalfSpace",
    "HalfspaceImpact",
    "HardSphere",
    "HertzLinearHistory",
    "Impact",
    "InputError",
    "KelvinVoigt",
    "LammpsMindlin",
    "LatinHypercube",
    "LiggghtsHertz",
    "LinearSpring",
    "LoadPath",
    "Material",
    "MixtureLaw",
    "Pair",
    "PointStatus",
    "ReboundLaw",
    "RoughLaw",
    "SmoothLaw",
    "Solution",
    "Sphere",
    "Status",
    "StrongeLaw",
    "Table",
    "ThorntonLaw",
    "WaltonBraunLaw",
    "WaltonFit",
    "WaltonLaw",
    "YadeMindlin",
    "classical",
    "collide",
    "convert",
    "curve",
    "datasets",
    "fit",
    "fit_walton",
    "impact",
    "load_path",
    "material",
    "material_sources",
    "materials",
    "plots",
    "read",
    "rebound",
    "regime_map",
    "save",
    "solve",
    "sweep",
    "verify",
]


def __getattr__(name: str) -> object:
    if name == "__version__":
        from carom.results import carom_version

        return carom_version()
    if name in _MODULES:
        return import_module(f"carom.{name}")
    return _named(name)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
