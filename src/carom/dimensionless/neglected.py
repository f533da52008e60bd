"""Bounds on the error of psi_2 by what the theory neglects, and where they are known.

Envelopes of full solutions, fitted, not proved: by boundary elements (studies/halfspace_study.csv),
and of walls with all their waves (studies/wall_waves.csv).
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
SMALL_CONTACT = 0.1  # a_max/R*: Hertz's parabolic gap against the sphere (Johnson 1985, 4.2)
NO_BETA = 1e-9  # of Dundurs' beta: as good as none, so that friction drops out
RANGE_ROUNDING = 1e-9
FARTHEST_BEYOND = 10.0  # beyond sliding, psi_1 - 4 chi + 1
LATERAL, RADIAL, COUPLED, TIED = 0.011, 0.28, 0.6, 0.34
TURNED = 1.45
ALONG, SHEARED, RADIATED = 0.25, 1.2, 1.05


def not_studied(kappa: float, beta: float, friction: float, chi: float) -> str:
    """Return a sentence on the parameter that lies outside the study of the bounds, or nothing."""
    studied = [("chi", chi, CHI), ("kappa", kappa, KAPPA)]
    if abs(beta) > NO_BETA and friction > 0.0:
        studied += [("Dundurs' beta", beta, BETA), ("friction", friction, FRICTION)]
        studied += [("Dundurs' beta over friction", abs(beta) / friction, RATIO)]
    for name, value, (least, most) in studied:
        slack = RANGE_ROUNDING * max(abs(least), abs(most))
        if not least - slack <= value <= most + slack:
            return f"{name} of {value:.3g} is outside {least:.3g} to {most:.3g}"
    return ""


def rebound_error(kappa: float, beta: float, friction: float, chi: float, psi: Any) -> Any:
    """Return a bound on the difference of psi_2 between the theory and the full contact.

    w [0.011 chi nu^2 + sqrt(chi) (0.28 B^2/(1 + B) + 0.6 beta^2)] + t B/(1 + B), B = |beta|/mu, nu
    of like materials of the same kappa, w = min(1, 2 psi)/(1 + e)^2, e what psi, its sign left out,
    exceeds 4 chi - 1 by, 10 at most, t = 0.34 exp(1 - 2 chi) max(0, 1 - 2 |psi - 1|); 2 psi at
    most. The terms are slip off the motion, radial slip, elastic coupling, and the tie of stick and
    slip at psi = 1, where a little coupling decides if chi is small. psi may be an array, friction
    is not zero; `not_studied` tells where the bound was never compared with full solutions.
    """
    psi, ratio = np.abs(psi), abs(beta) / friction
    held = ratio / (1.0 + ratio)
    coupling = np.sqrt(chi) * (RADIAL * ratio * held + COUPLED * beta**2)
    size = LATERAL * chi * poisson(kappa) ** 2 + coupling
    beyond = 1.0 + beyond_sliding(chi, psi)
    tie = TIED * np.exp(1.0 - 2.0 * chi) * held * np.maximum(1.0 - 2.0 * np.abs(psi - 1.0), 0.0)
    return np.minimum(size * np.minimum(1.0, 2.0 * psi) / beyond**2 + tie, 2.0 * psi)


def spin_error(chi: float, psi: Any, spin: Any) -> Any:
    """Return a bound on the change of psi_2 by spin about the normal.

    1.45 sqrt(max(1, chi)) tau min(1, 2 psi) min(1, (1 + tau)/(1 + e))^2, tau = omega_n a_max/(mu
    V_1), signs left out, e as in `rebound_error`; 2 psi at most. psi and spin may be arrays.
    """
    psi, spin = np.abs(psi), np.abs(spin)
    along = np.minimum(1.0, (1.0 + spin) / (1.0 + beyond_sliding(chi, psi))) ** 2
    size = TURNED * max(1.0, chi) ** 0.5 * spin
    return np.minimum(size * np.minimum(1.0, 2.0 * psi) * along, 2.0 * psi)


def plate_error(chi: float, psi: Any, size: Any, sheared: Any) -> Any:
    """Return a bound on the error of psi_2 on a thin plate by the waves that are no bending waves.

    (0.25 a/h + 2.4 chi s) min(1, 2 psi), with the largest radius of the contact over the
    thickness, a/h, and s by which e comes out too high as the plate also shears. The plate gives
    way along itself, which is of order a/h; where the contact slides throughout, the error is 2 chi
    times that of e.
    """
    whole = ALONG * size + 2.0 * SHEARED * chi * sheared
    return whole * np.minimum(1.0, 2.0 * np.abs(psi))


def wave_error(chi: float, psi: Any, share: Any) -> Any:
    """Return a bound on the change of psi_2 by waves in a thick wall that take this share.

    1.05 chi min(1, 0.8 psi) times the share of the energy; it is chi times it where the contact
    slides throughout, as e is smaller by half of the share.
    """
    return RADIATED * chi * share * np.minimum(1.0, 0.8 * np.abs(psi))


def beyond_sliding(chi: Any, psi: Any) -> Any:
    """Return psi less the border of sliding as far as studied: slip farther out is along x."""
    return np.clip(psi - np.maximum(4.0 * chi - 1.0, 1.0), 0.0, FARTHEST_BEYOND)


def poisson(kappa: float) -> float:
    """Return Poisson's ratio of like materials of this kappa."""
    return 2.0 * (1.0 - kappa) / (2.0 - kappa)
