"""What waves in a wall take from an impact, and how far a plate must reach for its rim to be quiet.

Numbers, or arrays of them with pairs of arrays.
"""

from math import pi
from typing import cast

from carom.bodies.pairs import Pair, Scales
from carom.bodies.shapes import HalfSpace, Sphere
from carom.quantities.arrays import sqrt, where

RADIATED = (1.343, -1.878, 0.812, 0.360)  # of Poisson's ratio, to 0.6 % from -1/2 to 1/2
PULSE = 1.5918146  # integral of F'^2 dt through Hertz's impact, in P_max^2 V_1/d_max
RIM = 1.3  # of the way of the fastest bending waves: what is quiet by more exact plates, too


def radiated_share(pair: Pair, scales: Scales) -> float:
    """Return the share of the energy that waves in a thick wall take; NaN without its density.

    The wall radiates B times the integral of F'^2 dt with B = f(nu)/(2 pi G c_s), f from the force
    on a half-space that oscillates (Miller & Pursey 1955: 4.836 for nu = 1/4). For like materials
    that is 1.11 (V_1/c)^(3/5) of the energy at nu = 1/4; Hunter (1957) is quoted with 1.04.
    """
    wall = pair.second.material
    if isinstance(pair.second, Sphere) or wall.is_rigid:
        return 0.0
    if wall.density is None:
        return float("nan")
    factor = sum(c * wall.poisson**k for k, c in enumerate(RADIATED))
    force = 25.0 / 16.0  # P_max = (5/4) m_n V_1^2/d_max
    slowness = sqrt(wall.density / wall.shear_modulus)
    per_mass = factor * force * PULSE * slowness / (pi * wall.shear_modulus)
    return per_mass * pair.normal_mass / scales.time**3


def quiet_width(pair: Pair, scales: Scales, duration: float) -> float:
    """Return up to which width in m waves come back from the rim of a plate within the contact.

    On a plate that gives way these are bending waves of the period of the contact, at their group
    velocity; on a thick wall compressional waves.
    """
    wall = cast(HalfSpace, pair.second)
    bends = RIM * 2.0 * 2.0**0.5 * half_wave(wall, duration)
    return where(pair.gives_way(scales), bends, wall.material.compressional_speed * duration)


def half_wave(plate: HalfSpace, duration: float) -> float:
    """Return half a bending wave of the contact, pi (D/(rho h))^(1/4)/sqrt(pi/t_c), in m."""
    stuff, thickness = plate.material, cast(float, plate.thickness)
    modulus = stuff.young / (12.0 * (1.0 - stuff.poisson**2))
    speed = sqrt(modulus / cast(float, stuff.density))  # (D/(rho h))^(1/2) is this times h
    return sqrt(pi * duration * speed * thickness)
