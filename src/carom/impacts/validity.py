"""Whether the assumptions of the theory hold for an impact, as numbers with a verdict."""

from math import isfinite, nan, sqrt

from carom.bodies.pairs import Pair
from carom.bodies.plausibility import doubts
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.neglected import (
    SMALL_CONTACT,
    SPIN,
    not_studied,
    rebound_error,
    spin_error,
)
from carom.impacts.result import ImpactResult
from carom.io.labels import Finding, Validity

YIELD_PRESSURE = 1.60  # p_0/Y at first yield of a sphere, von Mises (Johnson 1985, 6.1)
SLOW_CONTACT = 3.0  # contact time in transits of a wave through the sphere and back (Love 1927)
WEAK_COUPLING = 0.01  # |Dundurs' beta|: what is left uncoupled is below a hundredth
CLOSE_REBOUND = 0.01  # of psi_2, also against the full contact in three dimensions
STUDIED, LEAST_STUDIED = (0.3, 5.0), 0.5  # chi, and e, for which solids of one e were compared
FAST, YIELDED = 10.0, 0.05  # V_1/V_y up to which psi_2 is as close as this to rings of traction
METAL_FAST, METAL_YIELDED = 300.0, 0.07  # the same for metals
FULL = "the full contact in three dimensions"


def judge(
    hit: ImpactResult, strength: tuple[Finding, ...], losses: tuple[Finding, ...] = ()
) -> Validity:
    """Return the findings on an impact; `strength` are those on what the bodies bear."""
    coupling = _judged(
        "Dundurs beta",
        hit.pair.dundurs_beta,
        WEAK_COUPLING,
        "normal and tangential contact do not couple",
        "the materials are unlike, and this answer neglects their coupling",
    )
    spinning = (_judge_spin(hit, bool(losses)),) if hit.normal_spin else ()
    contact = judge_contact(hit, strength)
    return Validity((*contact, *losses, coupling, *spinning, _judge_rebound(hit, bool(losses))))


def _judge_rebound(hit: ImpactResult, loses: bool) -> Finding:
    """Return the finding on what slip off the motion and coupling may do to psi_2."""
    pair, name = hit.pair, "error of psi_2"
    numbers = pair.kappa, pair.dundurs_beta, pair.friction, pair.chi
    if pair.friction == 0.0 or not isfinite(hit.psi_in):
        nothing = "without friction the theory neglects nothing"
        return Finding(name, 0.0, CLOSE_REBOUND, True, nothing)
    if outside := not_studied(*numbers):
        return _unknown(name, f"{outside}; method='halfspace' solves the full contact")
    error = float(rebound_error(*numbers, hit.psi_in))
    if loses:
        return _unknown(name, f"with losses; for elastic bodies it is at most {error:.2g}")
    but = "apart from the spin about the normal, " if hit.normal_spin else ""
    good = f"{but}psi_2 is at most this far from {FULL}, by a study of such impacts"
    bad = f"{but}psi_2 may be this far from {FULL}, which method='halfspace' solves"
    return _judged(name, error, CLOSE_REBOUND, good, bad)


def _judge_spin(hit: ImpactResult, loses: bool) -> Finding:
    """Return the finding on what spin about the normal, which the theory leaves out, may do."""
    pair, name = hit.pair, "error of psi_2 by normal spin"
    cure = "method='halfspace' solves for it"
    if pair.friction == 0.0 or not isfinite(hit.psi_in):
        return Finding(name, 0.0, CLOSE_REBOUND, True, "without friction this spin does not matter")
    spin = abs(hit.normal_spin) * hit.scales.radius / (pair.friction * hit.normal_speed)
    outside = not_studied(pair.kappa, pair.dundurs_beta, pair.friction, pair.chi)
    if spin > SPIN.most:
        outside = f"spin of {spin:.3g} mu V_1/a_max is above {SPIN.most:g}"
    if loses:
        return _unknown(name, "with losses; the theory neglects this spin")
    if outside:
        return _unknown(name, f"{outside}; {cure}")
    good = "the spin about the normal, which the theory neglects, hardly matters"
    bad = f"the theory neglects the spin about the normal; {cure}"
    error = float(spin_error(pair.chi, hit.psi_in, spin))
    return _judged(name, error, CLOSE_REBOUND, good, bad)


def judge_losses(losses: LossNumbers, restitution: float, chi: float) -> Finding:
    """Return the finding on losses: which solid is assumed, and how much that may be in psi_2."""
    if losses.loss == Loss.METAL:
        return _judge_metal(losses)
    if losses.loss != Loss.PLASTIC:
        solid = "as viscous" if losses.loss == Loss.VISCOUS else "to relax"
        others = _others(losses.loss, restitution, chi)
        words = f"the solid is assumed {solid} in shear as in compression; {others}"
        return Finding("e", restitution, 1.0, None, words)
    ratio = losses.parameter**-2.5
    off = f"off by up to {YIELDED:g}"
    studied = ratio <= FAST * (1.0 + 1e-9)
    error = f"psi_2 is {off}" if studied else f"the error was not studied above {FAST:g}"
    words = f"the yielded contact is modelled by springs that obey Coulomb's law; {error}"
    soft = "its pressure stays at that of first yield; where it rises, as in Metal, e is higher"
    return Finding("V_1/V_y", ratio, FAST, None, f"{words}; {soft} by up to 0.25")


def _judge_metal(losses: LossNumbers) -> Finding:
    """Return the finding on a metal: how far its laws differ, and what springs may do to psi_2."""
    ratio = losses.parameter**-2.5
    laws = "e of other laws of perfectly plastic metals is lower by up to 0.12 or higher by 0.07"
    error = f"psi_2 is off by up to {METAL_YIELDED:g} as springs, not points, obey Coulomb's law"
    if ratio > METAL_FAST * (1.0 + 1e-9):
        error = f"the error of psi_2 was not studied above {METAL_FAST:g}"
    return Finding("V_1/V_y", ratio, METAL_FAST, None, f"{laws}; {error}")


def _others(loss: int, restitution: float, chi: float) -> str:
    """Return by how much psi_2 of other solids of the same e may differ, in words.

    (1 - e) max(1.2, 2.4 chi - 1.7) from Kelvin & Voigt's, an envelope of standard linear solids and
    yielding spheres, psi_1 up to 4 chi + 1; from a standard linear one twice that.
    """
    if not (STUDIED[0] <= chi <= STUDIED[1] and restitution >= LEAST_STUDIED):
        return "how far other solids of this e differ was not studied here"
    most = (1.0 if loss == Loss.VISCOUS else 2.0) * (1.0 - restitution)
    most *= max(1.2, 2.4 * chi - 1.7)
    return f"psi_2 of other solids of this e differs by up to {most:.2g}"


def judge_contact(hit: ImpactResult, strength: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """Return the findings on values that are hardly meant, a small contact, strength, slowness."""
    transits = hit.duration / max(_transit(hit.pair), 1e-300)
    slow = transits >= SLOW_CONTACT
    small = _judged(
        "a_max/R*",
        hit.scales.radius / hit.pair.effective_radius,
        SMALL_CONTACT,
        "the contact is small compared with the bodies",
        f"the contact is too large for Hertz's theory, which needs {SMALL_CONTACT} at most",
    )
    verdict = (
        "the contact lasts long enough to be quasi-static"
        if slow
        else f"elastic waves matter; the contact should last at least {SLOW_CONTACT:g} transits"
    )
    waves = Finding("contact time/wave transit", transits, SLOW_CONTACT, slow, verdict)
    return *doubts(hit.pair), small, *strength, waves


def _unknown(name: str, why: str) -> Finding:
    """Return the finding on what was not studied: here, or with losses."""
    colon = "" if why.startswith("with losses") else ":"
    return Finding(name, nan, CLOSE_REBOUND, None, f"not studied{colon} {why}")


def _judged(name: str, value: float, limit: float, good: str, bad: str) -> Finding:
    """Return the finding on a number that must not be beyond a limit."""
    holds = abs(value) <= limit
    return Finding(name, value, limit, holds, good if holds else bad)


def judge_pressure(pair: Pair, pressure: float) -> Finding:
    """Return the finding on yield where stresses are not known: by the pressure, without friction.

    First yield of a sphere under a pressure of Hertz's (Johnson 1985, section 6.1).
    """
    strengths = [
        m.yield_strength for m in (pair.first.material, pair.second.material) if m.yield_strength
    ]
    if not strengths:
        unknown = "not judged, as the yield strength is not known"
        return Finding("p_0/Y", float("nan"), YIELD_PRESSURE, None, unknown)
    body = "the softer body" if len(strengths) == 2 else "the body whose strength is known"
    yields = f"{body} yields above {YIELD_PRESSURE}, so the real restitution is below 1"
    ratio = pressure / min(strengths)
    return _judged("p_0/Y", ratio, YIELD_PRESSURE, f"{body} stays elastic", yields)


def _transit(pair: Pair) -> float:
    """Return the time of a bar wave through the slower sphere and back, 4 R sqrt(rho/E)."""
    bodies = [(body.radius, body.material) for body in pair.moving if not body.material.is_rigid]
    return max([4.0 * r / sqrt(m.young / (m.density or 1.0)) for r, m in bodies], default=0.0)


def judge_errors(psi_out: float, energy: float) -> tuple[Finding, ...]:
    """Return the findings on what a grid and steps leave of psi_2 and of the energy."""
    good = "the grid and the time steps are fine enough"
    bad = "the grid and the time steps are too coarse; take more elements and steps"
    limits = CLOSE_REBOUND, good, bad
    return _judged("error of psi_2", psi_out, *limits), _judged("error of energy", energy, *limits)
