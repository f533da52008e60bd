"""Findings on an impact: a number with its bound, and whether it holds, fails or is not judged.

These are on what takes energy that an elastic impact leaves out, and on what a plate needs.
"""

from collections.abc import Callable
from math import inf, nan, pi, sqrt
from typing import Any, cast

from carom.bodies.losses import LossLaw
from carom.bodies.materials import Material
from carom.bodies.pairs import Pair, Scales
from carom.bodies.shapes import HalfSpace, Sphere
from carom.impacts.adhesive import JKR_FROM, lost_by_maugis, pull_off_work, tabor, work_of_adhesion
from carom.impacts.result import ImpactResult
from carom.io.labels import Finding
from carom.quantities import arrays
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import text
from carom.quantities.refusals import refusal, refuse

LOST = 0.02  # share of the kinetic energy of the normal motion: e is above 0.99
RADIATED = (1.343, -1.878, 0.812, 0.360)  # of Poisson's ratio, to 0.6 % from -1/2 to 1/2
PULSE = 1.5918146  # integral of F'^2 dt through Hertz's impact, in P_max^2 V_1/d_max
CLEAN, STICKY = 0.05, 0.5  # J/m^2, between which the energies of most surfaces in air lie
RUBBER = 0.49975  # Poisson's ratio
DAMPED = 3.5446  # share of energy per loss factor: Kelvin & Voigt's solid of eta = pi tau/t_c

LONG_WAVE = 6.0  # thicknesses in a bending wave of twice the contact time, for thin plates
SHEARING = 6.8  # over the square of that ratio: what shorter waves add to 1 - e (theory, page 11)
ECHO = 2.0  # thicknesses that a compressional wave runs until its echo is back
SMALL_CONTACT = 0.1  # a_max/h: what the other face and the moment of friction change
SMALL_DEFLECTION = 0.2  # of h, up to which a plate bends without stretching
Assumption = Callable[[ImpactResult], Finding | None]


def judged(name: str, value: float, limit: float, good: str, bad: str) -> Finding:
    """Return the finding on a number that must not be beyond a limit."""
    holds = abs(value) <= limit
    return Finding(name, value, limit, holds, good if holds else bad)


def bounded(name: str, value: float, limit: float, good: str, bad: str) -> Finding:
    """Return the finding on a bound from above: beyond the limit it does not tell."""
    holds = True if abs(value) <= limit else None
    return Finding(name, value, limit, holds, good if holds else bad)


def lacking(
    name: str, limit: float, key: str, bodies: dict[str, Material], value: float = nan
) -> Finding:
    """Return the finding that cannot be judged, as these bodies lack a value of their material."""
    names = (stuff.name or f"the {body} body" for body, stuff in bodies.items())
    whose = " and ".join(dict.fromkeys(names))
    where = f"no {GLOSSARY[key].meaning} of {whose}: Material({key}=...)"
    return Finding(name, value, limit, None, f"not judged: {where}", f"{key} of {whose}")


def waves(hit: ImpactResult) -> Finding | None:
    """Return the finding on the waves that run off into the wall.

    The wall radiates B times the integral of F'^2 dt with B = f(nu)/(2 pi G c_s), f from the force
    on a half-space that oscillates (Miller & Pursey 1955: 4.836 for nu = 1/4). For like materials
    that is 1.11 (V_1/c)^(3/5) of the energy at nu = 1/4; Hunter (1957) is quoted with 1.04.
    """
    wall, stuff = hit.pair.second, hit.pair.second.material
    if isinstance(wall, Sphere) or stuff.is_rigid or hit.losses is not None:
        return None
    if hit.pair.thickness is not None:  # its waves are in the theory
        return None
    name = "energy of waves in the wall"
    if stuff.density is None:
        return lacking(name, LOST, "density", {"second": stuff})
    share = _radiated(stuff) * hit.pair.normal_mass / hit.scales.time**3
    echo = 0.5 * hit.duration * compressional_speed(stuff)
    thick = f"the wall is taken to be thick: more than {text(echo, 'm', 2)}, for no echo to return"
    good = f"waves take little from the ball; {thick}"
    return judged(name, share, LOST, good, f"waves in the wall take too much energy; {thick}")


def _radiated(wall: Material) -> float:
    """Return the energy of the waves over m_n (V_1/d_max)^3 and the kinetic energy, in s^3/kg."""
    density, modulus = wall.density or 1.0, wall.shear_modulus
    factor = sum(c * wall.poisson**k for k, c in enumerate(RADIATED))
    force = 25.0 / 16.0  # P_max = (5/4) m_n V_1^2/d_max
    return factor * force * PULSE / (pi * modulus * sqrt(modulus / density))


def compressional_speed(wall: Material) -> float:
    """Return the speed of compressional waves; of none that cannot be compressed, as of rubber."""
    nu, density = min(wall.poisson, RUBBER), wall.density or 1.0
    return sqrt(2.0 * (1.0 - nu) / (1.0 - 2.0 * nu) * wall.shear_modulus / density)


def adhesion(hit: ImpactResult) -> Finding:
    """Return the finding on adhesion: at most that of Johnson, Kendall & Roberts (Maugis 1992)."""
    pair, name = hit.pair, "work of adhesion"
    limit = LOST if hit.losses is None else 1.0
    energies = [work_of_adhesion(pair, usual) for usual in (CLEAN, STICKY)]
    least, most = (pull_off_work(pair, energy) / hit.scales.energy for energy in energies)
    number = tabor(pair, energies[0])
    stiff = f"; it is the most, as Tabor's number is {number:.2g}" if number < JKR_FROM else ""
    without = {body: m for body, m in pair.materials.items() if m.surface_energy is None}
    if least * lost_by_maugis(number) <= limit < most:
        words = f"not judged: pulling the bodies apart takes up to this share{stiff}"
        if not without:
            return Finding(name, least, limit, None, words)
        finding = lacking(name, limit, "surface_energy", without)
        between = f"it is {least:.2g} with {CLEAN} J/m^2 and {most:.2g} with {STICKY} J/m^2"
        return finding._replace(verdict=f"{finding.verdict}; {between}")
    usual = f" with {CLEAN} J/m^2" if without else ""
    bad = f"the bodies stick below {text(sqrt(least) * hit.scales.speed, 'm/s', 2)}{usual}"
    if least < 1.0:
        e = f"e is {sqrt(1.0 - least):.2g} by carom.classical.adhesive_impact{usual}"
        bad = f"pulling the bodies apart takes too much energy; {e}"
    good = "pulling the bodies apart takes little energy"
    return judged(name, most if most <= limit else least, limit, good, f"{bad}{stiff}")


def damping(hit: ImpactResult) -> Finding | None:
    """Return the finding on what the materials lose, each by its share of the deformation."""
    if hit.losses is not None:
        return None
    stuffs = hit.pair.materials
    shares = {
        body: hit.pair.effective_modulus * (1.0 - m.poisson**2) / m.young
        for body, m in stuffs.items()
        if not m.is_rigid
    }
    parts = {body: share * (stuffs[body].loss_factor or 0.0) for body, share in shares.items()}
    lost, name = DAMPED * sum(parts.values()), "energy lost in the material"
    without = {b: stuffs[b] for b in shares if stuffs[b].loss_factor is None}
    if without and lost <= LOST:
        return lacking(name, LOST, "loss_factor", without, lost or nan)
    worst = stuffs[max(parts, key=lambda body: parts[body])].name or "the material"
    bad = f"{worst} always loses energy; give losses=, as KelvinVoigt(restitution=...)"
    return judged(name, lost, LOST, "the materials lose little energy", bad)


def together(hit: ImpactResult) -> Finding | None:
    """Return the finding on all of these, if each is small and their sum is not."""
    findings = (waves(hit), adhesion(hit), damping(hit))
    total = sum(f.value for f in findings if f is not None and f.holds)
    if hit.losses is not None or total <= LOST:
        return None
    words = "each of these losses of energy is small, but together they may not be"
    return Finding("energy lost in all", total, LOST, None, words)


def bending(hit: ImpactResult, plate: HalfSpace) -> Finding:
    """Return the finding on a plate that bends: its waves are long, or no echo comes back."""
    name, thickness = "bending wave/h", cast(float, plate.thickness)
    ratio = 2.0 * _half_wave(plate, hit.duration) / thickness
    if hit.duration < ECHO * thickness / compressional_speed(plate.material):
        thick = "no echo is back when the contact ends: the wall is thick; leave thickness out"
        return Finding(name, ratio, LONG_WAVE, False, thick)
    if ratio < LONG_WAVE:
        between = "not judged: the plate is neither thin nor a thick wall; 1 - e is an estimate"
        return Finding(name, ratio, LONG_WAVE, None, between)
    percent = 100.0 * SHEARING / ratio**2
    more = f"1 - e is larger by some {percent:.0f} % of itself, as it also shears"
    return Finding(name, ratio, LONG_WAVE, True, f"the plate is thin enough to bend; {more}")


def small_on_plate(hit: ImpactResult, plate: HalfSpace) -> Finding:
    """Return the finding on the contact against the thickness."""
    ratio = hit.max_radius / cast(float, plate.thickness)
    good = "the contact is small against the plate, whose turning by friction is neglected"
    bad = "the contact is large against the plate; its other face and its turning matter"
    return judged("a_max/h", ratio, SMALL_CONTACT, good, bad)


def deflection(hit: ImpactResult, plate: HalfSpace) -> Finding:
    """Return the finding on how far the plate's middle moves, impulse over 8 sqrt(D rho h)."""
    impulse = hit.pair.normal_mass * hit.scales.speed * (1.0 + hit.normal_restitution)
    ratio = impulse / (plate.impedance * cast(float, plate.thickness))
    good, bad = "the plate bends without stretching", "the plate bends so far that it stretches"
    return judged("deflection/h", ratio, SMALL_DEFLECTION, good, bad)


def rim(hit: ImpactResult, plate: HalfSpace) -> Finding:
    """Return the finding on the rim: waves of the period of the contact run to it and back."""
    needed = quiet_width(plate, hit.duration)
    if plate.width is None:
        words = f"the plate is taken to be wide: more than {text(needed, 'm', 2)}"
        return Finding("width", inf, needed, True, words)
    wide = plate.width >= needed
    answers = f"the rim answers within the contact; it must be {text(needed, 'm', 2)} wide"
    good = "no wave comes back from the rim within the contact"
    return Finding("width", plate.width, needed, wide, good if wide else answers)


def quiet_width(plate: HalfSpace, duration: float) -> Any:
    """Return up to which width in m bending waves come back in time, at their group velocity."""
    return 2.0 * 2.0**0.5 * _half_wave(plate, duration)


def _half_wave(plate: HalfSpace, duration: float) -> Any:
    """Return half a bending wave of the contact, pi (D/(rho h))^(1/4)/sqrt(pi/t_c)."""
    stuff, thickness = plate.material, cast(float, plate.thickness)
    stiffness = stuff.young * thickness**2 / (12.0 * (1.0 - stuff.poisson**2))
    return arrays.sqrt(pi * duration * arrays.sqrt(stiffness / cast(float, stuff.density)))


def refuse_thin(pair: Pair, scales: Scales, losses: LossLaw | None) -> None:
    """Raise InputError where the theory of a plate cannot be applied at all."""
    thickness = pair.thickness
    lossy = "bodies on a plate are elastic so far; leave losses or thickness out"
    refuse(losses is not None and refusal("losses", losses, lossy))
    deep = f"the sphere would be pressed in by {text(scales.length, 'm')} on a thick wall"
    thin = thickness is not None and not thickness > scales.length
    refuse(thin and refusal("thickness", thickness, f"must be above the penetration; {deep}"))


def _if_plate(judge: Callable[[ImpactResult, Any], Finding]) -> Assumption:
    """Return an assumption that does not arise where no plate is struck."""
    return lambda hit: None if hit.pair.thickness is None else judge(hit, hit.pair.second)


OF_ENERGY: tuple[Assumption, ...] = (adhesion, damping, together)
OF_PLATES = tuple(map(_if_plate, (bending, small_on_plate, deflection, rim)))
OF_WALLS = (waves, *OF_PLATES)
