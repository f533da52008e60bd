"""Contact laws in fixed steps, as LAMMPS and LIGGGHTS take them, in SI units.

Velocity Verlet; forces from the positions and the velocities of the half step (pair_style granular;
gran model hertz tangential history), written from their documentation for a sphere on a wall.
"""

import numpy as np

from tests.oracles.dem_contact import (
    DURATION,
    E_STAR,
    FRICTION,
    G_EFF,
    HERTZ,
    MASS,
    RADIUS,
    SLOWEST,
    SPEED,
    damping_ratio,
)

E = 0.7
BETA = damping_ratio(E)
K_LINEAR = MASS * (3.3 / DURATION) ** 2


class Lammps:
    """Hertz, mindlin of a variant, x_gamma; damping coeff_restitution."""

    def __init__(self, variant, gamma=0.0, damped=False):
        self.force, self.rescale = "force" in variant, "rescale" in variant
        self.gamma, self.damped = gamma, damped
        self.history, self.widest = 0.0, 0.0

    def forces(self, d, v, w, dt):
        a = np.sqrt(RADIUS * d)
        # sqrt(m dF/dd), as LAMMPS has it for coeff_restitution
        damp = np.sqrt(MASS * 2 * E_STAR * a) * 2 * np.sqrt(5 / 6) * BETA if self.damped else 0.0
        normal = HERTZ * d**1.5 + damp * v
        stiffness, damp = 8 * G_EFF * a, self.gamma * damp
        if self.rescale and a < self.widest:
            self.history *= a / self.widest
        self.widest = a
        self.history += stiffness * w * dt if self.force else w * dt
        force = (self.history if self.force else stiffness * self.history) + damp * w
        if abs(force) > FRICTION * abs(normal):
            force = np.copysign(FRICTION * abs(normal), force)
            self.history = force - damp * w
            if not self.force:
                self.history /= stiffness
        return normal, force


class Liggghts:
    """Hertz with tangential history; EDEM's if it is the sum that is limited."""

    def __init__(self, limits_sum):
        self.limits_sum, self.history = limits_sum, 0.0

    def forces(self, d, v, w, dt):
        a = np.sqrt(RADIUS * d)
        s_n, s_t = 2 * E_STAR * a, 8 * G_EFF * a
        normal = HERTZ * d**1.5 + 2 * np.sqrt(5 / 6) * BETA * np.sqrt(s_n * MASS) * v
        self.history += w * dt
        damping = 2 * np.sqrt(5 / 6) * BETA * np.sqrt(s_t * MASS) * w
        limited = s_t * self.history + (damping if self.limits_sum else 0.0)
        limit = FRICTION * abs(normal)
        if abs(limited) <= limit:
            return normal, s_t * self.history + damping
        force = np.copysign(limit, limited)
        self.history = (force - damping if self.limits_sum else force) / s_t
        return normal, force


class Springs:
    """Linear springs and dashpots; or, while unloading, a spring that is stiffer by 1/e^2."""

    def __init__(self, ratio, gamma=0.0, damped=False, bilinear=False):
        self.ratio, self.gamma, self.damped, self.bilinear = ratio, gamma, damped, bilinear
        self.history, self.deepest, self.over = 0.0, 0.0, False

    def forces(self, d, v, w, dt):
        damp = 2 * BETA * np.sqrt(MASS * K_LINEAR) if self.damped else 0.0
        normal = K_LINEAR * d + damp * v
        if self.bilinear and d < self.deepest:
            normal = K_LINEAR * (self.deepest - (self.deepest - d) / E**2)
            self.over = normal <= 0.0
        self.deepest = max(self.deepest, d)
        stiffness = self.ratio * K_LINEAR
        self.history += w * dt
        force = stiffness * self.history + self.gamma * damp * w
        if abs(force) > FRICTION * abs(normal):
            force = np.copysign(FRICTION * abs(normal), force)
            self.history = (force - self.gamma * damp * w) / stiffness
        return normal, force


def rebound(code, psi, steps, duration=DURATION):
    dt, d, v, w, normal, force = duration / steps, 0.0, SPEED, psi * SLOWEST, 0.0, 0.0
    while True:
        v -= 0.5 * dt * normal / MASS
        w -= 0.5 * dt * 3.5 * force / MASS
        d += dt * v
        if d <= 0.0:
            return w / SLOWEST
        normal, force = code.forces(d, v, w, dt)
        if getattr(code, "over", False):
            return w / SLOWEST
        v -= 0.5 * dt * normal / MASS
        w -= 0.5 * dt * 3.5 * force / MASS
