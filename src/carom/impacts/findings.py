"""Findings on an impact: a number with its bound, and whether it holds, fails or is not judged.

These are on the roughness of the surfaces, and on what takes energy that an elastic impact leaves
out.
"""

from collections.abc import Callable
from math import nan, sqrt

from carom.bodies.materials import Material
from carom.bodies.shapes import Sphere
from carom.bodies.walls import radiated_share
from carom.impacts.adhesive import JKR_FROM, lost_by_maugis, pull_off_work, tabor, work_of_adhesion
from carom.impacts.result import ImpactResult
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import text
from carom.quantities.verdicts import Finding

SMOOTH = 0.05  # rms roughness over penetration
LAPPED, GROUND = 0.02e-6, 0.4e-6  # m, of balls of grade 10 (ISO 3290-1), of ground plates (N5)
LOST = 0.02  # share of the kinetic energy of the normal motion: e is above 0.99
CLEAN, STICKY = 0.05, 0.5  # J/m^2, between which the energies of most surfaces in air lie
DAMPED = 2.4068  # share of energy per loss factor that is the same at all frequencies
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
    """Return the finding on the waves that run off into a thick wall; see `radiated_share`."""
    wall = hit.pair.second
    if isinstance(wall, Sphere) or wall.material.is_rigid or hit.losses is not None:
        return None
    if hit.pair.gives_way(hit.scales):  # its waves are in the theory
        return None
    name = "energy of waves in the wall"
    if wall.material.density is None:
        return lacking(name, LOST, "density", {"second": wall.material})
    share = radiated_share(hit.pair, hit.scales)
    echo = text(0.5 * hit.duration * wall.material.compressional_speed, "m", 2)
    thick = f"the wall is taken to be thick: more than {echo}, for no echo to return"
    if hit.pair.thickness is not None:
        thick = f"solved as a thick wall, which it is from {echo} on: no echo is back in time"
    good = f"waves take little from the ball; {thick}"
    return judged(name, share, LOST, good, f"waves in the wall take too much energy; {thick}")


def roughness(hit: ImpactResult) -> Finding:
    """Return the finding on rough surfaces, by the parameter of Greenwood, Johnson & Matsubara.

    It is the roughness of both surfaces over the penetration (1984, Wear 100:47-57): up to 0.05 the
    errors of Hertz's theory are not likely to exceed 7 %. Where the roughness is not known, that of
    lapped and that of ground surfaces must agree.
    """
    name, own, depth = "rms roughness/penetration", hit.pair.roughness, hit.max_penetration
    smooth, rough = (LAPPED, GROUND) if own is None else (own, own)
    lapped, ground = (text(height, "m") for height in (LAPPED, GROUND))
    if rough / depth <= SMOOTH:
        usual = f", also if ground to {ground}" if own is None else ""
        return Finding(name, rough / depth, SMOOTH, True, f"the surfaces are smooth{usual}")
    if smooth / depth > SMOOTH:
        usual = f", even if lapped to {lapped}" if own is None else ""
        bad = f"the surfaces are rough{usual}: the contact is larger and softer than Hertz's"
        return Finding(name, smooth / depth, SMOOTH, False, bad)
    where = f"no {GLOSSARY['roughness'].meaning}: Pair(roughness=...)"
    between = f"it is this if lapped to {lapped}, {rough / depth:.2g} if ground to {ground}"
    words = f"not judged: {where}; {between}"
    return Finding(name, smooth / depth, SMOOTH, None, words, "roughness of the pair")


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


OF_ENERGY: tuple[Assumption, ...] = (adhesion, damping, together)
