"""Impacts solved by boundary elements: slip in any direction, unlike materials coupled."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.bodies.checks import with_friction
from carom.bodies.kinematics import Tangential, normal_inertia
from carom.bodies.pairs import Pair, Scales
from carom.dimensionless import solution as theory
from carom.dimensionless.states import SlipAngle
from carom.halfspace.compliance import Materials
from carom.halfspace.motion import NormalSpin
from carom.halfspace.solution import HalfspaceSolution, Resolution, refinement_error, solve
from carom.impacts.contacts.fields import OUTSIDE, SLIP, STICK, ZONES
from carom.impacts.peaks import judge_strength, struck_bodies
from carom.impacts.result import ImpactResult
from carom.impacts.validity import OF_BODIES, WEAK_COUPLING, judge, judge_errors, waves_aside
from carom.io.citations import ELEMENTS, bibtex
from carom.io.labels import labelled_dataset
from carom.io.progress import Progress, advancing
from carom.quantities.refusals import known_keywords, refusal, refuse
from carom.quantities.units import Value, counted
from carom.quantities.verdicts import Finding, Validity

if TYPE_CHECKING:
    import xarray as xr


BY_THEORY = "stresses are those of the theory, which neglects the coupling of unlike materials"
RANGES = {"elements": (8, 1000), "steps": (20, 100_000)}  # memory grows with elements squared
OF_STEPS = (
    *("time", "penetration", "displacement", "contact_radius", "stick_radius"),
    *("normal_force", "tangential_force"),
)
LARGEST_CHI = 1e3  # steps would be too many
LARGEST_PSI, LARGEST_SPIN = 1e9, 1e6  # what changes would be lost in rounding


@dataclass(frozen=True)
class BoundaryElements:
    """Grid and time steps of boundary elements, for `impact` as its method.

    The contact is solved with influence coefficients (Love 1929), convolution by FFT, Coulomb's law
    as a vector (Kalker 1990, section 4.2) and Verlet's time steps. If elements and steps grow
    together, the error falls with their square, for unlike materials with their power 3/2.

    Parameters
    ----------
    elements : int
        Square elements across the largest contact, 8 to 1000. 64 elements take some 13 MB of
        memory, 25 MB for unlike materials; memory grows with the square of elements.
    steps : int
        Time steps in the duration of Hertz's impact, 20 to 100,000; more are taken if chi is above
        2.

    Raises
    ------
    InputError
        If either is not a whole number in its range.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> coarse = carom.BoundaryElements(elements=16, steps=75)
    >>> hit = carom.impact(pair, speed=2.0, angle="30 deg", method=coarse)
    >>> exact = carom.impact(pair, speed=2.0, angle="30 deg")
    >>> abs(hit.psi_out - exact.psi_out) < 0.01
    True
    """

    elements: int = 64
    steps: int = 300

    def __post_init__(self) -> None:
        for name, (least, most) in RANGES.items():
            counted(name, getattr(self, name), least, most)


@dataclass(frozen=True, eq=False)
class HalfspaceImpact(ImpactResult):
    """The result of `impact` by boundary elements, with estimates of its error.

    The method is that of Love (1929) and Kalker (1990), section 4.2, see `BoundaryElements`. Units
    are SI, signs are those of `Impact`; `solution` is the same in `scales` of `pair` and speed, and
    `losses` are None. Phases are those that the grid resolves: short phases are
    missing, and phases may alternate where only a small part of the contact slips.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="alumina")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="soda-lime-glass"), friction=0.5)
    >>> coarse = carom.BoundaryElements(elements=10, steps=30)
    >>> hit = carom.impact(pair, speed=2.0, angle="30 deg", method=coarse)
    >>> hit.psi_out_error < 0.1
    True
    """

    solution: HalfspaceSolution = field(repr=False)
    _coarser: tuple[float, float] = field(kw_only=True)  # psi_out, a quarter and half as fine

    @property
    def normal_spin_out(self) -> float:
        """Spin about the normal after, of the first body less that of the second, in rad/s."""
        return self.solution.spin_out * self._spin_unit

    @property
    def contact_velocity_across(self) -> float:
        """Velocity of the contact point across the motion before, after the impact, in m/s.

        Along the axis of positive `spin`. Unlike bodies that spin about the normal veer off.
        """
        return float(self.solution.ledger.psi_across[-1]) * self.scales.tangential_speed

    @property
    def psi_out_error(self) -> float:
        """Estimate of the error of psi_out from two coarser solutions.

        In 98 % of 200 impacts the true error was smaller.
        """
        return refinement_error(*self._coarser, self.solution.psi_out)

    @property
    def dissipated_energy(self) -> float:
        """Energy lost to friction, in J, including that of the spin about the normal.

        With unlike materials it includes energy of the normal motion, too.
        """
        normal = super().lost_energy if self.pair.dundurs_beta else 0.0
        across = 0.5 * self.pair.tangential_mass * self.contact_velocity_across**2
        turning = 0.5 * normal_inertia(self.pair)
        turned = turning * (self.normal_spin**2 - self.normal_spin_out**2)
        return super().dissipated_energy + normal + turned - across

    @property
    def lost_energy(self) -> float:
        """Energy lost in the normal motion, except to friction, in J; zero for elastic bodies."""
        return 0.0

    @property
    def energy_error(self) -> float:
        """Largest change of the sum of all energies during the impact, as a share of it."""
        return self.solution.energy_error

    @property
    def slip_angles(self) -> tuple[SlipAngle, ...]:
        spans = ((phase.start, phase.end) for phase in self.solution.phases)
        return tuple(SlipAngle(*self.solution.slip_angles(*span)) for span in spans)

    @property
    def validity(self) -> Validity:
        """Whether the remaining assumptions hold, and whether the grid is fine enough."""
        errors = judge_errors(self.psi_out_error, self.energy_error)
        return Validity((*judge(self, OF_BODIES).findings, waves_aside(self), *errors))

    @cached_property
    def _strength(self) -> tuple[Finding, ...]:
        psi = self.psi_in if isfinite(self.psi_in) else 0.0
        solution = theory.solve(psi, self.pair.chi)
        strength = judge_strength(struck_bodies(self.pair, self.scales, solution))
        if abs(self.pair.dundurs_beta) <= WEAK_COUPLING:
            return strength
        return tuple(
            finding._replace(holds=None, verdict=f"{finding.verdict}; {BY_THEORY}")
            for finding in strength
        )

    def scalars(self) -> dict[str, float]:
        errors = {"psi_out_error": self.psi_out_error, "energy_error": self.energy_error}
        names = ("normal_spin_out", "contact_velocity_across") if self.normal_spin else ()
        return super().scalars() | {name: getattr(self, name) for name in names} | errors

    def inputs(self) -> dict[str, Any]:
        return super().inputs() | {"method": "halfspace", **self.solution.resolution._asdict()}

    def cite(self) -> str:
        """Return what to cite for this result, as BibTeX."""
        return bibtex(*ELEMENTS)

    @known_keywords
    def fields(self, at: Value) -> xr.Dataset:
        """Return tractions, zones and slip velocities on the grid, at one of the stored steps.

        Parameters
        ----------
        at : float or str
            Time since the first touch in s, 0 to `duration`; the nearest of some 60 stored steps is
            taken.

        Returns
        -------
        xarray.Dataset
            Along (y, x): pressure, traction_x, traction_y, zone (0 outside, 1 stick, 2 slip),
            slip_velocity_x, slip_velocity_y; and as numbers time (that of the step),
            contact_radius, stick_radius, normal_force, tangential_force, penetration, displacement,
            friction.

        Raises
        ------
        InputError
            If the time is outside the contact.

        Examples
        --------
        >>> coarse = carom.BoundaryElements(elements=16, steps=75)
        >>> hit = carom.impact(pair, speed=2.0, angle="30 deg", method=coarse)
        >>> patch = hit.fields(0.6 * hit.duration)
        >>> bool((abs(patch.traction_y) > 0.0).any())
        True
        """
        instant = self._instant(at) / self.scales.time
        shot = min(self.solution.snapshots, key=lambda kept: abs(kept.entry.time - instant))
        step, grid = shot.step, self.solution.patch.grid
        friction, unit = self.pair.friction, self._pressure_unit
        traction = friction * unit * grid.whole_vector(step.state.traction)
        slip = np.where(step.slips, shot.slip_velocity, 0.0)
        velocity = friction * self.normal_speed * grid.whole_vector(slip)
        zones = np.select([step.slips, step.touching], [SLIP, STICK], OUTSIDE)
        zone = grid.whole(zones).astype(np.int8)
        columns = {
            "pressure": unit * grid.whole(step.state.pressure),
            "traction_x": traction[0],
            "traction_y": traction[1],
            "slip_velocity_x": velocity[0],
            "slip_velocity_y": velocity[1],
        }
        variables = {name: (("y", "x"), values.T) for name, values in columns.items()}
        line = grid.line * self.scales.radius
        now = self._columns(self.solution.at(np.array([shot.entry.time])))
        numbers = {name: float(now[name][0]) for name in OF_STEPS} | {"friction": friction}
        return labelled_dataset(
            {**variables, "zone": (("y", "x"), zone.T, ZONES), **numbers},
            {"x": line, "y": line},
            {"title": "contact seen from above", "inputs": self.inputs()},
        )

    @property
    def _pressure_unit(self) -> float:
        """E* d_max/a_max in Pa: Hertz's largest pressure is 2/pi of it."""
        return 0.5 * np.pi * self.scales.pressure

    @property
    def _spin_unit(self) -> float:
        return self.pair.friction * self.normal_speed / self.scales.radius

    def _columns(self, h: Any) -> dict[str, Any]:
        columns = super()._columns(h)
        columns |= {"slip_angle": h.slip_angle, "slip_angle_max": h.slip_angle_max}
        if not self.normal_spin:
            return columns
        spin = h.spin * self._spin_unit
        moment = self.pair.friction * self._pressure_unit * self.scales.radius**3
        return columns | {
            "normal_spin": spin,
            "frictional_moment": h.moment * moment,
            "contact_velocity_across": h.psi_across * self.scales.tangential_speed,
            "normal_spin_kinetic_energy": 0.5 * normal_inertia(self.pair) * spin**2,
        }

    def _picture(self, time: float) -> xr.Dataset:
        return self.fields(time)


def solve_by_elements(
    pair: Pair,
    scales: Scales,
    motion: Tangential,
    normal_spin: float,
    method: BoundaryElements,
    progress: Progress,
) -> HalfspaceImpact:
    """Return an impact solved by boundary elements, on three grids; see `carom.impact`."""
    with_friction(pair, "without friction the theory is exact; leave method out")
    psi = pair.psi(motion.contact_velocity(pair), scales.speed)
    materials = Materials(pair.kappa, pair.dundurs_beta, pair.friction)
    spin = spin_about_normal(pair, scales, normal_spin)
    words, cure = "boundary elements solve", "leave method out"
    refuse(
        pair.chi > LARGEST_CHI
        and refusal("chi", pair.chi, f"{words} chi up to {LARGEST_CHI:g}; {cure}"),
        not abs(psi) <= LARGEST_PSI
        and refusal("psi_1", psi, f"{words} psi_1 up to {LARGEST_PSI:g}; {cure}"),
    )
    if not abs(spin.speed) <= LARGEST_SPIN:
        most = f"{LARGEST_SPIN * abs(normal_spin / spin.speed):.3g} rad/s here"
        allowed = f"{words} up to {most}, {LARGEST_SPIN:g} mu V_1/a_max"
        raise refusal("normal_spin", normal_spin, allowed)
    fine = Resolution(method.elements, method.steps)
    grids = (fine.half.half, fine.half, fine)
    total = sum(grid.steps for grid in grids)
    with advancing("solving by boundary elements", total, progress, unit="steps") as advance:
        *coarse, solution = (
            solve(psi, pair.chi, materials, grid, spin=spin, progress=advance) for grid in grids
        )
    more: Any = {"_coarser": (coarse[0].psi_out, coarse[1].psi_out), "normal_spin": normal_spin}
    return HalfspaceImpact(pair, scales.speed, *motion, solution, scales=scales, **more)


def spin_about_normal(pair: Pair, scales: Scales, normal_spin: float) -> NormalSpin:
    """Return a spin about the normal as boundary elements take it; 0 without friction."""
    speed = normal_spin * scales.radius / (pair.friction * scales.speed)
    return NormalSpin(speed, pair.normal_mass * scales.radius**2 / normal_inertia(pair))
