"""Impacts of rigid bodies of any shape, by Newton's and Euler's equations in SI units.

Many at once. Springs stand at even places of the contact's radius, steps of time are even: normal
forces are Hertz's, of E* (d - x^2/R) dx, tangential ones kappa E* u, cut along the slip to mu times
that. The work of friction is summed apart, spring by spring.
"""

from typing import NamedTuple

import numpy as np

CUTS = 6  # bisections for the slip, between bounds that differ by the ratio of stiffnesses


class Struck(NamedTuple):
    """What impacts come to, arrays (n,) and (n, 3), z from the second body to the first."""

    velocity: np.ndarray  # of both bodies, (2, n, 3)
    spin: np.ndarray  # (2, n, 3)
    impulse: np.ndarray  # on the first body
    work: np.ndarray  # of friction
    depth: np.ndarray  # the largest
    time: np.ndarray


def tensors(body, side):
    """Return 1/M, the place of the contact and the inverse tensor of inertia."""
    if getattr(body, "mass", None) is None:
        return 0.0, np.zeros(3), np.zeros((3, 3))
    if hasattr(body, "gyration_ratio"):
        moment = body.mass * body.gyration_ratio * body.radius**2
        return 1.0 / body.mass, np.array([0.0, 0.0, side * body.radius]), np.eye(3) / moment
    place = np.array(body.contact if len(body.contact) == 3 else np.insert(body.contact, 1, 0.0))
    if np.ndim(body.inertia) == 0:
        return 1.0 / body.mass, place, np.diag([0.0, 1.0 / body.inertia, 0.0])
    return 1.0 / body.mass, place, np.linalg.inv(body.inertia)


def axes(pair):
    """Return the directions along both axes of the contact, as columns."""
    across, along = np.linalg.eigh(pair.curvatures)[1].T[::-1]
    if abs(along[0]) < abs(across[0]):
        along = across
    along = along * np.sign(along[0])
    return np.array([along, [-along[1], along[0]]]).T


class Contacts:
    """The constants of contacts, and the bodies, stacked."""

    def __init__(self, pairs):
        of = [(tensors(p.first, -1.0), tensors(p.second, 1.0)) for p in pairs]
        self.light, self.arm, self.turning = (
            np.array([[bodies[i][part] for bodies in of] for i in range(2)]) for part in range(3)
        )
        self.modulus, self.radius, self.friction, self.mass = (
            np.array([getattr(p, name) for p in pairs])
            for name in ("effective_modulus", "effective_radius", "friction", "normal_mass")
        )
        self.axes = np.array([axes(p) for p in pairs])
        self.stiff = self.modulus[:, None] * np.array([p.kappas for p in pairs])

    def meeting(self, v, w):
        """Return the velocity of the first contact point relative to the second."""
        points = v + np.cross(w, self.arm)
        return points[0] - points[1]

    def push(self, v, w, impulse):
        """Return velocities and spins after an impulse on the first bodies."""
        pair = np.array([impulse, -impulse])
        turned = np.einsum("bnij,bnj->bni", self.turning, np.cross(self.arm, pair))
        return v + self.light[..., None] * pair, w + turned


def cut(u, limit, stiff):
    """Return deflections and forces after slip along the force, to a limit; u (n, 2, springs)."""
    trial, size = stiff * u, np.hypot(*np.moveaxis(stiff * u, 1, 0))
    excess = np.maximum(size / np.maximum(limit, 1e-300) - 1.0, 0.0)
    low, high = (
        excess[:, None] / bound(stiff, axis=1, keepdims=True) for bound in (np.max, np.min)
    )
    for _ in range(CUTS):
        slip = 0.5 * (low + high)
        beyond = (
            np.hypot(*np.moveaxis(trial / (1.0 + stiff * slip), 1, 0))[:, None] > limit[:, None]
        )
        low, high = np.where(beyond, slip, low), np.where(beyond, high, slip)
    force = trial / (1.0 + 0.5 * (low + high) * stiff)
    whole = limit / np.maximum(np.hypot(*np.moveaxis(force, 1, 0)), 1e-300)
    force *= np.where(excess > 0.0, whole, 1.0)[:, None]
    return force / stiff, force


def marched(pairs, velocity, spin, spin2, springs, reach):
    """March impacts at relative velocities and spins (n, 3); `reach` is the deepest, of d_max."""
    of = Contacts(pairs)
    v, w = np.array([velocity, 0.0 * velocity]), np.array([spin, spin2])
    approach = -of.meeting(v, w)[:, 2]
    deepest = (15.0 * of.mass * approach**2 / (16.0 * of.modulus * np.sqrt(of.radius))) ** 0.4
    cell = np.sqrt(of.radius * reach * deepest) / springs
    rise = (cell[:, None] * (np.arange(springs) + 0.5)) ** 2 / of.radius[:, None]
    step = (0.5 / springs * deepest / approach)[:, None]
    n = len(pairs)
    u, force, depth = np.zeros((n, 2, springs)), np.zeros((n, 3)), np.zeros(n)
    impulse, (work, most, time) = np.zeros((n, 3)), np.zeros((3, n))
    stiff, on = of.stiff[:, :, None], np.ones(n, dtype=bool)
    while on.any():
        h = step * on[:, None]
        v, w = of.push(v, w, 0.5 * h * force)
        gap = of.meeting(v, w)
        before, depth = depth, depth - h[:, 0] * gap[:, 2]
        sliding = np.einsum("nij,ni->nj", of.axes, gap[:, :2]) * h
        touched = rise < depth[:, None]
        grows = np.clip(
            (depth[:, None] - rise) / np.maximum(depth - before, 1e-300)[:, None], 0.0, 1.0
        )
        share = np.where(rise < before[:, None], 1.0, grows) * touched
        trial = u * touched[:, None] + sliding[:, :, None] * share[:, None]
        limit = of.friction[:, None] * of.modulus[:, None] * np.maximum(depth[:, None] - rise, 0.0)
        u, pull = cut(trial, limit, stiff)
        work += 2.0 * cell * np.sum(pull * (trial - u), axis=(1, 2)) * on
        across = -2.0 * cell[:, None] * pull.sum(axis=2)
        force[:, :2] = np.einsum("nij,nj->ni", of.axes, across)
        force[:, 2] = 4.0 / 3.0 * of.modulus * np.sqrt(of.radius) * np.maximum(depth, 0.0) ** 1.5
        v, w = of.push(v, w, 0.5 * h * force)
        impulse += h * force
        most, time = np.maximum(most, depth), time + h[:, 0]
        on &= depth >= 0.0
        force *= on[:, None]
        u *= on[:, None, None]
    return Struck(v, w, impulse, work, most / deepest, time)
