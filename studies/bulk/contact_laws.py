"""The contact laws that the study compares, as LAMMPS is told them.

Units: mass and diameter of a sphere and Young's modulus are 1. All spheres are alike, nu = 0.3.
"""

from math import sqrt
from typing import NamedTuple

POISSON = 0.3
KAPPA = (2 - 2 * POISSON) / (2 - POISSON)  # tangential over normal stiffness of a contact
MODULUS = 1 / (2 * (1 - POISSON**2))  # E*
RADIUS = 0.25  # R* of two spheres


class Setting(NamedTuple):
    """What all laws of a comparison share.

    `speed` is that at which spheres rebound with the restitution; `spring` is the stiffness of
    linear springs.
    """

    friction: float
    restitution: float
    speed: float
    spring: float


def secant(depth: float) -> float:
    """Return force over overlap of Hertz's contact of two spheres."""
    return 4 / 3 * MODULUS * sqrt(RADIUS * depth)


def overlap(speed: float) -> float:
    """Return the largest overlap of two spheres that meet at a speed V (Hertz).

    (15 m V^2/(16 E* R*^(1/2)))^(2/5), m = 1/2.
    """
    return (15 / 32 * speed**2 / (MODULUS * sqrt(RADIUS))) ** 0.4


def duration(speed: float) -> float:
    """Return the duration of the impact of two spheres that meet at this speed (Hertz)."""
    return 2.94327518432470 * overlap(speed) / speed


class Law(NamedTuple):
    """A contact law: what tables call it, and its tangential model in LAMMPS."""

    name: str
    model: str
    stiffness: float = 1.0  # of that which the model stands for

    @property
    def linear(self) -> bool:
        """Whether its springs are linear, the normal ones, too."""
        return self.model == "linear_history"


EXACT = Law("exact", "carom springs 32")
FINER = Law("exact 64", "carom springs 64")  # only to see whether 32 are enough
LAWS = (
    EXACT,
    Law("mindlin", "mindlin"),
    Law("mindlin_rescale/force", "mindlin_rescale/force"),
    Law("0.78 k_t", "mindlin_rescale/force", 0.78),
    Law("linear kappa", "linear_history", KAPPA),
    Law("linear 2/7", "linear_history", 2 / 7),
)
SHEAR = 2 * KAPPA * MODULUS  # F_t = SHEAR a U


def named(name: str) -> Law:
    """Return the law of this name."""
    return next(law for law in (*LAWS, FINER) if law.name == name)


def _granular(law: Law, setting: Setting) -> str:
    damping, loss = ("coeff_restitution", setting.restitution)
    if setting.restitution == 1.0:
        damping, loss = "velocity", 0.0
    if law.linear:
        normal, tangential = f"hooke {setting.spring!r}", law.stiffness * setting.spring
    else:
        normal, tangential = f"hertz {4 / 3 * MODULUS!r}", law.stiffness * SHEAR
    shear = f"tangential {law.model} {tangential!r} 1.0 {setting.friction!r}"
    return f"{normal} {loss!r} {shear} damping {damping}"


def _exact(setting: Setting) -> str:
    losses = f" restitution {setting.restitution!r} speed {setting.speed!r}"
    words = f"young 1.0 poisson {POISSON!r} friction {setting.friction!r}"
    return words + (losses if setting.restitution < 1.0 else "")


def pairs(law: Law, setting: Setting) -> str:
    """Return the lines of an input for contacts between spheres."""
    if law in (EXACT, FINER):
        return f"pair_style {law.model}\npair_coeff * * {_exact(setting)}"
    return f"pair_style granular\npair_coeff * * {_granular(law, setting)}"
