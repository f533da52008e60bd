"""What an impact does in the course of time: forces, velocities, radii, and where the energy is."""

from itertools import zip_longest
from math import isfinite
from typing import Any, NamedTuple, Protocol

from carom.bodies import Sphere
from carom.pairs import Pair

RESULTS = (
    "psi_in",
    "psi_out",
    "duration",
    "max_penetration",
    "max_force",
    "max_radius",
    "max_pressure",
    "rebound_speed",
    "rebound_angle",
    "tangential_speed_out",
    "spin_out",
    "spin2_out",
    "normal_restitution",
    "tangential_restitution",
    "contact_restitution",
    "dissipated_energy",
    "lost_energy",
)
PAIR = (
    "friction",
    "chi",
    "kappa",
    "dundurs_beta",
    "effective_modulus",
    "effective_shear_modulus",
    "effective_radius",
    "normal_mass",
    "tangential_mass",
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


class InTime(Solved, Protocol):
    """What a history needs besides: phases, and the dimensionless state at n times."""

    @property
    def psi_in(self) -> float: ...
    @property
    def phases(self) -> tuple[Any, ...]: ...
    def history(self, n: int) -> Any: ...


class Tangential(NamedTuple):
    """Tangential motion: speed of the first centre relative to the second, and the spins.

    Each is a number, or an array: along time, or of many impacts.
    """

    tangential_speed: float
    spin: float
    spin2: float

    def after(self, pair: Pair, impulse: Any) -> "Tangential":
        """Return the motion after an impulse on the contact point of the first body, against +x."""
        spins = (
            spin - impulse * body.radius / inertia(body) if body else spin + 0.0 * impulse
            for body, spin in zip_longest(pair.moving, self[1:])
        )
        return Tangential(self.tangential_speed - impulse / pair.normal_mass, *spins)

    def contact_velocity(self, pair: Pair) -> float:
        """Return the velocity of the contact point, V_x = v_t + R spin + R_2 spin2, in m/s."""
        carried = (body.radius * spin for body, spin in zip(pair.moving, self[1:], strict=False))
        return self.tangential_speed + sum(carried)

    def spin_energy(self, pair: Pair) -> float:
        """Return the kinetic energy of the spins, (1/2) sum I omega^2, in J."""
        moving = zip(pair.moving, self[1:], strict=False)
        return sum(0.5 * inertia(body) * spin**2 for body, spin in moving)


def inertia(body: Sphere) -> float:
    """Return the moment of inertia about the centre, M K^2, in kg m^2."""
    return body.mass * body.gyration_ratio * body.radius**2


def history_columns(
    pair: Pair, normal_speed: float, start: Tangential, solution: InTime, n: int
) -> dict[str, Any]:
    """Return the impact at n times by name of column, in SI units.

    In the frame of the centre of mass the kinetic energies of the normal motion, of the tangential
    motion of the centres and of the spins, both elastic energies and the work of friction add up to
    a constant. Of the tangential ones friction can act on that of the contact point alone,
    (1/2) m_t V_x^2; the rest stays what it was.
    """
    h, scales = solution.history(n), pair.scales(normal_speed)
    slides_freely = not isfinite(pair.psi(start.contact_velocity(pair), normal_speed))
    drift = start.contact_velocity(pair) if slides_freely else 0.0
    impulse_unit = pair.tangential_mass * scales.tangential_speed
    energy_unit = impulse_unit * scales.tangential_speed
    velocity = h.psi * scales.tangential_speed + drift
    now = start.after(pair, impulse_unit * (solution.psi_in - h.psi))
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
        "frictional_work": h.dissipated * energy_unit,
    }
