"""A law in fixed steps is what its code does, step for step, in SI units.

Velocity Verlet; forces from the positions and the velocities of the half step, as LAMMPS and
LIGGGHTS have them (pair_style granular; gran model hertz tangential history), written from their
documentation for a sphere on a wall.
"""

import numpy as np
import pytest

import carom

YOUNG, POISSON, DENSITY, RADIUS, FRICTION, SPEED = 70e9, 0.25, 2500.0, 1e-3, 0.3, 0.1
MASS = DENSITY * 4 / 3 * np.pi * RADIUS**3
E_EFF = YOUNG / (2 * (1 - POISSON**2))
G_EFF = YOUNG / (2 * (1 + POISSON)) / (2 * (2 - POISSON))
KAPPA = 4 * G_EFF / E_EFF
CHI = KAPPA / 2 * 3.5
HERTZ = 4 / 3 * E_EFF * np.sqrt(RADIUS)
DURATION = 2.94327518432470 * (1.25 * MASS * SPEED**2 / HERTZ) ** 0.4 / SPEED
E = 0.7
BETA = -np.log(E) / np.sqrt(np.pi**2 + np.log(E) ** 2)
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
        damp = np.sqrt(MASS * 2 * E_EFF * a) * 2 * np.sqrt(5 / 6) * BETA if self.damped else 0.0
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
        s_n, s_t = 2 * E_EFF * a, 8 * G_EFF * a
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
    unit = FRICTION * SPEED / KAPPA
    dt, d, v, w, normal, force = duration / steps, 0.0, SPEED, psi * unit, 0.0, 0.0
    while True:
        v -= 0.5 * dt * normal / MASS
        w -= 0.5 * dt * 3.5 * force / MASS
        d += dt * v
        if d <= 0.0:
            return w / unit
        normal, force = code.forces(d, v, w, dt)
        if getattr(code, "over", False):
            return w / unit
        v -= 0.5 * dt * normal / MASS
        w -= 0.5 * dt * 3.5 * force / MASS


VARIANTS = ("mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")
OF_HERTZ = [
    *((carom.dem.LammpsMindlin(name), lambda name=name: Lammps(name)) for name in VARIANTS),
    *(
        (
            carom.dem.LammpsMindlin(name, restitution=E, tangential_damping=0.6),
            lambda name=name: Lammps(name, 0.6, damped=True),
        )
        for name in VARIANTS
    ),
    (carom.dem.LiggghtsHertz(E), lambda: Liggghts(limits_sum=False)),
    (carom.dem.EdemHertzMindlin(E), lambda: Liggghts(limits_sum=True)),
]
OF_SPRINGS = [
    (carom.dem.LinearSpring(0.4), lambda: Springs(0.4)),
    (carom.dem.LinearSpring(0.4, E, 0.5), lambda: Springs(0.4, 0.5, damped=True)),
    (carom.dem.StrongeLaw(0.9, E), lambda: Springs(0.9, bilinear=True)),
]
PSI = (0.2, 0.7, 1.1, 2.5, 4.5)


@pytest.mark.parametrize("steps", [20, 57])
@pytest.mark.parametrize(("law", "code"), OF_HERTZ, ids=[str(law) for law, _ in OF_HERTZ])
def test_steps_are_those_of_the_code(law, code, steps):
    expected = [rebound(code(), psi, steps) for psi in PSI]
    found = law.rebound(PSI, CHI, kappa=KAPPA, steps=steps)
    assert np.allclose(found, expected, rtol=0.0, atol=1e-11)


@pytest.mark.parametrize(("law", "code"), OF_SPRINGS, ids=[str(law) for law, _ in OF_SPRINGS])
def test_steps_of_springs(law, code):
    """A linear contact as deep as Hertz's lasts pi, where Hertz's lasts 2.943."""
    duration = np.sqrt(MASS / K_LINEAR) * 2.94327518432470
    expected = [rebound(code(), psi, 50, duration) for psi in PSI]
    found = law.rebound(PSI, CHI, kappa=KAPPA, steps=50)
    assert np.allclose(found, expected, rtol=0.0, atol=1e-11)
