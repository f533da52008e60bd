"""What the theory leaves out: how far it may turn psi_2, and where that is known.

Envelopes of full solutions by boundary elements, studies/halfspace_study.csv; fitted, not proved.
"""

from typing import Any, NamedTuple

import numpy as np


class Studied(NamedTuple):
    """The least and the largest value of a parameter in the study."""

    least: float
    most: float


CHI, KAPPA = Studied(0.3, 8.0), Studied(2.0 / 3.0, 1.2)  # Poisson's ratio 0.5 to -0.5
BETA, FRICTION, RATIO = Studied(-0.5, 0.5), Studied(0.02, 1.0), Studied(0.0, 10.0)
SPIN = Studied(0.0, 20.0)
LIKE = 1e-9  # of Dundurs' beta: as good as none, so that friction drops out
ROUNDING = 1e-9
LATERAL, RADIAL, COUPLED, TIED = 0.011, 0.32, 1.8, 0.12
TURNED = 1.5


def not_studied(kappa: float, beta: float, friction: float, chi: float) -> str:
    """Return which parameter lies outside the study of the bounds, in words; empty if none does."""
    known = [("chi", chi, CHI), ("kappa", kappa, KAPPA)]
    if abs(beta) > LIKE:
        known += [("Dundurs' beta", beta, BETA), ("friction", friction, FRICTION)]
        known += [("Dundurs' beta over friction", abs(beta) / friction, RATIO)]
    for name, value, (least, most) in known:
        slack = ROUNDING * max(abs(least), abs(most))
        if not least - slack <= value <= most + slack:
            return f"{name} of {value:.3g} is outside {least:.3g} to {most:.3g}"
    return ""


def rebound_error(kappa: float, beta: float, friction: float, chi: float, psi: Any) -> Any:
    """Return how far psi_2 of the theory may be from that of the full contact.

    w [0.011 chi nu^2 + 0.32 chi^(1/4) B^2/(1 + B) + 1.8 beta^2] + 0.12 max(0, 1 - 2 |psi - 1|) B/(1 +
    B), with B = |beta|/mu, nu of like materials of the same kappa, w = min(1, 2 psi)/(1 + e)^2, e
    what psi, its sign left out, exceeds 4 chi - 1 by; 2 psi at most. The terms are slip off the
    motion, radial slip, elastic coupling, and the tie of stick and slip at psi = 1, where a little
    coupling decides. psi is a number or an array, friction not zero; `not_studied` tells where the
    bound was never compared with full solutions.
    """
    psi, ratio = np.abs(psi), abs(beta) / friction
    size = LATERAL * chi * poisson(kappa) ** 2 + COUPLED * beta**2
    held = ratio / (1.0 + ratio)
    size += RADIAL * chi**0.25 * ratio * held
    beyond = 1.0 + np.maximum(psi - max(4.0 * chi - 1.0, 1.0), 0.0)
    tie = TIED * held * np.maximum(1.0 - 2.0 * np.abs(psi - 1.0), 0.0)
    return np.minimum(size * np.minimum(1.0, 2.0 * psi) / beyond**2 + tie, 2.0 * psi)


def spin_error(chi: float, psi: Any, spin: Any) -> Any:
    """Return how far spin about the normal may turn psi_2; arrays, or numbers."""
    return np.minimum(TURNED * np.abs(spin), 2.0 * np.abs(psi))


def poisson(kappa: float) -> float:
    """Return Poisson's ratio of like materials of this kappa."""
    return 2.0 * (1.0 - kappa) / (2.0 - kappa)
