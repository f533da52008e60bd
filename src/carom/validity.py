"""Whether the assumptions of the theory hold for an impact, as numbers with a verdict."""

from math import inf, isinf, sqrt

from carom.bodies import Material
from carom.pairs import Pair
from carom.results import Finding, Validity

SMALL_CONTACT = 0.1  # a_max/R*: Hertz's parabolic gap against the sphere (Johnson 1985, 4.2)
YIELD_PRESSURE = 1.60  # p_0/Y at first yield of a sphere, von Mises (Johnson 1985, 6.1)
SLOW_CONTACT = 3.0  # contact time in transits of a wave through the sphere and back (Love 1927)
WEAK_COUPLING = 0.01  # |Dundurs' beta|: what is left uncoupled is below a hundredth


def judge(pair: Pair, normal_speed: float, duration: float) -> Validity:
    """Return the findings on an impact: small contact, no yield, slow contact, no coupling."""
    return Validity((*judge_contact(pair, normal_speed, duration), _coupling(pair.dundurs_beta)))


def judge_contact(pair: Pair, normal_speed: float, duration: float) -> tuple[Finding, ...]:
    """Return the findings on what does not depend on friction: small contact, no yield, slow."""
    scales = pair.scales(normal_speed)
    return (
        _small_contact(scales.radius / pair.effective_radius),
        *_yield(pair, scales.pressure),
        _slow_contact(duration / max(_transit(pair), 1e-300)),
    )


def _small_contact(ratio: float) -> Finding:
    holds = ratio <= SMALL_CONTACT
    verdict = (
        "the contact is small against the bodies"
        if holds
        else f"the contact is too large for Hertz's theory, which wants {SMALL_CONTACT} at most"
    )
    return Finding("a_max/R*", ratio, SMALL_CONTACT, holds, verdict)


def _yield(pair: Pair, pressure: float) -> tuple[Finding, ...]:
    strengths = [
        m.yield_strength for m in (pair.first.material, pair.second.material) if m.yield_strength
    ]
    if not strengths:
        unknown = "yield strength not known, so not judged"
        return (Finding("p_0/Y", float("nan"), YIELD_PRESSURE, None, unknown),)
    ratio = pressure / min(strengths)
    holds = ratio <= YIELD_PRESSURE
    body = "the softer body" if len(strengths) == 2 else "the body whose strength is known"
    verdict = (
        f"{body} stays elastic"
        if holds
        else f"{body} yields from {YIELD_PRESSURE} on: real restitution is below 1"
    )
    return (Finding("p_0/Y", ratio, YIELD_PRESSURE, holds, verdict),)


def _transit(pair: Pair) -> float:
    """Return the time of a bar wave through the slower sphere and back, 4 R sqrt(rho/E)."""
    return max(4.0 * body.radius / _wave_speed(body.material) for body in pair.moving)


def _wave_speed(material: Material) -> float:
    return inf if isinf(material.young) else sqrt(material.young / (material.density or 1.0))


def _slow_contact(ratio: float) -> Finding:
    holds = ratio >= SLOW_CONTACT
    verdict = (
        "the contact lasts long enough to be quasi-static"
        if holds
        else f"elastic waves matter: the contact should last {SLOW_CONTACT:g} transits at least"
    )
    return Finding("contact time/wave transit", ratio, SLOW_CONTACT, holds, verdict)


def _coupling(beta: float) -> Finding:
    holds = abs(beta) <= WEAK_COUPLING
    verdict = (
        "normal and tangential contact do not couple"
        if holds
        else "unlike materials: the answer is the uncoupled one, an approximation"
    )
    return Finding("Dundurs beta", beta, WEAK_COUPLING, holds, verdict)
