from .impacts.adhesive import adhesive_impact as adhesive_impact
from .impacts.contacts.classical import (
    Obliquity as Obliquity,
    cattaneo_mindlin as cattaneo_mindlin,
    critical_obliquity as critical_obliquity,
    loop_energy as loop_energy,
)
