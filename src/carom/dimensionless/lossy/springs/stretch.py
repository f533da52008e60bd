"""A spring in shear over one step: it sticks, or slips at Coulomb's limit.

A standard linear solid, f = u + g m, m' = u' - m/theta; g = 0 is an elastic one. In stick u grows
as U does. In slip f = sigma N, so that m relaxes by itself, in the time (1 + g) theta.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.numerics.kernels import kernel

SHORT = 1e-3  # of a step, in relaxation times: where its functions are series


class Step(NamedTuple):
    """What is the same for all springs in a step."""

    time: float
    psi: float  # at its start
    moved: float  # by how much U grows
    relaxing: float  # by how much m grows with U
    extra: float  # g
    give: float  # 1/(1 + g)
    fading: float  # 1/theta
    left: float  # exp(-time/theta)
    kept: float  # of a steady growth of u by m
    slipping: float  # exp(-time/((1 + g) theta))
    forced: float  # of a steady growth of f by m in slip


@kernel
def faded(time: float, relaxation: float) -> tuple[float, float, float]:
    """Return what fading leaves: of what was there, of a steady growth, of a growing rate.

    exp(-q), (1 - exp(-q))/q and theta ((1 + exp(-q))/2 - (1 - exp(-q))/q), q = time/theta; the last
    times the change of the rate over the step.
    """
    q = time / relaxation
    left = np.exp(-q)
    if q < SHORT:
        return left, 1.0 - 0.5 * q + q * q / 6.0, time * q / 12.0
    kept = -np.expm1(-q) / q
    return left, kept, relaxation * (0.5 * (1.0 + left) - kept)


@kernel
def lowest(start: float, slope: float, end: float) -> float:
    """Return the least value, its start apart, of a parabola on [0, 1].

    Slip that stops within a step leaves the springs at the limit of that moment; without it the
    error would depend on where in the step slip stops.
    """
    curvature = end - start - slope
    if slope < 0.0 and -slope < 2.0 * curvature:
        return start - slope * slope / (4.0 * curvature)
    return end


@kernel
def step_of(
    extra: float, relaxation: float, time: float, psi: float, half: float, rate: float
) -> Step:
    """Return a step from its length, psi at its start and in its middle, and psi'."""
    left, kept, growing = faded(time, relaxation)
    slower = (1.0 + extra) * relaxation
    slipping, forced, _ = faded(time, slower)
    return Step(
        time,
        psi,
        half * time,
        half * time * kept + growing * rate * time,
        extra,
        1.0 / (1.0 + extra),
        1.0 / relaxation,
        left,
        kept,
        slipping,
        forced / (1.0 + extra),
    )


@kernel
def stretched(
    u: float, m: float, limit: float, limit_end: float, rate: float, step: Step
) -> tuple[float, float]:
    """Return u and m after a step; rate is that of the limit at its start."""
    stuck, relaxed = u + step.moved, m * step.left + step.relaxing
    least, end, slid, slid_m = _slip(1.0, u, m, limit, limit_end, rate, step)
    sign = 1.0
    if least >= 0.0:
        least, end, slid, slid_m = _slip(-1.0, u, m, limit, limit_end, rate, step)
        sign = -1.0
    if least >= 0.0:
        return stuck, relaxed
    if least == end:
        return slid, slid_m
    return stuck + sign * least, relaxed + sign * least * step.kept


@kernel
def _slip(
    sign: float, u: float, m: float, limit: float, limit_end: float, rate: float, step: Step
) -> tuple[float, float, float, float]:
    """Return how slip differs from stick at the least and at the end, and u and m after it."""
    g, stuck = step.extra, u + step.moved
    start = (limit - sign * (u + g * m)) * step.give  # to the limit, at once
    began = m + sign * start
    slid_m = began * step.slipping + sign * (limit_end - limit) * step.forced
    slid = sign * limit_end - g * slid_m
    slope = (rate + sign * g * step.fading * began) * step.give - sign * step.psi
    end = sign * (slid - stuck)
    return lowest(start, slope * step.time, end), end, slid, slid_m
