"""YADE, driven through many impacts side by side."""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from string import Template
from typing import ClassVar

import numpy as np

from carom.bodies import Sphere
from carom.laws.dem import ContactLaw, LammpsMindlin, LinearSpring
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.liggghts import linear_stiffness, start_height, young_moduli

SCRIPT, RESULTS = "impacts.py", "results.txt"

IMPACTS = Template("""\
# Oblique impacts side by side, far apart: $bodies.
# yade -n -x $script leaves $results; SI units.
# z is the normal of the contacts, x their tangential direction. The contact point of the first body
# has V_x = v_x - R omega_y relative to the second one; psi = kappa V_x/(mu V_1), where
# V_1 = $normal_speed, mu = $friction, kappa = G*/E* = $kappa; chi = $chi.
# The largest overlap of an elastic impact is $overlap R.
# Law: $law
from math import atan

first = FrictMat($first_material, frictionAngle=atan($friction))
second = FrictMat($second_material, frictionAngle=atan($friction))
for material in (first, second):
    O.materials.append(material)

radius, second_radius = $radius, $second_radius
height = $height  # of the first body above the second: a hair before they touch
normal_speed = $normal_speed
# tangential speed, spin (omega_y is its negative)
impacts = [
$impacts
]

pairs = []
for i, (speed, spin) in enumerate(impacts):
    place = 4 * max(radius, second_radius) * i
    one = sphere((place, 0, height), radius, material=first)
    one.state.vel = (speed, 0, -normal_speed)
    one.state.angVel = (0, -spin, 0)
    pairs.append([O.bodies.append(one)])
    if second_radius > 0:
        pairs[-1].append(O.bodies.append(sphere((place, 0, 0), second_radius, material=second)))
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
        $physics,
        $functor
    ),
    NewtonIntegrator(damping=0),  # its default, 0.2, takes energy from every motion
]
O.dt = $time_step  # $steps of them in a contact of Hertz's
O.run($last, True)

with open("$results", "w") as file:
    file.write("# height, tangential and normal velocity of first to second body; spin of first\\n")
    for pair in pairs:
        states = [O.bodies[number].state for number in pair]
        apart, velocity = states[0].pos, states[0].vel
        if len(states) == 2:
            apart, velocity = apart - states[1].pos, velocity - states[1].vel
        row = (apart[2], velocity[0], velocity[2], -states[0].angVel[1])
        file.write(" ".join(repr(float(value)) for value in row) + "\\n")
""")

MINDLIN = """\
[Law2_ScGeom_MindlinPhys_Mindlin()],
        # Law2_ScGeom_MindlinPhys_HertzWithLinearShear(nonLin=1) gives the same; with nonLin=0, its
        # default, the shear stiffness is kso, which has the unit of another quantity.
        # Law2_ScGeom_MindlinPhys_MindlinDeresiewitz never sets a shear force: psi_2 = psi_1"""


@dataclass(frozen=True)
class Yade:
    """YADE: its law Mindlin, which accumulates the force as LAMMPS's mindlin/force, and springs.

    HertzWithLinearShear with nonLin = 1 is the same law; with nonLin = 0, its default, k_t does not
    follow from the contact at all. MindlinDeresiewitz never sets a shear force: psi_2 = psi_1.

    Parameters
    ----------
    path : str or Path, optional
        Where the program is; by default `yade` is looked for.

    Examples
    --------
    >>> from carom.laws.dem import LammpsMindlin
    >>> Yade().supports(LammpsMindlin("mindlin/force")), Yade().supports(LammpsMindlin("mindlin"))
    (True, False)
    """

    path: str | Path | None = None

    name: ClassVar[str] = "YADE"
    versions: ClassVar[str] = "2023.02a"

    @property
    def remedy(self) -> str:
        """What to do where it is absent."""
        if self.path is not None:
            return f"{str(self.path)!r} is not there or not executable; give another path"
        return "not found; install Debian's package yade"

    def executable(self) -> Path | None:
        """Return where the program is, or None."""
        found = shutil.which(self.path or "yade")
        return Path(found).absolute() if found else None

    def supports(self, law: ContactLaw) -> bool:
        """Tell whether the program has this law: elastic ones, whose damping is not its own."""
        if isinstance(law, LinearSpring):
            return law.restitution == 1.0
        if isinstance(law, LammpsMindlin):
            return law.variant == "mindlin/force" and law.restitution == law.stiffness == 1.0
        return False

    def files(self, experiment: Experiment) -> dict[str, str]:
        """Return complete inputs: text by file name."""
        return {SCRIPT: _script(experiment)}

    def command(self, folder: Path) -> list[str]:
        """Return the command that runs the inputs in a folder."""
        return [str(self.executable()), "-j1", "-n", "-x", SCRIPT]

    def outcomes(self, folder: Path, experiment: Experiment) -> Outcomes:
        """Return what a run has left in its folder; ValueError or OSError if it is not there."""
        height, tangential, normal, spin = np.loadtxt(folder / RESULTS, ndmin=2).T
        if np.any(height < start_height(experiment.pair)):
            raise ValueError("bodies are still in contact")
        return Outcomes(normal, tangential, spin)

    def version(self, printed: str) -> str:
        """Return the version that the program has printed."""
        found = re.search(r"Welcome to Yade (\S+)", printed)
        return found.group(1) if found else "unknown"


def _script(experiment: Experiment) -> str:
    pair, young = experiment.pair, young_moduli(experiment.pair)
    materials = [
        f"young={modulus!r}, poisson={body.material.poisson!r}, "
        f"density={body.material.density or 1.0!r}"
        for modulus, body in zip(young, (pair.first, pair.second), strict=True)
    ]
    physics, functor = _law(experiment)
    motions = zip(experiment.tangential_speed, experiment.spin, strict=True)
    return IMPACTS.substitute(
        bodies="pairs of spheres" if isinstance(pair.second, Sphere) else "spheres on a flat wall",
        script=SCRIPT,
        kappa=f"{pair.kappa:.9g}",
        chi=f"{pair.chi:.9g}",
        overlap=f"{experiment.scales.length / pair.first.radius:.2g}",
        results=RESULTS,
        law=experiment.law,
        first_material=materials[0],
        second_material=materials[1],
        friction=pair.friction,
        radius=pair.first.radius,
        second_radius=pair.second.radius if isinstance(pair.second, Sphere) else 0.0,
        height=start_height(pair),
        normal_speed=experiment.normal_speed,
        impacts="\n".join(f"    ({speed!r}, {spin!r})," for speed, spin in motions),
        physics=physics,
        functor=functor,
        time_step=experiment.time_step,
        steps=experiment.steps,
        last=experiment.steps + experiment.steps // 5 + 2,
    )


def _law(experiment: Experiment) -> tuple[str, str]:
    """Return YADE's words for what a contact is made of, and for its law."""
    if not isinstance(experiment.law, LinearSpring):
        return "[Ip2_FrictMat_FrictMat_MindlinPhys()]", MINDLIN
    normal, tangential = (
        f"MatchMaker(algo='val', val={float(value)!r})" for value in linear_stiffness(experiment)
    )
    physics = f"Ip2_FrictMat_FrictMat_FrictPhys(kn={normal}, ks={tangential})"
    return f"[{physics}]", "[Law2_ScGeom_FrictPhys_CundallStrack()],"
