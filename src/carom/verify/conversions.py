"""From elastic constants to the stiffnesses, and from restitution to the dampings, that codes take.

A linear contact cannot be as stiff as Hertz's at all loads: k_n is chosen for one normal speed.
"""

from collections.abc import Callable
from math import exp, pi, sqrt
from typing import Any, NamedTuple

from carom.dimensionless.hertz import DURATION
from carom.laws.dem.damping import damping_ratio, thornton_damping, tsuji_damping
from carom.pairs import Pair
from carom.quantities import not_negative, number, positive, refusal

SMALLEST_RESTITUTION = 1e-6


class Stiffnesses(NamedTuple):
    """Stiffnesses of one contact in the conventions of codes; SI units.

    `normal` and `tangential` are of linear springs that are pressed as far as Hertz's contact, so
    that k_t/k_n = kappa; `normal_by_duration` lets the contact last as long instead. `hertz` is k_n
    of F_n = k_n sqrt(R*) d^(3/2), 4 E*/3; `mindlin` k_t of F_t = k_t a U, 2 G* (8 G_eff, as codes
    write it); `steepest` the largest dF_n/dd during the impact, 2 E* a_max.
    """

    normal: float
    normal_by_duration: float
    tangential: float
    ratio: float
    hertz: float
    mindlin: float
    steepest: float


def stiffnesses(pair: Pair, normal_speed: float | str) -> Stiffnesses:
    """Return the stiffnesses of a contact for the codes, from E, nu, sizes and normal speed.

    k_n = (4/5) P_max/d_max (the energy of the impact presses it to d_max, as LIGGGHTS's hooke has
    it), or k_n = m_n (pi/t_c)^2; k_t/k_n = kappa = G*/E* (Mindlin 1949).

    Raises
    ------
    InputError
        If the pair is none or the speed not positive.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> found = carom.verify.stiffnesses(pair, "1 m/s")
    >>> f"{found.normal:.4g} N/m, k_t/k_n = {found.ratio:.4f}"
    '2.982e+07 N/m, k_t/k_n = 0.8235'
    """
    if not isinstance(pair, Pair):
        raise refusal("pair", pair, "must be a Pair of bodies; make one with carom.Pair")
    scales = pair.scales(positive("normal_speed", normal_speed))
    normal = 0.8 * scales.force / scales.length
    return Stiffnesses(
        normal=normal,
        normal_by_duration=pair.normal_mass * (pi / (DURATION * scales.time)) ** 2,
        tangential=pair.kappa * normal,
        ratio=pair.kappa,
        hertz=4.0 / 3.0 * pair.effective_modulus,
        mindlin=2.0 * pair.effective_shear_modulus,
        steepest=2.0 * pair.effective_modulus * scales.radius,
    )


def poisson_from_kappa(kappa: float) -> float:
    """Return Poisson's ratio of equal materials: kappa = 2 (1 - nu)/(2 - nu), solved for nu.

    Above 1/2 there is no elastic material: kappa is from 2/3 to 4/3.

    Raises InputError unless kappa is positive and below 2.

    Examples
    --------
    >>> import carom
    >>> round(carom.verify.poisson_from_kappa(1.4 / 1.7), 12)
    0.3
    """
    value = positive("kappa", kappa)
    if value >= 2.0:
        raise refusal("kappa", kappa, "must be below 2")
    return (2.0 - 2.0 * value) / (2.0 - value)


CONVENTIONS: dict[str, tuple[str, Callable[[float], float]]] = {
    "critical": ("part of critical damping, c/(2 sqrt(k m)); YADE betan of springs", damping_ratio),
    "lammps tsuji": ("alpha of LAMMPS, damping tsuji", tsuji_damping),
    "thornton": ("betan of YADE, DAMPING_GAMMA of Kratos: no pull", thornton_damping),
}


def damping(restitution: float, convention: str = "critical") -> float:
    """Return the damping that codes take for a wanted restitution, without unit.

    critical: zeta = -ln e/sqrt(pi^2 + ln^2 e), so that c = 2 zeta sqrt(k m_n) for a linear spring
    and c = 2 zeta sqrt(5/6) sqrt(2 E* a m_n) for Hertz's contact, exact while it may pull (Antypov
    & Elliott 2011); lammps tsuji: alpha of Tsuji et al. (1992); thornton: of a contact that ends
    when its force does (Thornton, Cummins & Cleary 2013, (B6), (B7)).

    Raises
    ------
    InputError
        If e is not above 0 and at most 1, or the convention is not known.

    Examples
    --------
    >>> import carom
    >>> zeta = carom.verify.damping(0.5)
    >>> round(zeta, 4), round(carom.verify.restitution(zeta), 12)
    (0.2155, 0.5)
    """
    value = number("restitution", restitution)
    if not SMALLEST_RESTITUTION <= value <= 1.0:
        raise refusal("restitution", restitution, "must be above 0 and at most 1")
    return _rule(convention)(value) + 0.0  # no -0 at e = 1


def restitution(value: float, convention: str = "critical") -> float:
    """Return the restitution that a code's damping is meant for: the inverse of `damping`.

    Raises
    ------
    InputError
        If the damping is negative or no restitution has it, or the convention is not known.

    Examples
    --------
    >>> import carom
    >>> alpha = carom.verify.damping(0.7, "lammps tsuji")
    >>> round(carom.verify.restitution(alpha, "lammps tsuji"), 10)
    0.7
    """
    from scipy.optimize import brentq

    rule, wanted = _rule(convention), not_negative("tangential_damping", value)
    if convention == "critical" and wanted < 1.0:
        return exp(-pi * wanted / sqrt(1.0 - wanted**2))
    least, most = rule(1.0), rule(SMALLEST_RESTITUTION)
    if wanted <= least:
        return 1.0
    if wanted > most:
        raise refusal("damping", value, f"must be at most {most:.4g}: no restitution has more")
    return float(brentq(lambda e: rule(e) - wanted, SMALLEST_RESTITUTION, 1.0, xtol=1e-14))


def _rule(convention: str) -> Callable[[float], float]:
    if convention not in CONVENTIONS:
        allowed = ", ".join(CONVENTIONS)
        raise refusal("convention", convention, f"must be one of {allowed}")
    return CONVENTIONS[convention][1]


def recipes(pair: Pair, normal_speed: float, wanted: float = 1.0) -> dict[str, Any]:
    """Return what to write into the inputs of codes for this contact, by code; SI units.

    Raises InputError as `stiffnesses` and `damping`.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> print(carom.verify.recipes(pair, 1.0)["LAMMPS Hertz"])
    hertz 1.5385e+11 0 tangential mindlin_rescale 1.9005e+11 0 0.2 damping velocity
    """
    k, mu, zeta = stiffnesses(pair, normal_speed), pair.friction, damping(wanted)
    m = pair.normal_mass
    dashpot = 2.0 * zeta * sqrt(k.normal * m)
    damped = "velocity" if wanted == 1.0 else "coeff_restitution"
    loss = 0.0 if wanted == 1.0 else wanted
    thornton = damping(wanted, "thornton")
    return {
        "LAMMPS Hertz": f"hertz {k.hertz:.4e} {loss:g} tangential mindlin_rescale"
        f" {k.mindlin:.4e} 0 {mu:g} damping {damped}",
        "LAMMPS Hooke": f"hooke {k.normal:.4e} {dashpot:.4e} tangential linear_history"
        f" {k.tangential:.4e} 0 {mu:g} damping velocity",
        "LIGGGHTS hooke/stiffness": f"kn {k.normal:.4e} kt {k.tangential:.4e}"
        f" gamman {dashpot / m:.4e} gammat 0",
        "YADE CundallStrack": f"kn {k.normal:.4e} ks {k.tangential:.4e}",
        "YADE Mindlin": f"betan {thornton:.5f} betas 0",
        "Kratos": f"DAMPING_GAMMA {thornton:.5f}",
        "MercuryDPM linear": f"stiffness {k.normal:.4e} dissipation {dashpot:.4e}"
        f" slidingStiffness {k.tangential:.4e}",
    }
