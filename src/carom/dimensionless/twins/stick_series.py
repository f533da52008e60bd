"""Influence of psi and force at the touch on psi, force and displacement in stick, as power series.

The series of `stick`, in z = (1 - v)/2, summed with twice the digits.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.twins.doubledouble import (
    DoubleDouble,
    Polynomial,
    Real,
    coefficients,
    fifth_root,
    power_series,
    square_root,
    two_product,
    two_sum,
)

# psi and Q at z follow from psi and Q at the touch, z = 0, because psi' = -(15/4) chi Q and
# Q' = psi sqrt(d). One recurrence (see `coefficients`, times 25, shift 60 chi) for each influence:
# polynomial of c[n], of c[n+1], of c[n-1].
Recurrence = tuple[Polynomial, Polynomial] | tuple[Polynomial, Polynomial, Polynomial]
PSI_OF_PSI: Recurrence = (25, 5, 0), (25, 40, 15)  # v h_1, (27)
PSI_OF_FORCE: Recurrence = (25, 25, 6), (25, 60, 35)  # v h_2 but for its factor
FORCE_OF_PSI: Recurrence = (25, 25, 6), (25, 65, 40)
FORCE_OF_FORCE: Recurrence = (25, -5, 0), (25, 35, 10)
# psi (1 - z)^(-3/5), to be integrated: U = (8/5) integral psi (4 z (1 - z))^(-3/5) dz
MOVED_OF_PSI: Recurrence = (50, 25, 9), (25, 40, 15), (25, -15, 2)
MOVED_OF_FORCE: Recurrence = (50, 65, 27), (25, 60, 35), (25, 5, 0)


@lru_cache(maxsize=512)
def _series(recurrence: Recurrence, chi: float) -> list[DoubleDouble]:
    top, bottom, *older = recurrence
    return coefficients(top, bottom, two_product(60.0, chi), *older)


@lru_cache(maxsize=128)
def _integrated(recurrence: Recurrence, chi: float, last: int) -> list[DoubleDouble]:
    return [c / float(5 * n + last) for n, c in enumerate(_series(recurrence, chi))]


class Place(NamedTuple):
    """A place in loading: z = (1 - v)/2, speed, (4 z)^(1/5), sqrt(d)."""

    z: DoubleDouble
    v: DoubleDouble
    fifth: DoubleDouble
    radius: DoubleDouble


def place(z: DoubleDouble, v: DoubleDouble) -> Place:
    """Return a place from z and the speed there."""
    return Place(z, v, fifth_root(4.0 * z), fifth_root(4.0 * z * (1.0 - z)))


def at_speed(v: Real) -> Place:
    """Return the place at a speed v."""
    return place(0.5 * two_sum(1.0, -v), DoubleDouble(v))


def at_depth(z: Real) -> Place:
    """Return the place at a z."""
    return place(DoubleDouble(z), 1.0 - 2.0 * DoubleDouble(z))


def at_speed_or_x(v: ArrayLike | None, x: ArrayLike | None) -> Place:
    """Return the places at speeds v or at x = d^(5/2), whichever is given."""
    if (v is None) == (x is None):
        raise ValueError("v, x: give one of the speed v and x = d^(5/2) = 1 - v^2, not both")
    name, given = ("v", v) if x is None else ("x", x)
    values = np.asarray(given, dtype=np.float64)
    wrong = ~((values >= 0.0) & (values <= 1.0))
    if wrong.any():
        raise ValueError(f"{name} = {values[wrong][0]:g}: a stick phase has 0 <= {name} <= 1")
    where = values if values.ndim else float(values)  # floats are quicker than arrays of none
    if name == "v":
        return at_speed(where)
    speed = square_root(two_sum(1.0, -where))
    return place(DoubleDouble(0.5 * where) / (1.0 + speed), speed)


def psi_at(chi: float, at: Place, psi: DoubleDouble, force: DoubleDouble) -> DoubleDouble:
    """Return psi at a place from psi and the force at the touch."""
    own = power_series(_series(PSI_OF_PSI, chi), at.z)
    other = power_series(_series(PSI_OF_FORCE, chi), at.z) * at.fifth * at.fifth
    return own * psi - other * (3.75 * (chi * force))


def force_at(chi: float, at: Place, psi: DoubleDouble, force: DoubleDouble) -> DoubleDouble:
    """Return Q at a place from psi and the force at the touch."""
    own = power_series(_series(FORCE_OF_FORCE, chi), at.z)
    other = power_series(_series(FORCE_OF_PSI, chi), at.z) * at.fifth * at.fifth * at.fifth
    return own * force + (2.0 * other / 3.0) * psi


def displacement_at(chi: float, at: Place, psi: DoubleDouble, force: DoubleDouble) -> DoubleDouble:
    """Return U at a place, counted from the touch."""
    square = at.fifth * at.fifth
    first = power_series(_integrated(MOVED_OF_PSI, chi, 2), at.z) * square
    second = power_series(_integrated(MOVED_OF_FORCE, chi, 4), at.z) * square * square
    return 2.0 * first * psi - 7.5 * second * (chi * force)
