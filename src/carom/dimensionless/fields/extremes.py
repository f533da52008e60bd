"""Measures of a stress, and where they are largest below a contact at one instant."""

from math import inf
from typing import NamedTuple

import numpy as np

from carom.dimensionless.fields import peaks
from carom.dimensionless.fields.peaks import COSINE, DEPTH, FOUND, RADIUS, VALUE
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.fields.subsurface import load_of
from carom.dimensionless.numerics.arrays import Array

TENSOR = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])  # where components xx, yy, zz, xy, xz, yz go
FIRST_STEP, LAST_STEP = 0.1, 1e-6  # of the climb, in contact radii


class Largest(NamedTuple):
    """The largest value of a measure of stress and where it lies."""

    value: float
    x: float
    y: float
    z: float


def principal_stresses(stress: Array) -> Array:
    """Return the principal stresses (n, 3) of stresses (n, 6), the largest first."""
    return np.asarray(np.linalg.eigvalsh(stress[:, TENSOR])[:, ::-1], dtype=np.float64)


def von_mises(stress: Array) -> Array:
    """Return the von Mises stress (n,) of stresses (n, 6)."""
    xx, yy, zz, xy, xz, yz = stress.T
    differences = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(0.5 * differences + 3.0 * (xy**2 + xz**2 + yz**2)))


def largest(
    measure: int,
    profile: Profile,
    *,
    friction: float,
    poisson: float,
    rim: float = 0.0,
    shallow: float = 0.0,
    deepest: float = inf,
) -> Largest:
    """Return the largest value of a measure of the stress below a contact at an instant.

    Parameters
    ----------
    measure : int
        VON_MISES, SHEAR or TENSION of `fields.peaks`.
    profile : Profile
        The memory of the contact.
    friction, poisson, rim
        As of `stresses`.
    shallow, deepest : float, optional
        Between which depths, in contact radii.

    Examples
    --------
    >>> from carom.dimensionless.fields.extremes import largest
    >>> from carom.dimensionless.fields.peaks import VON_MISES
    >>> from carom.dimensionless.fields.profile import flat, stacked
    >>> hertz = stacked([1.0], [flat(0.0, 1.0, 1.0, 0.0)])
    >>> found = largest(VON_MISES, hertz, friction=0.0, poisson=0.3)
    >>> round(found.value, 4), round(found.z, 4)
    (0.62, 0.4809)
    """
    b = profile.edges[-1]
    if b == 0.0:
        return Largest(0.0, 0.0, 0.0, 0.0)
    load, best = load_of(profile, poisson, rim), np.zeros(FOUND)
    for places in peaks.regions(profile, shallow, deepest):
        found = np.zeros(FOUND)
        peaks.scan(measure, places, friction, load, found)
        peaks.climb(measure, friction, load, shallow, deepest, FIRST_STEP, LAST_STEP, found)
        if found[VALUE] > best[VALUE]:
            best = found
    sine = np.sqrt(max(1.0 - best[COSINE] ** 2, 0.0))
    x, y = best[RADIUS] * best[COSINE], best[RADIUS] * sine
    return Largest(*map(float, (b * best[VALUE], b * x, b * y, b * best[DEPTH])))
