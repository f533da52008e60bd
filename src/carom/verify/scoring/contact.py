"""The part of a record of forces in which the bodies touch, in time since the first touch."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.pairs import Scales
from carom.dimensionless.numerics import hertz
from carom.impacts.exact import Impact
from carom.io.user_table import Mask, UserTable
from carom.quantities.arrays import Array
from carom.quantities.prefixes import text
from carom.quantities.refusals import InputError

FEWEST = 20  # rows with a force
INSTANTS, RESOLVED = 100, 1e-12  # among which the peak is looked for; of a time in d_max/V_1
SMALL = 0.1  # of the peak: what the first and last force of elastic bodies may be
FACTORS = {1e3: "m", 1e6: "u", 1e9: "n", 1e-3: "k", 1e-6: "M"}  # prefix by the factor of numbers
LIKE = 1.5  # how near a factor is to one of them
FAR = 30.0  # a ratio to Hertz's time that no law of contact explains


class Samples(NamedTuple):
    """Forces at times since the first touch, with the instants without force at either end.

    `rows` are the places in the results, -1 for an instant that was added; `touch` is the first
    touch in the time of the results, `end` the last since then.
    """

    time: Array
    normal_force: Array
    tangential_force: Array
    rows: NDArray[np.int64]
    touch: float
    end: float


def contact_samples(results: UserTable, hit: Impact) -> Samples:
    """Return the forces while the bodies touch.

    The first touch lies between the last row without force and the first with one, as long before
    as the exact impact takes to that force; so does the last.

    Raises InputError if the record has no such part, starts late, ends early, has too few rows in
    it, or is in another unit.
    """
    time, force = results["time"], results["normal_force"]
    _check_order(results)
    first, last = _ends(results)
    _check_units(time[first : last + 1], force, hit.scales)
    peak = float(force.max())
    _check_ends(results, first, last, peak, hit)
    count = last - first + 1
    if count < FEWEST:
        raise InputError(
            f"results: {count} rows have a normal force; a history needs at least {FEWEST}, "
            "record more often"
        )
    touch = float(time[first]) - _since_touch(float(force[first]), hit)
    end = float(time[last]) + _until_parting(float(force[last]), hit)
    if first > 0:
        touch = max(touch, float(time[first - 1]))
    if last + 1 < len(results):
        end = min(end, float(time[last + 1]))
    return _framed(results, first, last, touch, end)


def _since_touch(force: float, hit: Impact) -> float:
    """Return the time from the touch until the exact force has this value."""
    return _when(force, hit, 0.0)


def _until_parting(force: float, hit: Impact) -> float:
    """Return the time until the bodies part, from when the exact force has this value."""
    return hit.duration - _when(force, hit, hit.solution.duration)


def _when(force: float, hit: Impact, end: float) -> float:
    """Return when the exact force, between one end of the contact and its peak, has a value."""
    from scipy.optimize import brentq

    exact = hit.solution.history(INSTANTS)
    peak = float(exact.time[np.argmax(exact.normal_force)])

    def excess(time: float) -> float:
        return float(hit.solution.at(time).normal_force[0]) - force / hit.scales.force

    time = peak if excess(peak) <= 0.0 else brentq(excess, end, peak, xtol=RESOLVED)
    return time * hit.scales.time


def _framed(results: UserTable, first: int, last: int, touch: float, end: float) -> Samples:
    """Return the rows from first to last between an instant of touch and one of separation."""
    part = slice(first, last + 1)
    normal, tangential = (
        np.concatenate([[0.0], results[name][part], [0.0]])
        for name in ("normal_force", "tangential_force")
    )
    rows = np.concatenate([[-1], np.arange(first, last + 1), [-1]])
    time = np.concatenate([[touch], results["time"][part], [end]]) - touch
    return Samples(time, normal, tangential, rows, touch, end - touch)


def _check_order(results: UserTable) -> None:
    falls = np.concatenate([[False], np.diff(results["time"]) <= 0.0])
    results.refuse(
        "time", falls, "it must rise from row to row; sort the rows, and delete duplicates"
    )


def _ends(results: UserTable) -> tuple[int, int]:
    """Return the first and the last row of the contact."""
    force = results["normal_force"]
    touching = force > 0.0
    if touching.sum() < 0.5 * np.count_nonzero(force) or not touching.any():
        raise InputError(
            "normal_force: must be positive where the bodies press on each other; change its sign"
        )
    first, last = (int(i) for i in np.flatnonzero(touching)[[0, -1]])
    inside = np.arange(force.size)
    gaps: Mask = ~touching & (inside > first) & (inside < last)
    apart = "the bodies part and meet again; give the history of one impact"
    results.refuse("normal_force", gaps, apart)
    return first, last


def _check_ends(results: UserTable, first: int, last: int, peak: float, hit: Impact) -> None:
    """Raise InputError if the record does not start at the first touch and end at the last."""
    exact = hit.solution.history(FEWEST + 1).normal_force / hit.solution.max_force
    for place, what, soon in (
        (first, "start at the first touch", exact[1]),
        (last, "go on to the last touch", exact[-2]),
    ):
        share = float(results["normal_force"][place]) / peak
        if share > max(SMALL, soon):  # forces of viscous bodies rise steeply
            raise InputError(
                f"normal_force: the history does not {what}; in {results.one(place)} it is "
                f"{100 * share:.0f} % of the peak; record from before the touch until they part"
            )


def _check_units(time: Array, force: Array, scales: Scales) -> None:
    lasted = float(time[-1] - time[0]) / (hertz.DURATION * scales.time)
    pressed = float(force.max()) / scales.force
    for name, ratio, unit in (("time", lasted, "s"), ("normal_force", pressed, "N")):
        what = "the contact lasts" if name == "time" else "the peak is"
        for factor, prefix in FACTORS.items():
            if 1.0 / LIKE < ratio / factor < LIKE:
                raise InputError(
                    f"{name}: {what} {ratio:.4g} times Hertz's; if it is in {prefix}{unit}, "
                    f"head the column '{name} [{prefix}{unit}]'"
                )
    if len(time) > 1 and not 1.0 / FAR < lasted < FAR:
        raise InputError(
            f"time: the contact lasts {lasted:.4g} times Hertz's duration, "
            f"{text(hertz.DURATION * scales.time, 's', 4)}; is time counted in steps?"
        )
