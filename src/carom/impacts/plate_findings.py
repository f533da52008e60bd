"""Findings on a plate that is struck: whether it is thin enough to bend, and wide enough."""

from collections.abc import Callable
from math import inf
from typing import Any, cast

from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair, Scales
from carom.bodies.shapes import HalfSpace
from carom.bodies.walls import half_wave, quiet_width
from carom.impacts.findings import Assumption, bounded, judged
from carom.impacts.result import ImpactResult
from carom.quantities.prefixes import text
from carom.quantities.refusals import refusal, refuse
from carom.quantities.verdicts import Finding

LONG_WAVE = 6.0  # thicknesses in a bending wave of twice the contact time, for thin plates
SHEARING = 7.0  # over the square of that ratio: what shorter waves add to 1 - e (theory, page 11)
CLOSE_RESTITUTION = 0.01
BENDING = "bending wave/h"
SMALL_CONTACT = 0.1  # a_max/h: what the other face and the moment of friction change
SMALL_DEFLECTION = 0.2  # of h, up to which a plate bends without stretching


def bending(hit: ImpactResult, plate: HalfSpace) -> Finding:
    """Return the finding on the length of bending waves, against the thickness."""
    ratio = wave_ratio(hit, plate)
    good = "the plate is thin enough to bend"
    between = "not judged: the plate is neither thin nor a thick wall; 1 - e is an estimate"
    holds = True if ratio >= LONG_WAVE else None
    return Finding(BENDING, ratio, LONG_WAVE, holds, good if holds else between)


def shearing(hit: ImpactResult, plate: HalfSpace) -> Finding | None:
    """Return the finding on what shear of a thin plate takes, which the theory leaves out."""
    if wave_ratio(hit, plate) < LONG_WAVE:
        return None
    error = sheared(hit, plate)
    percent = f"{100.0 * SHEARING / wave_ratio(hit, plate) ** 2:.2g} %"
    more = f"as the plate also shears, 1 - e is larger by some {percent} of itself"
    return bounded("error of e", error, CLOSE_RESTITUTION, more, f"not judged: {more}")


def sheared(hit: ImpactResult, plate: HalfSpace) -> float:
    """Return by how much e comes out too high as the plate also shears, (1 - e) 7/r^2."""
    return (1.0 - hit.normal_restitution) * SHEARING / wave_ratio(hit, plate) ** 2


def wave_ratio(hit: ImpactResult, plate: HalfSpace) -> float:
    """Return the length of bending waves of twice the contact time over the thickness."""
    return 2.0 * half_wave(plate, hit.duration) / cast(float, plate.thickness)


def small_on_plate(hit: ImpactResult, plate: HalfSpace) -> Finding:
    """Return the finding on the contact against the thickness."""
    ratio = hit.max_radius / cast(float, plate.thickness)
    good = "the contact is small against the plate, whose other face does not matter"
    bad = "the contact is large against the plate; its other face and its turning matter"
    return judged("a_max/h", ratio, SMALL_CONTACT, good, bad)


def deflection(hit: ImpactResult, plate: HalfSpace) -> Finding:
    """Return the finding on how far the plate's middle moves, impulse over 8 sqrt(D rho h)."""
    impulse = hit.pair.normal_mass * hit.scales.speed * (1.0 + hit.normal_restitution)
    ratio = impulse / (plate.impedance * cast(float, plate.thickness))
    good, bad = "the plate bends without stretching", "the plate bends so far that it stretches"
    return judged("deflection/h", ratio, SMALL_DEFLECTION, good, bad)


def rim(hit: ImpactResult) -> Finding | None:
    """Return the finding on the rim: waves of the period of the contact run to it and back."""
    wall, bends = hit.pair.second, hit.pair.gives_way(hit.scales)
    if not isinstance(wall, HalfSpace) or not (bends or wall.width is not None):
        return None
    needed = quiet_width(hit.pair, hit.scales, hit.duration)
    if wall.width is None:
        words = f"the plate is taken to be wide: more than {text(needed, 'm', 2)}"
        return Finding("width", inf, needed, True, words)
    wide = wall.width >= needed
    answers = f"the rim answers within the contact; it must be {text(needed, 'm', 2)} wide"
    good = "no wave comes back from the rim within the contact"
    return Finding("width", wall.width, needed, wide, good if wide else answers)


def refuse_thin(pair: Pair, scales: Scales, losses: LossLaw | None) -> None:
    """Raise InputError where the theory of a plate cannot be applied at all."""
    thickness = pair.thickness
    lossy = "bodies on a plate are elastic so far; leave losses or thickness out"
    refuse(losses is not None and refusal("losses", losses, lossy))
    deep = f"the sphere would be pressed in by {text(scales.length, 'm')} on a thick wall"
    thin = thickness is not None and not thickness > scales.length
    refuse(thin and refusal("thickness", thickness, f"must be above the penetration; {deep}"))


def _if_plate(judge: Callable[[ImpactResult, Any], Finding | None]) -> Assumption:
    """Return an assumption that does not arise where no plate gives way."""
    return lambda hit: judge(hit, hit.pair.second) if hit.pair.gives_way(hit.scales) else None


OF_PLATES: tuple[Assumption, ...] = (
    *map(_if_plate, (bending, shearing, small_on_plate, deflection)),
    rim,
)
