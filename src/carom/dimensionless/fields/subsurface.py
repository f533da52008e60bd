"""The stress below the surface: pressure and friction of a contact, summed over their slices.

The slice s ds g(s)/sqrt(s^2 - r^2) of a traction acts like a line of point forces on the imaginary
axis, between the depths z - i s and z + i s. A stress due to it is s g(s) Im S(z + i s) ds, where S
is the antiderivative in the depth of the stress due to a point force (Boussinesq and Cerruti:
Johnson 1985, section 3.2 to 3.6), the depth that multiplies its harmonic functions kept real.

Lengths in sqrt(R* L), stresses in p_L = (2 E*/pi) sqrt(L/R*), tension positive, z the depth.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import evaluate
from carom.dimensionless.numerics.kernels import entry_point, kernel

Components = tuple[complex, complex, complex, complex, complex, complex]
Stress = tuple[float, float, float, float, float, float]
Place = tuple[float, float, float, float]  # x, y, z, and the radius sqrt(x^2 + y^2)

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
REACH = 2.5  # of the longest panel: with these nodes the error is near rounding
NEGLIGIBLE = 1e-30  # of the contact radius: less deep is the surface, nearer the axis is the axis
FAR = 1e50  # of the contact radius: taken for all that is farther, the stress being nil

BELOW, INSIDE, OUTSIDE = range(3)  # ways along s: at depth; on the surface, s < r and s > r


class Load(NamedTuple):
    """What acts on a body: pressure on 0 <= r <= edges[-1] = 1, friction of memory g along x.

    `pressed` and `pulled` are half of the densities of pressure and of traction over mu at the
    edge, where they end with a jump: a slice of no width.
    """

    edges: Vector
    g: Matrix
    friction: float  # positive where it pulls along +x
    poisson: float
    pressed: float
    pulled: float


@kernel
def inverse(c: complex) -> complex:
    """Return 1/c; several times faster than the division that minds overflow."""
    scale = 1.0 / (c.real * c.real + c.imag * c.imag)
    return complex(c.real * scale, -c.imag * scale)


@kernel
def normal_force(
    x: float, y: float, z: float, depth: complex, p: complex, t: complex, poisson: float
) -> Components:
    """Return S for a unit force into the body; p = 1/R and t = 1/(R + zeta), zeta the depth."""
    tp, ttp = t * p, t * t * p
    bend = tp * p * (t + p)
    soft, hard = 1.0 - 2.0 * poisson, 2.0 * poisson
    xx = hard * p + soft * (t - x * x * ttp) - z * (tp - x * x * bend)
    yy = hard * p + soft * (t - y * y * ttp) - z * (tp - y * y * bend)
    xy = x * y * (z * bend - soft * ttp)
    zp3 = z * p * p * p
    return xx, yy, p + depth * zp3, xy, x * zp3, y * zp3


@kernel
def tangential_force(
    x: float, y: float, z: float, p: complex, t: complex, poisson: float
) -> Components:
    """Return S for a unit force along x."""
    tp, tt, ttp, tttp = t * p, t * t, t * t * p, t * t * t * p
    bend, twist = tp * p * (t + p), ttp * p * (2.0 * t + p)
    hard = 2.0 * poisson
    xx = 2.0 * tp + hard * (tp + x * x * tttp - 1.5 * tt) - z * (3.0 * ttp - x * x * twist)
    yy = hard * (tp + y * y * tttp - 0.5 * tt) - z * (ttp - y * y * twist)
    xy = tp + hard * (x * x * tttp - 0.5 * tt) - z * (ttp - x * x * twist)
    xz = p - z * (tp - x * x * bend)
    return x * xx, x * yy, z * x * p * p * p, y * xy, xz, z * x * y * bend


@kernel
def point_force(
    x: float, y: float, z: float, depth: complex, distance: complex, poisson: float, pull: float
) -> Stress:
    """Return Im S for a unit force into the body together with a force `pull` along x."""
    p, t = inverse(distance), inverse(distance + depth)
    one = normal_force(x, y, z, depth, p, t, poisson)
    other = tangential_force(x, y, z, p, t, poisson)
    return (
        (one[0] + pull * other[0]).imag,
        (one[1] + pull * other[1]).imag,
        (one[2] + pull * other[2]).imag,
        (one[3] + pull * other[3]).imag,
        (one[4] + pull * other[4]).imag,
        (one[5] + pull * other[5]).imag,
    )


@kernel
def way_to(way: int, r: float, z: float, s: float) -> float:
    """Return the parameter u at which a way reaches the slice s."""
    if way == BELOW:
        return float(np.arcsinh((s - r) / z))
    if way == INSIDE:
        return float(np.arcsin(s / r))
    return float(np.arccosh(s / r))


@kernel
def along(way: int, r: float, z: float, u: float) -> tuple[float, complex, float]:
    """Return the slice s at u, sqrt(r^2 + (z + i s)^2) without cancellation, and ds/du.

    s = r + z sinh u makes the stresses analytic on the real axis: near s = r + i z the distance
    from it has a double zero in u. On the surface r sin u and r cosh u do the same.
    """
    if way == BELOW:
        sinh, cosh = np.sinh(u), np.cosh(u)
        s = r + z * sinh
        return s, np.sqrt(z * complex(1.0, sinh) * complex(z, s + r)), z * cosh
    if way == INSIDE:
        return r * np.sin(u), complex(r * np.cos(u), 0.0), r * np.cos(u)
    return r * np.cosh(u), complex(0.0, r * np.sinh(u)), r * np.sinh(u)


@kernel
def add_slices(total: Array, at: Place, way: int, panel: int, load: Load) -> None:
    """Add the stress due to the slices of one panel of the memory that lie on this way."""
    x, y, z, r = at
    inner, outer = load.edges[panel], load.edges[panel + 1]
    low = max(inner, r) if way == OUTSIDE else inner
    high = min(outer, r) if way == INSIDE else outer
    if low >= high:
        return
    start, end = way_to(way, r, z, low), way_to(way, r, z, high)
    pieces = int(np.ceil((end - start) / REACH))
    half = 0.5 * (end - start) / max(pieces, 1)
    for node in range(pieces * NODES.size):
        piece, k = divmod(node, NODES.size)
        s, distance, rate = along(way, r, z, start + half * (2.0 * piece + 1.0 + NODES[k]))
        pull = load.friction * evaluate(load.g[panel], inner, outer, s)
        stress = point_force(x, y, z, complex(z, s), distance, load.poisson, pull)
        for component in range(total.size):
            total[component] += WEIGHTS[k] * half * rate * s * stress[component]


@kernel
def add_rim(total: Array, at: Place, load: Load) -> None:
    """Add the stress due to the slice of no width at the edge."""
    x, y, z, r = at
    distance = np.sqrt(complex(z * z + (r - 1.0) * (r + 1.0), 2.0 * z))
    pull = load.friction * load.pulled / load.pressed
    stress = point_force(x, y, z, complex(z, 1.0), distance, load.poisson, pull)
    for component in range(total.size):
        total[component] += load.pressed * stress[component]


@kernel
def stress_at(total: Array, x: float, y: float, z: float, load: Load) -> None:
    """Add up the stress at one point."""
    r = max(np.hypot(x, y), NEGLIGIBLE)
    if load.pressed != 0.0:
        add_rim(total, (x, y, z, r), load)
    for panel in range(load.edges.size - 1):
        if z > NEGLIGIBLE:
            add_slices(total, (x, y, z, r), BELOW, panel, load)
        else:
            add_slices(total, (x, y, 0.0, r), INSIDE, panel, load)
            add_slices(total, (x, y, 0.0, r), OUTSIDE, panel, load)


@entry_point()
def fill(stress: Matrix, points: Matrix, load: Load) -> None:
    """Compute the stress at many points."""
    for row in range(points.shape[0]):
        stress_at(stress[row], points[row, 0], points[row, 1], points[row, 2], load)


def stresses(
    points: ArrayLike, profile: Profile, *, friction: float, poisson: float, rim: float = 0.0
) -> Array:
    """Return the stress below a contact at points, components in the order of `COMPONENTS`.

    sigma = integral of s Im[N(z + i s) + mu g(s) T(z + i s)] ds over 0 <= s <= b, with N and T the
    antiderivatives of Boussinesq's and Cerruti's stresses.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        x, y and depth z >= 0 in sqrt(R* L).
    profile : Profile
        The memory of the contact; its last edge is the radius of the contact.
    friction : float
        mu for the body that positive friction drags along +x (the second), -mu for the other.
    poisson : float
        Poisson's ratio of the body.
    rim : float
        Density of the pressure at the edge, where it ends with a jump; stresses are infinite there.

    Examples
    --------
    >>> from carom.dimensionless.fields.profile import flat, stacked
    >>> from carom.dimensionless.fields.subsurface import stresses
    >>> hertz = stacked([1.0], [flat(0.0, 1.0, 1.0, 0.0)])
    >>> axis = stresses([[0, 0, 0.48]], hertz, friction=0.0, poisson=0.3)[0]
    >>> round(float(axis[0] - axis[2]) / 2, 4)
    0.31
    """
    b = profile.edges[-1]
    where = np.asarray(points, dtype=np.float64)
    stress = np.zeros((where.shape[0], len(COMPONENTS)))
    if b > 0.0:
        rims = 0.5 * rim / b**2, 0.5 * profile.rim / b**2
        load = Load(profile.edges / b, profile.g, float(friction), float(poisson), *rims)
        fill(stress, np.clip(where / b, -FAR, FAR), load)
    stress *= b
    return stress
