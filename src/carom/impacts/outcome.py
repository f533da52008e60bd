"""What comes of an impact: velocities, spins, energies, extremes; and the course of it in time."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol, cast

from carom.bodies.checks import scales_fit
from carom.bodies.kinematics import Kinematics
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Scales
from carom.quantities.arrays import copysign, isfinite, where

FAST = 1e4  # psi_1 over 1 and the most that friction takes of it: it slips throughout
RESULTS = (
    *("psi_in", "psi_out"),
    *("duration", "max_penetration", "max_force", "max_radius", "max_pressure"),
    *("rebound_speed", "rebound_angle", "tangential_speed_out", "spin_out", "spin2_out"),
    *("normal_restitution", "tangential_restitution", "contact_restitution"),
    *("dissipated_energy", "lost_energy", "shear_lost_energy"),
)
PAIR = (
    *("friction", "chi", "kappa", "dundurs_beta"),
    *("effective_modulus", "effective_shear_modulus", "effective_radius"),
    *("normal_mass", "tangential_mass"),
)


class Solved(Protocol):
    """What an outcome needs of a solution: numbers, or arrays of them, in units of the scales."""

    @property
    def psi_out(self) -> float: ...
    @property
    def restitution(self) -> float: ...
    @property
    def duration(self) -> float: ...
    @property
    def max_penetration(self) -> float: ...
    @property
    def max_force(self) -> float: ...
    @property
    def max_radius(self) -> float: ...
    @property
    def max_pressure(self) -> float: ...
    @property
    def shear_lost(self) -> float: ...


class InTime(Solved, Protocol):
    """What a history needs besides: phases, and the dimensionless state at times, or at n."""

    @property
    def psi_in(self) -> float: ...
    @property
    def phases(self) -> tuple[Any, ...]: ...
    def at(self, time: Any) -> Any: ...
    def history(self, n: int) -> Any: ...


def _psi_lost(chi: float, solution: InTime, h: Any) -> Any:
    """Return psi_1 - psi until now; in fast gross slip by its closed form, 2 chi (1 - v/V_1)."""
    most = 2.0 * chi
    if abs(solution.psi_in) > FAST * (1.0 + most * (1.0 + solution.restitution)):
        return copysign(most, solution.psi_in) * (1.0 - h.centre_speed)
    return solution.psi_in - h.psi


def history_columns(outcome: "Outcome", h: Any) -> dict[str, Any]:
    """Return a history of the solution by name of column, in SI units.

    In the frame of the centre of mass the kinetic energies of the normal motion, of the tangential
    motion of the centres and of the spins, both elastic energies, the work of friction and what
    viscosity has taken add up to a constant. Of the tangential ones friction can act on that of the
    contact point alone, (1/2) m_t V_x^2; the rest stays what it was.
    """
    pair, scales, solution = outcome.pair, outcome.scales, cast(InTime, outcome.solution)
    slides_freely = not isfinite(outcome.psi_in)
    drift = outcome.contact_velocity if slides_freely else 0.0
    impulse_unit = pair.tangential_mass * scales.tangential_speed
    energy_unit = impulse_unit * scales.tangential_speed
    velocity = h.psi * scales.tangential_speed + drift
    now = outcome.before.after(pair, impulse_unit * _psi_lost(pair.chi, solution, h))
    return {
        "time": h.time * scales.time,
        "penetration": h.penetration * scales.length,
        "displacement": h.displacement * scales.tangential_length + drift * h.time * scales.time,
        "normal_velocity": h.centre_speed * scales.speed,
        "contact_velocity": velocity,
        "tangential_speed": now.tangential_speed,
        "spin": now.spin,
        "spin2": now.spin2,
        "normal_force": h.normal_force * scales.force,
        "tangential_force": h.force * scales.tangential_force,
        "contact_radius": h.contact_radius * scales.radius,
        "stick_radius": h.stick_radius * scales.radius * (0.0 if slides_freely else 1.0),
        "normal_kinetic_energy": h.centre_speed**2 * scales.energy,
        "tangential_kinetic_energy": 0.5 * pair.normal_mass * now.tangential_speed**2,
        "spin_kinetic_energy": now.spin_energy(pair),
        "contact_kinetic_energy": 0.5 * pair.tangential_mass * velocity**2,
        "normal_elastic_energy": h.normal_stored * scales.energy,
        "normal_loss": h.normal_lost * scales.energy,
        "tangential_elastic_energy": h.stored * energy_unit,
        "shear_loss": h.shear_lost * energy_unit,
        "frictional_work": h.dissipated * energy_unit,
    }


@dataclass(frozen=True, eq=False)
class Outcome(Kinematics):
    """How two bodies leave an impact; SI units. Every field but the bodies may be an array."""

    solution: Solved = field(repr=False)
    losses: LossLaw | None = None
    scales: Scales = field(kw_only=True, repr=False)

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
        """V_x - V_x', in fast gross slip in its closed form: the difference loses digits there."""
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
            **self.pair._describe(),
            "normal_speed": self.normal_speed,
            **self.before._asdict(),
            **({} if self.losses is None else {"losses": self.losses._describe()}),
        }


def outcome_fits(outcome: Outcome) -> bool:
    """Return whether floating point holds the numbers of an impact; an array for many."""
    parts = outcome.tangential_speed, *outcome.before.carried(outcome.pair)
    return scales_fit(outcome.pair, outcome.scales, outcome.contact_velocity, *parts)
