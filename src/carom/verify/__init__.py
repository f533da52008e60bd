"""The bench: contact laws of DEM codes, and the codes themselves, against the exact impact.

Examples
--------
>>> import carom
>>> best = carom.verify.rank().standings[0]
>>> best.entry.label, round(best.max_error, 2)
('Thornton, incremental', 0.16)
"""

from typing import TYPE_CHECKING

from carom.lazy import loader

if TYPE_CHECKING:
    from carom.verify.catalogue import CATALOGUE, Entry
    from carom.verify.conversions import (
        damping,
        poisson_from_kappa,
        recipes,
        restitution,
        stiffnesses,
    )
    from carom.verify.engines.experiments import Experiment
    from carom.verify.engines.lammps import Lammps
    from carom.verify.engines.liggghts import Liggghts
    from carom.verify.engines.running import EngineError, run
    from carom.verify.engines.yade import Yade
    from carom.verify.errors import error_map, force_error
    from carom.verify.measuring import Bench, bench
    from carom.verify.pack import write_pack
    from carom.verify.ranking import Ranking, rank
    from carom.verify.scoring import Score, score
    from carom.verify.steps import advised_steps, step_error
    from carom.verify.tuning import Tuning, tune

_HOMES = {
    "carom.verify.measuring": ("Bench", "bench"),
    "carom.verify.catalogue": ("CATALOGUE", "Entry"),
    "carom.verify.conversions": (
        "damping",
        "poisson_from_kappa",
        "recipes",
        "restitution",
        "stiffnesses",
    ),
    "carom.verify.engines.experiments": ("Experiment",),
    "carom.verify.engines.lammps": ("Lammps",),
    "carom.verify.engines.liggghts": ("Liggghts",),
    "carom.verify.engines.running": ("EngineError", "run"),
    "carom.verify.engines.yade": ("Yade",),
    "carom.verify.errors": ("error_map", "force_error"),
    "carom.verify.pack": ("write_pack",),
    "carom.verify.ranking": ("Ranking", "rank"),
    "carom.verify.scoring": ("Score", "score"),
    "carom.verify.steps": ("advised_steps", "step_error"),
    "carom.verify.tuning": ("Tuning", "tune"),
}

__all__ = [
    "CATALOGUE",
    "Bench",
    "EngineError",
    "Entry",
    "Experiment",
    "Lammps",
    "Liggghts",
    "Ranking",
    "Score",
    "Tuning",
    "Yade",
    "advised_steps",
    "bench",
    "damping",
    "error_map",
    "force_error",
    "poisson_from_kappa",
    "rank",
    "recipes",
    "restitution",
    "run",
    "score",
    "step_error",
    "stiffnesses",
    "tune",
    "write_pack",
]

__getattr__ = loader(__name__, _HOMES)
