"""What LAMMPS is given for an experiment: its coefficients of a law, and a script."""

from __future__ import annotations

from dataclasses import dataclass
from string import Template

from carom.bodies import Sphere
from carom.laws.dem import ContactLaw, HertzLinearHistory, LammpsMindlin, LinearSpring
from carom.pairs import Pair
from carom.quantities import refusal
from carom.verify.engines.arrangement import remarks, run_length, spacing, spring
from carom.verify.engines.experiments import Experiment

INPUT, SPHERES, RESULT = "in.impacts", "spheres.data", "outcomes.txt"
SKIN = 0.025  # of the distance between neighbours

SCRIPT = Template("""\
# $count oblique impacts of $bodies, side by side and far apart. Written by Carom.
#
#   lmp -in $input     leaves $result: how the spheres leave
#
$impact

units           si
atom_style      sphere
boundary        m m m
newton          off
comm_modify     vel yes cutoff $cutoff
neighbor        $skin bin
atom_modify     sort 0 0.0
read_data       $spheres

# Law: $law
$meanings
variable        kn index $kn
variable        kt index $kt
variable        loss index $loss   # $loss_meaning
variable        xgamma index $xgamma   # tangential over normal damping
variable        mu index $friction   # friction
$contact

fix             motion all nve/sphere
timestep        $time_step   # s: $steps steps in the $duration s of Hertz's contact
thermo          $run
run             $run

write_dump      all custom $result id x z vx vz omegay modify sort id format float %.17g
""")

ON_WALL = "fix             contact all wall/gran granular {words} zplane 0.0 NULL"
IN_PAIRS = "pair_style      granular\npair_coeff      * * {words}"


@dataclass(frozen=True)
class Coefficients:
    """A law as LAMMPS takes it: models, stiffnesses, and what the normal direction loses."""

    normal: str
    tangential: str
    kn: float
    kt: float
    damping: str = "velocity"
    loss: float = 0.0

    def words(self, kn: str, kt: str, loss: str, xgamma: str, mu: str) -> str:
        """Return the law as the arguments of `pair_coeff` and `fix wall/gran granular`."""
        shear = f"tangential {self.tangential} {kt} {xgamma} {mu}"
        return f"{self.normal} {kn} {loss} {shear} damping {self.damping}"

    @property
    def meanings(self) -> str:
        """Comments on the stiffnesses."""
        springs = {
            "hooke": "F_n = kn delta, kn = (4/5) P_max/d_max of Hertz's impact",
            "hertz": "F_n = kn sqrt(R*) delta^(3/2), kn = (4/3) E*",
        }
        per_radius = self.tangential != "linear_history"
        shear = "kt a U, kt = 2 G*, 1/G* = sum (2 - nu)/(4 G)" if per_radius else "kt U"
        return f"# {springs[self.normal]}\n# F_t = {shear}; at most mu F_n"

    @property
    def loss_meaning(self) -> str:
        """Comment on the damping."""
        return "N s/m" if self.damping == "velocity" else "coefficient of restitution"


def coefficients(experiment: Experiment) -> Coefficients:
    """Return the law of an experiment as LAMMPS takes it.

    hooke: F_n = k_n d; hertz: F_n = k_n sqrt(R*) d^(3/2); linear_history: F_t = k_t U; mindlin:
    F_t = k_t a U. The loss is in N s/m with damping velocity, else e. Source: the documentation of
    LAMMPS, pair_style granular. Without damping it is velocity with 0, for the polynomial of tsuji
    does not vanish at e = 1.

    Raises InputError if LAMMPS does not have the law.
    """
    law, pair = experiment.law, experiment.pair
    shear = 2.0 * pair.effective_shear_modulus
    if isinstance(law, LinearSpring):
        normal, tangential, dashpot = spring(experiment)
        return Coefficients("hooke", "linear_history", normal, tangential, loss=dashpot)
    if isinstance(law, HertzLinearHistory):
        kt = law.stiffness * shear * experiment.scales.radius
        return _hertz(pair, "linear_history", kt, "coeff_restitution", law.restitution)
    if isinstance(law, LammpsMindlin):
        return _hertz(pair, law.variant, law.stiffness * shear, law.damping, law.restitution)
    raise refusal("law", law, "LAMMPS does not have it")


def _hertz(pair: Pair, model: str, kt: float, damping: str, restitution: float) -> Coefficients:
    whole = Coefficients("hertz", model, 4.0 / 3.0 * pair.effective_modulus, kt)
    if restitution == 1.0:
        return whole
    return Coefficients("hertz", model, whole.kn, kt, damping, restitution)


def tangential_damping(law: ContactLaw) -> float:
    """Return x_gamma of a law that LAMMPS has."""
    return float(getattr(law, "tangential_damping", 0.0))


def script(experiment: Experiment) -> str:
    """Return the input script."""
    law, pair = coefficients(experiment), experiment.pair
    words = law.words("${kn}", "${kt}", "${loss}", "${xgamma}", "${mu}")
    numbers = {
        "kn": law.kn,
        "kt": law.kt,
        "loss": law.loss,
        "xgamma": tangential_damping(experiment.law),
        "friction": pair.friction,
        "time_step": experiment.time_step,
    }
    return SCRIPT.substitute(
        remarks(experiment),
        **{name: repr(value) for name, value in numbers.items()},
        input=INPUT,
        result=RESULT,
        spheres=SPHERES,
        cutoff=f"{spacing(pair):.6g}",
        skin=f"{SKIN * spacing(pair):.6g}",
        meanings=law.meanings,
        loss_meaning=law.loss_meaning,
        contact=(IN_PAIRS if isinstance(pair.second, Sphere) else ON_WALL).format(words=words),
        run=run_length(experiment),
    )
