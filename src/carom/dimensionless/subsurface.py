"""The stress below the surface: pressure and friction of a contact, summed over their slices.

The slice s ds g(s)/sqrt(s^2 - r^2) of a traction acts like a line of point forces on the imaginary
axis, between the depths z - i s and z + i s. A stress due to it is s g(s) Im S(z + i s) ds, where S
is the antiderivative in the depth of the stress due to a point force (Boussinesq and Cerruti:
Johnson 1985, section 3.2 to 3.6), the depth that multiplies its harmonic functions kept real.

Lengths in sqrt(R* L), stresses in p_L = (2 E*/pi) sqrt(L/R*), tension positive, z the depth.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.dimensionless._jit import kernel
from carom.dimensionless.profile import Profile, evaluate

Array = NDArray[np.float64]
Stress = tuple[float, float, float, float, float, float]
Place = tuple[float, float, float, float]  # x, y, z, and the radius sqrt(x^2 + y^2)

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
REACH = 2.5  # of the longest panel: with these nodes the error is near rounding
NEGLIGIBLE = 1e-30  # of the contact radius: less deep is the surface, nearer the axis is the axis

BELOW, INSIDE, OUTSIDE = range(3)  # ways along s: at depth; on the surface, s < r and s > r


class Load(NamedTuple):
    """What acts on a body: pressure on 0 <= r <= edges[-1], friction of memory g along x."""

    edges: Array
    g: Array
    friction: float  # positive where it pulls along +x
    poisson: float


@kernel
def inverse(c: complex) -> complex:
    """Return 1/c; several times faster than the division that minds overflow."""
    scale = 1.0 / (c.real * c.real + c.imag * c.imag)
    return complex(c.real * scale, -c.imag * scale)


@kernel
def point_force(
    x: float, y: float, z: float, depth: complex, distance: complex, poisson: float, pull: float
) -> Stress:
    """Return Im S for a unit normal force together with a tangential force `pull`."""
    p = inverse(distance)
    t = inverse(distance + depth)
    tp = t * p
    ttp = t * tp
    bend = tp * p * (t + p)
    twist = ttp * p * (2.0 * t + p)
    core = tp - x * x * bend
    soft, hard = 1.0 - 2.0 * poisson, 2.0 * poisson
    half = 0.5 * t * t
    xx = hard * p + soft * (t - x * x * ttp) - z * core
    yy = hard * p + soft * (t - y * y * ttp) - z * (tp - y * y * bend)
    ppp = p * p * p
    zz = p + z * depth * ppp
    xy = x * y * (z * bend - soft * ttp)
    xz, yz = z * x * ppp, z * y * ppp
    pulled_xx = x * (
        2.0 * tp + hard * (tp + x * x * t * ttp - 3.0 * half) - z * (3.0 * ttp - x * x * twist)
    )
    pulled_yy = x * (hard * (tp + y * y * t * ttp - half) - z * (ttp - y * y * twist))
    pulled_xy = y * (tp + hard * (x * x * t * ttp - half) - z * (ttp - x * x * twist))
    return (
        (xx + pull * pulled_xx).imag,
        (yy + pull * pulled_yy).imag,
        (zz + pull * xz).imag,
        (xy + pull * pulled_xy).imag,
        (xz + pull * (p - z * core)).imag,
        (yz + pull * z * x * y * bend).imag,
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
def add_slices(total: Array, at: Place, way: int, low: float, high: float, load: Load) -> None:
    """Add the stress due to the slices low <= s <= high of one panel of the memory."""
    x, y, z, r = at
    panel = np.searchsorted(load.edges, 0.5 * (low + high)) - 1
    start, end = way_to(way, r, z, low), way_to(way, r, z, high)
    pieces = int(np.ceil((end - start) / REACH))
    half = 0.5 * (end - start) / max(pieces, 1)
    for node in range(pieces * NODES.size):
        piece, k = divmod(node, NODES.size)
        s, distance, rate = along(way, r, z, start + half * (2.0 * piece + 1.0 + NODES[k]))
        g = evaluate(load.g[panel], load.edges[panel], load.edges[panel + 1], s)
        pull = load.friction * g
        stress = point_force(x, y, z, complex(z, s), distance, load.poisson, pull)
        for component in range(total.size):
            total[component] += WEIGHTS[k] * half * rate * s * stress[component]


@kernel
def stress_at(total: Array, x: float, y: float, z: float, load: Load) -> None:
    """Add up the stress at one point."""
    least = NEGLIGIBLE * load.edges[-1]
    r = max(np.hypot(x, y), least)
    for panel in range(load.edges.size - 1):
        low, high = load.edges[panel], load.edges[panel + 1]
        if z > least:
            add_slices(total, (x, y, z, r), BELOW, low, high, load)
            continue
        if low < r:
            add_slices(total, (x, y, 0.0, r), INSIDE, low, min(high, r), load)
        if high > r:
            add_slices(total, (x, y, 0.0, r), OUTSIDE, max(low, r), high, load)


@kernel
def fill(stress: Array, points: Array, load: Load) -> None:
    """Compute the stress at many points."""
    for row in range(points.shape[0]):
        stress_at(stress[row], points[row, 0], points[row, 1], points[row, 2], load)


def stresses(points: ArrayLike, profile: Profile, *, friction: float, poisson: float) -> Array:
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

    Examples
    --------
    >>> from carom.dimensionless.profile import flat, stacked
    >>> hertz = stacked([1.0], [flat(0.0, 1.0, 1.0, 0.0)])
    >>> axis = stresses([[0, 0, 0.48]], hertz, friction=0.0, poisson=0.3)[0]
    >>> round((axis[0] - axis[2]) / 2, 4)
    0.31
    """
    where = np.ascontiguousarray(points, dtype=np.float64)
    stress = np.zeros((where.shape[0], len(COMPONENTS)))
    fill(stress, where, Load(profile.edges, profile.g, float(friction), float(poisson)))
    return stress
