"""Whether the assumptions of the theory hold for an impact, as numbers with a verdict.

A finding is a function of an impact in one of the lists at the end; one that does not arise is
None. What the bodies bear, which takes more, is in `peaks`.
"""

from collections.abc import Sequence
from math import inf, isfinite, isnan, nan, sqrt
from typing import cast

import numpy as np

from carom.bodies.pairs import Pair
from carom.bodies.plausibility import doubts
from carom.bodies.shapes import HalfSpace, Sphere
from carom.bodies.smooth_body import Body
from carom.bodies.walls import radiated_share
from carom.dimensionless import neglected
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.neglected import SMALL_CONTACT
from carom.impacts.findings import OF_ENERGY, Assumption, bounded, judged, lacking, roughness, waves
from carom.impacts.plate_findings import LONG_WAVE, OF_PLATES, sheared, wave_ratio
from carom.impacts.result import ImpactResult
from carom.quantities.verdicts import Finding, Validity

SLOW_CONTACT = 3.0  # contact time in transits of a wave through the sphere and back (Love 1927)
WEAK_COUPLING = 0.01  # |Dundurs' beta|: what is left uncoupled is below a hundredth
CLOSE_REBOUND = 0.01  # of psi_2, also against the full contact in three dimensions
STUDIED, LEAST_STUDIED = (0.3, 5.0), 0.5  # chi, and e, for which solids of one e were compared
FAST, YIELDED = 10.0, 0.05  # V_1/V_y up to which psi_2 is as close as this to rings of traction
STIFF_SHELL, SOFT_SHELL = 0.01, 0.1  # dent of a shell over Hertz's depth: as a ball, as none
SOLID_BALL = 0.4 * (1.0 + 1e-9)  # K^2/R^2
NO_SOLID_BALL = "a ball with this radius of gyration is not solid"
METAL_FAST, METAL_YIELDED = 300.0, 0.07  # the same for metals
SLIM, TURNS = 8.3, 1e-9  # axes of an ellipse up to which turning forces were compared; none
SLENDER = 3.0  # radius of gyration over that of curvature, from which on a body may bend
GRAVITY = 9.80665  # m/s^2
LIGHT = 0.02  # of V_1, which gravity may add within the contact
FULL = "the full contact in three dimensions"


def judge(hit: ImpactResult, assumptions: Sequence[Assumption]) -> Validity:
    """Return the findings on an impact, of what its bodies bear and of these assumptions."""
    findings = (assumption(hit) for assumption in assumptions)
    there = tuple(finding for finding in findings if finding is not None)
    good = "the contact is small compared with the bodies"
    bad = f"the contact is too large for Hertz's theory, which needs {SMALL_CONTACT} at most"
    small = judged("a_max/R*", hit._size_ratio, SMALL_CONTACT, good, bad)
    return Validity((*doubts(hit.pair), small, *hit._strength, *there))


def _slow_contact(hit: ImpactResult) -> Finding:
    transits = hit.duration / max(_transit(hit.pair), 1e-300)
    name = "contact time/wave transit"
    if transits == 0.0:
        stuffs = hit.pair.materials.items()
        without = {body: stuff for body, stuff in stuffs if stuff.density is None}
        return lacking(name, SLOW_CONTACT, "density", without)
    slow = transits >= SLOW_CONTACT
    good = "the contact lasts long enough to be quasi-static"
    bad = f"elastic waves matter; the contact should last at least {SLOW_CONTACT:g} transits"
    return Finding(name, transits, SLOW_CONTACT, slow, good if slow else bad)


def _transit(pair: Pair) -> float:
    """Return the time of a bar wave through the slower body and back, 4 R sqrt(rho/E).

    R is how far the centre of mass is from the contact; infinite where no density is known.
    """
    bodies = [(body.reach, body.material) for body in pair.moving if not body.material.is_rigid]
    return max([4.0 * r * sqrt((m.density or inf) / m.young) for r, m in bodies], default=0.0)


def _weight(hit: ImpactResult) -> Finding | None:
    """Return the finding on gravity, which adds up to 2 chi g t_c/V_1 to psi_2, but no energy."""
    gained = GRAVITY * hit.duration / hit.scales.speed
    if isinstance(hit.pair.second, Sphere) or not np.any(hit.psi_in) or not gained > LIGHT:
        return None
    change = 2.0 * hit.pair.chi * gained
    words = f"not judged: where gravity acts along the normal, psi_2 changes by up to {change:.2g}"
    return Finding("speed by weight/V_1", gained, LIGHT, None, words)


def _shell(hit: ImpactResult) -> Finding | None:
    """Return the finding on hollow spheres: dent over d_max, k = 4 E h^2/(R sqrt(3 (1 - nu^2)))."""
    dents = [_dent(body, hit) for body in hit.pair.moving if not body.material.is_rigid]
    dent, name = max(dents, default=0.0), "dent of the shell/d_max"
    if isnan(sum(dents)):
        words = f"{NO_SOLID_BALL}; Sphere(inner_radius=...) tells a shell"
        return Finding(name, nan, STIFF_SHELL, None, f"not judged: {words}", "inner_radius")
    if dent == 0.0:
        return None
    if dent <= SOFT_SHELL:
        good = "the shell is so stiff that its contact is that of a solid ball"
        perhaps = "the shell gives way a little, which the theory neglects"
        return bounded(name, dent, STIFF_SHELL, good, perhaps)
    words = (
        "the shell dents, which the theory neglects: measure e and the rebound at several angles, "
        "and let carom.fit find kappa"
    )
    return Finding(name, dent, STIFF_SHELL, False, words)


def _dent(ball: Sphere, hit: ImpactResult) -> float:
    """Return the dent of a shell over d_max: 0 if it is solid, NaN if that is not known."""
    if ball.gyration_radius is not None:
        return nan if ball.gyration_ratio > SOLID_BALL else 0.0
    if ball.inner_radius == 0.0:
        return 0.0
    wall, stuff = ball.radius - ball.inner_radius, ball.material
    thin = 4.0 * stuff.young * wall**2 / ball.radius
    return hit.scales.force * sqrt(3.0 * (1.0 - stuff.poisson**2)) / (thin * hit.scales.length)


def _slender(hit: ImpactResult) -> Finding | None:
    """Return the finding on bodies that bend: radius of gyration against that at the contact."""
    bodies = [body for body in hit.pair.moving if isinstance(body, Body)]
    ratio = max((body.slenderness for body in bodies if not body.material.is_rigid), default=0.0)
    if ratio <= SLENDER:
        return None
    words = "not judged: a slender body bends, too; the theory takes it as rigid but at the contact"
    return Finding("K/R at the contact", ratio, SLENDER, None, words)


def _slips_aside(hit: ImpactResult) -> Finding | None:
    """Return the finding on slip that is not along the force, studied for round contacts alone."""
    pair = hit.pair  # with nu = 0 a traction moves the surface along itself alone
    along = all(m.is_rigid or m.poisson == 0.0 for m in pair.materials.values())
    if pair.friction == 0.0 or (pair.dundurs_beta == 0.0 and along):
        return None
    words = "that slip is not quite along the force was studied for spheres only, there to 0.01"
    return _unknown("error of psi_2", f"off the centre; {words}")


def _turns(hit: ImpactResult) -> Finding | None:
    """Return the finding on forces that turn in an ellipse, by springs of two stiffnesses."""
    axes = hit.pair._ellipse[1:3]
    slim = max(axes) / min(axes)
    if hit.pair.is_planar or slim <= 1.0 + TURNS or hit.pair.friction == 0.0:
        return None
    good = "springs of two stiffnesses give a force that turns to 0.002 of the friction limit"
    return bounded("a/b", slim, SLIM, good, "not studied: the force may turn in a slimmer ellipse")


def _solid(hit: ImpactResult) -> Finding | None:
    """Return the finding on the solid that losses assume."""
    if hit.losses is None:
        return None
    numbers = hit.losses._loss(hit.pair, hit.scales)
    if numbers.loss == Loss.PLATE:
        words = "not judged: nothing but its inelasticity is known of the plate"
        where = "HalfSpace(thickness=...) instead of ZenerPlate"
        return Finding("e", hit.normal_restitution, 1.0, None, f"{words}; give {where}", where)
    if hit.pair.friction > 0.0 and not hit.pair.is_central:
        words = "not studied: how other solids of this e leave, struck off their centre"
        return Finding("e", hit.normal_restitution, 1.0, None, words)
    oblique = bool(np.any(hit.psi_in))
    return judge_losses(numbers, hit.normal_restitution, hit.pair.chi, oblique=oblique)


def judge_losses(
    losses: LossNumbers, restitution: float, chi: float, *, oblique: bool = True
) -> Finding:
    """Return the finding on losses: which solid is assumed, and how much that may be in psi_2."""
    if losses.loss == Loss.METAL:
        return _judge_metal(losses)
    if losses.loss != Loss.PLASTIC:
        if not oblique:
            words = "struck head-on, where what the solid loses in shear does not matter"
            return Finding("e", restitution, 1.0, True, words)
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

    (1 - e) max(1.2, 2.4 chi - 1.7) from Kelvin & Voigt's, psi_1 up to 4 chi + 1, an envelope; from
    a standard linear solid twice that.
    """
    if not (STUDIED[0] <= chi <= STUDIED[1] and restitution >= LEAST_STUDIED):
        return "how far other solids of this e differ was not studied here"
    most = (1.0 if loss == Loss.VISCOUS else 2.0) * (1.0 - restitution)
    most *= max(1.2, 2.4 * chi - 1.7)
    return f"psi_2 of other solids of this e differs by up to {most:.2g}"


def _spin(hit: ImpactResult) -> Finding | None:
    """Return the finding on what spin about the normal, which the theory leaves out, may do."""
    if not hit.normal_spin:
        return None
    pair, name = hit.pair, "error of psi_2 by normal spin"
    cure = "method='halfspace' solves for it"
    if pair.friction == 0.0 or not isfinite(hit.psi_in):
        return Finding(name, 0.0, CLOSE_REBOUND, True, "without friction this spin does not matter")
    spin = abs(hit.normal_spin) * hit.scales.radius / (pair.friction * hit.normal_speed)
    outside = neglected.not_studied(pair.kappa, pair.dundurs_beta, pair.friction, pair.chi)
    if spin > neglected.SPIN.most:
        outside = f"spin of {spin:.3g} mu V_1/a_max is above {neglected.SPIN.most:g}"
    if hit.losses is not None:
        return _unknown(name, "with losses; the theory neglects this spin")
    if outside:
        return _unknown(name, f"{outside}; {cure}")
    good = "the spin about the normal, which the theory neglects, hardly matters"
    bad = f"the theory neglects the spin about the normal; {cure}"
    error = float(neglected.spin_error(pair.chi, hit.psi_in, spin))
    return bounded(name, error, CLOSE_REBOUND, good, bad)


def _rebound(hit: ImpactResult) -> Finding:
    """Return the finding on what slip off the motion and coupling may do to psi_2."""
    pair, name = hit.pair, "error of psi_2"
    numbers = pair.kappa, pair.dundurs_beta, pair.friction, pair.chi
    unlike = abs(pair.dundurs_beta) > neglected.NO_BETA
    if pair.friction == 0.0 or not isfinite(hit.psi_in):
        nothing = "without friction the theory neglects nothing"
        return Finding(name, 0.0, CLOSE_REBOUND, True, nothing)
    if hit.psi_in == 0.0 and not unlike:
        return Finding(name, 0.0, CLOSE_REBOUND, True, "like bodies that meet head-on do not slip")
    if outside := neglected.not_studied(*numbers):
        return _unknown(name, f"{outside}; method='halfspace' solves the full contact")
    by_waves, wall = _waved(hit)
    if isnan(by_waves):
        return _unknown(name, wall)
    by_contact = float(neglected.rebound_error(*numbers, hit.psi_in))
    error = by_contact + by_waves
    if hit.losses is not None:
        return _unknown(name, f"with losses; for elastic bodies it is at most {error:.2g}")
    but = "apart from the spin about the normal, " if hit.normal_spin else ""
    why = f", as the materials are unlike (Dundurs beta {pair.dundurs_beta:.3g})" * unlike
    good = f"{but}psi_2 is at most this far from {FULL}{wall}, by studies of such impacts"
    bad = f"{but}psi_2 may be this far from {FULL}{why}, which method='halfspace' solves{wall}"
    if by_waves > by_contact:
        bad = f"{but}psi_2 may be this far from {FULL}{wall}, to which waves add {by_waves:.2g}"
    return bounded(name, error, CLOSE_REBOUND, good, bad)


def _waved(hit: ImpactResult) -> tuple[float, str]:
    """Return what waves in the wall may do to psi_2 that the theory leaves out, and which they are.

    It is NaN where that is not known, and then with the reason.
    """
    pair, second = hit.pair, hit.pair.second
    if isinstance(second, Sphere) or second.material.is_rigid:
        return 0.0, ""
    if isinstance(second, HalfSpace) and pair.gives_way(hit.scales):
        if wave_ratio(hit, second) < LONG_WAVE:
            return nan, "all waves of a plate that is neither thin nor a thick wall"
        sizes = hit.max_radius / cast(float, second.thickness), sheared(hit, second)
        error = float(neglected.plate_error(pair.chi, hit.psi_in, *sizes))
        return error, " on a plate with all its waves"
    share = radiated_share(pair, hit.scales)
    if isnan(share):
        return nan, "waves in a wall without a density"
    error = float(neglected.wave_error(pair.chi, hit.psi_in, share))
    return error, " on a wall with its waves"


def _unknown(name: str, why: str) -> Finding:
    """Return the finding on what was not studied: here, or with losses."""
    colon = "" if why.startswith("with losses") else ":"
    return Finding(name, nan, CLOSE_REBOUND, None, f"not studied{colon} {why}")


def judge_errors(psi_out: float, energy: float) -> tuple[Finding, ...]:
    """Return the findings on what a grid and steps leave of psi_2 and of the energy."""
    good = "the grid and the time steps are fine enough"
    bad = "the grid and the time steps are too coarse; take more elements and steps"
    limits = CLOSE_REBOUND, good, bad
    return judged("error of psi_2", psi_out, *limits), judged("error of energy", energy, *limits)


def waves_aside(hit: ImpactResult) -> Finding:
    """Return the finding on waves in the wall, which boundary elements leave out."""
    error, wall = _waved(hit) if isfinite(hit.psi_in) else (0.0, "")
    if isnan(error):
        return _unknown("error of psi_2 by waves", wall)
    good = "waves in the wall, which boundary elements leave out, hardly change psi_2"
    bad = "boundary elements leave out waves in the wall, which may change psi_2 by this"
    return bounded("error of psi_2 by waves", error, CLOSE_REBOUND, good, bad)


OF_BODIES: tuple[Assumption, ...] = (
    *(_slow_contact, _weight, _shell, roughness, waves, *OF_PLATES, *OF_ENERGY, _solid),
)
OF_SHAPES: tuple[Assumption, ...] = (
    *(f for f in OF_BODIES if f is not _shell),
    *(_slender, _turns, _slips_aside),
)
OF_THEORY: tuple[Assumption, ...] = (*OF_BODIES, _spin, _rebound)
