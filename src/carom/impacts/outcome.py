"""How two bodies leave an oblique impact: velocities, spins, restitution, energy, extremes."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from carom.bodies.kinematics import Kinematics, Tangential
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Scales, representable
from carom.bodies.shapes import describe
from carom.impacts.history import FAST, PAIR, RESULTS, Solved
from carom.quantities.elementwise import copysign, isfinite, where


@dataclass(frozen=True, eq=False)
class Outcome(Kinematics):
    """How two bodies leave an impact; SI units. Every field but the bodies may be an array.

    Tangential speeds are those of the first body relative to the second, positive spin adds to the
    tangential speed of the contact point: V_x = v_t + R omega + R_2 omega_2.
    """

    tangential_speed: float
    spin: float
    spin2: float
    solution: Solved = field(repr=False)
    losses: LossLaw | None = None

    @property
    def _before(self) -> Tangential:
        return Tangential(self.tangential_speed, self.spin, self.spin2)

    @property
    def fits(self) -> bool:
        """Whether floating point holds the numbers of this impact."""
        parts = self.tangential_speed, *self._before.carried(self.pair)
        return representable(self.pair, self.normal_speed, self.contact_velocity, *parts)

    @property
    def normal_restitution(self) -> float:
        """Normal coefficient of restitution, normal velocity after over before; 1 if elastic."""
        return self.solution.restitution

    @cached_property
    def contact_velocity_out(self) -> float:
        """Tangential velocity of the contact point after, in m/s."""
        slowed = self.psi_out * self.scales.tangential_speed
        return where(isfinite(self.psi_in), slowed, self.contact_velocity)

    @cached_property
    def psi_out(self) -> float:
        """Dimensionless velocity kappa V_x/(mu V_1) after; infinite without friction."""
        return where(isfinite(self.psi_in), self.solution.psi_out, self.psi_in)

    @cached_property
    def _slowed_by(self) -> float:
        """V_x - V_x'; in fast gross slip, where that difference loses digits, by its closed form.

        It is 2 chi (1 + e) mu V_1/kappa there, by Coulomb's law.
        """
        before, lost = self.contact_velocity, self.contact_velocity - self.contact_velocity_out
        unit = self.scales.tangential_speed
        most = 2.0 * self.pair.chi * (1.0 + self.normal_restitution) * unit
        return where(abs(before) > FAST * (unit + most), copysign(most, before), lost)

    @property
    def tangential_impulse(self) -> float:
        """Impulse of the tangential force on the first body, against +x, in N s."""
        return self.pair.tangential_mass * self._slowed_by

    @property
    def dissipated_energy(self) -> float:
        """Energy lost to friction, in J."""
        twice_mean = self.contact_velocity + self.contact_velocity_out
        lost = 0.5 * self.pair.tangential_mass * self._slowed_by * twice_mean
        return lost - self.shear_lost_energy

    @property
    def shear_lost_energy(self) -> float:
        """Energy lost to viscosity in shear, in J."""
        unit = self.pair.tangential_mass * self.scales.tangential_speed**2
        return self.solution.shear_lost * unit

    @property
    def lost_energy(self) -> float:
        """Energy lost in the normal motion, in J."""
        left = self.normal_restitution**2
        return self.scales.energy * (1.0 - left)

    @cached_property
    def scales(self) -> Scales:
        """Scales by which dimensionless results become those of this impact."""
        return self.pair.scales(self.normal_speed)

    @property
    def duration(self) -> float:
        """Duration of the contact, in s."""
        return self.solution.duration * self.scales.time

    @property
    def max_penetration(self) -> float:
        """Largest normal approach, in m."""
        return self.solution.max_penetration * self.scales.length

    @property
    def max_force(self) -> float:
        """Largest normal force, in N."""
        return self.solution.max_force * self.scales.force

    @property
    def max_radius(self) -> float:
        """Largest contact radius, in m."""
        return self.solution.max_radius * self.scales.radius

    @property
    def max_pressure(self) -> float:
        """Largest contact pressure, in Pa, that of Hertz at the largest force and true radius.

        For viscous bodies it is that of elastic bodies under the same force.
        """
        return self.solution.max_pressure * self.scales.pressure

    def scalars(self) -> dict[str, float]:
        """Return the numbers of the result by name."""
        numbers = {name: float(getattr(self, name)) for name in RESULTS}
        return numbers | {name: getattr(self.pair, name) for name in PAIR}

    def inputs(self) -> dict[str, Any]:
        """Return what the impact was made from, as plain numbers and words."""
        return {
            "first": describe(self.pair.first),
            "second": describe(self.pair.second),
            "friction": self.pair.friction,
            "normal_speed": self.normal_speed,
            **self._before._asdict(),
            **({} if self.losses is None else {"losses": self.losses.describe()}),
        }
