from .contact_step import ContactStep as ContactStep
from .function import FunctionLaw as FunctionLaw, FunctionRebound as FunctionRebound
from .hard import HardSphere as HardSphere
from .memory import ExactContactLaw as ExactContactLaw
from .mindlin import (
    EdemHertzMindlin as EdemHertzMindlin,
    LammpsMindlin as LammpsMindlin,
    LiggghtsHertz as LiggghtsHertz,
    YadeMindlin as YadeMindlin,
)
from .springs import (
    HertzLinearHistory as HertzLinearHistory,
    LinearSpring as LinearSpring,
    StrongeLaw as StrongeLaw,
    ThorntonLaw as ThorntonLaw,
    WaltonBraunLaw as WaltonBraunLaw,
)
