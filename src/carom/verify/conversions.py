"""From elastic constants to the stiffnesses, and from restitution to the dampings, that codes take.

A linear contact cannot be as stiff as Hertz's at all loads: k_n is chosen for one normal speed.
"""

from collections.abc import Callable
from math import exp, pi, sqrt
from typing import NamedTuple

from carom.bodies.checks import checked_pair, checked_scales
from carom.bodies.pairs import Pair
from carom.dem import damping
from carom.dem.springs import LammpsMindlin, LinearSpring
from carom.dimensionless.numerics.hertz import DURATION
from carom.quantities.refusals import checked_type, one_of, refusal, refuse
from carom.quantities.units import Value, not_negative, positive

SPRING, MINDLIN = LinearSpring(), LammpsMindlin("mindlin_rescale/force")


class Stiffnesses(NamedTuple):
    """Stiffnesses of one contact in the conventions of codes; SI units.

    `normal` and `tangential` are of linear springs that are pressed as far as Hertz's contact, so
    that their `ratio` is kappa; `normal_by_duration` lets the contact last as long instead. `hertz`
    is k_n of F_n = k_n sqrt(R*) d^(3/2), 4 E*/3; `mindlin` k_t of F_t = k_t a U, 2 G* (8 G_eff, as
    codes write it); `steepest` the largest dF_n/dd during the impact, 2 E* a_max.
    """

    normal: float
    normal_by_duration: float
    tangential: float
    ratio: float
    hertz: float
    mindlin: float
    steepest: float


def stiffnesses(pair: Pair, normal_speed: float | str) -> Stiffnesses:
    """Return the stiffnesses of a contact for DEM codes, from E, nu, sizes and normal speed.

    A linear spring has k_n = (4/5) P_max/d_max, so that the energy of the impact presses it to
    d_max, as in LIGGGHTS' hooke, or k_n = m_n (pi/t_c)^2, so that the contact lasts as long. Its
    k_t/k_n is kappa = G*/E* (Mindlin 1949).

    Parameters
    ----------
    pair : Pair
        The bodies.
    normal_speed : float or str
        V_1 in m/s, positive.

    Returns
    -------
    Stiffnesses
        normal, normal_by_duration, tangential and steepest in N/m; ratio, k_t/k_n; hertz and
        mindlin in Pa.

    Raises
    ------
    InputError
        If the pair is not a Pair, or the speed is not positive.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> k = carom.verify.stiffnesses(pair, "1 m/s")
    >>> f"{k.normal:.4g} N/m, k_t/k_n = {k.ratio:.4f}"
    '2.982e+07 N/m, k_t/k_n = 0.8235'
    """
    checked_pair(pair)
    scales = checked_scales(pair, positive("normal_speed", normal_speed))
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
    """Return Poisson's ratio of equal materials: kappa = 2 (1 - nu)/(2 - nu) (Mindlin 1949) for nu.

    Elastic materials have nu from -1 to 1/2, and so kappa from 4/3 down to 2/3.

    Parameters
    ----------
    kappa : float
        G*/E*, positive and below 2.

    Returns
    -------
    float
        Poisson's ratio nu.

    Raises
    ------
    InputError
        If it is out of range.

    Examples
    --------
    >>> round(carom.verify.poisson_from_kappa(1.4 / 1.7), 12)
    0.3
    """
    value = positive("kappa", kappa)
    refuse(value >= 2.0 and refusal("kappa", kappa, "must be below 2"))
    return (2.0 - 2.0 * value) / (2.0 - value)


CONVENTIONS: dict[str, Callable[[float], float]] = {
    "critical": damping.damping_ratio,  # c/(2 sqrt(k m)); betan of YADE's springs
    "lammps tsuji": damping.tsuji_damping,  # alpha of LAMMPS, damping tsuji
    "thornton": damping.thornton_damping,  # betan of YADE, DAMPING_GAMMA of Kratos: no pull
}


def damping_from_restitution(restitution: float, convention: str = "critical") -> float:
    """Return the damping, a pure number, that DEM codes need for a restitution.

    "critical" is the fraction zeta = -ln e/sqrt(pi^2 + ln^2 e) of critical damping: c = 2 zeta
    sqrt(k m_n) for a linear spring, and c = 2 zeta sqrt(5/6) sqrt(2 E* a m_n) for Hertz's contact,
    exact if the force may become a pull (Antypov & Elliott 2011). "lammps tsuji" is alpha of Tsuji
    et al. (1992). "thornton" is for a contact that ends when its force becomes zero (Thornton,
    Cummins & Cleary 2013, (B6), (B7)).

    Parameters
    ----------
    restitution : float
        e, above 0 and at most 1.
    convention : str
        "critical", "lammps tsuji" or "thornton".

    Returns
    -------
    float
        zeta, alpha or betan, a pure number.

    Raises
    ------
    InputError
        If e is not above 0 and at most 1, or the convention is not known.

    Examples
    --------
    >>> zeta = carom.verify.damping_from_restitution(0.5)
    >>> round(zeta, 4), round(carom.verify.restitution_from_damping(zeta), 12)
    (0.2155, 0.5)
    """
    value = damping.damped_restitution("restitution", restitution)
    rule = CONVENTIONS[one_of("convention", convention, CONVENTIONS)]
    return rule(value) + 0.0  # no -0 at e = 1


def restitution_from_damping(value: float, convention: str = "critical") -> float:
    """Return the restitution of a damping, the inverse of `damping`.

    Parameters
    ----------
    value : float
        The damping, not negative.
    convention : str
        As for `damping`.

    Returns
    -------
    float
        e, above 0 and at most 1.

    Raises
    ------
    InputError
        If the damping is negative or too large for any restitution, or the convention is unknown.

    Examples
    --------
    >>> alpha = carom.verify.damping_from_restitution(0.7, "lammps tsuji")
    >>> round(carom.verify.restitution_from_damping(alpha, "lammps tsuji"), 10)
    0.7
    """
    from scipy.optimize import brentq

    rule = CONVENTIONS[one_of("convention", convention, CONVENTIONS)]
    wanted = not_negative("damping", value, "1")
    if convention == "critical" and wanted < 1.0:
        return exp(-pi * wanted / sqrt(1.0 - wanted**2))
    least, most = rule(1.0), rule(damping.SMALLEST)
    if wanted <= least:
        return 1.0
    if wanted > most:
        raise refusal("damping", value, f"must be at most {most:.4g}; no restitution needs more")
    return float(brentq(lambda e: rule(e) - wanted, damping.SMALLEST, 1.0, xtol=1e-14))


def recipes(
    pair: Pair,
    normal_speed: float,
    wanted: Value = 1.0,
    *,
    spring: LinearSpring = SPRING,
    mindlin: LammpsMindlin = MINDLIN,
) -> dict[str, str]:
    """Return what to write into the inputs of DEM codes for a contact, by code, in SI units.

    Parameters
    ----------
    pair : Pair
        The bodies and their friction.
    normal_speed : float
        Normal speed of the impact for which linear springs are made, in m/s.
    wanted : float or str
        Normal coefficient of restitution.
    spring, mindlin : LinearSpring, LammpsMindlin
        Tangential stiffnesses, e.g. those that `tune` has found, and of `mindlin` the tangential
        damping; by default the stiffnesses of the bodies, and none.

    Returns
    -------
    dict
        Text by the name of the code and of its contact model; the exact law first, several lines.

    Raises
    ------
    InputError
        If `stiffnesses` or `damping` refuses a value.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> print(carom.verify.recipes(pair, 1.0)["LAMMPS Hertz"])
    hertz 1.5385e+11 0 tangential mindlin_rescale/force 1.9005e+11 0 0.2 damping velocity
    """
    allowed = "must be a {0}, e.g. carom.{0}()"
    checked_type("spring", spring, LinearSpring, allowed.format("LinearSpring"))
    checked_type("mindlin", mindlin, LammpsMindlin, allowed.format("LammpsMindlin"))
    e = damping.damped_restitution("restitution", wanted)
    k, mu, zeta = stiffnesses(pair, normal_speed), pair.friction, damping_from_restitution(e)
    ratio = k.ratio if spring.stiffness_ratio is None else spring.stiffness_ratio
    k_n, k_t, dashpot = k.normal, ratio * k.normal, 2.0 * zeta * sqrt(k.normal * pair.normal_mass)
    loss, sideways, rule = 0.0, 0.0, "velocity"
    if e < 1.0:
        loss, sideways, rule = e, mindlin.tangential_damping, "coeff_restitution"
    beta = damping_from_restitution(e, "thornton")
    return {
        **_exact_law(pair, normal_speed, e),
        "LAMMPS Hertz": f"hertz {k.hertz:.4e} {loss:g} tangential {mindlin.variant}"
        f" {mindlin.stiffness * k.mindlin:.4e} {sideways:g} {mu:g} damping {rule}",
        "LAMMPS Hooke": f"hooke {k_n:.4e} {dashpot:.4e} tangential linear_history"
        f" {k_t:.4e} 0 {mu:g} damping velocity",
        "LIGGGHTS hooke/stiffness": f"kn {k_n:.4e} kt {k_t:.4e}"
        f" gamman {dashpot / pair.normal_mass:.4e} gammat 0",
        "LIGGGHTS hertz, EDEM": f"E, nu of the bodies, coefficientRestitution {e:g}",
        "YADE CundallStrack": f"kn {k_n:.4e} ks {k_t:.4e}"
        + ("" if e == 1.0 else " (has no damping)"),
        "YADE Mindlin": f"betan {beta:.5f} betas 0",
        "Kratos": f"DAMPING_GAMMA {beta:.5f}",
        "MercuryDPM linear": f"stiffness {k_n:.4e} dissipation {dashpot:.4e}"
        f" slidingStiffness {k_t:.4e}",
        "MFiX linear": f"KN {k_n:.4e} KT_FAC {ratio:.4f} DES_EN_INPUT {e:g}",
    }


def _exact_law(pair: Pair, normal_speed: float, restitution: float) -> dict[str, str]:
    """Return the lines of LAMMPS with the exact law, unless a body is rigid; types are 1 and 2."""
    one, two = pair.first.material, pair.second.material
    if one.is_rigid or two.is_rigid:
        return {}
    friction = f"friction {pair.friction:g}"
    damped = f" restitution {restitution:g} speed {normal_speed:.4g}" if restitution < 1.0 else ""
    stuff = [f"young {each.young:.6g} poisson {each.poisson:g} " for each in (one, two)]
    lines = ["pair_style carom", f"pair_coeff 1 1 {stuff[0]}{friction}{damped}"]
    if len(pair.moving) == 1:
        lines.append(f"fix walls all wall/carom {stuff[1]}{friction}{damped} region WALL")
    elif stuff[0] != stuff[1]:
        lines.append(f"pair_coeff 2 2 {stuff[1]}{friction}{damped}")
    return {"LAMMPS, exact law": "\n".join(lines)}
