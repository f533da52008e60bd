"""Elastic contact laws of DEM codes by plain integrals, in units of Hertz's impact."""

import numpy as np


def linear_springs(ratios, psi, chi, count=3000):
    """Return psi_2, (ratios, psi), of two linear springs of k_t/(k_n kappa), by the midpoint rule.

    With k_n d_max^2 = m V_1^2 the contact is d = sin t, N = 0.8 sin t, 0 < t < pi; psi' =
    -(5/2) chi T, T' = 0.8 (k_t/k_n)/kappa psi, |T| <= N.
    """
    velocity = np.tile(psi, (len(ratios), 1))
    stiffness = 0.8 * np.array(ratios)[:, np.newaxis]
    step, force = np.pi / count, np.zeros_like(velocity)
    for limit in 0.8 * np.sin(step * np.arange(1, count + 1)):
        velocity = velocity - 1.25 * step * chi * force
        force = np.clip(force + stiffness * step * velocity, -limit, limit)
        velocity = velocity - 1.25 * step * chi * force
    return velocity


def spring_force(psi, chi, count=40_000):
    """Return equal parts of the duration, T/(mu P_max) of two linear springs, by the midpoint rule.

    With k_n d_max^2 = m V_1^2 the contact is d = sin t, N = 0.8 sin t, 0 < t < pi.
    """
    time = np.linspace(0.0, np.pi, count + 1)
    step, force, forces = time[1], 0.0, [0.0]
    for limit in 0.8 * np.sin(time[1:]):
        middle = psi - 0.5 * step * 2.5 * chi * force
        force = max(-limit, min(limit, force + 0.8 * step * middle))
        psi -= step * 2.5 * chi * 0.5 * (forces[-1] + force)
        forces.append(force)
    return time / np.pi, np.array(forces)


def mindlin_out(psi, chi, count=20_000):
    """Return psi_2 of F_t = k_t(a) U, |F_t| <= mu F_n, by an own integral: symplectic Euler.

    In units of Hertz's impact: d'' = -(5/4) d^(3/2), psi' = -(5/2) chi T, T = (3/2) sqrt(d) U.
    """
    depth, speed, spring, step = 0.0, 1.0, 0.0, 3.0 / count
    while depth >= 0.0:
        limit = depth**1.5
        force = 1.5 * depth**0.5 * spring
        if abs(force) > limit:
            force = limit if force > 0.0 else -limit
            spring = force / (1.5 * depth**0.5)
        speed -= step * 1.25 * limit
        psi -= step * 2.5 * chi * force
        depth += step * speed
        spring += step * psi
    return psi
