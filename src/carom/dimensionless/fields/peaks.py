"""Where the stress below a contact at one instant is largest: a scan of places, then a climb.

At a radius and depth, stress depends on the angle by its cosine and sine alone (`subsurface`), so
that the largest value around a circle needs no stress but that of one point.
"""

from math import inf
from typing import NamedTuple

import numpy as np

from carom.dimensionless.fields import subsurface as at
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.fields.subsurface import Load, load_of, stress_parts
from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

VON_MISES, SHEAR, TENSION = MEASURES = range(3)
VALUE, RADIUS, DEPTH, COSINE = range(4)  # columns of a peak
PEAK_COLUMNS = 4

COSINES = np.cos(np.linspace(0.0, np.pi, 9))
PLANE_TOLERANCE = 1e-7  # a place in the plane of the motion whose value comes so near is taken
GOLDEN_STEPS = 24  # by which an angle between two of them is found, to a thousandth
GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
MOST_STEPS = 400
WAYS = np.array([[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [-1, -1], [1, -1], [-1, 1]], dtype=float)

# Places of the scan in contact radii: on the surface, and below.
ON_SURFACE = np.array([0.0, 0.25, 0.5, 0.7, 0.85, 0.95, 1.05, 1.15])
BELOW = np.array(
    [(r, z) for z in (0.1, 0.25, 0.38, 0.5, 0.65) for r in (0.0, 0.25, 0.5, 0.75, 1.0)]
)
RADII_BEHIND = (0.0, 0.5, 1.0, 1.4, 1.8, 2.4, 3.2, 4.5, 6.0)
BEHIND = np.array([(r, z) for z in (0.0, 0.15, 0.5, 1.2) for r in RADII_BEHIND])
FARTHEST_CLIMB = 20.0  # from the centre, in radii of the contact or depths of the search
TENSOR = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])  # where components xx, yy, zz, xy, xz, yz go
FIRST_STEP, LAST_STEP = 0.1, 1e-6  # of the climb, in contact radii


@kernel
def extreme_principals(
    rr: float, tt: float, zz: float, rt: float, rz: float, tz: float
) -> tuple[float, float]:
    """Return the largest and the smallest principal stress.

    By two where shear across the plane of r and z is nil, else by the angle of the deviator.
    """
    if rt == 0.0 and tz == 0.0:
        middle, radius = 0.5 * (rr + zz), np.hypot(0.5 * (rr - zz), rz)
        return max(middle + radius, tt), min(middle - radius, tt)
    mean = (rr + tt + zz) / 3.0
    a, b, c = rr - mean, tt - mean, zz - mean
    size = np.sqrt((a * a + b * b + c * c + 2.0 * (rt * rt + rz * rz + tz * tz)) / 6.0)
    if size == 0.0:
        return mean, mean
    determinant = a * (b * c - tz * tz) - rt * (rt * c - tz * rz) + rz * (rt * tz - b * rz)
    angle = np.arccos(min(max(0.5 * determinant / size**3, -1.0), 1.0)) / 3.0
    low = np.cos(angle + 2.0 * np.pi / 3.0)
    return mean + 2.0 * size * np.cos(angle), mean + 2.0 * size * low


@kernel
def measured(measure: int, parts: Array, cos: float, friction: float) -> float:
    """Return a measure of the stress at an angle of this cosine."""
    along, across = friction * cos, friction * np.sqrt(max(1.0 - cos * cos, 0.0))
    rr, tt = parts[at.P_RR] + along * parts[at.C_RR], parts[at.P_TT] + along * parts[at.C_TT]
    zz, rz = parts[at.P_ZZ] + along * parts[at.C_ZZ], parts[at.P_RZ] + along * parts[at.C_RZ]
    rt, tz = across * parts[at.S_RT], across * parts[at.S_TZ]
    if measure == VON_MISES:
        shears = rt * rt + rz * rz + tz * tz
        normals = (rr - tt) ** 2 + (tt - zz) ** 2 + (zz - rr) ** 2
        return float(np.sqrt(0.5 * normals + 3.0 * shears))
    high, low = extreme_principals(rr, tt, zz, rt, rz, tz)
    return 0.5 * (high - low) if measure == SHEAR else high


@kernel
def around(measure: int, parts: Array, friction: float) -> tuple[float, float]:
    """Return the largest value around the circle and the cosine of its angle."""
    ahead = measured(measure, parts, 1.0, friction)
    behind = measured(measure, parts, -1.0, friction)
    best, end = (ahead, 1.0) if ahead >= behind else (behind, -1.0)
    place, least = -1, best + PLANE_TOLERANCE * abs(best)
    for i in range(1, COSINES.size - 1):
        value = measured(measure, parts, COSINES[i], friction)
        if value > least:
            best, place, least = value, i, value
    if place < 0:
        return best, end
    low, high = np.arccos(COSINES[place - 1]), np.arccos(COSINES[place + 1])
    for _ in range(GOLDEN_STEPS):
        one, two = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        first = measured(measure, parts, np.cos(one), friction)
        if first > measured(measure, parts, np.cos(two), friction):
            high = two
        else:
            low = one
    cos = float(np.cos(0.5 * (low + high)))
    return max(best, measured(measure, parts, cos, friction)), cos


@kernel
def try_place(measure: int, r: float, z: float, friction: float, load: Load, best: Array) -> bool:
    """Write the largest value around a circle and where it is, if it is larger than the best."""
    value, cos = around(measure, stress_parts(max(r, at.NEGLIGIBLE), z, load), friction)
    larger = value > best[VALUE]
    if larger:
        best[VALUE], best[RADIUS], best[DEPTH], best[COSINE] = value, r, z, cos
    return bool(larger)


@entry_point()
def scan(measure: int, places: Matrix, friction: float, load: Load, best: Vector) -> None:
    """Write the largest value of a measure among places (radius, depth), and where it is."""
    best[VALUE] = -np.inf
    for row in range(places.shape[0]):
        try_place(measure, places[row, 0], places[row, 1], friction, load, best)


@entry_point()
def climb(
    measure: int,
    friction: float,
    load: Load,
    shallow: float,
    deepest: float,
    step: float,
    last: float,
    best: Vector,
) -> None:
    """Move the best place uphill, within the depths, until steps are smaller than the last."""
    farthest = FARTHEST_CLIMB * max(1.0, shallow)
    for _ in range(MOST_STEPS):
        moved = False
        for way in range(WAYS.shape[0]):
            r = min(abs(best[RADIUS] + step * WAYS[way, 0]), farthest)
            z = min(max(best[DEPTH] + step * WAYS[way, 1], shallow), min(deepest, farthest))
            moved = try_place(measure, r, z, friction, load, best)
            if moved:
                break
        if not moved:
            step *= 0.5
            if step < last:
                break


def jumps(profile: Profile, shallow: float) -> Array:
    """Return the places at the surface where the memory jumps, the edge among them."""
    radii = profile.edges[1:] / profile.edges[-1]
    return np.column_stack((radii, np.full(radii.size, shallow)))


def regions(profile: Profile, shallow: float = 0.0, deepest: float = np.inf) -> list[Array]:
    """Return the places to scan, one array for each region that may have a peak of its own.

    Near the surface, where memory jumps, and deeper; at a depth what pulls may lie far behind.
    """
    surface = np.column_stack((ON_SURFACE, np.full(ON_SURFACE.size, shallow)))
    near = np.concatenate((surface, jumps(profile, shallow)))
    if deepest <= shallow:
        return [near]
    below = np.clip(BELOW, [0.0, shallow], [np.inf, deepest])
    if shallow > 0.0:
        wide = max(1.0, shallow) * BEHIND + [0.0, shallow]
        return [np.concatenate((near, wide)), below]
    return [near, below]


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
    """Return the largest value of a measure of the stress at an instant; else as `stresses`."""
    b = profile.edges[-1]
    if b == 0.0:
        return Largest(0.0, 0.0, 0.0, 0.0)
    load, best = load_of(profile, poisson, rim), np.zeros(PEAK_COLUMNS)
    for places in regions(profile, shallow, deepest):
        peak = np.zeros(PEAK_COLUMNS)
        scan(measure, places, friction, load, peak)
        climb(measure, friction, load, shallow, deepest, FIRST_STEP, LAST_STEP, peak)
        if peak[VALUE] > best[VALUE]:
            best = peak
    sine = np.sqrt(max(1.0 - best[COSINE] ** 2, 0.0))
    x, y = best[RADIUS] * best[COSINE], best[RADIUS] * sine
    return Largest(*map(float, (b * best[VALUE], b * x, b * y, b * best[DEPTH])))
