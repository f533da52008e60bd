"""Tractions and displacements at the surface, from the memory of the contact.

A slice g ds of the memory carries the traction of a rigid tangential displacement of the circle of
radius s; its displacement is uniform inside and known in closed form outside. In units of
sqrt(R* L) for radii, p_L = (2 E*/pi) sqrt(L/R*) for tractions, L or mu L/kappa for displacements.
"""

import numpy as np

from carom.dimensionless.fields.profile import Profile, is_constant
from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import evaluate
from carom.dimensionless.numerics.kernels import entry_point, kernel

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(20)


@kernel
def pressure(square: float, rim: float, r: float) -> float:
    """Return Hertz's pressure and that of the edge, rim/(2 sqrt(b^2 - r^2)): Barber (1979), (1)."""
    if r * r > square:
        return 0.0
    root = np.sqrt(square - r * r)
    return float(root + at_rim(rim, root))


@kernel
def at_rim(rim: float, root: float) -> float:
    """Return what a density that ends with a jump adds, infinite at the edge itself."""
    if rim == 0.0:
        return 0.0
    return float(0.5 * rim / root) if root > 0.0 else float(np.copysign(np.inf, rim))


@kernel
def normal_displacement(d: float, r: float) -> float:
    """Return u_z of both surfaces together, inside and outside (Johnson 1985, 3.41, 3.42)."""
    if r * r <= d:
        return d - 0.5 * r * r
    angle = 2.0 * np.arctan2(np.sqrt(d), np.sqrt(r * r - d))
    return float(r * r / (2.0 * np.pi) * sine_less_chord(angle))


@kernel
def sine_less_chord(angle: float) -> float:
    """Return sin x - x cos x without cancellation for small x."""
    if angle > 0.5:
        return float(np.sin(angle) - angle * np.cos(angle))
    term, total = angle**3 / 3.0, 0.0
    for k in range(1, 8):
        total += term
        term *= -(angle**2) / (2.0 * k * (2.0 * k + 3.0))
    return total


@kernel
def traction(profile: Profile, r: float) -> float:
    """Return f = integral_r^b g s ds/sqrt(s^2 - r^2), Barber's (6), over mu; and of the rim."""
    edges, total = profile.edges, 0.0
    if profile.rim != 0.0 and r <= edges[-1]:
        total = at_rim(profile.rim, np.sqrt(edges[-1] * edges[-1] - r * r))
    for i in range(edges.size - 1):
        low, high = max(edges[i], r), edges[i + 1]
        if high <= low:
            continue
        first, last = np.sqrt(low * low - r * r), np.sqrt(high * high - r * r)
        half = 0.5 * (last - first)
        if is_constant(profile.g[i]):
            total += profile.g[i, 0] * (last - first)
            continue
        for k in range(ABSCISSAS.size):
            w = first + half * (1.0 + ABSCISSAS[k])
            x = min(np.sqrt(r * r + w * w), high)
            total += half * WEIGHTS[k] * evaluate(profile.g[i], edges[i], high, x)
    return total


@entry_point()
def tractions(profile: Profile, radii: Vector, out: Vector) -> None:
    """Write the traction over mu for every radius."""
    for i in range(radii.size):
        out[i] = traction(profile, radii[i])


@kernel
def displacement(profile: Profile, r: float) -> tuple[float, float]:
    """Return the two radial functions of the tangential displacement of both surfaces together.

    u_x = u_0 + lambda u_2 cos 2 theta, u_y = lambda u_2 sin 2 theta, with
    u_0 = (2/pi) integral q ds/sqrt(r^2 - s^2), u_2 = (4/(pi r^2)) integral g s^2 sqrt(r^2 - s^2) ds
    over s < min(r, b). With s = r sin(phi) both integrands are smooth. For g = 1 inside: (29).
    """
    edges = profile.edges
    if edges.size < 2:
        return 0.0, 0.0
    if r <= 0.0:
        return evaluate(profile.q[0], edges[0], edges[1], 0.0), 0.0
    mean, lateral = 0.0, 0.0
    for i in range(edges.size - 1):
        low, high = edges[i], edges[i + 1]
        if low >= r:
            break
        first, last = np.arcsin(low / r), np.arcsin(min(high / r, 1.0))
        if is_constant(profile.g[i]):
            one, two = uniform_panel(profile, i, r, first, last)
            mean += one
            lateral += two
            continue
        half = 0.5 * (last - first)
        for k in range(ABSCISSAS.size):
            angle = first + half * (1.0 + ABSCISSAS[k])
            x, weight = min(r * np.sin(angle), high), half * WEIGHTS[k]
            mean += weight * evaluate(profile.q[i], low, high, x)
            lateral += weight * (x * np.cos(angle)) ** 2 * evaluate(profile.g[i], low, high, x)
    return 2.0 / np.pi * mean, 4.0 / np.pi * lateral


@kernel
def uniform_panel(
    profile: Profile, i: int, r: float, first: float, last: float
) -> tuple[float, float]:
    """Return what a panel of constant g adds to both integrals, between two angles phi."""
    low, high, g = profile.edges[i], profile.edges[i + 1], profile.g[i, 0]
    rim = evaluate(profile.q[i], low, high, high)
    span = last - first
    squares = r * r * (0.5 * span - 0.5 * np.sin(span) * np.cos(first + last))
    lateral = g * r * r * (span / 8.0 - np.sin(2.0 * span) * np.cos(2.0 * (first + last)) / 16.0)
    return (rim + g * high * high) * span - g * squares, lateral


@entry_point()
def slip_shape(front: float, r: float) -> tuple[float, float]:
    """Return the radial functions of the slip rate outside the front, per unit of it far outside.

    The stick zone moves as a punch: w_x = W (w_0 - lambda w_2 cos 2 theta), w_y = -W lambda w_2
    sin 2 theta, w_0 = (2/pi) acos(a/r), w_2 = (2/pi) a sqrt(r^2 - a^2)/r^2.
    """
    if front <= 0.0:
        return 1.0, 0.0
    if r <= front:
        return 0.0, 0.0
    w = np.sqrt((r - front) * (r + front))
    return 2.0 / np.pi * np.arctan2(w, front), 2.0 / np.pi * front * w / (r * r)


@entry_point()
def sample(
    profile: Profile, d: float, square: float, rim: float, radii: Vector, out: Matrix
) -> None:
    """Write pressure, traction over mu, u_z, u_0, u_2 at radii; d is penetration, `square` b^2."""
    for i in range(radii.size):
        r = radii[i]
        out[i, 0], out[i, 1] = pressure(square, rim, r), traction(profile, r)
        if profile.n.shape[0] > 0:
            pressed = Profile(profile.edges, profile.q, profile.n, 0.0, profile.n)
            out[i, 0] = traction(pressed, r)
        out[i, 2] = normal_displacement(d, r)
        out[i, 3], out[i, 4] = displacement(profile, r)


def displaced(profile: Profile, radii: Array) -> Array:
    """Return the radial functions w_0, w_2 of what springs with this profile have slipped."""
    out = np.empty((radii.size, 5))
    sample(profile, 0.0, 0.0, 0.0, np.ascontiguousarray(radii), out)
    return np.asarray(out[:, 3:] * np.array([1.0, -1.0]))
