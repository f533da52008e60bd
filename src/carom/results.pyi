from .dimensionless.lossy.viscoelastic.solution import ViscoelasticSolution as ViscoelasticSolution
from .dimensionless.solution import Solution as Solution
from .impacts.adhesive import AdhesiveImpact as AdhesiveImpact
from .impacts.body_impact import BodyImpact as BodyImpact
from .impacts.boundary_elements import HalfspaceImpact as HalfspaceImpact
from .impacts.contacts.fields import Contact as Contact
from .impacts.contacts.load_paths import LoadPath as LoadPath
from .impacts.exact import Impact as Impact
from .lab.fitting import Estimate as Estimate, Fit as Fit, JointFit as JointFit
from .many.collisions.records import Collisions as Collisions, JudgedCollisions as JudgedCollisions
from .many.laws.walton_fit import WaltonFit as WaltonFit
from .quantities.verdicts import Validity as Validity
