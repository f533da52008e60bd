from . import (
    classical as classical,
    datasets as datasets,
    dem as dem,
    laws as laws,
    plots as plots,
    results as results,
    shapes as shapes,
    status as status,
    verify as verify,
)
from .bodies.cases import read as read
from .bodies.losses import (
    ElasticPlastic as ElasticPlastic,
    KelvinVoigt as KelvinVoigt,
    Metal as Metal,
    StandardLinearSolid as StandardLinearSolid,
    ZenerPlate as ZenerPlate,
)
from .bodies.materials import Material as Material, material as material, materials as materials
from .bodies.observables import convert_observables as convert_observables
from .bodies.pairs import Pair as Pair
from .bodies.shapes import Cup as Cup, HalfSpace as HalfSpace, Sphere as Sphere
from .bodies.smooth_body import Body as Body
from .dimensionless.numerics.shared_library import (
    get_include as get_include,
    get_library as get_library,
)
from .dimensionless.rebounds import rebound as rebound
from .dimensionless.solution import solve as solve
from .impacts.boundary_elements import BoundaryElements as BoundaryElements
from .impacts.contacts.load_paths import load_path as load_path
from .impacts.curves import curve as curve, regime_map as regime_map
from .impacts.solve import impact as impact
from .io.files import save as save
from .io.version import __version__ as __version__
from .lab.fitting import fit as fit, joint_fit as joint_fit
from .lab.fitting.tracks import track as track
from .many.collisions import collide as collide
from .many.sweeps import sweep as sweep
from .many.sweeps.designs import Grid as Grid, LatinHypercube as LatinHypercube
from .many.sweeps.strength_map import bearable_speeds as bearable_speeds
from .many.sweeps.tables import Table as Table
from .many.sweeps.wearing import wear_of_many as wear_of_many
from .quantities.refusals import InputError as InputError
