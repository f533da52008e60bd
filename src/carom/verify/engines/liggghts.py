"""LIGGGHTS, driven through many impacts side by side."""

from __future__ import annotations

import re
import shutil
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from string import Template
from typing import ClassVar

import numpy as np

from carom.bodies import Sphere
from carom.laws.dem import ContactLaw, LiggghtsHertz, LinearSpring
from carom.laws.dem.coefficients import SPRING
from carom.laws.dem.damping import damping_ratio
from carom.pairs import Pair
from carom.verify.engines.experiments import Experiment, Outcomes

SCRIPT, BODIES, RESULTS = "in.liggghts", "bodies.data", "results.dump"
SPACING = 4.0  # between impacts, in radii of the largest body
RIGID = 1e9  # Young's modulus of a body that does not deform, in units of the other one's
HAIR = 1.0 + 4.0 * sys.float_info.epsilon
DURATIONS, DAMPED_DURATIONS = 2, 4  # of Hertz's contact, after which the bodies have parted

IMPACTS = Template("""\
# Oblique impacts side by side, far apart: $bodies.
# liggghts -in $script reads $data and leaves $results; SI units.
# z is the normal of the contacts, x their tangential direction. The contact point of the first body
# has V_x = v_x - R omega_y relative to the second one; psi = kappa V_x/(mu V_1), where
# V_1 = $normal_speed, mu = $friction, kappa = G*/E* = $kappa; chi = $chi.
# The largest overlap of an elastic impact is $overlap R.
atom_style      granular
atom_modify     map array
communicate     single vel yes
boundary        f f f
newton          off
units           si
hard_particles  yes             # allows Young's moduli above 1 GPa
soft_particles  yes             # and below 5 MPa
read_data       $data
neighbor        $skin bin
neigh_modify    delay 0

# Law: $law
# type 1 is the first body, type 2 the second one
$properties
pair_style      gran model $model
pair_coeff      * *
$wall
fix             motion all nve/sphere
timestep        $time_step        # $steps of them in a contact of Hertz's
thermo          $last
thermo_modify   lost error norm no
dump            results all custom $last $results id x z vx vz omegay
dump_modify     results sort id format "%d %.17g %.17g %.17g %.17g %.17g"
run             $last
""")


@dataclass(frozen=True)
class Liggghts:
    """LIGGGHTS-PUBLIC: Hertz or linear springs, with tangential history.

    The contact point of LIGGGHTS lies at R - d/2 from the centre, which costs a few d/R of psi_2:
    impacts at low speed are the sharper test. It asks for a restitution above 0.05.

    Parameters
    ----------
    path : str or Path, optional
        Where the program is; by default `liggghts` is looked for.

    Examples
    --------
    >>> from carom.laws.dem import LammpsMindlin, LiggghtsHertz
    >>> Liggghts().supports(LiggghtsHertz(restitution=0.9)), Liggghts().supports(LammpsMindlin())
    (True, False)
    """

    path: str | Path | None = None

    name: ClassVar[str] = "LIGGGHTS"
    versions: ClassVar[str] = "3.8.0"

    @property
    def remedy(self) -> str:
        """What to do where it is absent."""
        if self.path is not None:
            return f"{str(self.path)!r} is not there or not executable; give another path"
        return "not found; install Debian's package liggghts"

    def executable(self) -> Path | None:
        """Return where the program is, or None."""
        found = shutil.which(self.path or "liggghts")
        return Path(found).absolute() if found else None

    def supports(self, law: ContactLaw) -> bool:
        """Tell whether the program has this law."""
        if isinstance(law, LinearSpring):
            return law.restitution == 1.0 or law.tangential_damping == 0.0
        return type(law) is LiggghtsHertz

    def files(self, experiment: Experiment) -> dict[str, str]:
        """Return complete inputs: text by file name."""
        return {SCRIPT: _script(experiment), BODIES: _bodies(experiment)}

    def command(self, folder: Path) -> list[str]:
        """Return the command that runs the inputs in a folder."""
        return [str(self.executable()), "-in", SCRIPT]

    def outcomes(self, folder: Path, experiment: Experiment) -> Outcomes:
        """Return what a run has left in its folder; ValueError or OSError if it is not there."""
        text = (folder / RESULTS).read_text(encoding="utf-8")
        _, _, last = text.rpartition("ITEM: ATOMS")
        rows = np.array([line.split() for line in last.splitlines()[1:]], dtype=np.float64)
        count = len(experiment)
        first = rows[:count, 1:]
        second = rows[count:, 1:] if isinstance(experiment.pair.second, Sphere) else 0.0 * first
        _, height, tangential, normal, _ = (first - second).T
        if np.any(height < start_height(experiment.pair)):
            raise ValueError("bodies are still in contact")
        return Outcomes(normal, tangential, -first[:, 4])

    def version(self, printed: str) -> str:
        """Return the version that the program has printed."""
        found = re.search(r"LIGGGHTS-PUBLIC ([\w.]+)", printed)
        return found.group(1) if found else "unknown"


def young_moduli(pair: Pair) -> tuple[float, float]:
    """Return Young's moduli of both bodies for a program that knows no infinity."""
    first, second = pair.first.material.young, pair.second.material.young
    return min(first, RIGID * second), min(second, RIGID * first)


def linear_stiffness(experiment: Experiment) -> tuple[float, float]:
    """Return k_n of a spring that the impact presses as far as Hertz's contact, and k_t, in N/m."""
    law, scales = experiment.law, experiment.scales
    normal = SPRING * scales.force / scales.length
    ratio = law.stiffness_ratio if isinstance(law, LinearSpring) else None
    return normal, normal * (ratio or experiment.pair.kappa)


def start_height(pair: Pair) -> float:
    """Return the height of the first body above the second, or a wall, a hair before they touch.

    Not at touch: a dashpot would act before the first step.
    """
    return HAIR * sum(body.radius for body in pair.moving)


def _script(experiment: Experiment) -> str:
    pair, law = experiment.pair, experiment.law
    model = "hooke/stiffness" if isinstance(law, LinearSpring) else "hertz"
    damping = "off" if isinstance(law, LinearSpring) else "on"
    model, options = f"{model} tangential history", f"tangential_damping {damping}"
    wall = f"fix wall all wall/gran model {model} primitive type 2 zplane 0.0 {options}"
    if isinstance(pair.second, Sphere):
        wall = "# no wall: the second bodies are spheres"
    elastic = getattr(law, "restitution", 1.0) == 1.0
    return IMPACTS.substitute(
        bodies="pairs of spheres" if isinstance(pair.second, Sphere) else "spheres on a flat wall",
        script=SCRIPT,
        normal_speed=experiment.normal_speed,
        friction=pair.friction,
        kappa=f"{pair.kappa:.9g}",
        chi=f"{pair.chi:.9g}",
        overlap=f"{experiment.scales.length / pair.first.radius:.2g}",
        data=BODIES,
        results=RESULTS,
        skin=0.1 * pair.first.radius,
        law=law,
        properties="\n".join(_properties(experiment)),
        model=f"{model} {options}",
        wall=wall,
        time_step=experiment.time_step,
        steps=experiment.steps,
        last=(DURATIONS if elastic else DAMPED_DURATIONS) * experiment.steps,
    )


def _properties(experiment: Experiment) -> Iterator[str]:
    """Yield the material properties of both types of bodies."""
    pair, law = experiment.pair, experiment.law

    def each(name: str, one: float, two: float) -> str:
        values = f"{float(one)!r} {float(two)!r}"
        return f"fix {name} all property/global {name} peratomtype {values}"

    def both(name: str, value: float) -> str:
        values = " ".join([repr(float(value))] * 4)
        return f"fix {name} all property/global {name} peratomtypepair 2 {values}"

    yield both("coefficientFriction", pair.friction)
    if isinstance(law, LinearSpring):
        normal, tangential = linear_stiffness(experiment)
        yield both("kn", normal)
        yield both("kt", tangential)
        # LIGGGHTS multiplies gamman by the effective mass; gammat is not used, yet must be there
        yield both("gamman", 2.0 * damping_ratio(law.restitution) * sqrt(normal / pair.normal_mass))
        yield both("gammat", 0.0)
    else:
        yield each("youngsModulus", *young_moduli(pair))
        yield each("poissonsRatio", pair.first.material.poisson, pair.second.material.poisson)
        yield both("coefficientRestitution", getattr(law, "restitution", 1.0))


def _bodies(experiment: Experiment) -> str:
    """Return the data file: bodies that all but touch, and how they move."""
    edge = SPACING * max(body.radius for body in experiment.pair.moving)
    atoms = list(_atoms(experiment))
    lines = [
        "# Atoms: number, type, diameter, density, x y z. Velocities: number, v, omega",
        "",
        f"{len(atoms)} atoms",
        "2 atom types",
        f"{-edge!r} {edge * len(experiment)!r} xlo xhi",
        f"{-edge!r} {edge!r} ylo yhi",
        f"{-edge!r} {edge!r} zlo zhi",
        "",
        "Atoms",
        "",
        *atoms,
        "",
        "Velocities",
        "",
        *_velocities(experiment, len(atoms)),
    ]
    return "\n".join(lines) + "\n"


def _atoms(experiment: Experiment) -> Iterator[str]:
    """Yield the bodies: the first ones of all impacts, then the second ones."""
    pair, number = experiment.pair, 0
    spacing = SPACING * max(body.radius for body in pair.moving)
    for kind, body in enumerate(pair.moving, 1):
        height = start_height(pair) if kind == 1 else 0.0
        for place in range(len(experiment)):
            number += 1
            shape = f"{2.0 * body.radius!r} {body.material.density!r}"
            yield f"{number} {kind} {shape} {place * spacing!r} 0 {height!r}"


def _velocities(experiment: Experiment, bodies: int) -> Iterator[str]:
    """Yield how the bodies move; the second ones rest."""
    speeds = zip(experiment.tangential_speed, experiment.spin, strict=True)
    for number, (speed, spin) in enumerate(speeds, 1):
        yield f"{number} {speed!r} 0 {-experiment.normal_speed!r} 0 {-spin!r} 0"
    for number in range(len(experiment) + 1, bodies + 1):
        yield f"{number} 0 0 0 0 0 0"
