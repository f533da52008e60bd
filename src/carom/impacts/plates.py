"""What the theory of a plate needs: long bending waves, a small contact and deflection, width."""

from math import inf, pi, sqrt
from typing import cast

from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair, Scales
from carom.bodies.shapes import HalfSpace
from carom.impacts.result import ImpactResult
from carom.io.labels import Finding
from carom.quantities.prefixes import text
from carom.quantities.refusals import refusal, refuse

LONG_WAVE = 6.0  # thicknesses in a bending wave of twice the contact time, for thin plates
ECHO = 2.0  # thicknesses that a compressional wave runs until its echo is back
SMALL_CONTACT = 0.1  # a_max/h: what the other face and the moment of friction change
SMALL_DEFLECTION = 0.2  # of h, up to which a plate bends without stretching


def judge_plate(hit: ImpactResult) -> tuple[Finding, ...]:
    """Return the findings on a plate that is struck; none on a thick wall."""
    plate = hit.pair.second
    if not isinstance(plate, HalfSpace) or plate.thickness is None:
        return ()
    return (
        _judge_waves(plate, plate.thickness, hit.duration),
        _judge_contact(hit.max_radius / plate.thickness),
        _judge_deflection(hit, plate.impedance * plate.thickness),
        _judge_width(plate, plate.thickness, hit.duration),
    )


def _judge_waves(plate: HalfSpace, thickness: float, duration: float) -> Finding:
    """Return the finding on bending: waves of some lengths of the thickness, or no echo at all."""
    name, ratio = "bending wave/h", 2.0 * _bending(plate, thickness, duration) / thickness
    if duration < ECHO * thickness / _compressional_speed(plate):
        thick = "the contact ends before an echo is back: the wall is thick; leave thickness out"
        return Finding(name, ratio, LONG_WAVE, False, thick)
    if ratio < LONG_WAVE:
        between = "the plate is neither thin nor a thick wall: 1 - e is an estimate"
        return Finding(name, ratio, LONG_WAVE, None, between)
    return Finding(name, ratio, LONG_WAVE, True, "the plate is thin enough to bend as a whole")


def _judge_contact(ratio: float) -> Finding:
    small = ratio <= SMALL_CONTACT
    good = "the contact is small against the plate, whose turning by friction is neglected"
    bad = "the contact is large against the plate; its other face and its turning matter"
    return Finding("a_max/h", ratio, SMALL_CONTACT, small, good if small else bad)


def _judge_deflection(hit: ImpactResult, unit: float) -> Finding:
    """Return the finding on how far the plate's middle moves, impulse over 8 sqrt(D rho h)."""
    impulse = hit.pair.normal_mass * hit.normal_speed * (1.0 + hit.normal_restitution)
    ratio = impulse / unit
    small = ratio <= SMALL_DEFLECTION
    good, bad = "the plate bends without stretching", "the plate bends so far that it stretches"
    return Finding("deflection/h", ratio, SMALL_DEFLECTION, small, good if small else bad)


def _judge_width(plate: HalfSpace, thickness: float, duration: float) -> Finding:
    """Return the finding on the rim: waves of the period of the contact run to it and back."""
    needed = 2.0 * sqrt(2.0) * _bending(plate, thickness, duration)
    if plate.width is None:
        words = f"the plate is taken as wide, which it is above {text(needed, 'm', 3)}"
        return Finding("width", inf, needed, True, words)
    wide = plate.width >= needed
    answers = f"the rim answers within the contact; it must be {text(needed, 'm', 3)} wide"
    verdict = "no wave comes back from the rim within the contact"
    return Finding("width", plate.width, needed, wide, verdict if wide else answers)


def _bending(plate: HalfSpace, thickness: float, duration: float) -> float:
    """Return half the length of a bending wave of twice the contact time.

    pi (D/(rho h))^(1/4)/sqrt(omega), omega = pi/t_c.
    """
    stuff = plate.material
    stiffness = stuff.young * thickness**2 / (12.0 * (1.0 - stuff.poisson**2))
    return sqrt(pi * duration * sqrt(stiffness / cast(float, stuff.density)))


def _compressional_speed(plate: HalfSpace) -> float:
    """Return c_L, infinite in what cannot be compressed."""
    stuff = plate.material
    squeezed = (1.0 + stuff.poisson) * (1.0 - 2.0 * stuff.poisson)
    if squeezed <= 0.0:
        return inf
    return sqrt(stuff.young * (1.0 - stuff.poisson) / (cast(float, stuff.density) * squeezed))


def refuse_thin(pair: Pair, scales: Scales, losses: LossLaw | None) -> None:
    """Raise InputError where the theory of a plate cannot be applied at all."""
    thickness = pair.thickness
    lossy = "bodies on a plate are elastic so far; leave losses or thickness out"
    refuse(losses is not None and refusal("losses", losses, lossy))
    deep = f"the sphere would be pressed in by {text(scales.length, 'm')} on a thick wall"
    thin = thickness is not None and not thickness > scales.length
    refuse(thin and refusal("thickness", thickness, f"must be above the penetration; {deep}"))
