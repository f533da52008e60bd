"""Damping for a wanted restitution, as the codes define it."""

from math import expm1, log, log1p, pi, sqrt
from typing import Any

from carom.dem.coefficients import SPRING
from carom.quantities.units import within

COEFF_RESTITUTION, TSUJI = "coeff_restitution", "tsuji"
RULES = (COEFF_RESTITUTION, TSUJI)
SMALLEST = 1e-6  # restitution


def damped_restitution(name: str, value: Any) -> float:
    """Return a restitution that a damping is made for, or raise InputError."""
    return within(name, value, SMALLEST, 1.0, "1")


def damping_ratio(restitution: float) -> float:
    """Return the part of critical damping that leaves a restitution e: -ln e/sqrt(pi^2 + ln^2 e).

    Exact for a linear spring and, with a damping that grows as d^(1/4), for Hertz's contact as
    well, if the contact ends where the penetration does (Antypov & Elliott 2011).
    """
    loss = -log(restitution)
    return loss / sqrt(pi**2 + loss**2)


def tsuji_damping(restitution: float) -> float:
    """Return alpha of Tsuji, Tanaka & Ishida (1992), a polynomial of LAMMPS's documentation."""
    coefficients = (1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218)
    return sum(value * restitution**power for power, value in enumerate(coefficients))


def thornton_damping(restitution: float) -> float:
    """Return the part of critical damping that leaves e where Hertz's contact ends without force.

    The damping is 2 beta sqrt(m_n k) v, k = 2 E* a the tangent stiffness; beta = sqrt(1/(1 - (1 +
    e)^2 exp A) - 1), A a polynomial fit: Thornton, Cummins & Cleary (2013), (B6), (B7). What it
    leaves is e to 1e-4 where e <= 0.9; near 1 it damps too much, 0.979 is left for 0.99.
    """
    if restitution == 1.0:
        return 0.0
    fit = (
        *(-6.918798, -16.41105, 146.8049, -796.4559, 2928.711),
        *(-7206.864, 11494.29, -11342.18, 6276.757, -1489.915),
    )
    exponent = sum(value * restitution**power for power, value in enumerate(fit, 1))
    return 1.0 / sqrt(expm1(-exponent - 2.0 * log1p(restitution)))  # nothing is taken from one


def hertz_damping(restitution: float, rule: str = COEFF_RESTITUTION) -> float:
    """Return c of the damping c d^(1/4) v of Hertz's contact, in its units; none for e = 1."""
    if restitution == 1.0:
        return 0.0
    if rule == TSUJI:
        return sqrt(SPRING) * tsuji_damping(restitution)
    return 2.0 * damping_ratio(restitution)
