"""The exact contact law as the plugin has it in LAMMPS: its lines in an input script."""

from carom.adapters import lammps
from carom.bodies.shapes import Sphere
from carom.dem import ExactContactLaw
from carom.dem.base import ContactLaw
from carom.verify.engines.experiments import Experiment

SPRINGS = (16, 32, 64)
ON_WALL = """\
region          wall plane 0.0 0.0 0.0 0.0 0.0 1.0
fix             contact all wall/carom {words} region wall"""


def supports(law: ContactLaw) -> bool:
    """Tell whether the plugin has this law; only where it has been built."""
    fits = isinstance(law, ExactContactLaw) and law.springs in SPRINGS and law.viscous_shear
    return fits and (lammps.folder(lammps.wheel_version()) / lammps.NAME).exists()


def lines(experiment: Experiment) -> str:
    """Return what the script says of the law: like bodies with the E* and kappa of the pair.

    kappa = 2 (1 - nu)/(2 - nu), E = 2 (1 - nu^2) E*.
    """
    law, pair = experiment.law, experiment.pair
    assert isinstance(law, ExactContactLaw)
    poisson = (2.0 - 2.0 * pair.kappa) / (2.0 - pair.kappa)
    young = 2.0 * (1.0 - poisson**2) * pair.effective_modulus
    words = f"young {young!r} poisson {poisson!r} friction {pair.friction!r}"
    if law.restitution < 1.0:
        from carom.dimensionless.lossy.panels.stages import viscous_loss

        words += f" retardation {viscous_loss(law.restitution) * experiment.scales.time!r}"
    style = f"pair_style      carom springs {law.springs} precision double\n"
    coeff = f"pair_coeff      * * {words}"
    on_wall = "" if isinstance(pair.second, Sphere) else "\n" + ON_WALL.format(words=words)
    return f"# Law: {law.name}, {law.springs} of them\n{style}{coeff}{on_wall}"
