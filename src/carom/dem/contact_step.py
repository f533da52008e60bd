"""An impact in equal time steps in SI units, with a tangential force that a Python function gives.

The steps are those of DEM codes, velocity Verlet, as in `stepping`; nothing here is compiled.
"""

from collections.abc import Callable
from math import sqrt
from typing import Any, NamedTuple

from carom.bodies.pairs import Pair
from carom.bodies.shapes import HalfSpace, Sphere
from carom.dem.coefficients import SPRING
from carom.dem.stepping import PATIENCE
from carom.dimensionless.numerics.hertz import DURATION
from carom.quantities.arrays import Array

NORMAL = ("hertz", "linear")  # how the elastic part of the normal force grows

Force = Callable[[Any, Any], tuple[float, Any]]


class ContactStep(NamedTuple):
    """What a contact law is given in one time step, in SI units.

    V_x, `tangential_velocity`, is that of the contact point, of the first body relative to the
    second; the force that a law returns acts on the first body along x, so that it is negative
    where it slows V_x > 0. Stiffnesses are those of a contact of radius a that sticks, k_n = 2 E* a
    and k_t = 2 G* a (Mindlin 1949), which is 8 G_eff a where codes write G* = 4 G_eff; with linear
    springs they are constants, k_t = kappa k_n.

    Parameters
    ----------
    overlap : float
        d in m.
    normal_velocity : float
        In m/s, positive while the bodies approach.
    normal_force : float
        F_n in N, damping included; negative where it pulls.
    tangential_velocity : float
        V_x in m/s.
    time_step : float
        In s.
    contact_radius : float
        a = sqrt(R* d) in m.
    normal_stiffness, tangential_stiffness : float
        k_n and k_t in N/m.
    friction : float
        Coefficient mu.
    effective_radius : float
        R* in m.
    effective_modulus, effective_shear_modulus : float
        E* and G* in Pa.
    normal_mass, tangential_mass : float
        m_n and m_t in kg: dv/dt = -F_n/m_n, dV_x/dt = F_t/m_t.

    Examples
    --------
    >>> import carom
    >>> def spring(contact, stretch):
    ...     stretch = stretch + contact.tangential_velocity * contact.time_step
    ...     return -contact.tangential_stiffness * stretch, stretch
    >>> round(carom.dem.FunctionLaw(spring).rebound(0.5, 1.44), 3)
    0.477
    """

    overlap: float
    normal_velocity: float
    normal_force: float
    tangential_velocity: float
    time_step: float
    contact_radius: float
    normal_stiffness: float
    tangential_stiffness: float
    friction: float
    effective_radius: float
    effective_modulus: float
    effective_shear_modulus: float
    normal_mass: float
    tangential_mass: float


class Fault(Exception):
    """What a function did wrong: a status, and the words for it; `step` is where."""

    def __init__(self, status: int, words: str) -> None:
        super().__init__(words)
        self.status, self.step = status, -1


class Bodies(NamedTuple):
    """Two bodies at one normal speed, as dimensionless numbers ask for them, in SI units."""

    constants: tuple[float, float, float, float, float, float]  # as in a ContactStep, from friction
    speed: float
    length: float
    force: float
    kappa: float
    linear: bool
    damping: float

    def normal_force(self, d: float, v: float) -> float:
        """Return the normal force in N, its damping included."""
        part, rate = d / self.length, v / self.speed
        if self.linear:
            return self.force * (SPRING * part + self.damping * rate)
        return self.force * (part * sqrt(part) + self.damping * sqrt(sqrt(part)) * rate)


def steel_on_steel() -> Pair:
    """Return the pair of the published comparison: nu = 0.3, hence chi = 1.4412."""
    return Pair(Sphere(radius=0.005, material="steel"), HalfSpace(material="steel"), friction=0.2)


def bodies_of(
    pair: Pair, speed: float, chi: float, kappa: float, *, linear: bool, damping: float
) -> Bodies:
    """Return bodies of this chi and kappa: G* and m_t follow from them, the rest is the pair's."""
    scales, mass = pair.scales(speed), pair.normal_mass
    modulus = pair.effective_modulus
    constants = (
        *(pair.friction, pair.effective_radius, modulus, kappa * modulus),
        *(mass, 0.5 * kappa * mass / chi),
    )
    return Bodies(constants, speed, scales.length, scales.force, kappa, linear, damping)


def stepped_by(
    bodies: Bodies, law: Force, state: Any, psi: float, steps: int, record: Array
) -> tuple[int, float]:
    """Return how many rows of the record are filled and psi_2; -1 if the bodies do not part.

    The record is in the units of Hertz's impact, its tangential force positive against V_x > 0.
    """
    friction, radius, modulus, _, m_n, m_t = bodies.constants
    unit, limit = friction * bodies.speed / bodies.kappa, friction * bodies.force
    whole = bodies.length / bodies.speed  # unit of time
    dt = DURATION * whole / steps
    d, v, along, f_n, f_t = 0.0, bodies.speed, psi * unit, 0.0, 0.0
    for i in range(PATIENCE * steps):
        if i < len(record):
            normal = (i * dt / whole, d / bodies.length, v / bodies.speed)
            record[i] = *normal, along / unit, f_n / bodies.force, -f_t / limit
        v -= 0.5 * dt * f_n / m_n
        along += 0.5 * dt * f_t / m_t
        d += dt * v
        if d <= 0.0:
            return i + 1, along / unit
        f_n = bodies.normal_force(d, v)
        a = sqrt(radius * d)
        k_n = SPRING * bodies.force / bodies.length if bodies.linear else 2.0 * modulus * a
        try:
            given = ContactStep(
                *(d, v, f_n, along, dt, a, k_n, bodies.kappa * k_n), *bodies.constants
            )
            f_t, state = law(given, state)
        except Fault as fault:
            fault.step = i
            raise
        v -= 0.5 * dt * f_n / m_n
        along += 0.5 * dt * f_t / m_t
    return -1, float("nan")
