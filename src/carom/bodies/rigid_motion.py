"""The motion of two bodies in space, before and after an impulse at their contact."""

from typing import Any, NamedTuple

import numpy as np

from carom.bodies.kinematics import inertia
from carom.bodies.pairs import Pair
from carom.bodies.shapes import Sphere
from carom.bodies.smooth_body import Body
from carom.quantities.arrays import Array


class Rigid(NamedTuple):
    """A body in the frame of the contact: inverse mass, place of the contact, both inertias."""

    lightness: float
    place: Array
    turning: Array  # inverse of the inertia
    inertia: Array


def rigid(body: Any, side: float) -> Rigid:
    """Return a body whose contact is below (side -1) or above it; walls do not move."""
    if isinstance(body, Sphere):
        moment = inertia(body)
        place = np.array([0.0, 0.0, side * body.radius])
        return Rigid(1.0 / body.mass, place, np.eye(3) / moment, moment * np.eye(3))
    if isinstance(body, Body) and body.mass is not None:
        tensor = np.asarray(body.inertia, dtype=np.float64)
        whole = tensor if tensor.ndim else np.diag([0.0, float(tensor), 0.0])
        return Rigid(1.0 / body.mass, body.place, body.turning, whole)
    return Rigid(0.0, np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3)))


class RigidMotion(NamedTuple):
    """Velocity of the first centre relative to the second, spins of both, along x, y, z.

    z points from the second body to the first, spins are right-handed. Arrays (3,), or (n, 3).
    """

    velocity: Array
    spin: Array
    spin2: Array

    def at_contact(self, pair: Pair) -> Array:
        """Return the velocity of the contact points along x, y and the normal, approaching."""
        first, second = rigid(pair.first, -1.0), rigid(pair.second, 1.0)
        turned = np.cross(self.spin, first.place) - np.cross(self.spin2, second.place)
        return (self.velocity + turned) * [1.0, 1.0, -1.0]

    def after(self, pair: Pair, impulse: Array) -> "RigidMotion":
        """Return the motion after an impulse on the first body, against x, y and the normal."""
        first, second = rigid(pair.first, -1.0), rigid(pair.second, 1.0)
        pushed = impulse * [-1.0, -1.0, 1.0]
        return RigidMotion(
            self.velocity + pushed * (first.lightness + second.lightness),
            self.spin + np.cross(first.place, pushed) @ first.turning,
            self.spin2 - np.cross(second.place, pushed) @ second.turning,
        )

    def energies(self, pair: Pair) -> tuple[Array, Array, Array]:
        """Return kinetic energies: along the normal, across it, of the spins, in J.

        Those of the centres are in the frame of the centre of mass.
        """
        first, second = rigid(pair.first, -1.0), rigid(pair.second, 1.0)
        half = 0.5 / (first.lightness + second.lightness)
        turning = np.sum(self.spin * (self.spin @ first.inertia), axis=-1)
        turning = turning + np.sum(self.spin2 * (self.spin2 @ second.inertia), axis=-1)
        squares = self.velocity**2
        return half * squares[..., 2], half * (squares[..., 0] + squares[..., 1]), 0.5 * turning
