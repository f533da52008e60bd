from . import classical as classical, datasets as datasets, plots as plots, verify as verify
from .bodies.losses import (
    ElasticPlastic as ElasticPlastic,
    KelvinVoigt as KelvinVoigt,
    StandardLinearSolid as StandardLinearSolid,
)
from .bodies.materials import (
    Material as Material,
    material as material,
    material_sources as material_sources,
    materials as materials,
)
from .bodies.pairs import Pair as Pair
from .bodies.reading import read as read
from .bodies.shapes import Cup as Cup, HalfSpace as HalfSpace, Sphere as Sphere
from .collisions import (
    Collisions as Collisions,
    CollisionStatus as CollisionStatus,
    JudgedCollisions as JudgedCollisions,
    Judgement as Judgement,
    collide as collide,
)
from .contacts.load_paths import LoadPath as LoadPath, load_path as load_path
from .datasets.observables import convert as convert
from .dimensionless.elastic.phases import Status as Status
from .dimensionless.numerics.shared_library import (
    get_include as get_include,
    get_library as get_library,
)
from .dimensionless.rebounds import rebound as rebound
from .dimensionless.solution import Solution as Solution, solve as solve
from .fitting import Fit as Fit, fit as fit
from .impacts.boundary_elements import (
    BoundaryElements as BoundaryElements,
    HalfspaceImpact as HalfspaceImpact,
)
from .impacts.curves import curve as curve, regime_map as regime_map
from .impacts.exact import Impact as Impact
from .impacts.solve import impact as impact
from .io.files import save as save
from .io.version import __version__ as __version__
from .laws.dem import (
    EdemHertzMindlin as EdemHertzMindlin,
    FunctionLaw as FunctionLaw,
    FunctionRebound as FunctionRebound,
    HardSphere as HardSphere,
    HertzLinearHistory as HertzLinearHistory,
    LammpsMindlin as LammpsMindlin,
    LiggghtsHertz as LiggghtsHertz,
    LinearSpring as LinearSpring,
    MemoryLaw as MemoryLaw,
    StrongeLaw as StrongeLaw,
    ThorntonLaw as ThorntonLaw,
    WaltonBraunLaw as WaltonBraunLaw,
    YadeMindlin as YadeMindlin,
)
from .laws.exact import ReboundLaw as ReboundLaw
from .laws.mixture import MixtureLaw as MixtureLaw
from .laws.rigid import RoughLaw as RoughLaw, SmoothLaw as SmoothLaw, WaltonLaw as WaltonLaw
from .laws.walton_fit import WaltonFit as WaltonFit, fit_walton as fit_walton
from .quantities.refusals import InputError as InputError
from .sweeps import sweep as sweep
from .sweeps.designs import Grid as Grid, LatinHypercube as LatinHypercube
from .sweeps.points import PointStatus as PointStatus
from .sweeps.strength_map import strength as strength
from .sweeps.tables import Table as Table
from .sweeps.wearing import wear as wear
