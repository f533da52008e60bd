from .function import (
    ContactStep as ContactStep,
    FunctionLaw as FunctionLaw,
    FunctionRebound as FunctionRebound,
)
from .hard import HardSphere as HardSphere
from .memory import ExactContactLaw as ExactContactLaw
from .springs import (
    EdemHertzMindlin as EdemHertzMindlin,
    HertzLinearHistory as HertzLinearHistory,
    LammpsMindlin as LammpsMindlin,
    LiggghtsHertz as LiggghtsHertz,
    LinearSpring as LinearSpring,
    StrongeLaw as StrongeLaw,
    ThorntonLaw as ThorntonLaw,
    WaltonBraunLaw as WaltonBraunLaw,
    YadeMindlin as YadeMindlin,
)
