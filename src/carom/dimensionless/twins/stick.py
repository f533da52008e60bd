"""The stick phase of the paper in closed form: equations (15)-(27) and (33)-(37).

Barber (1979), 'Adhesive contact during the oblique impact of elastic spheres', J. Appl. Math. Phys.
(ZAMP) 30:468-476. Units: lengths d_max, time d_max/V_1, tangential displacement mu d_max/kappa.

The paper's h_1, h_2 of (20) blow up like (1 - x)^(-1/2) at the turning point x = 1. Because
gamma = alpha + beta - 1/2 there, the quadratic transformation (Abramowitz & Stegun 15.3.24, which
is DLMF 15.8.18 followed by Euler's 15.8.1)

    F(a, b; a + b - 1/2; x) = (1 - x)^(-1/2) F(2a - 1, 2b - 1; a + b - 1/2; z),  z = (1 - v)/2,

takes that factor out exactly, 1 - x = v^2, and leaves power series in 0 <= z <= 1/2. They hold
alternating terms of 10^7 and more when chi is large, so they are summed with twice the digits.
Their coefficients are rational in chi: alpha and beta of (22) are not needed.

After gross slip the constants follow from continuity of velocity and force, as the paper says, but
these give g = 1 and dg/dv = (2 chi - 1)/v, that is b g' = -(5/2) (2 chi - 1) x/(1 - x), not the
g' = 0 printed in (35): with g' = 0 the equation of motion (14) would have the force jump by the
factor 1/(2 chi).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq, minimize_scalar

from carom.dimensionless.twins.doubledouble import DoubleDouble, Real, two_sum
from carom.dimensionless.twins.stick_series import (
    Place,
    at_depth,
    at_speed,
    at_speed_or_x,
    displacement_at,
    force_at,
    place,
    psi_at,
)

CHI_MAX = 400.0  # above, even 32 digits are lost in the alternating sums
POINTS = 800  # where |g| is looked at for the end: 80 to the half oscillation at CHI_MAX
ROUNDING = 2e-15  # |g| must pass 1 by more than this: where it only touches, stick goes on
PEAK = {"xatol": 1e-10}
RTOL = 4.0 * np.finfo(np.float64).eps
LAST = 1e-13  # of the start: an end nearer to the turning point is rounding of psi_1 and chi


def _refuse_unless_in_range(psi: float, chi: float) -> None:
    if not np.isfinite(psi):
        raise ValueError(f"psi = {psi}: a finite number is needed")
    if not 0.0 < chi <= CHI_MAX:
        raise ValueError(f"chi = {chi}: 0 < chi <= {CHI_MAX:g} is allowed")


def transition_speed(psi: float, chi: float) -> float:
    """Return the speed v = V_z/V_1 at which gross slip from the first touch ends, (34).

    v = (|psi_1| - 2 chi)/(1 - 2 chi): 1 for |psi_1| = 1, 0 for 2 chi, -1 for 4 chi - 1. A value
    above 1 or below -1 is never reached.

    Parameters
    ----------
    psi, chi : float
        psi_1 and chi, dimensionless; chi = 1/2 never ends gross slip.

    Raises
    ------
    ValueError
        If psi is not finite, or chi is not in (0, CHI_MAX] or is 1/2.

    Notes
    -----
    Barber (1979), equation (34).

    Examples
    --------
    >>> from carom.dimensionless.twins.stick import transition_speed
    >>> transition_speed(2.0, 1.5)
    0.5
    """
    _refuse_unless_in_range(psi, chi)
    if chi == 0.5:
        raise ValueError("chi = 0.5: gross slip does not end, (34) needs chi other than 1/2")
    return (abs(psi) - 2.0 * chi) / (1.0 - 2.0 * chi)


@dataclass(frozen=True)
class Stick:
    """A stick phase: g = psi_1 h_1 from the first touch, h_1 and h_2 mixed after gross slip.

    g = psi/v, psi' = -(15/4) chi Q, Q' = psi sqrt(d), U' = psi with v^2 = 1 - x, x = d^(5/2).
    Make one with `from_touch` or `after_gross_slip`; the formulas hold between the speeds `start`
    and `end`, and are continued beyond. Each takes speeds v = V_z/V_1 or places x in [0, 1], of any
    shape, and returns that shape (a float for a float); both keep full relative precision, v near
    the turning point and x near the touch. Anything else is a ValueError.

    Parameters
    ----------
    psi_1, chi : float
        Dimensionless; kappa V_x/(mu V_1) before the impact, any sign, and (16).
    slides_first : bool
        Whether gross slip comes before.

    Raises
    ------
    ValueError
        If chi is not in (0, CHI_MAX], or there is no such phase: from the first touch it needs
        |psi_1| < 1 (<= 1 if chi >= 1/2), after gross slip 1 < |psi_1| < 2 chi.

    Notes
    -----
    Barber (1979), equations (15)-(27) and (33)-(37).

    Examples
    --------
    >>> from carom.dimensionless.twins.stick import Stick
    >>> stick = Stick.from_touch(0.5, 1.44)
    >>> round(stick.end, 12), stick.slip_sign
    (0.267774892465, -1)
    >>> stick.g([1.0, stick.end]).round(12) + 0.0
    array([ 0.5, -1. ])
    >>> round(stick.force(0.5), 12), round(stick.displacement(x=0.75), 12)
    (0.176345642776, 0.321989349768)
    """

    psi_1: float
    chi: float
    slides_first: bool = False

    def __post_init__(self) -> None:
        """Refuse what has no stick phase."""
        _refuse_unless_in_range(self.psi_1, self.chi)
        speed = abs(self.psi_1)
        if self.slides_first and not 1.0 < speed < 2.0 * self.chi:
            raise ValueError(
                f"psi = {self.psi_1}: stick follows gross slip for 1 < |psi| < 2 chi"
                f" = {2.0 * self.chi:g}"
            )
        if not self.slides_first and not (speed < 1.0 or (speed == 1.0 and self.chi >= 0.5)):
            raise ValueError(
                f"psi = {self.psi_1}: stick from the first touch needs |psi| < 1"
                " (|psi| = 1 is allowed for chi >= 1/2)"
            )

    @classmethod
    def from_touch(cls, psi: float, chi: float) -> "Stick":
        """Return the stick phase that starts at the first touch, (27).

        Examples
        --------
        >>> from carom.dimensionless.twins.stick import Stick
        >>> Stick.from_touch(0.3, 0.5).g([1.0, 0.5, 0.001])
        array([0.3, 0.3, 0.3])
        """
        return cls(float(psi), float(chi))

    @classmethod
    def after_gross_slip(cls, psi: float, chi: float) -> "Stick":
        """Return the stick phase that follows gross slip from the first touch, (34).

        Examples
        --------
        >>> from carom.dimensionless.twins.stick import Stick
        >>> stick = Stick.after_gross_slip(2.0, 1.5)
        >>> stick.start, stick.g(stick.start)
        (0.5, 1.0)
        """
        return cls(float(psi), float(chi), slides_first=True)

    @cached_property
    def _start(self) -> Place:
        if not self.slides_first:
            return at_speed(1.0)
        z = 0.5 * two_sum(abs(self.psi_1), -1.0) / two_sum(2.0 * self.chi, -1.0)
        return place(z, 1.0 - 2.0 * z)

    @cached_property
    def _touch(self) -> tuple[DoubleDouble, DoubleDouble]:
        """The psi and Q at d = 0 from which stick alone would have led here."""
        zero, one = DoubleDouble(0.0), DoubleDouble(1.0)
        if not self.slides_first:
            return DoubleDouble(self.psi_1), zero
        at, chi = self._start, self.chi
        sign = float(np.sign(self.psi_1))
        psi = sign * at.v
        force = 2.0 * sign * at.radius * at.radius * at.radius / 3.0
        # the matrix of influences has the determinant 1: its inverse
        return (
            force_at(chi, at, zero, one) * psi - psi_at(chi, at, zero, one) * force,
            psi_at(chi, at, one, zero) * force - force_at(chi, at, one, zero) * psi,
        )

    @cached_property
    def _moved_before(self) -> DoubleDouble:
        """U at the start, by (33), less what stick alone would have led to."""
        if not self.slides_first:
            return DoubleDouble(0.0)
        at = self._start
        # without inertia (chi = 0) psi stays 1 and U is the time
        time = displacement_at(0.0, at, DoubleDouble(1.0), DoubleDouble(0.0))
        slope = 2.0 * self.chi
        moved = two_sum(abs(self.psi_1), -slope) * time + slope * at.radius * at.radius
        return float(np.sign(self.psi_1)) * moved - displacement_at(self.chi, at, *self._touch)

    @property
    def start(self) -> float:
        """The speed v at which the phase starts, (34)."""
        return float(self._start.v.hi)

    def psi(self, v: ArrayLike | None = None, *, x: ArrayLike | None = None) -> Real:
        """Return psi = g v, (25), at speeds v or at x = d^(5/2), in [0, 1] (else ValueError)."""
        return psi_at(self.chi, at_speed_or_x(v, x), *self._touch).hi

    def g(self, v: ArrayLike | None = None, *, x: ArrayLike | None = None) -> Real:
        """Return g = psi/v, (27), at speeds v or at x, in [0, 1]; at v = 0 mostly infinite."""
        at = at_speed_or_x(v, x)
        psi = psi_at(self.chi, at, *self._touch).hi
        with np.errstate(divide="ignore", invalid="ignore"):
            g = np.divide(psi, at.v.hi)
        at_turning = (np.asarray(psi) == 0.0) & (np.asarray(at.v.hi) == 0.0)
        if at_turning.any():  # the limit of g, which is dpsi/dv
            g = np.where(at_turning, 3.0 * self.chi * force_at(self.chi, at, *self._touch).hi, g)
        return g if np.ndim(g) else float(g)

    def force(self, v: ArrayLike | None = None, *, x: ArrayLike | None = None) -> Real:
        """Return Q = (2/3) F_x/(mu P_max), (12), at speeds v or at x, in [0, 1]."""
        return force_at(self.chi, at_speed_or_x(v, x), *self._touch).hi

    def displacement(self, v: ArrayLike | None = None, *, x: ArrayLike | None = None) -> Real:
        """Return U = integral of g dd, in units of mu d_max/kappa, at speeds v or x, in [0, 1]."""
        return (
            displacement_at(self.chi, at_speed_or_x(v, x), *self._touch) + self._moved_before
        ).hi

    @property
    def end(self) -> float | None:
        """The speed v at which |g| = 1 ends the phase; None if it lasts to the turning point.

        Then chi = chi_n = ((11 + 20 n)^2 - 1)/240, or what rounding cannot tell from it.
        """
        return None if self._end is None else float(self._end.v.hi)

    @property
    def end_x(self) -> float | None:
        """The end as x = d^(5/2) = 1 - v^2, with full relative precision near the touch."""
        return None if self._end is None else float((4.0 * self._end.z * (1.0 - self._end.z)).hi)

    @property
    def slip_sign(self) -> int:
        """The sign of the slip that starts at the end, that of g there; 0 without an end."""
        return (
            0 if self._end is None else int(np.sign(psi_at(self.chi, self._end, *self._touch).hi))
        )

    def _excess(self, at: Place) -> float:
        """|psi| - v."""
        psi = psi_at(self.chi, at, *self._touch)
        return float(((psi if psi.hi >= 0.0 else -psi) - at.v).hi)

    def _bulges(self, above: float, below: float) -> float | None:
        """Return the speed between where |g| has a maximum, if it is past 1 there."""
        peak = minimize_scalar(
            lambda v: -float(np.abs(self.g(v))),
            bounds=(below, above),
            method="bounded",
            options=PEAK,
        )
        return float(peak.x) if -peak.fun > 1.0 + ROUNDING else None

    @cached_property
    def _end(self) -> Place | None:
        v = np.sin(np.linspace(np.arcsin(self.start), 0.0, POINTS))
        v[0], v[-1] = self.start, LAST * self.start
        size = np.abs(self.g(v))
        size[0] = min(abs(self.psi_1), 1.0)  # rounding of the start speed must not end the phase
        before, here, after = size[:-2], size[1:-1], size[2:]
        peak = np.zeros(POINTS, dtype=bool)
        # a maximum between points rises above them by less than their own differences
        may_pass = 2.0 * here - np.minimum(before, after) > 1.0 + ROUNDING
        peak[1:-1] = may_pass & (here >= before) & (here >= after)
        for i in np.flatnonzero(peak | (size > 1.0 + ROUNDING)):
            beyond: float | None = float(v[i])
            if size[i] <= 1.0 + ROUNDING:
                beyond = self._bulges(float(v[i - 1]), float(v[i + 1]))
            if beyond is not None:
                return self._crossing(float(v[i - 1]), beyond)
        return None

    def _crossing(self, above: float, below: float) -> Place:
        """Return where |psi| = v between two speeds, in the variable that is small there."""
        if above <= 0.5:
            at: Callable[[Real], Place] = at_speed
            stuck, slipping = above, below
        else:
            at = at_depth
            stuck, slipping = 0.5 * (1.0 - above), 0.5 * (1.0 - below)
        if self._excess(at(stuck)) >= 0.0:
            return at(stuck)
        return at(brentq(lambda p: self._excess(at(p)), stuck, slipping, xtol=1e-300, rtol=RTOL))
