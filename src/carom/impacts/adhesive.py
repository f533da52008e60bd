"""Impacts of spheres that adhere: what pulling apart takes, and the rebound without slip."""

from dataclasses import dataclass, field
from functools import cached_property
from math import isnan, nan, pi, sqrt
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies import checks
from carom.bodies.kinematics import Tangential
from carom.bodies.pairs import Pair, Scales
from carom.dimensionless.adhesion import STICKING, Adhering, solve_adhering
from carom.impacts.outcome import Outcome
from carom.io.citations import ADHESION, bibtex
from carom.quantities.arrays import Array, numbers, refuse_where, together
from carom.quantities.refusals import known_keywords, refusal, refuse
from carom.quantities.units import APPROACH, Value, not_negative

PULL_OFF = 8.0 / 15.0 * (2.0 * pi) ** (5.0 / 3.0) * STICKING  # 7.0922
SPACING = 0.3e-9  # m, of atoms in touch
TABOR = (0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 100.0)
LOST = (0.005, 0.059, 0.243, 0.475, 0.649, 0.733, 0.819, 0.889, 0.943, 0.971, 0.994)
JKR_FROM = 5.0  # of Tabor's number (Johnson & Greenwood 1997)
MOST_AT_ONCE = 100_000
NAME = "work_of_adhesion"
FINITE = "must be finite numbers, one or an array of them"


@dataclass(frozen=True, eq=False)
class AdhesiveImpact(Outcome):
    """The result of `adhesive_impact`; SI units, and arrays where arrays were given.

    `solution` is the same without units, in `scales` of `pair` and speed; there are no other
    losses.

    What sticks has a restitution of 0, and no duration nor psi_out: NaN. The `dissipated_energy` is
    lost in shear as the edge of the contact recedes; `max_pressure` is that at the centre (Johnson,
    Kendall & Roberts 1971).

    Examples
    --------
    >>> bead = carom.Sphere(radius="50 um", material="pmma")
    >>> pair = carom.Pair(bead, carom.HalfSpace(material="glass"), friction=0.3)
    >>> hit = carom.classical.adhesive_impact(pair, normal_speed=0.05, work_of_adhesion=0.1)
    >>> hit.sticks, round(hit.normal_restitution, 3)
    (False, 0.908)
    """

    solution: Adhering = field(repr=False)
    work_of_adhesion: float = field(default=0.0, kw_only=True)

    @property
    def sticking_speed(self) -> float:
        """Normal speed up to which the bodies stick, in m/s."""
        return sticking_speed(self.pair, self.work_of_adhesion)

    @property
    def sticks(self) -> Any:
        """Whether the bodies stick, as pulling them apart takes more energy than there is."""
        return self.normal_speed <= self.sticking_speed

    @property
    def pull_off_force(self) -> float:
        """Largest force that pulls the bodies apart slowly, (3/2) pi Gamma R*, in N."""
        return 1.5 * pi * self.work_of_adhesion * self.pair.effective_radius

    @property
    def tabor(self) -> float:
        """Tabor's number, with surfaces 0.3 nm apart.

            mu_T = (R* Gamma^2/(E*^2 z_0^3))^(1/3)

        From 5 on the contact is that of Johnson, Kendall & Roberts (1971). With less, forces reach
        farther than the bodies deform, and less energy is lost than by their contact.
        """
        return tabor(self.pair, self.work_of_adhesion)

    @property
    def shear_release(self) -> float:
        """Largest energy per area that shear sets free at the edge, over the work of adhesion.

        Well below 1 the contact has the radius that it has without shear, as is assumed.
        """
        slope = self.contact_velocity / self.normal_speed
        with np.errstate(invalid="ignore"):  # nothing over no adhesion
            return cast(float, self.pair.kappa * slope**2 * self.solution.release)

    def inputs(self) -> dict[str, Any]:
        """Return what the impact was made from, as plain numbers and words."""
        return super().inputs() | {NAME: self.work_of_adhesion}

    def cite(self) -> str:
        """Return what to cite for this result, as BibTeX."""
        return bibtex(*ADHESION)

    @cached_property
    def _slowed_by(self) -> float:
        return self.contact_velocity - self.contact_velocity_out


@known_keywords
def adhesive_impact(
    pair: Pair,
    *,
    normal_speed: ArrayLike,
    tangential_speed: ArrayLike = 0.0,
    spin: ArrayLike = 0.0,
    spin2: ArrayLike = 0.0,
    work_of_adhesion: Value | None = None,
) -> AdhesiveImpact:
    """Return how spheres leave an impact in which they adhere and their contact never slips.

        W_s = 7.0922 (Gamma^5 R*^4/E*^2)^(1/3), (1/2) m_n V_s^2 = W_s
        e^2 = 1 - (V_s/V_1)^2

    The normal impact is exact for the contact of Johnson, Kendall & Roberts (1971): it jumps in
    where the spheres touch, and out where the fixed approach becomes unstable. W_s is what this
    takes, and up to the sticking speed V_s the bodies stick (Thornton & Ning 1998). No contact
    loses more; where `tabor` is below 5, e is larger. In shear the contact is taken to stick
    wherever it is closed, with the radius that it has without shear: psi_2/psi_1 is that of small
    psi_1, and `shear_release` says how small. Slip of adhering surfaces is not treated.

    Parameters
    ----------
    pair : Pair
        The bodies; their friction is only the unit of psi.
    normal_speed, tangential_speed : array_like or str
        Components of the velocity of the first body relative to the second, in m/s.
    spin, spin2 : array_like or str
        Spins of the first body, and of the second if it is a sphere, in rad/s; all these are
        numbers, or arrays that broadcast.
    work_of_adhesion : float or str, optional
        Energy per area that parts the surfaces, Gamma in J/m^2, which is twice the surface energy
        of like materials. By default 2 sqrt(gamma_1 gamma_2) of the materials' `surface_energy`,
        an estimate if they are unlike.

    Returns
    -------
    AdhesiveImpact
        The rebound: normal_restitution, sticks, sticking_speed, pull_off_force, psi_out,
        velocities and spins, duration, extremes; and tabor and shear_release, by which to judge.

    Raises
    ------
    InputError
        If a value is missing or out of range, the bodies do not approach, or the contact of bodies
        at rest is as large as the bodies.

    Examples
    --------
    >>> ball = carom.Sphere(radius="10 um", material="pmma")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="glass"), friction=0.3)
    >>> hit = carom.classical.adhesive_impact(
    ...     pair, normal_speed=[0.01, 0.1, 1.0], tangential_speed=1e-3, work_of_adhesion="0.1 J/m^2"
    ... )
    >>> hit.normal_restitution.round(3).tolist()
    [0.0, 0.599, 0.997]
    """
    given = (normal_speed, tangential_speed, spin, spin2)
    speed, motion = _motion(checks.checked_pair(pair), given)
    energy, scales = _energy(pair, work_of_adhesion), _scales(pair, speed, motion)
    psi = pair.psi(motion.contact_velocity(pair), speed)
    solution = solve_adhering(psi, pair.chi, sticking_speed(pair, energy) / speed)
    solution = Adhering(*(_plain(np.asarray(each)) for each in solution))
    return AdhesiveImpact(pair, speed, *motion, solution, scales=scales, work_of_adhesion=energy)


def _energy(pair: Pair, given: Value | None) -> float:
    """Return the work of adhesion in J/m^2, of the materials if none is given, or raise."""
    lacks = "missing; give it, or carom.Material(surface_energy=...) of both materials"
    energy = work_of_adhesion(pair, nan) if given is None else not_negative(NAME, given)
    refuse(isnan(energy) and f"{NAME}: {lacks}")
    large = "at rest the contact would be as large as the bodies; check the units"
    soft = pair.effective_modulus * pair.effective_radius <= 2.0 * pi * energy
    refuse(soft and refusal(NAME, energy, large))
    return energy


def _motion(pair: Pair, given: tuple[ArrayLike, ...]) -> tuple[Any, Tangential]:
    """Return the normal speed and the tangential motion, or raise InputError."""
    names = ("normal_speed", "tangential_speed", "spin", "spin2")
    read = {name: numbers(name, value, FINITE) for name, value in zip(names, given, strict=True)}
    shape = together(read, MOST_AT_ONCE)
    for name, values in read.items():
        refuse_where(name, values, ~np.isfinite(values), FINITE)
    speed = read["normal_speed"]
    refuse_where("normal_speed", speed, speed <= 0.0, f"must be positive{APPROACH}")
    checks.check_second_spin(pair, given[3], spins=bool(np.any(read["spin2"])))
    speed, *motion = (_plain(np.broadcast_to(each, shape).copy()) for each in read.values())
    return speed, Tangential(*motion)


def _plain(values: Array) -> Any:
    return values if values.ndim else values.item()


def _scales(pair: Pair, speed: Any, motion: Tangential) -> Scales:
    """Return the scales of impacts, or raise InputError if floating point cannot hold them."""
    velocity, carried = motion.contact_velocity(pair), motion.carried(pair)
    slides = pair.friction == 0.0 and bool(np.any(velocity))
    needed = "must be positive where the contact point moves: without friction nothing sticks"
    refuse(slides and refusal("friction", 0.0, needed))
    parts = speed, velocity, motion.tangential_speed, *carried
    if not np.ndim(speed):
        return checks.checked_scales(pair, *parts)
    with np.errstate(all="ignore"):
        scales = pair.scales(speed)
        fits = checks.scales_fit(pair, scales, *parts[1:])
    for each in () if np.all(fits) else np.nditer(parts):
        checks.checked_scales(pair, *map(float, each))
    return scales


def work_of_adhesion(pair: Pair, usual: float) -> float:
    """Return Gamma = 2 sqrt(gamma_1 gamma_2) in J/m^2, with `usual` where no energy is known."""
    energies = [stuff.surface_energy for stuff in pair.materials.values()]
    one, two = (usual if energy is None else energy for energy in energies)
    return 2.0 * sqrt(one * two)


def pull_off_work(pair: Pair, energy: float) -> float:
    """Return the energy that an impact with this work of adhesion takes, in J."""
    size = (pair.effective_radius**2 / pair.effective_modulus) ** (2.0 / 3.0)
    return float(PULL_OFF * energy ** (5.0 / 3.0) * size)


def sticking_speed(pair: Pair, energy: float) -> float:
    """Return the normal speed up to which the bodies stick, in m/s."""
    return sqrt(2.0 * pull_off_work(pair, energy) / pair.normal_mass)


def tabor(pair: Pair, energy: float) -> float:
    """Return Tabor's number."""
    reach = (energy / (pair.effective_modulus * SPACING)) ** 2
    return float((pair.effective_radius / SPACING * reach) ** (1.0 / 3.0))


def lost_by_maugis(number: float) -> float:
    """Return the loss of Maugis & Dugdale's contact over `pull_off_work`, from a table."""
    return float(np.interp(np.log(max(number, 1e-9)), np.log(TABOR), LOST, left=0.0))
