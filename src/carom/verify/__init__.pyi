from .benchmark import Bench as Bench, bench as bench
from .conversions import (
    damping_from_restitution as damping_from_restitution,
    poisson_from_kappa as poisson_from_kappa,
    recipes as recipes,
    restitution_from_damping as restitution_from_damping,
    stiffnesses as stiffnesses,
)
from .engines.experiments import Experiment as Experiment
from .engines.lammps import Lammps as Lammps
from .engines.liggghts import Liggghts as Liggghts
from .engines.running import EngineError as EngineError, run as run
from .engines.yade import Yade as Yade
from .entries import Entry as Entry, catalogue as catalogue
from .errors import (
    advised_steps as advised_steps,
    error_map as error_map,
    force_error as force_error,
    step_error as step_error,
)
from .pack import write_pack as write_pack
from .ranking import Ranking as Ranking, rank as rank
from .scoring import Score as Score, score as score
from .tuning import Tuning as Tuning, tune as tune
