"""YADE, driven through many impacts side by side."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from string import Template
from typing import ClassVar

import numpy as np

from carom.bodies.pairs import Counterbody
from carom.bodies.shapes import Sphere
from carom.dem import LammpsMindlin, LinearSpring, YadeMindlin
from carom.dem.base import ContactLaw
from carom.verify.engines import arrangement
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.running import Engine

SCRIPT, RESULT = "impacts.py", "results.txt"

IMPACTS = Template("""\
# $count oblique impacts of $bodies, side by side and far apart. Written by Carom.
#
#   yade -n -x $script     leaves $result: how the spheres leave
#
$impact
from math import atan

first = FrictMat($first_material, frictionAngle=atan($friction))
second = FrictMat($second_material, frictionAngle=atan($friction))
for material in (first, second):
    O.materials.append(material)

radius, second_radius = $radius, $second_radius
height = $height  # of the first body above the second: a hair before they touch
normal_speed = $normal_speed
# tangential speed, spin (omegay is its negative)
impacts = [
$impacts
]

first_bodies, second_bodies = [], []
for i, (speed, spin) in enumerate(impacts):
    place = $spacing * i
    one = sphere((0, place, height), radius, material=first)
    one.state.vel = (speed, 0, -normal_speed)
    one.state.angVel = (0, -spin, 0)
    first_bodies.append(O.bodies.append(one))
    if second_radius > 0:
        two = sphere((0, place, 0), second_radius, material=second)
        second_bodies.append(O.bodies.append(two))
if second_radius == 0:
    O.bodies.append(utils.wall(0, axis=2, sense=1, material=second))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1 * radius),
    InteractionLoop(
        [
            # without hertzian a wall has the radius of the sphere, and R* = R/2
            Ig2_Wall_Sphere_ScGeom(hertzian=True),
            Ig2_Sphere_Sphere_ScGeom(),
        ],
        # Law: $law
        [$physics],
        [$functor],$comment
    ),
    NewtonIntegrator(damping=0),  # its default, 0.2, takes energy from every motion
]
O.dt = $time_step  # s: $steps steps in the $duration s of Hertz's contact
O.run($run, True)

with open("$result", "w") as file:
    file.write("# x z vx vz omegay of the first bodies, then of the second ones\\n")
    for number in first_bodies + second_bodies:
        state = O.bodies[number].state
        row = (state.pos[0], state.pos[2], state.vel[0], state.vel[2], state.angVel[1])
        file.write(" ".join(repr(float(value)) for value in row) + "\\n")
""")

MINDLIN = "Law2_ScGeom_MindlinPhys_Mindlin()"
ABOUT_MINDLIN = """
        # Law2_ScGeom_MindlinPhys_HertzWithLinearShear(nonLin=1) gives the same; with nonLin=0, its
        # default, the shear stiffness is kso, which has the unit of another quantity.
        # Law2_ScGeom_MindlinPhys_MindlinDeresiewitz never sets a shear force: psi_2 = psi_1"""


@dataclass(frozen=True)
class Yade(Engine):
    """YADE: its law Mindlin, which adds up the force as LAMMPS's mindlin/force does, and springs.

    HertzWithLinearShear with nonLin = 1 is the same law; with nonLin = 0, its default, k_t does not
    depend on the contact at all. MindlinDeresiewitz never sets a shear force, so psi_2 = psi_1.

    Parameters
    ----------
    path : str or Path, optional
        The executable, by default the one on the PATH.

    Examples
    --------
    >>> import carom
    >>> engine = carom.verify.Yade()
    >>> mindlin = carom.dem.YadeMindlin(restitution=0.9)
    >>> engine.supports(mindlin), engine.supports(carom.dem.LammpsMindlin("mindlin"))
    (True, False)
    """

    name: ClassVar[str] = "YADE"
    versions: ClassVar[str] = "2023.02a"
    called: ClassVar[str] = "yade"
    arguments: ClassVar[tuple[str, ...]] = ("-j1", "-n", "-x", SCRIPT)
    advice: ClassVar[str] = "install Debian's package yade"
    greeting: ClassVar[str] = r"Welcome to Yade (\S+)"

    def supports(self, law: ContactLaw) -> bool:
        """Tell whether the program has this law; its springs have no dashpot of their own."""
        if isinstance(law, LinearSpring):
            return law.restitution == 1.0
        if isinstance(law, LammpsMindlin):
            return law.variant == "mindlin/force" and law.restitution == law.stiffness == 1.0
        return isinstance(law, YadeMindlin)

    def files(self, experiment: Experiment) -> dict[str, str]:
        """Return complete inputs: text by file name."""
        return {SCRIPT: _script(experiment)}

    def outcomes(self, folder: Path, experiment: Experiment) -> Outcomes:
        """Return what a run has left in its folder; ValueError or OSError if it is not there."""
        return arrangement.outcomes_of(experiment, np.loadtxt(folder / RESULT, ndmin=2))


def _script(experiment: Experiment) -> str:
    pair, second = experiment.pair, experiment.pair.second
    first_young, second_young = arrangement.young_moduli(pair)
    physics, functor = _law(experiment)
    motions = zip(experiment.tangential_speed, experiment.spin, strict=True)
    return IMPACTS.substitute(
        arrangement.shared_values(experiment),
        script=SCRIPT,
        result=RESULT,
        first_material=_material(pair.first, first_young),
        second_material=_material(second, second_young),
        friction=pair.friction,
        radius=pair.first.radius,
        second_radius=second.radius if isinstance(second, Sphere) else 0.0,
        height=arrangement.HAIR * arrangement.touching(pair),
        normal_speed=experiment.normal_speed,
        impacts="\n".join(f"    ({speed!r}, {spin!r})," for speed, spin in motions),
        spacing=arrangement.spacing(pair),
        physics=physics,
        functor=functor,
        comment=ABOUT_MINDLIN if functor == MINDLIN else "",
    )


def _material(body: Counterbody, young: float) -> str:
    poisson, density = body.material.poisson, body.material.density or 1.0
    return f"young={young!r}, poisson={poisson!r}, density={density!r}"


def _law(experiment: Experiment) -> tuple[str, str]:
    """Return YADE's words for what a contact is made of, and for its law."""
    if isinstance(experiment.law, LinearSpring):
        normal, tangential, _ = arrangement.spring(experiment)
        stiffnesses = f"kn={_matched(normal)}, ks={_matched(tangential)}"
        return (
            f"Ip2_FrictMat_FrictMat_FrictPhys({stiffnesses})",
            "Law2_ScGeom_FrictPhys_CundallStrack()",
        )
    e = arrangement.restitution(experiment)
    damping = "" if e == 1.0 else f"en={_matched(e)}, es={_matched(e)}"
    return f"Ip2_FrictMat_FrictMat_MindlinPhys({damping})", MINDLIN


def _matched(value: float) -> str:
    return f"MatchMaker(algo='val', val={float(value)!r})"
