from .collisions import Collisions as Collisions, JudgedCollisions as JudgedCollisions
from .contacts.load_paths import LoadPath as LoadPath
from .dimensionless.solution import Solution as Solution
from .fitting import Estimate as Estimate, Fit as Fit
from .impacts.boundary_elements import HalfspaceImpact as HalfspaceImpact
from .impacts.exact import Impact as Impact
from .laws.walton_fit import WaltonFit as WaltonFit
