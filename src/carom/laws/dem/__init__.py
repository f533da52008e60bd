"""Contact laws as the codes of the discrete element method define them, each with its source."""

from carom.laws.base import Law
from carom.laws.dem.base import ContactLaw
from carom.laws.dem.contact_step import ContactStep
from carom.laws.dem.function import FunctionLaw, FunctionRebound
from carom.laws.dem.hard import HardSphere
from carom.laws.dem.incremental import ThorntonLaw, WaltonBraunLaw
from carom.laws.dem.memory import MemoryLaw
from carom.laws.dem.mindlin import EdemHertzMindlin, LammpsMindlin, LiggghtsHertz, YadeMindlin
from carom.laws.dem.springs import HertzLinearHistory, LinearSpring, StrongeLaw
from carom.laws.status import LawStatus

__all__ = [
    "ContactLaw",
    "ContactStep",
    "EdemHertzMindlin",
    "FunctionLaw",
    "FunctionRebound",
    "HardSphere",
    "HertzLinearHistory",
    "LammpsMindlin",
    "Law",
    "LawStatus",
    "LiggghtsHertz",
    "LinearSpring",
    "MemoryLaw",
    "StrongeLaw",
    "ThorntonLaw",
    "WaltonBraunLaw",
    "YadeMindlin",
]
