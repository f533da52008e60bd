"""Spheres as LAMMPS and LIGGGHTS, its descendant, read and write them: data files and dumps."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from carom.verify.engines.arrangement import Placed, placed, spacing
from carom.verify.engines.experiments import Experiment

Array = NDArray[np.float64]

TABLE = "ITEM: ATOMS"  # what stands above the last table of a dump


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
        "\n".join(_velocity(i, body) for i, body in enumerate(bodies, 1)),
    )
    return "\n\n".join(sections) + "\n"


def read_dump(path: Path) -> Array:
    """Return x, z, vx, vz, omega_y of each sphere at the end of a dump that has them after ids."""
    _, _, table = path.read_text(encoding="utf-8").rpartition(TABLE)
    rows = [line.split()[1:] for line in table.splitlines()[1:]]
    return np.array(rows, dtype=np.float64).reshape(-1, 5)


def _atom(index: int, body: Placed, count: int) -> str:
    size, density = 2.0 * body.sphere.radius, body.sphere.material.density
    kind = 1 if index < count else 2
    return f"{index + 1} {kind} {size!r} {density!r} 0.0 {body.y!r} {body.z!r}"


def _velocity(number: int, body: Placed) -> str:
    return f"{number} {body.vx!r} 0.0 {body.vz!r} 0.0 {0.0 - body.spin!r} 0.0"
