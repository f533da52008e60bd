"""How hard the stress beside a contact pulls at flaws: shallow cracks that go straight down.

A crack stands across the direction from the centre, and is long against its depth c. With the
weight function of an edge crack (Tada, Paris & Irwin 2000, section 8), which is within 0.3 %,
K = 2 sqrt(c/pi) integral of (1.3 - 0.3 u^(5/4)) sigma(c u)/sqrt(1 - u^2) du over 0 < u < 1. Shallow
cracks are short and deep ones leave the tension behind, so that those between are pulled at most.
"""

import numpy as np

from carom.dimensionless.fields.peaks import COSINE, DEPTH, GOLDEN, MOST_STEPS, RADIUS, VALUE
from carom.dimensionless.fields.subsurface import C_RR, NEGLIGIBLE, P_RR, Load, stress_parts
from carom.dimensionless.numerics.arrays import Array, Cube, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import evaluate, nodes, transform
from carom.dimensionless.numerics.kernels import entry_point, kernel

DEEPEST_FLAW = 0.25  # of the flaws, in contact radii: deeper, nothing pulls harder
TERMS = 16  # of the stress over the root of the depth, in which it is smooth beside the edge
ROOTS = 0.5 + 0.5 * nodes(TERMS)
TO_SERIES = transform(TERMS)
TRIAL_DEPTHS = 10  # depths, evenly spaced by their roots
GOLDEN_STEPS = 8  # by which the depth that is pulled at hardest is is_harder between two of them
RADII = np.array([1.0, 1.03, 1.1])  # of the scan, in contact radii
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(10)
_PARTS = 0.5 + 0.5 * _NODES
_DEPTHS = np.sin(0.5 * np.pi * _PARTS**2)
PLACES = np.sqrt(_DEPTHS)  # of the integral, as roots of the depth over that of the crack
SHARES = _WEIGHTS * _PARTS * (1.3 - 0.3 * _DEPTHS**1.25)


@kernel
def stress_at_depths(series: Matrix, r: float, friction: float, load: Load) -> None:
    """Write the tension before (row 0) and behind the contact as series in the root of depth."""
    series[:] = 0.0
    for k in range(TERMS):
        parts = stress_parts(max(r, NEGLIGIBLE), DEEPEST_FLAW * ROOTS[k] ** 2, load)
        for i in range(TERMS):
            series[0, i] += TO_SERIES[i, k] * (parts[P_RR] + friction * parts[C_RR])
            series[1, i] += TO_SERIES[i, k] * (parts[P_RR] - friction * parts[C_RR])


@kernel
def pull(root: float, series: Array) -> float:
    """Return K/sqrt(pi) of a crack, from the root of its depth over the deepest."""
    total = 0.0
    for k in range(PLACES.size):
        total += SHARES[k] * evaluate(series, 0.0, 1.0, root * PLACES[k])
    return float(np.sqrt(DEEPEST_FLAW) * root * total)


@kernel
def hardest(series: Array, limit: float) -> tuple[float, float]:
    """Return the hardest pull at cracks up to a root of the depth, and that root."""
    best, place = -np.inf, 0
    for i in range(1, TRIAL_DEPTHS + 1):
        value = pull(limit * i / TRIAL_DEPTHS, series)
        if value > best:
            best, place = value, i
    root = limit * place / TRIAL_DEPTHS
    low = limit * (place - 1) / TRIAL_DEPTHS
    high = limit * min(place + 1, TRIAL_DEPTHS) / TRIAL_DEPTHS
    for _ in range(GOLDEN_STEPS):
        one, two = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        if pull(one, series) > pull(two, series):
            high = two
        else:
            low = one
    between = pull(0.5 * (low + high), series)
    return (between, 0.5 * (low + high)) if between > best else (best, root)


@kernel
def keep_harder(r: float, series: Matrix, limit: float, best: Array) -> bool:
    """Write the hardest pull at flaws at a radius, if it is harder than the best."""
    is_harder = False
    for side in range(2):
        value, root = hardest(series[side], limit)
        if value > best[VALUE]:
            best[VALUE], best[RADIUS], best[DEPTH] = value, r, DEEPEST_FLAW * root * root
            best[COSINE] = 1.0 - 2.0 * side
            is_harder = True
    return is_harder


@kernel
def try_radius(
    r: float, limit: float, friction: float, load: Load, series: Matrix, best: Array
) -> bool:
    """Write the hardest pull at flaws at a radius, if it is harder than the best."""
    stress_at_depths(series, r, friction, load)
    return keep_harder(r, series, limit, best)


@entry_point()
def tensions(radii: Vector, friction: float, load: Load, series: Cube) -> None:
    """Write the series of `stress_at_depths` for each radius."""
    for i in range(radii.size):
        stress_at_depths(series[i], radii[i], friction, load)


@entry_point()
def hardest_among(radii: Vector, series: Cube, flaw: float, best: Vector) -> None:
    """Write the hardest pull at flaws of this depth at most among radii, and where it is."""
    limit = np.sqrt(min(flaw / DEEPEST_FLAW, 1.0))
    best[VALUE] = -np.inf
    for i in range(radii.size):
        keep_harder(radii[i], series[i], limit, best)


@entry_point()
def climb_flaws(
    step: float, last: float, flaw: float, friction: float, load: Load, series: Matrix, best: Vector
) -> None:
    """Move along the radius to where the pull is hardest."""
    limit = np.sqrt(min(flaw / DEEPEST_FLAW, 1.0))
    for _ in range(MOST_STEPS):
        further = try_radius(abs(best[RADIUS] + step), limit, friction, load, series, best)
        if further or try_radius(abs(best[RADIUS] - step), limit, friction, load, series, best):
            continue
        step *= 0.5
        if step < last:
            break
