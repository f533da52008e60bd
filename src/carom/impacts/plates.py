"""What the theory of a plate needs: long bending waves, a small contact and deflection, width."""

from math import inf, pi
from typing import cast

from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair, Scales
from carom.bodies.shapes import HalfSpace
from carom.impacts.dissipation import compressional_speed
from carom.impacts.findings import judged
from carom.impacts.result import ImpactResult
from carom.io.labels import Finding
from carom.quantities.arrays import sqrt
from carom.quantities.prefixes import text
from carom.quantities.refusals import refusal, refuse

LONG_WAVE = 6.0  # thicknesses in a bending wave of twice the contact time, for thin plates
SHEARING = 6.8  # over the square of that ratio: what shorter waves add to 1 - e (theory, page 11)
ECHO = 2.0  # thicknesses that a compressional wave runs until its echo is back
SMALL_CONTACT = 0.1  # a_max/h: what the other face and the moment of friction change
SMALL_DEFLECTION = 0.2  # of h, up to which a plate bends without stretching


def bending(hit: ImpactResult) -> Finding | None:
    """Return the finding on a plate that bends: its waves are long, or no echo comes back."""
    if hit.pair.thickness is None:
        return None
    plate, thickness = cast(HalfSpace, hit.pair.second), hit.pair.thickness
    name, ratio = "bending wave/h", 2.0 * _half_wave(plate, hit.duration) / thickness
    if hit.duration < ECHO * thickness / compressional_speed(plate.material):
        thick = "no echo is back when the contact ends: the wall is thick; leave thickness out"
        return Finding(name, ratio, LONG_WAVE, False, thick)
    if ratio < LONG_WAVE:
        between = "not judged: the plate is neither thin nor a thick wall; 1 - e is an estimate"
        return Finding(name, ratio, LONG_WAVE, None, between)
    percent = 100.0 * SHEARING / ratio**2
    more = f"1 - e is larger by some {percent:.0f} % of itself, as it also shears"
    return Finding(name, ratio, LONG_WAVE, True, f"the plate is thin enough to bend; {more}")


def small_on_plate(hit: ImpactResult) -> Finding | None:
    """Return the finding on the contact against the thickness."""
    if hit.pair.thickness is None:
        return None
    ratio = hit.max_radius / hit.pair.thickness
    good = "the contact is small against the plate, whose turning by friction is neglected"
    bad = "the contact is large against the plate; its other face and its turning matter"
    return judged("a_max/h", ratio, SMALL_CONTACT, good, bad)


def deflection(hit: ImpactResult) -> Finding | None:
    """Return the finding on how far the plate's middle moves, impulse over 8 sqrt(D rho h)."""
    if hit.pair.thickness is None:
        return None
    impulse = hit.pair.normal_mass * hit.scales.speed * (1.0 + hit.normal_restitution)
    ratio = impulse / (cast(HalfSpace, hit.pair.second).impedance * hit.pair.thickness)
    good, bad = "the plate bends without stretching", "the plate bends so far that it stretches"
    return judged("deflection/h", ratio, SMALL_DEFLECTION, good, bad)


def rim(hit: ImpactResult) -> Finding | None:
    """Return the finding on the rim: waves of the period of the contact run to it and back."""
    if hit.pair.thickness is None:
        return None
    plate = cast(HalfSpace, hit.pair.second)
    needed = quiet_width(plate, hit.duration)
    if plate.width is None:
        words = f"the plate is taken to be wide: more than {text(needed, 'm', 2)}"
        return Finding("width", inf, needed, True, words)
    wide = plate.width >= needed
    answers = f"the rim answers within the contact; it must be {text(needed, 'm', 2)} wide"
    good = "no wave comes back from the rim within the contact"
    return Finding("width", plate.width, needed, wide, good if wide else answers)


def quiet_width(plate: HalfSpace, duration: float) -> float:
    """Return up to which width in m bending waves come back in time, at their group velocity."""
    return 2.0 * sqrt(2.0) * _half_wave(plate, duration)


def _half_wave(plate: HalfSpace, duration: float) -> float:
    """Return half a bending wave of the contact, pi (D/(rho h))^(1/4)/sqrt(pi/t_c)."""
    stuff, thickness = plate.material, cast(float, plate.thickness)
    stiffness = stuff.young * thickness**2 / (12.0 * (1.0 - stuff.poisson**2))
    return sqrt(pi * duration * sqrt(stiffness / cast(float, stuff.density)))


def refuse_thin(pair: Pair, scales: Scales, losses: LossLaw | None) -> None:
    """Raise InputError where the theory of a plate cannot be applied at all."""
    thickness = pair.thickness
    lossy = "bodies on a plate are elastic so far; leave losses or thickness out"
    refuse(losses is not None and refusal("losses", losses, lossy))
    deep = f"the sphere would be pressed in by {text(scales.length, 'm')} on a thick wall"
    thin = thickness is not None and not thickness > scales.length
    refuse(thin and refusal("thickness", thickness, f"must be above the penetration; {deep}"))
