"""The memory of a contact as annuli of constant g: what straight steps in d and U leave behind.

Lengths in units of L, squares of radii in R* L, tangential displacement U in mu L/kappa. While a
spring sticks, q(s) = U + c(s), and g = -dc/ds. With F = s + sigma c and l = d - sigma U Coulomb's
law is F <= l for either sign sigma of slip; F never falls outwards, so slip enters at the edge.
"""

import numpy as np

from carom.dimensionless.fields import profile
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

# A row is the outer rim of an annulus: s there, the radius, g of the annulus, c at the rim, and of
# q - q(rim) the integral up to the rim and that of the square. Row 0 is the centre.
RIM, RADIUS, SLOPE, SHIFT, FORCE, SQUARE = range(6)
STACK_COLUMNS = 6


def new_stack(steps: int) -> Array:
    """Return the memory of bodies that just touch, with room for this many steps."""
    stack = np.empty((steps + 2, STACK_COLUMNS))
    stack[0] = 0.0
    return stack


@kernel
def cubes(inner: float, outer: float) -> float:
    """Return (2/3) (outer^3 - inner^3): the integral of s_outer - s over a disc, of both radii."""
    return 2.0 / 3.0 * (outer - inner) * (outer * outer + outer * inner + inner * inner)


@kernel
def ring_square(inner: float, outer: float) -> float:
    """Return the integral of (outer^2 - x^2)^2 over x from inner to outer."""
    h = outer - inner
    return h * h * h * (4.0 / 3.0 * outer * outer - outer * h + 0.2 * h * h)


@kernel
def add(stack: Array, top: int, s: float, g: float, c: float) -> int:
    """Add an annulus up to s with this g, and c at its rim; return the new top."""
    inner, radius = stack[top, RADIUS], np.sqrt(s)
    force, fall = stack[top, FORCE], g * (s - stack[top, RIM])
    square = stack[top, SQUARE] + fall * (2.0 * force + fall * inner)
    top += 1
    row = stack[top]
    row[RIM], row[RADIUS], row[SLOPE], row[SHIFT] = s, radius, g, c
    row[FORCE] = force + g * cubes(inner, radius)
    row[SQUARE] = square + g * g * ring_square(inner, radius)
    return top


@kernel
def annulus_at(stack: Array, top: int, s: float) -> int:
    """Return the annulus that reaches up to s or beyond, its inner rim below s; 0 if s <= 0."""
    for i in range(top, 0, -1):
        if stack[i - 1, RIM] < s:
            return i
    return 0


@kernel
def shift_at(stack: Array, i: int, s: float) -> float:
    """Return c at a place s of annulus i, or at the centre for i = 0."""
    if i == 0:
        return float(stack[0, SHIFT])
    return float(stack[i - 1, SHIFT] - stack[i, SLOPE] * (s - stack[i - 1, RIM]))


@kernel
def edge_at(stack: Array, i: int, d: float) -> tuple[float, float]:
    """Return c and Q if the edge were at d in annulus i."""
    if d == stack[i, RIM]:
        return stack[i, SHIFT], stack[i, FORCE]
    rise = stack[i, SLOPE] * cubes(stack[i - 1, RADIUS], np.sqrt(d))
    return shift_at(stack, i, d), stack[i - 1, FORCE] + rise


@kernel
def cut(stack: Array, i: int, s: float) -> int:
    """Cut the memory off at s, which lies in annulus i; return the new top."""
    if i == 0 or s <= stack[i - 1, RIM]:
        return max(i - 1, 0)
    if s < stack[i, RIM]:
        add(stack, i - 1, s, stack[i, SLOPE], shift_at(stack, i, s))
    return i


@kernel
def front_at_limit(
    stack: Array, i: int, sign: int, limit: float, rounding: float
) -> tuple[int, float]:
    """Return annulus and s where F = l, from annulus i inwards, 0 if nowhere; over flat memory."""
    for k in range(i, 0, -1):
        inner = stack[k - 1, RIM]
        room = limit - (inner + sign * stack[k - 1, SHIFT])
        if room > rounding:
            rate, rim = 1.0 - sign * stack[k, SLOPE], stack[k, RIM]
            return k, inner + room / rate if room < rate * (rim - inner) else rim
    return 0, 0.0


@kernel
def front_at_force(
    stack: Array, i: int, sign: int, b: float, force: float, rounding: float
) -> tuple[int, float]:
    """Return where the front stands when slip out to b has brought Q to a force, as above.

    Outside the front q = sigma (d - s), hence Q = Q(a) + sigma (2/3) (b^3 - a^3), a cubic in a.
    """
    for k in range(i, 0, -1):
        inner = stack[k - 1, RADIUS]
        room = cubes(inner, b) - sign * (force - stack[k - 1, FORCE])
        if room > rounding:
            rate, rim = 1.0 - sign * stack[k, SLOPE], stack[k, RIM]
            if room >= rate * cubes(inner, stack[k, RADIUS]):
                return k, rim
            x = np.cbrt(inner * inner * inner + 1.5 * room / rate)
            return k, min(max(x * x, stack[k - 1, RIM]), rim)
    return 0, 0.0


@kernel
def slip_outside(stack: Array, i: int, s: float, sign: int, d: float, u: float) -> int:
    """Bring all memory outside the front at s in annulus i to its limit; return the new top."""
    top = cut(stack, i, s)
    if top == 0:
        stack[0, SHIFT] = sign * d - u
    if d > stack[top, RIM]:
        top = add(stack, top, d, float(sign), -u)
    return top


@kernel
def stick_radius(stack: Array, top: int) -> float:
    """Return the radius up to which the contact is inside its limits."""
    if top == 0 or abs(stack[top, SLOPE]) < 1.0:
        return float(stack[top, RADIUS])
    return float(stack[top - 1, RADIUS])


@kernel
def carried(stack: Array, top: int, r: float) -> tuple[float, float]:
    """Return the radial functions of the tangential displacement of both surfaces at radius r.

    u_x = u_0 + lambda u_2 cos 2 theta, u_y = lambda u_2 sin 2 theta; superposed from Barber (1979),
    (29), and its like outside the contact: a disc of g = 1 for each rim.
    """
    mean, lateral, one, two = 0.0, 0.0, 0.0, 0.0
    for i in range(1, top + 1):
        inner_one, inner_two = one, two
        rim, radius = stack[i, RIM], stack[i, RADIUS]
        if radius <= r:
            angle, leg = np.arcsin(radius / r), radius * np.sqrt((r - radius) * (r + radius))
        else:
            angle, leg = 0.5 * np.pi, 0.0
        one = ((2.0 * rim - r * r) * angle + leg) / np.pi
        two = 0.5 / np.pi * r * r * (angle - 0.25 * np.sin(4.0 * angle))
        mean += stack[i, SLOPE] * (one - inner_one)
        lateral += stack[i, SLOPE] * (two - inner_two)
    return mean, lateral


def profile_of(stack: Array) -> Profile:
    """Return the memory as a profile: exact, with a panel for each annulus."""
    edges, rows, q = [], [], 0.0
    for inner, outer in zip(stack[-2::-1], stack[:0:-1], strict=True):
        if outer[RADIUS] > inner[RADIUS]:
            edges.append(float(outer[RADIUS]))
            rows.append(profile.flat(inner[RADIUS], outer[RADIUS], outer[SLOPE], q))
        q += outer[SLOPE] * (outer[RIM] - inner[RIM])
    return profile.stacked(edges[::-1], rows[::-1])
