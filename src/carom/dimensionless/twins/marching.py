"""The oblique impact of elastic bodies by marching in time over springs.

The method of Maw, Barber & Fawcett (1976), Wear 38:101-114, a check on the exact solution that
shares nothing with it: the contact is cut into annuli, time into steps, and in every step each
annulus sticks or slips by its own Coulomb limit (see marching_springs). The normal motion (see
marching_motion) is Hertz's, d'' = -(5/4) d^(3/2).

Units: d and x^2 in d_max, time in d_max/V_1, U and q in mu d_max/kappa, psi in mu V_1/kappa.
"""

from collections.abc import Iterable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel
from carom.dimensionless.twins import marching_motion, marching_springs
from carom.dimensionless.twins.marching_springs import OUTSIDE

Slips = NDArray[np.int8]
Phase = tuple[str, int, float, float]

KINDS = ("stick", "slip", "gross slip")
RESOLUTION = 10.0  # of time, in units of 1/springs: about five springs met or released

NO_SLIPS = np.empty((0, 0), np.int8)


def _check(psi: float, chi: float, springs: int, steps: int) -> None:
    if not np.isfinite(psi):
        raise ValueError(f"psi: {psi:g} is not finite")
    if not 0.0 < chi < np.inf:
        raise ValueError(f"chi: {chi:g} is not positive and finite")
    if springs < 1:
        raise ValueError(f"springs: {springs} is not positive")
    if steps < 1 or steps % (2 * springs):
        raise ValueError(f"steps: {steps} is not a multiple of 2 springs, {2 * springs}")


def march_on(psi: float, chi: float, motion: Array, stride: int = 2) -> float:
    """Return psi_2 after any normal motion, given on small steps as by marching_motion.

    psi_2 = psi_1 - (15/4) chi integral of Q dt

    Dimensionless; `motion` has shape (steps + 1, 6), and its edge must grow to its peak and fall
    to zero; every `stride`-th step of the loading a spring is met. Maw, Barber & Fawcett (1976).

    >>> from carom.dimensionless.twins.marching import march_on
    >>> from carom.dimensionless.twins.marching_motion import elastic
    >>> round(march_on(4.0, 0.5, elastic(2000)), 9)
    2.0
    """
    return float(marching_springs.integrate(float(psi), float(chi), motion, stride, NO_SLIPS))


def march(psi: float, chi: float, springs: int = 500, steps: int = 2000) -> float:
    """Return psi_2, the tangential velocity after the impact, to second order in both steps.

    psi_2 = psi_1 - (15/4) chi integral of Q dt

    Dimensionless scalars. With four steps a spring the error is about 0.3/springs^2 for chi in
    [1.1, 1.8]; it grows with chi. Raises ValueError if psi is not finite, chi not positive, or
    `steps` not a multiple of 2 `springs`. Maw, Barber & Fawcett (1976), Wear 38:101-114.

    >>> from carom.dimensionless.twins.marching import march
    >>> round(march(4.0, 0.5), 9)
    2.0
    """
    _check(psi, chi, springs, steps)
    return march_on(psi, chi, marching_motion.elastic(steps), steps // (2 * springs))


def extrapolated(psi: float, chi: float, springs: int = 4000, steps: int = 16000) -> float:
    """Return psi_2 by Richardson extrapolation over halved, hence even, `springs` and `steps`.

    psi_2 = (4 march(springs, steps) - march(springs/2, steps/2))/3

    Dimensionless scalars. What is left is of second order too, but small and irregular: a front
    that stops between two springs leaves a kink in q there. Raises ValueError as `march` does,
    or if `springs` is odd. Richardson (1911), Phil. Trans. A 210:307-357.

    >>> from carom.dimensionless.twins.marching import extrapolated
    >>> round(extrapolated(0.3, 4.0), 6)
    -0.3
    """
    if springs % 2:
        raise ValueError(f"springs: {springs} is odd")
    fine = march(psi, chi, springs, steps)
    return (4.0 * fine - march(psi, chi, springs // 2, steps // 2)) / 3.0


def march_slips(
    psi: float, chi: float, springs: int = 500, steps: int = 2000
) -> tuple[Array, Array, Slips]:
    """Return the times of the steps, the places of the springs, and the sign of slip of each.

    slip is 1 where q = d - x^2, -1 where q = x^2 - d, 0 in stick, 2 where there is no contact.

    Dimensionless; shapes (steps + 1,), (springs,), (steps + 1, springs). Raises ValueError as
    `march` does. Maw, Barber & Fawcett (1976), Wear 38:101-114.

    >>> from carom.dimensionless.twins.marching import march_slips
    >>> times, x, slips = march_slips(0.5, 1.44)
    >>> slips[1400, ::40]  # while unloading, a ring at the edge slips
    array([ 0,  0,  0,  0,  0,  0, -1, -1,  2,  2,  2,  2,  2], dtype=int8)
    """
    _check(psi, chi, springs, steps)
    slips = np.full((steps + 1, springs), OUTSIDE, np.int8)
    stride, motion = steps // (2 * springs), marching_motion.elastic(steps)
    marching_springs.integrate(float(psi), float(chi), motion, stride, slips)
    return motion[:, 1], marching_springs.places(motion, stride)[:-1], slips


def resolution(springs: int) -> float:
    """Return the length, in d_max/V_1, of the shortest phase that so many springs tell."""
    return RESOLUTION / springs


def resolved(phases: Iterable[Phase], shortest: float) -> list[Phase]:
    """Leave out phases shorter than `shortest`, their time to the next, and join equal neighbours.

    Times in d_max/V_1.

    >>> from carom.dimensionless.twins.marching import resolved
    >>> resolved([("slip", 1, 0.0, 1.0), ("stick", 0, 1.0, 1.1), ("slip", -1, 1.1, 2.9)], 0.2)
    [('slip', 1, 0.0, 1.0), ('slip', -1, 1.0, 2.9)]
    """
    kept: list[Phase] = []
    stop = 0.0
    for kind, sign, start, stop in phases:
        if kept and kept[-1][:2] == (kind, sign):
            kept[-1] = (kind, sign, kept[-1][2], stop)
        elif stop - start >= shortest:
            kept.append((kind, sign, kept[-1][3] if kept else 0.0, stop))
    if kept:
        kept[-1] = (*kept[-1][:3], stop)
    return kept


@kernel
def _label(slips: Slips) -> int:
    """Return 0 if the edge sticks, else its sign of slip: once if some slip, twice if all do."""
    sign = 0
    for j in range(slips.size - 1, -1, -1):
        if slips[j] != OUTSIDE:
            if sign != 0 and slips[j] != sign:
                return sign
            if slips[j] == 0:
                return 0
            sign = slips[j]
    return 2 * sign


def march_phases(psi: float, chi: float, springs: int = 500, steps: int = 2000) -> list[Phase]:
    """Return the phases of elastic bodies in order of time as (kind, sign of slip, start, end).

    kind is "stick" (sign 0), "slip" (in a ring) or "gross slip"; times in d_max/V_1. A ring is
    seen once a spring slips in it, and phases shorter than `resolution(springs)` are left out.
    Stick that seems to begin while unloading is a ring not yet seen, and goes to the next phase:
    at the receding edge Coulomb's two limits fall together, and one of them must be met. Raises
    ValueError as `march` does. Maw, Barber & Fawcett (1976), Wear 38:101-114.

    >>> from carom.dimensionless.twins.marching import march_phases
    >>> [(kind, sign) for kind, sign, start, end in march_phases(0.5, 1.44)]
    [('stick', 0), ('slip', -1), ('gross slip', -1)]
    """
    times, _, slips = march_slips(psi, chi, springs, steps)
    labels = np.array([_label(row) for row in slips])
    changes = np.flatnonzero(np.diff(labels[1:steps])) + 1
    bounds = [0.0, *(0.5 * (times[changes] + times[changes + 1])).tolist(), hertz.DURATION]
    firsts = [1, *(changes + 1).tolist()]
    runs = [
        (KINDS[abs(labels[first])], int(np.sign(labels[first])), start, end)
        for first, (start, end) in zip(firsts, pairwise(bounds), strict=True)
        if labels[first] or 2 * first <= steps
    ]
    return resolved(runs, resolution(springs))
