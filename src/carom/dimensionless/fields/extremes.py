"""Where the stress below a contact is largest."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.numerics.arrays import Array

Measure = Callable[[Array], Array]
Axes = tuple[Array, Array, Array]

TENSOR = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])  # where components xx, yy, zz, xy, xz, yz go

# The coarse grid: radii and depths in contact radii, angles in degrees on one side of y = 0.
# Places below are rows (radius, angle, depth) in these units.
RADII = np.linspace(0.0, 1.25, 26)
ANGLES = np.linspace(0.0, 180.0, 7)
DEPTHS = np.linspace(0.0, 1.0, 11)
SURFACE = np.zeros(1)

CUSPS = 24  # so many radii at most, where the memory jumps, join the grid
STARTS = 3  # peaks of the grid that are refined
TOLERANCE = {"xatol": 1e-7, "fatol": 1e-13, "maxiter": 400}
ALIKE = 1e-13  # of the largest: a place in the plane y = 0 that comes so near is taken


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


def largest(measure: Measure, profile: Profile, depths: Array = DEPTHS) -> Largest:
    """Return the largest value of a measure of the stress below a contact.

    A coarse grid over one side of the plane of symmetry finds the peaks; the highest are refined.
    Radii where the memory jumps are on the grid, since the surface stress has cusps there.

    Parameters
    ----------
    measure : callable
        Takes points of shape (n, 3), in sqrt(R* L), to values of shape (n,), even in y.
    profile : Profile
        The memory of the contact.
    depths : array, optional
        Of the coarse grid, in contact radii; SURFACE to stay on the surface.

    Examples
    --------
    >>> from carom.dimensionless.fields.extremes import largest, von_mises
    >>> from carom.dimensionless.fields.profile import flat, stacked
    >>> from carom.dimensionless.fields.subsurface import stresses
    >>> hertz = stacked([1.0], [flat(0.0, 1.0, 1.0, 0.0)])
    >>> def measure(points):
    ...     return von_mises(stresses(points, hertz, friction=0.0, poisson=0.3))
    >>> found = largest(measure, hertz)
    >>> round(found.value, 4), round(found.z, 4)
    (0.62, 0.4809)
    """
    from scipy.ndimage import maximum_filter

    b = profile.edges[-1]
    if b == 0.0:
        return Largest(0.0, 0.0, 0.0, 0.0)

    def measured(places: Array) -> Array:
        return np.asarray(measure(b * _cartesian(places)) / b)

    axes = (_radii(profile), ANGLES, depths)
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    values = measured(grid.reshape(-1, 3)).reshape(grid.shape[:-1])
    peaks = np.argwhere(values == maximum_filter(values, size=3, mode="nearest"))
    highest = sorted(peaks, key=lambda peak: -values[tuple(peak)])[:STARTS]
    refined = (_refined(measured, axes, peak) for peak in highest)
    tried = np.concatenate([_and_in_plane(place) for place in refined])
    found = measured(tried)
    best = np.flatnonzero(found >= found.max() - ALIKE * abs(found.max()))[-1:]
    return Largest(*map(float, b * np.append(found[best], _cartesian(tried[best]))))


def _radii(profile: Profile) -> Array:
    """Return the radii of the grid: evenly spaced, at cusps, and as dense outside as inside."""
    signs = (-1.0) ** np.arange(profile.g.shape[1])
    inner, outer = profile.g @ signs, profile.g.sum(axis=1)
    jumps = np.abs(np.append(inner[1:], np.inf) - outer)  # the edge of the contact is always one
    cusps = profile.edges[1:][np.argsort(-jumps)[:CUSPS]] / profile.edges[-1]
    mirrored = 2.0 - cusps
    return np.unique(np.concatenate([RADII, cusps, mirrored[mirrored < RADII[-1]]]))


def _refined(measured: Measure, axes: Axes, peak: NDArray[np.intp]) -> Array:
    """Return the place of the maximum near a peak of the grid (Nelder & Mead 1965)."""
    from scipy.optimize import minimize

    low, start, high = (
        np.array(
            [axis[np.clip(i + step, 0, axis.size - 1)] for axis, i in zip(axes, peak, strict=True)]
        )
        for step in (-1, 0, 1)
    )
    free = high > low

    def placed(moved: Array) -> Array:
        place = start.copy()
        place[free] = moved
        return place

    result = minimize(
        lambda moved: -measured(placed(moved)[np.newaxis])[0],
        start[free],
        method="Nelder-Mead",
        bounds=np.stack([low[free], high[free]], axis=-1),
        options=TOLERANCE,
    )
    return placed(result.x)


def _and_in_plane(place: Array) -> Array:
    """Return a place and the nearest one in the plane y = 0, across which stress varies least."""
    r, angle, z = place
    return np.array([place, [r, 180.0 if angle > 90.0 else 0.0, z]])


def _cartesian(cylindrical: Array) -> Array:
    from scipy.special import cosdg, sindg

    r, angle, z = cylindrical.T
    return np.stack([r * cosdg(angle), r * np.abs(sindg(angle)), z], axis=-1)
