"""Impacts solved exactly within the theory, and what happens inside their contact."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite, nan
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.kinematics import Tangential
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair, Scales
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers, checked_law
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.lossy.springs.solution import MarchedSolution
from carom.dimensionless.lossy.viscoelastic.solution import ViscoelasticSolution
from carom.dimensionless.solution import Solution, solve, solve_with
from carom.dimensionless.states import SlipAngle
from carom.impacts.contacts.fields import Contact, contact_in_impact
from carom.impacts.contacts.in_contact import InContact
from carom.impacts.findings import Assumption
from carom.impacts.peaks import judge_pressure, judge_strength, peaks_dataset, struck_bodies
from carom.impacts.plate_findings import refuse_thin
from carom.impacts.result import ImpactResult
from carom.impacts.validity import OF_THEORY, judge
from carom.impacts.wear import wear_of
from carom.io.citations import IMPACT, PLATE, bibtex
from carom.quantities.prefixes import text
from carom.quantities.refusals import refusal
from carom.quantities.units import Value, not_negative
from carom.quantities.verdicts import Finding, Validity

if TYPE_CHECKING:
    import xarray as xr

DEEPEST = 100.0  # of the depth from which on peaks are searched for, in contact radii


@dataclass(frozen=True, eq=False)
class Impact(ImpactResult, InContact):
    """The result of `impact`: the rebound, every phase, and what happens inside the contact.

    SI units; `solution` is the same without units, in `scales` of `pair` and speed, with `losses`
    if there are any. Tangential speeds are those of the first body relative to the second. Positive
    spin adds to the tangential speed of the contact point: V_x = v_t + R omega + R_2 omega_2. The
    theory is that of Maw, Barber & Fawcett (1976), in the form of Barber (1979).

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> hit = carom.impact(pair, speed=2.0, angle="30 deg", spin="100 rad/s")
    >>> round(hit.contact_velocity, 3), round(hit.contact_velocity_out, 3)  # V_x in m/s
    (1.5, -0.623)
    """

    solution: Solution | LossySolution = field(repr=False)
    _assumptions: ClassVar[tuple[Assumption, ...]] = OF_THEORY

    @property
    def validity(self) -> Validity:
        """Whether the assumptions of the theory hold, as numbers with limits and verdicts."""
        return judge(self, self._assumptions)

    @cached_property
    def _strength(self) -> tuple[Finding, ...]:
        if self.pair.is_round and not isinstance(self.solution, MarchedSolution):
            return judge_strength(struck_bodies(self.pair, self.scales, self.solution))
        return (judge_pressure(self.pair, self.scales.pressure, yields=self._yields),)

    @property
    def _yields(self) -> bool:
        """Whether what yields is in the law of losses."""
        yielding = (Loss.PLASTIC, Loss.METAL)
        return isinstance(self.solution, LossySolution) and self.solution._losses.loss in yielding

    @property
    def slip_angles(self) -> tuple[SlipAngle, ...]:
        """Angle between slip and traction in each phase, which the theory neglects, in rad.

        It is NaN where it is not known: with losses, and of bodies that are no spheres.
        """
        if isinstance(self.solution, LossySolution) or not self.pair.is_round:
            return (SlipAngle(nan, nan),) * len(self.phases)
        if not isfinite(self.psi_in):
            return (SlipAngle(0.0, 0.0),)
        return self.solution.slip_angles(self.pair.lateral_ratio)

    def _refuse_shape(self) -> None:
        """Raise InputError if what happens inside such a contact is not known."""

    def _contact(self, at: Any) -> Contact:
        self._refuse_shape()
        drift = 0.0 if self.pair.friction else self.contact_velocity
        instant, inputs = self._instant(at), {"inputs": self.inputs()}
        return contact_in_impact(self.pair, self.scales, drift, self.solution, instant, inputs)

    def wear(
        self,
        n: int = 201,
        *,
        coefficient: Value | None = None,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
    ) -> xr.Dataset:
        """Return the work of friction per area through the impact, and the depth of wear.

        The work per area is W_A = integral of mu p w dt, with the pressure p and the slip rate w
        along x, the direction in which points slip in the theory. The depth of wear is h =
        k/mu W_A, and the worn volume is k/mu times the work of friction (Archard 1953, J. Appl.
        Phys. 24:981). Without friction the depth is the integral of k p w dt.

        Parameters
        ----------
        n : int
            Number of distances from the centre, from 2 to 100,000.
        coefficient : float or str, optional
            Archard's coefficient of wear k of one body, in m^2/N: the removed volume over load and
            sliding distance, e.g. "1e-13 m^2/N" or "1e-4 mm^3/(N m)". The sum of the coefficients
            of both bodies gives the depth and the volume that they lose together.
        x, y : array_like, shapes (nx,) and (ny,)
            Positions in m of the map, x along V_x; by default 101 by 101 points over the contact.

        Returns
        -------
        xarray.Dataset
            Along `distance` in m: mean_friction_work in J/m^2, the mean around the centre. Along
            (y, x): friction_work. As numbers: dissipated_energy, the work of friction by the
            balance of energies; max_friction_work, the largest anywhere in the contact, at the
            distance max_wear_radius; and work_error, the relative difference between it and the
            work per area summed over the contact: 1e-8 for elastic bodies up to chi = 6, 2e-7
            beyond, about 1e-5 for viscous ones, more near normal incidence, some 1e-3 for those
            that yield or relax. With a coefficient also mean_wear_depth, wear_depth, max_wear_depth
            in m and worn_volume in m^3, from the work per area where work_error is above 1e-4.

        Raises
        ------
        InputError
            If n is out of range, the coefficient is negative or above 1 m^2/N, or positions are not
            finite.

        Examples
        --------
        >>> worn = hit.wear(coefficient="1e-13 m^2/N")
        >>> round(float(worn.max_friction_work), 1), worn.friction_work.units
        (4515.6, 'J/m^2')
        >>> f"{float(worn.max_wear_depth) * 1e9:.2f} nm"
        '2.26 nm'
        """
        self._refuse_shape()
        return wear_of(self, n, coefficient, x, y)

    def peaks(self, *, depth: Value | None = None) -> xr.Dataset:
        """Return the largest stresses of the whole impact in each body: value, place and instant.

        These are the von Mises stress, the shear stress (s_1 - s_3)/2 and the tensile stress s_1,
        with the principal stresses s_i of `stress`, over all places and instants, to 1e-4 of the
        value; place and instant are known to about 0.01 of the contact radius and the duration, as
        stresses are flat there. The stress intensity is that of long surface cracks
        up to `flaw_size` deep, which go straight down across the plane of the impact, K = 2
        sqrt(c/pi) integral of (1.3 - 0.3 u^(5/4)) sigma(c u)/sqrt(1 - u^2) du (Tada, Paris & Irwin
        2000), to 0.5 %; for flaws below 1/2000 of the contact radius it is up to 2 % too large.

        Parameters
        ----------
        depth : float or str, optional
            Smallest depth at which stresses are searched, in m. By default the surface; for viscous
            bodies, whose stress at the surface is infinite while they are loaded, 0.2 of the
            largest contact radius.

        Returns
        -------
        xarray.Dataset
            Along `body`, for the bodies that deform: peak_von_mises, peak_shear and peak_tension in
            Pa, and where flaws are known stress_intensity in Pa m^0.5 with critical_flaw, the depth
            of the flaw. Each has its place in m, _x, _y and the depth _z, and its _time in s; the
            place of a stress intensity is the mouth of the flaw. For the strengths that are known
            also yield_ratio, tension_ratio and toughness_ratio. The attribute `missing` names the
            strengths that are not known. The attribute `notes` says if a body yields, so that
            stresses are upper bounds, and if the materials are unlike, whose radial tractions the
            theory neglects.

        Raises
        ------
        InputError
            If the depth is negative, above 100 contact radii, zero for viscous bodies, or the
            stress is not known, as in spheres that yield.

        Examples
        --------
        >>> glass = carom.material("glass", flaw_size="20 um")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material=glass), friction=0.2)
        >>> peaks = carom.impact(pair, speed=2.0, angle="30 deg").peaks().sel(body="second")
        >>> round(float(peaks.peak_tension) / 1e6), round(float(peaks.toughness_ratio), 2)  # MPa
        (1255, 7.16)
        """
        self._refuse_shape()
        self._refuse_stress()
        from_depth = None if depth is None else not_negative("depth", depth, "m")
        if from_depth == 0.0 and isinstance(self.solution, ViscoelasticSolution):
            allowed = "viscous bodies have infinite stresses at the surface; give a positive depth"
            raise refusal("depth", depth, allowed)
        deepest = DEEPEST * self.max_radius
        if from_depth is not None and from_depth > deepest:
            allowed = f"below {text(deepest, 'm', 3)} hardly any stress is left"
            raise refusal("depth", depth, allowed)
        bodies = struck_bodies(self.pair, self.scales, self.solution, from_depth)
        return peaks_dataset(self.pair, bodies, {"inputs": self.inputs()})

    def _refuse_stress(self) -> None:
        if self._yields:
            unknown = "what stress a yielded contact leaves below it is not known"
            cure = "take KelvinVoigt, or leave losses out"
            raise refusal("losses", self.losses, f"{unknown}; {cure}")

    def cite(self) -> str:
        """Return what to cite for this result, as BibTeX.

        Examples
        --------
        >>> [line for line in hit.cite().splitlines() if line.startswith("@")]
        ['@software{carom,', '@article{barber1979,', '@article{maw1976,']
        """
        source = () if self.losses is None else (self.losses._source,)
        plate = (PLATE,) if self.pair.gives_way(self.scales) else ()
        return bibtex(*IMPACT, *source, *plate)

    def _phase_columns(self) -> dict[str, list[float]]:
        return {} if isinstance(self.solution, LossySolution) else super()._phase_columns()

    def _picture(self, time: float) -> xr.Dataset:
        reach = 1.15 * self.max_radius
        line = np.linspace(-reach, reach, 101)
        return self.fields(time, line, line)


def solve_exactly(
    pair: Pair, scales: Scales, motion: Tangential, losses: LossLaw | None, normal_spin: float = 0.0
) -> Impact:
    """Return an impact solved within the theory; see `carom.impact`."""
    psi = pair.psi(motion.contact_velocity(pair), scales.speed)
    solution = solution_of(pair, scales, psi if isfinite(psi) else 0.0, losses)
    return Impact(
        pair, scales.speed, *motion, solution, losses, scales=scales, normal_spin=normal_spin
    )


def solution_of(
    pair: Pair, scales: Scales, psi: float, losses: LossLaw | None
) -> Solution | LossySolution:
    """Return the solution of an impact through the centres, or raise InputError."""
    solution: Solution | LossySolution
    numbers = loss_numbers(pair, scales, losses)
    if losses is None and numbers.parameter == 0.0:
        solution = solve(psi, pair.chi)
    else:
        solution = solve_with(psi, pair.chi, numbers)
    if solution.status is not Status.SOLVED:
        name, value = ("chi", pair.chi) if losses is None else ("losses", losses)
        message = solution.status.message
        why = f"the impact at psi_1 = {psi:g}, chi = {pair.chi:g} is {message}"
        if solution.status is Status.PLATE_GIVES_WAY:
            raise refusal("thickness", pair.thickness, why)
        raise refusal(name, value, why)
    return solution


def loss_numbers(pair: Pair, scales: Scales, losses: LossLaw | None) -> LossNumbers:
    """Return what the impact loses energy to, in numbers; an elastic one as on a thick wall."""
    if losses is None or pair.thickness is not None:
        refuse_thin(pair, scales, losses)
        give = pair.plate_give(scales.speed) if pair.gives_way(scales) else 0.0
        return LossNumbers(Loss.PLATE, give)
    loss, *numbers = checked_law(losses)._loss(pair, scales)
    if any(map(np.ndim, numbers)):
        raise refusal("losses", losses, "an impact takes one number; carom.sweep takes many")
    return LossNumbers(loss, *map(float, numbers))
