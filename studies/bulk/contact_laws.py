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

    `speed` is that at which spheres rebound with the restitution, `spring` the stiffness of linear
    springs, `springs` the number of those of the exact law.
    """

    friction: float
    restitution: float
    speed: float
    spring: float
    springs: int = 16


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


EXACT = Law("exact", "carom")
COARSE = Law("16 springs", "carom")  # only to see whether 16 are enough
BESIDE = Law("beside granular", "hybrid/overlay granular carom part tangential")
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
    return next(law for law in (*LAWS, COARSE, BESIDE) if law.name == name)


def _granular(law: Law, setting: Setting) -> str:
    damping, loss = ("coeff_restitution", setting.restitution)
    if setting.restitution == 1.0:
        damping, loss = "velocity", 0.0
    if law.linear:
        normal, tangential = f"hooke {setting.spring!r}", law.stiffness * setting.spring
    else:
        normal, tangential = f"hertz {4 / 3 * MODULUS!r}", law.stiffness * SHEAR
    shear = f"tangential {law.model} {tangential!r} 1.0 {setting.friction!r}"
    if law == BESIDE:
        shear = f"tangential linear_nohistory 0.0 {setting.friction!r}"
    return f"{normal} {loss!r} {shear} damping {damping}"


def pairs(law: Law, setting: Setting) -> str:
    """Return the lines of an input for contacts between spheres."""
    exact = f"young 1.0 poisson {POISSON!r} friction {setting.friction!r}"
    style = f"pair_style {law.model} springs {setting.springs}\n"
    if law == BESIDE:
        granular = f"pair_coeff * * granular {_granular(law, setting)}\n"
        return f"{style}{granular}pair_coeff * * carom {exact}"
    if law in (EXACT, COARSE):
        if setting.restitution < 1.0:
            exact += f" restitution {setting.restitution!r} speed {setting.speed!r}"
        return f"{style}pair_coeff * * {exact}"
    return f"pair_style granular\npair_coeff * * {_granular(law, setting)}"
