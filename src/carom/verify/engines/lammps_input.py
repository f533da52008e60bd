"""What LAMMPS is given for an experiment: its coefficients of a law, a script, the spheres."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from string import Template
from typing import NamedTuple

from carom.bodies import Sphere
from carom.laws.dem import ContactLaw, HertzLinearHistory, LammpsMindlin, LinearSpring
from carom.laws.dem.damping import damping_ratio
from carom.pairs import Pair
from carom.quantities import refusal
from carom.verify.engines.experiments import Experiment

INPUT, SPHERES, RESULT = "in.impacts", "spheres.data", "outcomes.txt"

SPACING = 4.0  # from centre to centre, in radii of the larger sphere
GAP = 1e-15  # of a radius: LAMMPS of 2021 damps spheres that exactly touch
BEYOND = 1.15  # durations of the contact that are run

SCRIPT = Template("""\
# $count oblique impacts of $bodies, side by side and far apart. Written by Carom.
#
#   lmp -in $input     leaves $result: id x z vx vz omegay of every sphere after its impact
#
# $contact_point
# psi = kappa V_x/(mu V_1), kappa = G*/E* = $kappa, mu = $friction, V_1 = $speed m/s;
# chi = $chi. The largest overlap of an elastic impact is $overlap radii.

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
    law, pair, scales = experiment.law, experiment.pair, experiment.scales
    shear = 2.0 * pair.effective_shear_modulus
    if isinstance(law, LinearSpring):
        return _springs(law, pair, 0.8 * scales.force / scales.length)
    if isinstance(law, HertzLinearHistory):
        kt = law.stiffness * shear * scales.radius
        return _hertz(pair, "linear_history", kt, "coeff_restitution", law.restitution)
    if isinstance(law, LammpsMindlin):
        return _hertz(pair, law.variant, law.stiffness * shear, law.damping, law.restitution)
    raise refusal("law", law, "LAMMPS does not have it")


def _springs(law: LinearSpring, pair: Pair, kn: float) -> Coefficients:
    dashpot = 2.0 * damping_ratio(law.restitution) * sqrt(pair.normal_mass * kn)
    kt = (law.stiffness_ratio or pair.kappa) * kn
    return Coefficients("hooke", "linear_history", kn, kt, loss=dashpot)


def _hertz(pair: Pair, model: str, kt: float, damping: str, restitution: float) -> Coefficients:
    whole = Coefficients("hertz", model, 4.0 / 3.0 * pair.effective_modulus, kt)
    if restitution == 1.0:
        return whole
    return Coefficients("hertz", model, whole.kn, kt, damping, restitution)


def tangential_damping(law: ContactLaw) -> float:
    """Return x_gamma of a law that LAMMPS has."""
    return float(getattr(law, "tangential_damping", 0.0))


def run_length(experiment: Experiment) -> int:
    """Return how many steps it takes until all have parted; damping prolongs the contact."""
    ratio = damping_ratio(getattr(experiment.law, "restitution", 1.0))
    return int(BEYOND * experiment.steps / sqrt(1.0 - ratio**2)) + 2


class Placed(NamedTuple):
    """A sphere at its place and its motion, in the plane y = const."""

    sphere: Sphere
    y: float
    z: float
    vx: float
    vz: float
    spin: float

    def atom(self, number: int) -> str:
        """Return its line of the section Atoms: id, type, diameter, density, x, y, z."""
        body = self.sphere
        return (
            f"{number} 1 {2.0 * body.radius!r} {body.material.density!r} 0.0 {self.y!r} {self.z!r}"
        )

    def velocity(self, number: int) -> str:
        """Return its line of the section Velocities: id, vx, vy, vz, omegax, omegay, omegaz."""
        return f"{number} {self.vx!r} 0.0 {self.vz!r} 0.0 {0.0 - self.spin!r} 0.0"


def placed(experiment: Experiment) -> list[Placed]:
    """Return first bodies that touch z = 0 from above, then second spheres that do from below.

    The centre of mass of two spheres rests; a half-space does.
    """
    pair, speed = experiment.pair, experiment.normal_speed
    motions = list(zip(experiment.tangential_speed, experiment.spin, strict=True))
    rows = [SPACING * largest(pair) * row for row in range(len(motions))]
    share = 1.0
    if isinstance(pair.second, Sphere):
        share = pair.second.mass / (pair.first.mass + pair.second.mass)
    height = pair.first.radius * (1.0 + GAP)
    result = [
        Placed(pair.first, y, height, share * drift, -share * speed, spin)
        for y, (drift, spin) in zip(rows, motions, strict=True)
    ]
    if isinstance(pair.second, Sphere):
        depth, share = -pair.second.radius * (1.0 + GAP), 1.0 - share
        result += [
            Placed(pair.second, y, depth, -share * drift, share * speed, 0.0)
            for y, (drift, _) in zip(rows, motions, strict=True)
        ]
    return result


def largest(pair: Pair) -> float:
    """Return the radius of the larger sphere."""
    return max(body.radius for body in pair.moving)


def spheres(experiment: Experiment) -> str:
    """Return the data file: where the spheres are, and their velocities."""
    bodies, edge = placed(experiment), SPACING * largest(experiment.pair)
    sections = (
        f"# {len(bodies)} spheres that are about to touch; written by Carom",
        f"{len(bodies)} atoms\n1 atom types\n"
        f"{-edge!r} {edge!r} xlo xhi\n"
        f"{-edge!r} {edge * len(experiment)!r} ylo yhi\n"
        f"{-edge!r} {edge!r} zlo zhi",
        "Atoms # sphere",
        "\n".join(body.atom(number) for number, body in enumerate(bodies, 1)),
        "Velocities",
        "\n".join(body.velocity(number) for number, body in enumerate(bodies, 1)),
    )
    return "\n\n".join(sections) + "\n"


def script(experiment: Experiment) -> str:
    """Return the input script."""
    law, pair = coefficients(experiment), experiment.pair
    in_pairs = isinstance(pair.second, Sphere)
    words = law.words("${kn}", "${kt}", "${loss}", "${xgamma}", "${mu}")
    numbers = {
        "kn": law.kn,
        "kt": law.kt,
        "loss": law.loss,
        "xgamma": tangential_damping(experiment.law),
        "friction": pair.friction,
        "speed": experiment.normal_speed,
        "time_step": experiment.time_step,
    }
    remarks = {
        "kappa": pair.kappa,
        "chi": pair.chi,
        "overlap": experiment.scales.length / pair.first.radius,
        "cutoff": SPACING * largest(pair),
        "skin": 0.1 * largest(pair),
        "duration": experiment.duration,
    }
    return SCRIPT.substitute(
        {name: repr(value) for name, value in numbers.items()},
        **{name: f"{value:.6g}" for name, value in remarks.items()},
        count=len(experiment),
        bodies="two spheres" if in_pairs else "a sphere on a flat wall",
        contact_point=_contact_point(experiment),
        input=INPUT,
        result=RESULT,
        spheres=SPHERES,
        law=f"{experiment.law.name}, {experiment.law!r}",
        meanings=law.meanings,
        loss_meaning=law.loss_meaning,
        contact=(IN_PAIRS if in_pairs else ON_WALL).format(words=words),
        steps=experiment.steps,
        run=run_length(experiment),
    )


def _contact_point(experiment: Experiment) -> str:
    if isinstance(experiment.pair.second, Sphere):
        first, second, count = "R1 omegay1", "R2 omegay2", len(experiment)
        return (
            f"Sphere i strikes sphere i + {count}. "
            f"Contact point: V_x = vx1 - {first} - vx2 - {second}."
        )
    return "Contact point: V_x = vx - R omegay."
