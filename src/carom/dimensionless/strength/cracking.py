"""How hard an impact pulls at flaws of the surface, and how wide the contact is that cracks it."""

from math import inf

import numpy as np

from carom.dimensionless.fields import flaws
from carom.dimensionless.fields.peaks import PEAK_COLUMNS, RADIUS, VALUE
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.strength.peaks import Contacts, Peak, Search

COARSE_STEP = 8e-3  # last one of a climb, in contact radii, but for the last climb
LEAST_PULL = 1e-12  # less is rounding
WIDTH_SETTLED = 1e-4  # relative change from one round to the next
MOST_ROUNDS = 12
WIDER, MOST_TRIALS = 1.5, 60  # from one trial width to the next


class _FlawSearch(Search):
    """A search for where and when flaws up to a depth are pulled at hardest."""

    def __init__(self, contacts: Contacts, poisson: float, flaw: float) -> None:
        super().__init__(contacts)
        self.poisson, self.flaw = poisson, flaw

    def scanned(self, time: float) -> Array:
        tensions, key = self.contacts.tensions, (self.poisson, time)
        if key not in tensions and self.contacts.size(time) > 0.0:
            tensions[key] = self._tensions(time, flaws.RADII)
        return self._hardest(time, flaws.RADII, tensions.get(key))[np.newaxis]

    def climbed(self, time: float, start: Array, step: float, last: float = COARSE_STEP) -> Array:
        best, size = self.pulled(time, start[RADIUS]), self.contacts.size(time)
        if size > 0.0:
            load, series = self.contacts.load(time, self.poisson), np.empty((2, flaws.TERMS))
            problem = self.flaw / size, self.contacts.friction, load, series
            best[VALUE] /= size**1.5
            flaws.climb_flaws(step, last, *problem, best)
            best[VALUE] *= size**1.5
        return best

    def pulled(self, time: float, radius: float) -> Array:
        """Return the hardest pull at an instant at a radius, in radii of the contact."""
        if self.contacts.size(time) == 0.0:
            return np.zeros(PEAK_COLUMNS)
        radii = np.array([radius])
        return self._hardest(time, radii, self._tensions(time, radii))

    def _tensions(self, time: float, radii: Array) -> Array:
        series = np.empty((radii.size, 2, flaws.TERMS))
        flaws.tensions(
            radii, self.contacts.friction, self.contacts.load(time, self.poisson), series
        )
        return series

    def _hardest(self, time: float, radii: Array, series: Array | None) -> Array:
        best, size = np.zeros(PEAK_COLUMNS), self.contacts.size(time)
        if series is not None:
            flaws.hardest_among(radii, series, self.flaw / size, best)
            best[VALUE] *= size**1.5
        return best


def intensity(contacts: Contacts, poisson: float, flaw: float = inf) -> Peak:
    """Return the largest stress intensity at flaws up to a depth through an impact.

    `value` is K/(p_L sqrt(pi) (R* L)^(1/4)) and z the depth of the flaw, `flaw` at most, both in
    sqrt(R* L); otherwise as `peaks`.

    >>> import carom
    >>> from carom.dimensionless.strength.cracking import intensity
    >>> from carom.dimensionless.strength.peaks import Contacts
    >>> sliding = Contacts(carom.solve(9.0, 1.44), friction=0.2)
    >>> round(intensity(sliding, 0.3, 1e-8).value / 1e-4, 3)  # 1.122 times the stress at the edge
    0.528
    """
    peak = _FlawSearch(contacts, poisson, flaw).peak()
    return peak if peak.value > LEAST_PULL else peak._replace(value=0.0)


def cracking_width(contacts: Contacts, poisson: float, flaw: float, wanted: float) -> float:
    """Return the width sqrt(R* L) of the impact whose stress intensity is as wanted.

    It solves w^(3/2) f(c/w) = `wanted`, f the value of `intensity`, since p_L grows with the width
    w: the larger K_c, the wider. Once the flaw is deeper than those that are pulled at hardest,
    w^(3/2) is K_c/f alone, which is Auerbach's law. Infinite where nothing pulls.

    `flaw` is the depth of the deepest flaws, in any unit of length, `wanted` K_c pi R*/(2 E*
    sqrt(pi)), in that unit to the power 3/2.

    >>> import carom
    >>> from carom.dimensionless.strength.cracking import cracking_width, intensity
    >>> from carom.dimensionless.strength.peaks import Contacts
    >>> contacts = Contacts(carom.solve(0.5, 1.44), friction=0.2)
    >>> width = cracking_width(contacts, 0.23, flaw=1.0, wanted=100.0)
    >>> round(width**1.5 * intensity(contacts, 0.23, 1.0 / width).value, 2)
    100.0
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
        return float(wanted - width**1.5 * search.pulled(peak.time, radius)[VALUE])

    low = high = least
    for _ in range(MOST_TRIALS):
        high *= WIDER
        if missing(high) <= 0.0:
            return float(brentq(missing, low, high, rtol=0.1 * WIDTH_SETTLED))
        low = high
    return inf
