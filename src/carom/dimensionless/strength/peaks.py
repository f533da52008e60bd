"""The largest stresses below a contact through a whole impact, each with its place and instant."""

from collections.abc import Sequence

import numpy as np

from carom.dimensionless.fields import peaks as instant
from carom.dimensionless.fields.peaks import MEASURES, SHEAR, TENSION, VON_MISES
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.strength.searching import LAST_STEP, Contacts, Peak, Search

__all__ = ("MEASURES", "SHEAR", "TENSION", "VON_MISES", "peaks")


class _StressSearch(Search):
    """A search for the largest value of one measure of stress in a body."""

    def __init__(self, contacts: Contacts, poisson: float, measure: int) -> None:
        super().__init__(contacts)
        self.poisson, self.measure = poisson, measure

    def scanned(self, time: float) -> Array:
        if self.contacts.size(time) == 0.0:
            return np.zeros((2, instant.FOUND))
        shallow = self.contacts.shallow(time)
        regions = instant.regions(self.contacts.at(time)[0], shallow)
        return np.array([self._best(time, places) for places in regions])

    def climbed(self, time: float, start: Array, step: float, last: float = LAST_STEP) -> Array:
        size = self.contacts.size(time)
        if size == 0.0:
            return np.zeros(instant.FOUND)
        shallow = self.contacts.shallow(time)
        place = np.array([[start[instant.RADIUS], max(start[instant.DEPTH], shallow)]])
        starts = [place]
        if place[0, 1] == shallow:  # at the surface jumps move with the front
            starts.append(instant.jumps(self.contacts.at(time)[0], shallow))
        load = self.contacts.load(time, self.poisson)
        given = self.measure, self.contacts.friction, load, shallow, np.inf
        found = [self._best(time, places) for places in starts]
        for best in found:
            best[instant.VALUE] /= size
            instant.climb(*given, step, last, best)
            best[instant.VALUE] *= size
        return max(found, key=lambda best: best[instant.VALUE])

    def _best(self, time: float, places: Array) -> Array:
        best, load = np.zeros(instant.FOUND), self.contacts.load(time, self.poisson)
        instant.scan(self.measure, places, self.contacts.friction, load, best)
        best[instant.VALUE] *= self.contacts.size(time)
        return best


def peaks(
    contacts: Contacts, poisson: float, measures: Sequence[int] = MEASURES
) -> tuple[Peak, ...]:
    """Return the largest von Mises, shear and tensile stress in the second body through an impact.

    Places and instants are scanned, then refined. Dense scans find nothing that is larger by 1e-4
    (`tests/invariants/test_peaks.py`). Of viscous bodies the stress is infinite at the edge while
    they are loaded, and at the first touch: the depth of `contacts` keeps the search away.

    Parameters
    ----------
    contacts : Contacts
        Those of an impact, and its friction.
    poisson : float
        Poisson's ratio of the body.
    measures : sequence of int, optional
        Some of VON_MISES, SHEAR, TENSION.

    Returns
    -------
    tuple of Peak
        For each measure `value` in p_L, x, y, z in sqrt(R* L), time in d_max/V_1.

    Examples
    --------
    >>> import carom
    >>> from carom.dimensionless.strength.peaks import Contacts, peaks
    >>> mises, shear, tension = peaks(Contacts(carom.solve(0.5, 1.44), friction=0.2), 0.3)
    >>> round(mises.value, 4), round(mises.z, 2)
    (0.6214, 0.48)
    """
    known = contacts.peaks
    for each in measures:
        if (poisson, each) not in known:
            found = _StressSearch(contacts, poisson, each).peak()
            known[poisson, each] = found._replace(value=max(found.value, 0.0))
    return tuple(known[poisson, each] for each in measures)
