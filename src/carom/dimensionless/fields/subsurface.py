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

from carom.dimensionless.fields.profile import Profile, thinned
from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import evaluate
from carom.dimensionless.numerics.kernels import entry_point, kernel

NormalStress = tuple[complex, complex, complex, complex]
TangentialStress = tuple[complex, complex, complex, complex, complex, complex]

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
PANEL_REACH = 2.5  # of the longest panel: with these nodes the error is near rounding
NEGLIGIBLE = 1e-30  # of the contact radius: less deep is the surface, nearer the axis is the axis
FARTHEST_POINT = 1e50  # of the contact radius: taken for all that is farther, the stress being nil

BELOW, INSIDE, OUTSIDE = range(3)  # ways along s: at depth; on the surface, s < r and s > r

# In cylindrical coordinates pressure gives stresses that do not depend on the angle, friction along
# x some that go with its cosine and some that go with its sine: ten numbers at a radius and depth.
P_RR, P_TT, P_ZZ, P_RZ, C_RR, C_TT, C_ZZ, C_RZ, S_RT, S_TZ = range(10)
PARTS = 10


class Load(NamedTuple):
    """What acts on a body: pressure on 0 <= r <= edges[-1] = 1, friction of memory g along x.

    `pressed` and `pulled` are half of the densities of pressure and of traction over mu at the
    edge, where they end with a jump: a slice of no width.
    """

    edges: Vector
    g: Matrix
    n: Matrix  # of the pressure, none where it is Hertz's
    poisson: float
    pressed: float
    pulled: float
    parts: Vector  # where `stress_parts` writes


@kernel
def inverse(c: complex) -> complex:
    """Return 1/c; several times faster than the division that minds overflow."""
    scale = 1.0 / (c.real * c.real + c.imag * c.imag)
    return complex(c.real * scale, -c.imag * scale)


@kernel
def normal_force(
    r: float, z: float, depth: complex, p: complex, t: complex, poisson: float
) -> NormalStress:
    """Return rr, tt, zz, rz of S for a unit force into the body; p = 1/R, t = 1/(R + depth)."""
    tp, ttp, zp3 = t * p, t * t * p, z * p * p * p
    soft, hard = 1.0 - 2.0 * poisson, 2.0 * poisson
    ring = hard * p + soft * t - z * tp
    radial = ring - r * r * (soft * ttp - z * tp * p * (t + p))
    return radial, ring, p + depth * zp3, r * zp3


@kernel
def tangential_force(
    r: float, z: float, p: complex, t: complex, poisson: float
) -> TangentialStress:
    """Return S for a unit force along x: rr, tt, zz, rz over the cosine, rt, tz over the sine."""
    tp, tt, ttp, tttp = t * p, t * t, t * t * p, t * t * t * p
    bend, twist, hard = tp * p * (t + p), ttp * p * (2.0 * t + p), 2.0 * poisson
    ring = hard * (tp - 0.5 * tt) - z * ttp
    radial = 2.0 * tp + hard * (tp + r * r * tttp - 1.5 * tt) - z * (3.0 * ttp - r * r * twist)
    shear = z * ttp - tp + 0.5 * hard * tt
    along = p - z * tp
    return r * radial, r * ring, z * r * p * p * p, along + z * r * r * bend, r * shear, -along


@kernel
def add_point(
    parts: Array,
    r: float,
    z: float,
    depth: complex,
    distance: complex,
    poisson: float,
    push: float,
    pull: float,
) -> None:
    """Add Im S of a point at this depth, for a force `push` into the body and `pull` along x."""
    p, t = inverse(distance), inverse(distance + depth)
    rr, tt, zz, rz = normal_force(r, z, depth, p, t, poisson)
    parts[P_RR] += push * rr.imag
    parts[P_TT] += push * tt.imag
    parts[P_ZZ] += push * zz.imag
    parts[P_RZ] += push * rz.imag
    if pull == 0.0:
        return
    rr, tt, zz, rz, rt, tz = tangential_force(r, z, p, t, poisson)
    parts[C_RR] += pull * rr.imag
    parts[C_TT] += pull * tt.imag
    parts[C_ZZ] += pull * zz.imag
    parts[C_RZ] += pull * rz.imag
    parts[S_RT] += pull * rt.imag
    parts[S_TZ] += pull * tz.imag


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
def add_slices(parts: Array, r: float, z: float, way: int, panel: int, load: Load) -> None:
    """Add the stress due to the slices of one panel of the memory that lie on this way."""
    inner, outer = load.edges[panel], load.edges[panel + 1]
    low = max(inner, r) if way == OUTSIDE else inner
    high = min(outer, r) if way == INSIDE else outer
    if low >= high:
        return
    start, end = way_to(way, r, z, low), way_to(way, r, z, high)
    pieces = int(np.ceil((end - start) / PANEL_REACH))
    half = 0.5 * (end - start) / max(pieces, 1)
    for node in range(pieces * NODES.size):
        piece, k = divmod(node, NODES.size)
        s, distance, rate = along(way, r, z, start + half * (2.0 * piece + 1.0 + NODES[k]))
        push = WEIGHTS[k] * half * rate * s
        pull = push * evaluate(load.g[panel], inner, outer, s)
        if load.n.shape[0] > 0:
            push *= evaluate(load.n[panel], inner, outer, s)
        add_point(parts, r, z, complex(z, s), distance, load.poisson, push, pull)


@kernel
def stress_parts(r: float, z: float, load: Load) -> Array:
    """Return the ten numbers of the stress at a radius and depth, for friction of coefficient 1."""
    parts = load.parts
    parts[:] = 0.0
    if load.pressed != 0.0:  # the slice of no width at the edge
        distance = np.sqrt(complex(z * z + (r - 1.0) * (r + 1.0), 2.0 * z))
        depth = complex(z, 1.0)
        add_point(parts, r, z, depth, distance, load.poisson, load.pressed, load.pulled)
    for panel in range(load.edges.size - 1):
        if z > NEGLIGIBLE:
            add_slices(parts, r, z, BELOW, panel, load)
        else:
            add_slices(parts, r, 0.0, INSIDE, panel, load)
            add_slices(parts, r, 0.0, OUTSIDE, panel, load)
    return parts


@kernel
def turn(stress: Array, parts: Array, cos: float, sin: float, friction: float) -> None:
    """Write the stress in the directions of x, y and z at an angle from x."""
    rr, tt = parts[P_RR] + friction * cos * parts[C_RR], parts[P_TT] + friction * cos * parts[C_TT]
    rt, rz = friction * sin * parts[S_RT], parts[P_RZ]
    stress[0] = rr * cos * cos + tt * sin * sin - 2.0 * rt * sin * cos
    stress[1] = rr * sin * sin + tt * cos * cos + 2.0 * rt * sin * cos
    stress[2] = parts[P_ZZ] + friction * cos * parts[C_ZZ]
    stress[3] = (rr - tt) * sin * cos + rt * (cos - sin) * (cos + sin)
    stress[4] = rz * cos + friction * (cos * cos * parts[C_RZ] - sin * sin * parts[S_TZ])
    stress[5] = rz * sin + friction * sin * cos * (parts[C_RZ] + parts[S_TZ])


@entry_point()
def fill(stress: Matrix, points: Matrix, friction: float, load: Load) -> None:
    """Compute the stress at many points; positive friction pulls along +x."""
    for row in range(points.shape[0]):
        x, y = points[row, 0], points[row, 1]
        r = np.hypot(x, y)
        cos, sin = (x / r, y / r) if r > NEGLIGIBLE else (1.0, 0.0)
        parts = stress_parts(max(r, NEGLIGIBLE), points[row, 2], load)
        turn(stress[row], parts, cos, sin, friction)


def stresses(
    points: ArrayLike, profile: Profile, *, friction: float, poisson: float, rim: float = 0.0
) -> Array:
    """Return the stress below a contact at points, components in the order of `COMPONENTS`.

    sigma = integral of s Im[N(z + i s) + mu g(s) T(z + i s)] ds over 0 <= s <= b, with N and T the
    antiderivatives of Boussinesq's and Cerruti's stresses.

    Points have x, y and depth z >= 0 in sqrt(R* L), the last edge of the profile is the radius of
    the contact; `friction` is mu for the body that positive friction drags along +x (the second),
    -mu for the other; `rim` is the density of pressure at the edge, where stresses are infinite.
    """
    b = profile.edges[-1]
    where = np.asarray(points, dtype=np.float64)
    stress = np.zeros((where.shape[0], len(COMPONENTS)))
    if b > 0.0:
        scaled = np.clip(where / b, -FARTHEST_POINT, FARTHEST_POINT)
        fill(stress, scaled, float(friction), load_of(profile, poisson, rim))
    stress *= b
    return stress


def load_of(profile: Profile, poisson: float, rim: float = 0.0) -> Load:
    """Return what acts on a body, lengths in radii of the contact."""
    profile = thinned(profile)
    b = profile.edges[-1]
    rims = 0.5 * rim / b**2, 0.5 * profile.rim / b**2
    return Load(profile.edges / b, profile.g, profile.n, float(poisson), *rims, np.empty(PARTS))
