"""How impacts are set up in a DEM program: spheres side by side and about to touch, stiffnesses."""

from __future__ import annotations

import sys
from math import sqrt
from pathlib import Path
from string import Template
from typing import Any, NamedTuple

import numpy as np

from carom.bodies.pairs import Pair
from carom.bodies.shapes import Sphere
from carom.dem import LinearSpring
from carom.dem.coefficients import SPRING
from carom.dem.damping import damping_ratio
from carom.folder import DATA
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal
from carom.verify.engines.experiments import Experiment, Outcomes

SPACING = 4.0  # from centre to centre, in radii of the larger sphere
SKIN = 0.025  # of that distance
ALMOST_TOUCHING = 1.0 + 4.0 * sys.float_info.epsilon  # programs damp spheres that exactly touch
RIGID_MODULUS = 1e9  # of a body that does not deform, in units of the other body's
DURATIONS = 1.15  # of an elastic contact that are run
TABLE_HEAD = "ITEM: ATOMS"  # of the last table in a dump


class Spring(NamedTuple):
    """A linear contact: stiffnesses in N/m, dashpot of the normal direction in N s/m."""

    normal: float
    tangential: float
    dashpot: float


def spring(experiment: Experiment) -> Spring:
    """Return the linear contact of an experiment, pressed as far as Hertz's: k_n = (4/5) P/d."""
    law, pair, scales = experiment.law, experiment.pair, experiment.scales
    if not isinstance(law, LinearSpring):
        raise refusal("law", law, "must be a LinearSpring")
    normal = SPRING * scales.force / scales.length
    dashpot = 2.0 * damping_ratio(law.restitution) * sqrt(pair.normal_mass * normal)
    return Spring(normal, normal * (law.stiffness_ratio or pair.kappa), dashpot)


def young_moduli(pair: Pair) -> tuple[float, float]:
    """Return Young's moduli of both bodies in Pa for a program that knows no infinity."""
    first, second = pair.first.material.young, pair.second.material.young
    return min(first, RIGID_MODULUS * second), min(second, RIGID_MODULUS * first)


def restitution(experiment: Experiment) -> float:
    """Return the e that the damping of a law is made for, 1 without damping."""
    return float(getattr(experiment.law, "restitution", 1.0))


def run_length(experiment: Experiment) -> int:
    """Return how many steps it takes until all have parted; damping prolongs the contact."""
    ratio = damping_ratio(restitution(experiment))
    return int(DURATIONS * experiment.steps / (1.0 - ratio**2)) + 2


def spacing(pair: Pair) -> float:
    """Return the distance between the centres of neighbouring impacts in m."""
    return SPACING * max(body.radius for body in pair.moving)


def touching(pair: Pair) -> float:
    """Return the distance in m at which the centre of the first body touches the second."""
    return sum(body.radius for body in pair.moving)


class Placed(NamedTuple):
    """A sphere at its place and its motion, in a plane y = const; spin is -omega_y."""

    sphere: Sphere
    y: float
    z: float
    vx: float
    vz: float
    spin: float


def placed(experiment: Experiment) -> list[Placed]:
    """Return first bodies above z = 0, then second spheres below, which almost touch, by a hair."""
    pair, speed = experiment.pair, experiment.normal_speed
    share = share_of_first(pair)
    spheres = []
    sides = (share, 1.0, 1.0), (share - 1.0, -1.0, 0.0)
    motions = list(zip(experiment.tangential_speed, experiment.spin, strict=True))
    for body, (part, side, spins) in zip(pair.moving, sides, strict=False):
        z = side * ALMOST_TOUCHING * body.radius
        for row, (drift, spin) in enumerate(motions):
            y = spacing(pair) * row
            spheres.append(Placed(body, y, z, part * drift, -part * speed, spins * spin))
    return spheres


def share_of_first(pair: Pair) -> float:
    """Return the first body's part of a relative velocity; the centre of mass is at rest."""
    if not isinstance(pair.second, Sphere):
        return 1.0
    return pair.second.mass / (pair.first.mass + pair.second.mass)


def outcomes_of(experiment: Experiment, states: Array) -> Outcomes:
    """Return how bodies leave, from x, z, vx, vz, omega_y; ValueError if one still touches."""
    count, pair = len(experiment), experiment.pair
    wanted = count * len(pair.moving), 5
    if states.shape != wanted:
        raise ValueError("a table of {} by {}, not {} by {}".format(*states.shape, *wanted))
    first, second = states[:count], states[count:]
    x, z, vx, vz, _ = (first - second if second.size else first).T
    distance = np.hypot(x, z) if second.size else z
    if np.any(distance <= touching(pair)):
        raise ValueError("the bodies still touch at the end")
    return Outcomes(vz, vx, 0.0 - first[:, 4])


def template(name: str) -> Template:
    """Return a template of inputs."""
    path = DATA / "engines" / name
    return Template(path.read_text(encoding="utf-8"))


def filled(name: str, experiment: Experiment, **words: Any) -> str:
    """Return a template with what any input says of an experiment, and with more words."""
    return template(name).substitute(shared_values(experiment), **words)


def shared_values(experiment: Experiment) -> dict[str, str]:
    """Return what any input says, by the names that templates have for it."""
    pair, two = experiment.pair, isinstance(experiment.pair.second, Sphere)
    point = "vx1 - R1 omegay1 - vx2 - R2 omegay2" if two else "vx - R omegay"
    overlap = experiment.scales.length / pair.first.radius
    return {
        "bodies": "two spheres" if two else "a sphere on a flat wall",
        "law": f"{experiment.law.name}, {experiment.law!r}",
        "impact": (
            f"# z is the normal of the contacts, x their tangential direction. Contact point:\n"
            f"# V_x = {point}; psi = kappa V_x/(mu V_1), kappa = G*/E* = {pair.kappa:.6g},\n"
            f"# mu = {pair.friction:.6g}, V_1 = {experiment.normal_speed:.6g} m/s; "
            f"chi = {pair.chi:.6g}.\n"
            f"# The largest overlap of an elastic impact is {overlap:.2g} radii."
        ),
        "count": str(len(experiment)),
        "steps": str(experiment.steps),
        "duration": f"{experiment.duration:.6g}",
        "time_step": repr(experiment.time_step),
        "run": str(run_length(experiment)),
        "skin": f"{SKIN * spacing(pair):.6g}",
    }


def data_file(experiment: Experiment) -> str:
    """Return the data file: where the spheres are, and their velocities; type 1 or 2 for body."""
    bodies, edge = placed(experiment), spacing(experiment.pair)
    sections = (
        "# Spheres that are about to touch; the second bodies follow in the order of the first.\n"
        "# Atoms: id, type, diameter, density, x, y, z. Velocities: id, vx, vy, vz, omega",
        f"{len(bodies)} atoms\n2 atom types\n"
        f"{-edge!r} {edge!r} xlo xhi\n"
        f"{-edge!r} {edge * len(experiment)!r} ylo yhi\n"
        f"{-edge!r} {edge!r} zlo zhi",
        "Atoms",
        "\n".join(_atom(i, body, len(experiment)) for i, body in enumerate(bodies)),
        "Velocities",
        "\n".join(
            f"{i} {body.vx!r} 0.0 {body.vz!r} 0.0 {0.0 - body.spin!r} 0.0"
            for i, body in enumerate(bodies, 1)
        ),
    )
    return "\n\n".join(sections) + "\n"


def read_dump(path: Path) -> Array:
    """Return x, z, vx, vz, omega_y of each sphere at the end of a dump that has them after ids."""
    _, _, table = path.read_text(encoding="utf-8").rpartition(TABLE_HEAD)
    rows = [line.split()[1:] for line in table.splitlines()[1:]]
    return np.array(rows, dtype=np.float64).reshape(-1, 5)


def _atom(index: int, body: Placed, count: int) -> str:
    size, density = 2.0 * body.sphere.radius, body.sphere.material.density
    kind = 1 if index < count else 2
    return f"{index + 1} {kind} {size!r} {density!r} 0.0 {body.y!r} {body.z!r}"
