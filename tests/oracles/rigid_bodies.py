"""Rigid bodies in collision, by Newton's and Euler's equations for each of them."""

from math import atan, hypot, pi

import numpy as np

NAMES = ("velocity1", "spin1", "velocity2", "spin2")


def inertia(body):
    """Return radius, mass and moment of inertia, by volume integrals of shells of radius r."""
    if not hasattr(body, "inner_radius"):  # a wall
        return 0.0, np.inf, np.inf
    outer, inner, density = body.radius, body.inner_radius, body.material.density
    mass = 4.0 * pi * density * (outer**3 - inner**3) / 3.0
    if body.gyration_radius is not None:
        return outer, mass, mass * body.gyration_radius**2
    return outer, mass, 8.0 * pi / 3.0 * density * (outer**5 - inner**5) / 5.0


def cross_matrix(r):
    return np.array([[0.0, -r[2], r[1]], [r[2], 0.0, -r[0]], [-r[1], r[0], 0.0]])


def collided(pair, tangential, normal, restitution=1.0, **motion):
    """Return motions after one collision: J from the 3 x 3 compliance of the contact points.

    `tangential(V_t, V_n, compliance ratio)` returns V_t' of the contact points.
    """
    (radius1, mass1, moment1), (radius2, mass2, moment2) = inertia(pair.first), inertia(pair.second)
    v1, w1, v2 = (motion[name] for name in NAMES[:3])
    w2 = motion.get("spin2", np.zeros(3))
    arm1, arm2 = radius1 * normal, -radius2 * normal
    V = v1 + np.cross(w1, arm1) - v2 - np.cross(w2, arm2)
    closing = V @ normal
    sliding = V - closing * normal
    compliance = np.eye(3) * (1.0 / mass1 + 1.0 / mass2)
    for arm, moment in ((arm1, moment1), (arm2, moment2)):
        compliance -= cross_matrix(arm) @ cross_matrix(arm) / moment
    ratio = np.trace(compliance) / 2.0 - (along := normal @ compliance @ normal) / 2.0
    out = tangential(sliding, closing, ratio / along) - restitution * closing * normal
    J = np.linalg.solve(compliance, V - out)
    spin1, spin2 = w1 + np.cross(arm1, -J) / moment1, w2 + np.cross(arm2, J) / moment2
    return v1 - J / mass1, spin1, v2 + J / mass2, spin2


def walton(friction, beta, restitution):
    """Return V_t' of Walton's law, as a force balance: stick if Coulomb's law allows."""

    def tangential(sliding, closing, ratio):
        speed = np.linalg.norm(sliding)
        slowed = friction * (1.0 + restitution) * closing * ratio
        return sliding * (-beta if speed * (1.0 + beta) <= slowed else 1.0 - slowed / speed)

    return tangential


def followed(pair, motion, impulse, restitution):
    """Return all quantities from the motion of each body in the laboratory, second body included.

    The first body lies above the plane z = 0 of the contact and falls; the impulse on it is
    (-J, J_n). Angular velocities are counted about +y with x to the right and z up, so that a
    contact point below the centre moves by -R omega_y, and Carom's spin is -omega_y there; the
    contact point of the second body, above its centre, moves by +R omega_y.
    """
    normal, tangential, spin, spin2 = motion
    (R_1, m_1, I_1), (R_2, m_2, I_2) = inertia(pair.first), inertia(pair.second)
    push = (1 + restitution) * normal / (1 / m_1 + 1 / m_2)
    v_1, v_2 = np.array([0.3 + tangential, 0.1 - normal]), np.array([0.3, 0.1])
    omega_1, omega_2 = -spin, -spin2
    after_1 = v_1 + np.array([-impulse, push]) / m_1
    after_2 = v_2 - np.array([-impulse, push]) / m_2
    # torque r x F about +y: z F_x - x F_z, with r = (0, -R) and (0, R_2)
    after_omega_1 = omega_1 + (-R_1) * (-impulse) / I_1
    after_omega_2 = omega_2 + R_2 * impulse / I_2

    def contact(v_1, v_2, omega_1, omega_2):
        """Relative tangential velocity of the two points that touch."""
        return v_1[0] - R_1 * omega_1 - v_2[0] - R_2 * omega_2

    before, after = v_1 - v_2, after_1 - after_2
    slip = contact(v_1, v_2, omega_1, omega_2)
    slip_out = contact(after_1, after_2, after_omega_1, after_omega_2)
    unit = pair.friction * normal / pair.kappa
    return {
        "speed": hypot(*before),
        "angle": atan(before[0] / -before[1]),
        "normal_speed": -before[1],
        "tangential_speed": before[0],
        "spin": spin,
        "spin2": spin2,
        "contact_angle": atan(slip / -before[1]),
        "psi_in": slip / unit,
        "normal_restitution": -after[1] / before[1],
        "normal_speed_out": after[1],
        "tangential_speed_out": after[0],
        "spin_out": -after_omega_1,
        "spin2_out": -after_omega_2,
        "rebound_speed": hypot(*after),
        "rebound_angle": atan(after[0] / after[1]),
        "contact_rebound_angle": atan(slip_out / after[1]),
        "tangential_restitution": after[0] / before[0],
        "contact_restitution": slip_out / slip,
        "contact_beta": -slip_out / slip,
        "impulse_ratio": impulse / push,
        "psi_out": slip_out / unit,
    }
