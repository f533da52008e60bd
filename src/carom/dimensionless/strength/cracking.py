"""How hard an impact pulls at flaws of the surface, and how wide the contact is that cracks it.

Flaws are shallow cracks that go straight down. A crack stands across the direction from the centre,
and is long against its depth c. With the weight function of an edge crack (Tada, Paris & Irwin
2000, section 8), which is within 0.3 %, K = 2 sqrt(c/pi) integral of (1.3 - 0.3 u^(5/4)) sigma(c u)
/sqrt(1 - u^2) du over 0 < u < 1. Shallow cracks are short and deep ones leave the tension behind,
so that those between are pulled at most.
"""

from math import inf

import numpy as np

from carom.dimensionless.fields import peaks as at
from carom.dimensionless.fields.subsurface import C_RR, NEGLIGIBLE, P_RR, Load, stress_parts
from carom.dimensionless.numerics.arrays import Array, Cube, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import evaluate, nodes, transform
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.dimensionless.strength.peaks import Contacts, Peak, Search

DEEPEST_FLAW = 0.25  # in contact radii: deeper, nothing pulls harder
TERMS = 16  # of the stress over the root of the depth, in which it is smooth beside the edge
ROOTS = 0.5 + 0.5 * nodes(TERMS)
TO_SERIES = transform(TERMS)
TRIAL_DEPTHS = 10  # evenly spaced by their roots
GOLDEN_STEPS = 8  # by which the depth that is pulled at hardest is found between two of them
RADII = np.array([1.0, 1.03, 1.1])  # of the scan, in contact radii
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(10)
_PARTS = 0.5 + 0.5 * _NODES
_DEPTHS = np.sin(0.5 * np.pi * _PARTS**2)
PLACES = np.sqrt(_DEPTHS)  # of the integral, as roots of the depth over that of the crack
SHARES = _WEIGHTS * _PARTS * (1.3 - 0.3 * _DEPTHS**1.25)

COARSE_STEP = 8e-3  # last one of a climb, in contact radii, but for the last climb
LEAST_PULL = 1e-12  # less is rounding
WIDTH_SETTLED = 1e-4  # relative change from one round to the next
MOST_ROUNDS = 12
WIDER, MOST_TRIALS = 1.5, 60  # from one trial width to the next


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
        one, two = high - at.GOLDEN * (high - low), low + at.GOLDEN * (high - low)
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
        if value > best[at.VALUE]:
            best[at.VALUE], best[at.RADIUS], best[at.DEPTH] = value, r, DEEPEST_FLAW * root * root
            best[at.COSINE] = 1.0 - 2.0 * side
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
    best[at.VALUE] = -np.inf
    for i in range(radii.size):
        keep_harder(radii[i], series[i], limit, best)


@entry_point()
def climb_flaws(
    step: float, last: float, flaw: float, friction: float, load: Load, series: Matrix, best: Vector
) -> None:
    """Move along the radius to where the pull is hardest."""
    limit = np.sqrt(min(flaw / DEEPEST_FLAW, 1.0))
    for _ in range(at.MOST_STEPS):
        further = try_radius(abs(best[at.RADIUS] + step), limit, friction, load, series, best)
        if further or try_radius(abs(best[at.RADIUS] - step), limit, friction, load, series, best):
            continue
        step *= 0.5
        if step < last:
            break


class _FlawSearch(Search):
    """A search for where and when flaws up to a depth are pulled at hardest."""

    def __init__(self, contacts: Contacts, poisson: float, flaw: float) -> None:
        super().__init__(contacts)
        self.poisson, self.flaw = poisson, flaw

    def scanned(self, time: float) -> Array:
        tensions, key = self.contacts.tensions, (self.poisson, time)
        if key not in tensions and self.contacts.size(time) > 0.0:
            tensions[key] = self._tensions(time, RADII)
        return self._hardest(time, RADII, tensions.get(key))[np.newaxis]

    def climbed(self, time: float, start: Array, step: float, last: float = COARSE_STEP) -> Array:
        best, size = self.pulled(time, start[at.RADIUS]), self.contacts.size(time)
        if size > 0.0:
            load, series = self.contacts.load(time, self.poisson), np.empty((2, TERMS))
            problem = self.flaw / size, self.contacts.friction, load, series
            best[at.VALUE] /= size**1.5
            climb_flaws(step, last, *problem, best)
            best[at.VALUE] *= size**1.5
        return best

    def pulled(self, time: float, radius: float) -> Array:
        """Return the hardest pull at an instant at a radius, in radii of the contact."""
        if self.contacts.size(time) == 0.0:
            return np.zeros(at.PEAK_COLUMNS)
        radii = np.array([radius])
        return self._hardest(time, radii, self._tensions(time, radii))

    def _tensions(self, time: float, radii: Array) -> Array:
        series = np.empty((radii.size, 2, TERMS))
        tensions(radii, self.contacts.friction, self.contacts.load(time, self.poisson), series)
        return series

    def _hardest(self, time: float, radii: Array, series: Array | None) -> Array:
        best, size = np.zeros(at.PEAK_COLUMNS), self.contacts.size(time)
        if series is not None:
            hardest_among(radii, series, self.flaw / size, best)
            best[at.VALUE] *= size**1.5
        return best


def intensity(contacts: Contacts, poisson: float, flaw: float = inf) -> Peak:
    """Return the largest stress intensity at flaws up to a depth through an impact.

    `value` is K/(p_L sqrt(pi) (R* L)^(1/4)) and z the depth of the flaw, `flaw` at most, both in
    sqrt(R* L); otherwise as `peaks`.
    """
    peak = _FlawSearch(contacts, poisson, flaw).peak()
    value = peak.value if peak.value > LEAST_PULL else 0.0
    return peak._replace(value=value, z=min(peak.z, flaw))


def cracking_width(contacts: Contacts, poisson: float, flaw: float, wanted: float) -> float:
    """Return the width sqrt(R* L) of the impact whose stress intensity is as wanted.

    It solves w^(3/2) f(c/w) = `wanted`, f the value of `intensity`, since p_L grows with the width
    w: the larger K_c, the wider. Once the flaw is deeper than those that are pulled at hardest,
    w^(3/2) is K_c/f alone, which is Auerbach's law. Infinite where nothing pulls.

    `flaw` is the depth of the deepest flaws, in any unit of length, `wanted` K_c pi R*/(2 E*
    sqrt(pi)), in that unit to the power 3/2.
    """
    peak = intensity(contacts, poisson)
    if peak.value <= 0.0:
        return inf
    least = width = float((wanted / peak.value) ** (2.0 / 3.0))  # if no flaw is missing
    if flaw >= peak.z * width:
        return width
    for _ in range(MOST_ROUNDS):
        before, width = width, _width_there(contacts, poisson, flaw, wanted, peak, least)
        if abs(width - before) <= WIDTH_SETTLED * width:
            break
        peak = intensity(contacts, poisson, flaw / width)
    return width


def _width_there(
    contacts: Contacts, poisson: float, flaw: float, wanted: float, peak: Peak, least: float
) -> float:
    """Return the width from which flaws are pulled at as wanted at a place and an instant."""
    from scipy.optimize import brentq

    radius = abs(peak.x) / contacts.size(peak.time)

    def missing(width: float) -> float:
        search = _FlawSearch(contacts, poisson, flaw / width)
        return float(wanted - width**1.5 * search.pulled(peak.time, radius)[at.VALUE])

    low = high = least
    for _ in range(MOST_TRIALS):
        high *= WIDER
        if missing(high) <= 0.0:
            return float(brentq(missing, low, high, rtol=0.1 * WIDTH_SETTLED))
        low = high
    return inf
