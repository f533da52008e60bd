"""The history of forces of one impact beside the exact one at the same times."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from carom.dimensionless import hertz
from carom.dimensionless.states import History
from carom.exact_impacts import Impact
from carom.readings import Array
from carom.verify.scoring.contact import Samples

TAIL = 64  # instants added where the exact contact outlasts the one that was given


@dataclass(frozen=True, eq=False)
class Forces:
    """A history of forces, its time since the first touch, and the exact history; SI units.

    Impulses are integrals, by trapezia, of the difference from the exact forces, whose own impulses
    are known: however coarse it is sampled, the exact history has no error.
    """

    hit: Impact
    samples: Samples

    @cached_property
    def time(self) -> Array:
        """Time since the first touch, until neither contact lasts."""
        own, exact = self.samples.time, self.hit.duration
        if own[-1] >= exact * (1.0 - 1e-12):
            return own
        return np.concatenate([own, np.linspace(own[-1], exact, TAIL)[1:]])

    @property
    def normal_force(self) -> Array:
        """The normal force that was given, zero after the last touch."""
        return self._padded(self.samples.normal_force)

    @property
    def tangential_force(self) -> Array:
        """The tangential force that was given, zero after the last touch."""
        return self._padded(self.samples.tangential_force)

    def _padded(self, values: Array) -> Array:
        return np.concatenate([values, np.zeros(self.time.size - values.size)])

    @cached_property
    def solution(self) -> History:
        """The exact impact at these times, dimensionless; as it ends where they go on."""
        scale = self.hit.scales.time
        return self.hit.solution.at(np.clip(self.time / scale, 0.0, hertz.DURATION))

    @property
    def exact_normal_force(self) -> Array:
        """The exact normal force."""
        return self.solution.penetration**1.5 * self.hit.scales.force

    @property
    def exact_tangential_force(self) -> Array:
        """The exact tangential force."""
        return self.solution.force * self.hit.scales.tangential_force

    @cached_property
    def normal_error(self) -> Array:
        """Error in the normal force, in units of P_max."""
        return (self.normal_force - self.exact_normal_force) / self.hit.scales.force

    @cached_property
    def tangential_error(self) -> Array:
        """Error in the tangential force, in units of mu P_max."""
        unit = self.hit.pair.friction * self.hit.scales.force
        return (self.tangential_force - self.exact_tangential_force) / unit

    @cached_property
    def psi(self) -> Array:
        """psi of the contact point as the tangential force that was given makes it."""
        excess = self.tangential_force - self.exact_tangential_force
        impulse = np.concatenate([[0.0], np.cumsum(np.diff(self.time) * _middles(excess))])
        unit = self.hit.pair.tangential_mass * self.hit.scales.tangential_speed
        return self.solution.psi - impulse / unit

    @property
    def restitution(self) -> float:
        """Normal velocity after to before, from the impulse of the normal force."""
        excess = self.normal_force - self.exact_normal_force
        impulse = float(np.diff(self.time) @ _middles(excess))
        return 1.0 + impulse / (self.hit.pair.normal_mass * self.hit.normal_speed)

    @property
    def duration_error(self) -> float:
        """Error in the duration of the contact, relative."""
        return self.samples.end / self.hit.duration - 1.0

    @property
    def peak_error(self) -> float:
        """Error in the largest normal force of these times, in units of P_max."""
        own, exact = self.normal_force.max(), self.exact_normal_force.max()
        return float(own - exact) / self.hit.scales.force

    @property
    def energy_change(self) -> float:
        """Kinetic energy after less that before, in J."""
        normal = self.hit.scales.energy * (self.restitution**2 - 1.0)
        return normal - self.lost

    @property
    def lost(self) -> float:
        """Work that the tangential force has taken from the motion, in J."""
        unit = 0.5 * self.hit.pair.tangential_mass * self.hit.scales.tangential_speed**2
        return float(unit * (self.psi[0] - self.psi[-1]) * (self.psi[0] + self.psi[-1]))

    def rms(self, values: Array) -> float:
        """Return the root of the mean square over time."""
        squares = np.diff(self.time) @ _middles(values**2)
        return float(np.sqrt(squares / self.time[-1]))


def _middles(values: Array) -> Array:
    return 0.5 * (values[1:] + values[:-1])
