"""The contact laws of LAMMPS as its manual states them, two bodies in a plane, step by step.

From the equations of pair_style granular, fix wall/gran and fix nve/sphere, apart from the laws of
`carom.dem`, whose normal stays: here that of two free spheres turns. Without damping.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from carom.bodies.pairs import Pair
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal
from carom.verify.engines import arrangement
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.lammps import GranularLaw, coefficients

LINEAR = "linear_history"
STORES_FORCE = ("mindlin/force", "mindlin_rescale/force")  # the others store a displacement
RESCALES = ("mindlin_rescale", "mindlin_rescale/force")  # what is stored, as the contact shrinks


@dataclass(frozen=True)
class State:
    """Places, velocities, spins and torques of first bodies, then second spheres: (bodies, n).

    In SI units; omega and torque are about y, as LAMMPS has them.
    """

    x: Array
    z: Array
    vx: Array
    vz: Array
    omega: Array
    torque: Array


@dataclass(frozen=True)
class Bodies:
    """Radii and masses, (bodies, 1)."""

    radius: Array
    mass: Array

    @property
    def inertia(self) -> Array:
        """Moments of inertia of solid spheres."""
        return 0.4 * self.mass * self.radius**2

    @property
    def effective_radius(self) -> float:
        """R1 R2/(R1 + R2), that of the sphere on a wall."""
        return float(np.prod(self.radius) / (np.sum(self.radius) if len(self.radius) == 2 else 1.0))


@dataclass
class Contact:
    """A contact and what it remembers: displacement or force, and the radius it had."""

    law: GranularLaw
    bodies: Bodies
    time_step: float
    stored: Array
    radius: Array

    def forces(self, now: State) -> tuple[Array, Array, Array]:
        """Return forces along x and z and torques about y, with the memory brought on by a step."""
        normal_x, normal_z, overlap = self._geometry(now)
        radius = np.sqrt(self.bodies.effective_radius * overlap)
        normal = self.law.kn * overlap * (radius if self.law.normal == "hertz" else 1.0)
        tangential = self._friction(self._slip(now, normal_x, normal_z), radius, normal)
        along_x = normal * normal_x + tangential * normal_z
        along_z = normal * normal_z - tangential * normal_x
        torque = -self._arms(overlap) * tangential
        sides = np.array([[1.0], [-1.0]][: len(self.bodies.radius)])
        return sides * along_x, sides * along_z, torque

    def _geometry(self, now: State) -> tuple[Array, Array, Array]:
        """Return the unit normal, from the second body to the first, and the overlap."""
        free = len(self.bodies.radius) == 2
        x, z = _difference(now.x) if free else np.zeros_like(now.x[0]), _difference(now.z)
        distance = np.sqrt(x * x + z * z)
        overlap = np.maximum(float(np.sum(self.bodies.radius)) - distance, 0.0)
        return x / distance, z / distance, overlap

    def _slip(self, now: State, normal_x: Array, normal_z: Array) -> Array:
        """Return the velocity of the contact point along the tangent (n_z, -n_x)."""
        drift = _difference(now.vx) * normal_z - _difference(now.vz) * normal_x
        return np.asarray(drift - np.sum(self.bodies.radius * now.omega, axis=0))

    def _friction(self, slip: Array, radius: Array, normal: Array) -> Array:
        """Return the force on the first body along the tangent, at most mu F_n.

        What is stored is worth -k_t as a displacement, 1 as a force.
        """
        law = self.law
        stiffness = law.kt * (np.ones_like(radius) if law.tangential == LINEAR else radius)
        worth = np.ones_like(radius) if law.tangential in STORES_FORCE else -stiffness
        kept = worth * self.stored
        if law.tangential in RESCALES:
            kept = kept * np.minimum(1.0, _ratio(radius, self.radius, 1.0))
        spring = kept - stiffness * slip * self.time_step
        force = np.clip(spring, -law.mu * normal, law.mu * normal)
        self.stored, self.radius = _ratio(force, worth, 0.0), radius
        return force

    def _arms(self, overlap: Array) -> Array:
        """Return the arms of friction: to the middle of the overlap of spheres, R on a wall."""
        half = 0.5 if len(self.bodies.radius) == 2 else 0.0
        return self.bodies.radius - half * overlap


def trajectory(experiment: Experiment, segments: Sequence[int]) -> list[State]:
    """Return the states after each of some runs, so many steps long, one after the other.

    Velocity Verlet; forces are taken at the velocities of half a step, as LAMMPS does.

    Raises
    ------
    InputError
        If the law has damping, or LAMMPS does not have it.
    """
    if arrangement.restitution(experiment) != 1.0:
        raise refusal("law", experiment.law, "it has damping, which this twin lacks")
    bodies, now = _before(experiment)
    contact = Contact(
        coefficients(experiment), bodies, experiment.time_step, *np.zeros((2, len(experiment)))
    )
    found, force = [], np.zeros((3, *now.x.shape))
    for steps in segments:
        for _ in range(steps):
            now = _kicked(now, bodies, force, experiment.time_step)
            now = _drifted(now, experiment.time_step)
            force = np.array(contact.forces(now))
            now = _kicked(now, bodies, force, experiment.time_step)
        found.append(replace(now, torque=force[2]))
    return found


def outcomes_of(last: State) -> Outcomes:
    """Return how the first body leaves each impact, relative to the second, of the last state."""
    return Outcomes(_difference(last.vz), _difference(last.vx), 0.0 - last.omega[0])


def _before(experiment: Experiment) -> tuple[Bodies, State]:
    """Return the bodies and how they are before."""
    pair: Pair = experiment.pair
    placed, moving = arrangement.placed(experiment), pair.moving
    before = {
        name: np.array([getattr(body, name) for body in placed]).reshape(len(moving), -1)
        for name in ("z", "vx", "vz", "spin")
    }
    column = np.array([[body.radius, body.mass] for body in moving])
    zero = np.zeros_like(before["z"])
    state = State(zero, before["z"], before["vx"], before["vz"], 0.0 - before["spin"], zero)
    return Bodies(column[:, :1], column[:, 1:]), state


def _kicked(now: State, bodies: Bodies, force: Array, time_step: float) -> State:
    half = 0.5 * time_step
    return replace(
        now,
        vx=now.vx + half * force[0] / bodies.mass,
        vz=now.vz + half * force[1] / bodies.mass,
        omega=now.omega + half * force[2] / bodies.inertia,
    )


def _drifted(now: State, time_step: float) -> State:
    return replace(now, x=now.x + time_step * now.vx, z=now.z + time_step * now.vz)


def _difference(values: Array) -> Array:
    return np.asarray(values[0] - values[1] if len(values) == 2 else values[0])


def _ratio(value: Array, other: Array, otherwise: float) -> Array:
    """Return a quotient, or what it is otherwise where nothing divides."""
    return np.divide(value, other, out=np.full_like(value, otherwise), where=other != 0.0)
