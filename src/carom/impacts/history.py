"""What an impact does in the course of time: forces, velocities, radii, and where the energy is."""

from math import copysign, isfinite
from typing import Any, Protocol

from carom.bodies.kinematics import Tangential
from carom.bodies.pairs import Pair

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


def _psi_lost(pair: Pair, solution: InTime, h: Any) -> Any:
    """Return psi_1 - psi until now; in fast gross slip by its closed form, 2 chi (1 - v/V_1)."""
    most = 2.0 * pair.chi
    if abs(solution.psi_in) > FAST * (1.0 + most * (1.0 + solution.restitution)):
        return copysign(most, solution.psi_in) * (1.0 - h.speed)
    return solution.psi_in - h.psi


def history_columns(
    pair: Pair, normal_speed: float, start: Tangential, solution: InTime, n: int
) -> dict[str, Any]:
    """Return the impact at n times by name of column, in SI units.

    In the frame of the centre of mass the kinetic energies of the normal motion, of the tangential
    motion of the centres and of the spins, both elastic energies, the work of friction and what
    viscosity has taken add up to a constant. Of the tangential ones friction can act on that of the
    contact point alone, (1/2) m_t V_x^2; the rest stays what it was.
    """
    h, scales = solution.history(n), pair.scales(normal_speed)
    slides_freely = not isfinite(pair.psi(start.contact_velocity(pair), normal_speed))
    drift = start.contact_velocity(pair) if slides_freely else 0.0
    impulse_unit = pair.tangential_mass * scales.tangential_speed
    energy_unit = impulse_unit * scales.tangential_speed
    velocity = h.psi * scales.tangential_speed + drift
    now = start.after(pair, impulse_unit * _psi_lost(pair, solution, h))
    return {
        "time": h.time * scales.time,
        "penetration": h.penetration * scales.length,
        "displacement": h.displacement * scales.tangential_length + drift * h.time * scales.time,
        "normal_velocity": h.speed * normal_speed,
        "contact_velocity": velocity,
        "tangential_speed": now.tangential_speed,
        "spin": now.spin,
        "spin2": now.spin2,
        "normal_force": h.normal_force * scales.force,
        "tangential_force": h.force * scales.tangential_force,
        "contact_radius": h.contact_radius * scales.radius,
        "stick_radius": h.stick_radius * scales.radius * (0.0 if slides_freely else 1.0),
        "normal_kinetic_energy": h.speed**2 * scales.energy,
        "tangential_kinetic_energy": 0.5 * pair.normal_mass * now.tangential_speed**2,
        "spin_kinetic_energy": now.spin_energy(pair),
        "contact_kinetic_energy": 0.5 * pair.tangential_mass * velocity**2,
        "normal_elastic_energy": h.normal_stored * scales.energy,
        "normal_loss": h.normal_lost * scales.energy,
        "tangential_elastic_energy": h.stored * energy_unit,
        "shear_loss": h.shear_lost * energy_unit,
        "frictional_work": h.dissipated * energy_unit,
    }
