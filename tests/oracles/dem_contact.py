"""A steel sphere on a steel half-space in SI units: what the twins of DEM codes share."""

import numpy as np

YOUNG, POISSON, DENSITY, RADIUS, FRICTION, SPEED = 210e9, 0.3, 7850.0, 5e-3, 0.2, 0.5
MASS = DENSITY * 4 / 3 * np.pi * RADIUS**3
E_STAR = YOUNG / (2 * (1 - POISSON**2))
G_EFF = YOUNG / (2 * (1 + POISSON)) / (2 * (2 - POISSON))  # of LAMMPS and LIGGGHTS
KAPPA = 4 * G_EFF / E_STAR
CHI = KAPPA / 2 * 3.5  # solid sphere: m_n/m_t = 1 + m R^2/I
HERTZ = 4 / 3 * E_STAR * np.sqrt(RADIUS)
DEEPEST = (1.25 * MASS * SPEED**2 / HERTZ) ** 0.4
DURATION = 2.94327518432470 * DEEPEST / SPEED
SLOWEST = FRICTION * SPEED / KAPPA  # V_x of psi = 1
LEAST = 1e-9  # penetration at both ends, in units of the deepest


def damping_ratio(e):
    """Return what a dashpot must be to leave a restitution, over critical."""
    return -np.log(e) / np.sqrt(np.pi**2 + np.log(e) ** 2)
