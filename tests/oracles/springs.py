"""Contact laws of DEM codes, and springs in shear along a path, by plain integrals."""

import numpy as np
from scipy.integrate import solve_ivp


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


def damped_rebound(damping_of, power, pulls=True):
    """Return -v_2/v_1 of d'' = -d^power - c(d) d', the end where d, or the force, vanishes."""

    def force(d, v):
        return max(d, 0.0) ** power + damping_of(max(d, 0.0)) * v

    def end(_, y):
        return y[0] if pulls else force(*y)

    end.terminal, end.direction = True, -1.0
    start = [1e-9, 1.0]
    done = solve_ivp(
        lambda _, y: [y[1], -force(*y)], (0.0, 1e3), start, events=end, rtol=1e-10, atol=1e-12
    )
    return -done.y[1, -1]


def along_a_path(d, u, s, parts):
    """q of springs at s, each clamped to Coulomb's limits after each small part of a step."""
    a, touching, old = np.zeros(s.size), np.zeros(s.size, dtype=bool), (0.0, 0.0)
    for new in zip(d, u, strict=True):
        for k in range(parts):
            d0, d1 = (old[0] + (new[0] - old[0]) * i / parts for i in (k, k + 1))
            u0, u1 = (old[1] + (new[1] - old[1]) * i / parts for i in (k, k + 1))
            met = (s < d1) & ~touching
            if met.any():
                a[met] = s[met] - u0 - (u1 - u0) * (s[met] - d0) / (d1 - d0)
            touching = s < d1
            a = np.where(touching, np.clip(a, 2 * s - d1 - u1, d1 - u1), a)
        old = new
    return np.where(touching, a - s + u1, 0.0)
