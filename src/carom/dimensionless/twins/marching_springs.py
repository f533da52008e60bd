"""Tangential springs in small steps: the tangential half of the marching method.

Of the Abel-transformed traction each annulus of the contact is one spring of deflection q(x), so
that the annuli do not act on one another; each sticks or slips by its own Coulomb limit:

    U' = psi,  psi' = -(15/4) chi Q,  Q = integral of q dx over 0 <= x <= b,
    q' = psi, but |q| <= D - x^2.

The normal motion (time, b, D) is given on the steps, as by marching_motion. Springs are met with
q = 0 at the ends of steps of the loading, one every `stride` steps.
"""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

Slips = NDArray[np.int8]

AT_LIMIT = 1e-12  # a spring nearer than this to Coulomb's limit slips; above rounding of q
OUTSIDE = 2  # in a map of slip: no contact


@kernel
def share(near: float, far: float) -> float:
    """Return the weight at `near` of the integral to `far` of a q linear in x^2."""
    return abs(far - near) * (2.0 * far + near) / (3.0 * (far + near))


@kernel
def places(motion: Array, stride: int) -> Array:
    """Return the places x of the springs, and the largest radius of the contact."""
    peak = np.argmax(motion[:, 3])
    return np.append(motion[:peak:stride, 3], motion[peak, 3])


@kernel
def weigh(x: Array) -> tuple[Array, Array]:
    """Return weights of the springs, and what the last one in contact loses of its weight.

    The weights integrate a q that is linear in x^2 between the springs and zero at the edge.
    """
    outer = np.empty(x.size - 1)
    weights = np.zeros(x.size - 1)
    for j in range(x.size - 1):
        outer[j] = share(x[j], x[j + 1])
        weights[j] = outer[j] + (share(x[j], x[j - 1]) if j > 0 else 0.0)
    return weights, outer


@kernel
def _lowest(start: float, slope: float, end: float) -> float:
    """Return the least value, its start apart, of a parabola on [0, 1].

    Slip that stops within a step leaves the springs at the limit of that moment; without it the
    error would depend on where in the step slip stops.
    """
    curvature = end - start - slope
    if slope < 0.0 and -slope < 2.0 * curvature:
        return start - slope * slope / (4.0 * curvature)
    return end


@kernel
def _stretch(q: Array, s: Array, weights: Array, step: float, upper: float, lower: float) -> float:
    """Move the springs by `step` within Coulomb's limits and return their force."""
    force = 0.0
    for j in range(q.size):
        q[j] = max(min(q[j] + step, upper - s[j]), s[j] - lower)
        force += weights[j] * q[j]
    return force


@kernel
def _mark(slips: Slips, q: Array, s: Array, limit: float) -> None:
    """Write the sign of slip of every spring in contact, 0 in stick."""
    for j in range(q.size):
        slips[j] = 0
        if limit - s[j] - abs(q[j]) <= AT_LIMIT:
            slips[j] = 1 if q[j] > 0.0 else -1


@kernel
def integrate(psi: float, chi: float, motion: Array, stride: int, slips: Slips) -> float:
    """Return psi after contact, kick-drift-kick; fill `slips` unless empty."""
    x = places(motion, stride)
    s = x * x
    weights, outer = weigh(x)
    q = np.zeros(outer.size)
    u, force = 0.0, 0.0
    for i in range(motion.shape[0] - 1):
        at, t, clock, _, limit, growth = motion[i, :6]
        at_end, t_end, clock_end, edge_end, limit_end, _ = motion[i + 1, :6]
        dt, kick, old = t_end - t, 0.5 * (at_end - at) * 3.75 * chi, psi
        psi -= kick * clock * force
        step = psi * dt
        to_upper = _lowest(limit - u, (growth - old) * dt, limit_end - u - step)
        to_lower = _lowest(limit + u, (growth + old) * dt, limit_end + u + step)
        u += step
        touching = np.searchsorted(x[: q.size], edge_end)
        inner, last = q[:touching], max(touching - 1, 0)
        whole = weights[last]
        weights[last] += share(x[last], edge_end) - outer[last]
        force = _stretch(inner, s, weights, step, u + to_upper, to_lower - u)
        psi -= kick * clock_end * force
        if slips.size > 0:
            _mark(slips[i + 1], inner, s, limit_end)
        weights[last] = whole
    return psi
