from .benchmark import Bench as Bench, bench as bench
from .catalogue import CATALOGUE as CATALOGUE, Entry as Entry
from .conversions import (
    damping as damping,
    poisson_from_kappa as poisson_from_kappa,
    recipes as recipes,
    restitution as restitution,
    stiffnesses as stiffnesses,
)
from .engines.experiments import Experiment as Experiment
from .engines.lammps import Lammps as Lammps
from .engines.liggghts import Liggghts as Liggghts
from .engines.running import EngineError as EngineError, run as run
from .engines.yade import Yade as Yade
from .errors import error_map as error_map, force_error as force_error
from .pack import write_pack as write_pack
from .ranking import Ranking as Ranking, rank as rank
from .scoring import Score as Score, score as score
from .steps import advised_steps as advised_steps, step_error as step_error
from .tuning import Tuning as Tuning, tune as tune
