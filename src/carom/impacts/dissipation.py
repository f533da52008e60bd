"""What takes energy that an elastic impact leaves out: waves, adhesion, losses in the material."""

from math import nan, pi, sqrt

from carom.bodies.materials import Material
from carom.bodies.shapes import Sphere
from carom.impacts.adhesive import JKR_FROM, lost_by_maugis, pull_off_work, tabor, work_of_adhesion
from carom.impacts.findings import judged, lacking
from carom.impacts.result import ImpactResult
from carom.io.labels import Finding
from carom.quantities.prefixes import text

LOST = 0.02  # share of the kinetic energy of the normal motion: e is above 0.99
RADIATED = (1.343, -1.878, 0.812, 0.360)  # of Poisson's ratio, to 0.6 % from -1/2 to 1/2
PULSE = 1.5918146  # integral of F'^2 dt through Hertz's impact, in P_max^2 V_1/d_max
CLEAN, STICKY = 0.05, 0.5  # J/m^2, between which the energies of most surfaces in air lie
RUBBER = 0.49975  # Poisson's ratio
DAMPED = 3.5446  # share of energy per loss factor: Kelvin & Voigt's solid of eta = pi tau/t_c


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
    without = {"first": pair.first.material, "second": pair.second.material}
    without = {body: m for body, m in without.items() if m.surface_energy is None}
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
    stuffs = {"first": hit.pair.first.material, "second": hit.pair.second.material}
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
