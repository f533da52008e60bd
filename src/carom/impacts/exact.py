"""Impacts solved exactly within the theory, and what happens inside their contact."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isfinite, nan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.kinematics import Tangential
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair
from carom.contacts.contact import Contact, contact_in_impact
from carom.contacts.in_contact import InContact
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import LossNumbers, checked_law
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.solution import Solution, solve, solve_with
from carom.dimensionless.states import SlipAngle
from carom.impacts.result import ImpactResult
from carom.impacts.validity import judge, judge_losses
from carom.io.citations import IMPACT, bibtex
from carom.io.labels import Finding, Validity
from carom.quantities.refusals import refusal
from carom.quantities.units import Value

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True, eq=False)
class Impact(ImpactResult, InContact):
    """The result of `impact`: the rebound, every phase, and what happens inside the contact.

    SI units. Tangential speeds are those of the first body relative to the second, positive spin
    adds to the tangential speed of the contact point: V_x = v_t + R spin + R_2 spin2. The theory is
    that of Maw, Barber & Fawcett (1976), in the form of Barber (1979).

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> hit = carom.impact(pair, speed=2.0, angle="30 deg", spin="100 rad/s")
    >>> round(hit.contact_velocity, 3), round(hit.contact_velocity_out, 3)  # V_x in m/s
    (1.5, -0.623)
    """

    solution: Solution | LossySolution = field(repr=False)

    _told_by = "time : float or str", "Time since the first touch in s, 0 to `duration`."

    @property
    def validity(self) -> Validity:
        """How far the assumptions of the theory hold, as numbers with a verdict."""
        found: tuple[Finding, ...] = ()
        if isinstance(self.solution, LossySolution):
            found = (judge_losses(self.solution.losses, self.normal_restitution, self.pair.chi),)
        given = self.pair, self.normal_speed, self.duration, self.psi_in
        return judge(*given, found, self.normal_spin)

    @property
    def slip_angles(self) -> tuple[SlipAngle, ...]:
        """Angle between slip and traction in each phase, which the theory neglects, in rad.

        NaN with losses: there it is not known.
        """
        if isinstance(self.solution, LossySolution):
            return (SlipAngle(nan, nan),) * len(self.phases)
        if not isfinite(self.psi_in):
            return (SlipAngle(0.0, 0.0),)
        return self.solution.slip_angles(self.pair.lateral_ratio)

    def contact(self, time: Value) -> Contact:
        drift = 0.0 if isfinite(self.psi_in) else self.contact_velocity
        inputs = {"inputs": self.inputs()}
        return contact_in_impact(
            self.pair, self.normal_speed, drift, self.solution, self._instant(time), inputs
        )

    def fields(
        self,
        time: Value,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
    ) -> xr.Dataset:
        return super().fields(time, x, y, points=points)

    def stress(
        self,
        time: Value,
        x: ArrayLike | None = None,
        z: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
        body: str = "second",
    ) -> xr.Dataset:
        return super().stress(time, x, z, points=points, body=body)

    def radial(self, time: Value, n: int = 401) -> xr.Dataset:
        return super().radial(time, n)

    def cite(self) -> str:
        """Return what to cite for this result, as BibTeX.

        Returns
        -------
        str
            Entries of BibTeX, one after the other.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
        >>> hit = carom.impact(pair, speed=2.0, angle="30 deg")
        >>> [line for line in hit.cite().splitlines() if line.startswith("@")]
        ['@software{carom,', '@article{barber1979,', '@article{maw1976,']
        """
        source = () if self.losses is None else (self.losses.source,)
        return bibtex(*IMPACT, *source)

    def _phase_columns(self) -> dict[str, list[float]]:
        return {} if isinstance(self.solution, LossySolution) else super()._phase_columns()

    def _picture(self, time: float) -> xr.Dataset:
        reach = 1.15 * self.max_radius
        line = np.linspace(-reach, reach, 101)
        return self.fields(time, line, line)


def solve_exactly(
    pair: Pair,
    normal_speed: float,
    motion: Tangential,
    losses: LossLaw | None,
    normal_spin: float = 0.0,
) -> Impact:
    """Return an impact solved within the theory; see `carom.impact`."""
    psi = pair.psi(motion.contact_velocity(pair), normal_speed)
    solution = _solution(pair, normal_speed, psi if isfinite(psi) else 0.0, losses)
    return Impact(pair, normal_speed, *motion, solution, losses, normal_spin=normal_spin)


def _solution(
    pair: Pair, normal_speed: float, psi: float, losses: LossLaw | None
) -> Solution | LossySolution:
    given = pair, normal_speed, psi
    found = solve(psi, pair.chi) if losses is None else _with_losses(*given, losses)
    if found.status is not Status.SOLVED:
        name, value = ("chi", pair.chi) if losses is None else ("losses", losses)
        what = f"the impact at psi_1 = {psi:g}, chi = {pair.chi:g} is {found.status.message}"
        raise refusal(name, value, what)
    return found


def _with_losses(
    pair: Pair, normal_speed: float, psi: float, losses: LossLaw
) -> Solution | LossySolution:
    loss, *numbers = checked_law(losses, "loss")(pair, normal_speed)
    if any(map(np.ndim, numbers)):
        raise refusal("losses", losses, "an impact takes one number; carom.sweep takes many")
    return solve_with(psi, pair.chi, LossNumbers(loss, *map(float, numbers)))
