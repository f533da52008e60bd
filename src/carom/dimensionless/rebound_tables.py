"""psi_2 as a table over psi_1, chi and e: series of psi_2/psi_1 between the regime borders.

psi_2/psi_1 is not smooth where the regime changes. So psi_1 is measured by its place, in which 0
and the three borders lie at 0, 1, 2 and 3 for every chi and e; from 3 on the contact slides
throughout and needs no table. The variables of a table are those of chi and e that have a range,
and the place. A table of one chi and e has psi_1 itself.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.viscoelastic.impacts import TOLERANCE
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.numerics import patches
from carom.dimensionless.numerics.arrays import Array, Counts, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import evaluate
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.dimensionless.numerics.patches import Patches, Samples, sections
from carom.dimensionless.rebounds import lossy_rebounds, regime_borders, solved
from carom.folder import DATA
from carom.quantities.refusals import refusal

STORED = DATA / "rebounds.npz"
STORED_CHI, STORED_E = (0.248, 4.09), (0.3, 1.0)
SMALLEST, SMALLEST_LOSSY = 1e-6, 1e-3  # psi_1: below, psi_2/psi_1 is taken as constant
FOLD = 0.5  # chi up to which all borders are 1
NARROW = 1e-7  # of a panel with losses: their kinks are too weak to be felt within


def psi_at(place: Array, chi: Array, restitution: Array) -> Array:
    """Return psi_1 of a place from 0 to 3, at borders to the bit."""
    one, turn, end = np.moveaxis(regime_borders(chi, restitution), -1, 0)
    sides = (2.0 - place) * one + (place - 1.0) * turn, (3.0 - place) * turn + (place - 2.0) * end
    return np.asarray(np.where(place <= 1.0, place, np.where(place <= 2.0, *sides)))


@kernel
def place_of(psi: float, chi: float, restitution: float) -> float:
    """Return the place of psi_1 >= 0; from 3 on the contact slides throughout."""
    width = 2.0 * chi - 1.0
    if psi < 1.0:
        return psi
    if width <= 0.0 or psi >= 2.0 * chi * (1.0 + restitution) - restitution:
        return 3.0
    beyond = psi - 2.0 * chi
    return 1.0 + (psi - 1.0) / width if beyond < 0.0 else 2.0 + beyond / (restitution * width)


@entry_point()
def fill(
    psi: Matrix,
    chi: Vector,
    restitution: Vector,
    table: Patches,
    point: Vector,
    sections: Matrix,
    kept: Counts,
    psi_out: Matrix,
) -> None:
    """Write psi_2 of rows of impacts; `sections` holds series of the leaves `kept` for a row."""
    last = table.terms.size - 1
    terms, leaves = table.terms[last], table.series.shape[0]
    for row in range(psi.shape[0]):
        if last > 0:
            point[0] = chi[row]
        if last > 1:
            point[1] = restitution[row]
        sliding = 2.0 * chi[row] * (1.0 + restitution[row])
        for column in range(psi.shape[1]):
            size = abs(psi[row, column])
            lost = sliding
            place = place_of(size, chi[row], restitution[row])
            if place < 3.0:
                point[last] = place
                leaf = patches.leaf_at(table, point)
                slot, key = leaf % kept.size, row * leaves + leaf
                if kept[slot] != key:
                    patches.contract(table, leaf, point, sections[slot])
                    kept[slot] = key
                low, high = table.corners[leaf, last, 0], table.corners[leaf, last, 1]
                ratio = evaluate(sections[slot, :terms], low, high, max(place, low))
                lost = min(sliding, size * min(2.0, max(0.0, 1.0 - ratio)))
            psi_out[row, column] = np.copysign(1.0, psi[row, column]) * (size - lost)


def psi_out(table: Patches, psi: Array, chi: Array, restitution: Array) -> Array:
    """Return psi_2 (rows, impacts) from psi_1, and chi and e of rows, within the table's range."""
    leaves, size = table.series.shape
    slots = leaves if psi.shape[1] > 1 else 1
    room = np.empty(table.terms.size), np.empty((slots, size)), np.full(slots, -1, dtype=np.int64)
    result = np.empty(psi.shape)
    chi, restitution, psi = map(np.ascontiguousarray, (chi, restitution, psi))
    fill(psi, chi, restitution, table, *room, result)
    return result


def panels(table: Patches, chi: float, restitution: float) -> tuple[Array, Array]:
    """Return panels in psi_1, (n + 1,), and series of psi_2/psi_1, (n, terms), at one chi and e."""
    places, series = sections(table, *(chi, restitution)[: table.terms.size - 1])
    if table.terms.size == 1:
        return places, series
    ends = psi_at(places, np.asarray(chi), np.asarray(restitution))
    wide = np.diff(ends) > 0.0  # for chi <= 1/2 the borders are one
    return np.append(ends[:-1][wide], ends[-1]), series[wide]


def tabulated(
    chi: tuple[float, float],
    restitution: tuple[float, float],
    tolerance: float,
    advance: Callable[[int], object],
    *,
    degrees: tuple[int, int, int] = (8, 8, 8),
    weight: Callable[[Array], Array] = np.ones_like,
    impact_tolerance: float = TOLERANCE,
    give: float = 0.0,
) -> Patches:
    """Return the table over ranges of chi and e, or one value of either, where the ends are one.

    `give` is lambda of a plate, of which e is the restitution; chi is then one value.

    The last terms of a series are below `tolerance` as errors in psi_2, which have a `weight` that
    depends on chi; `impact_tolerance` is that of viscous impacts. `advance` is called with the
    number of impacts that have been solved. Raises InputError if one cannot be solved.
    """
    ranges, elastic = (chi, restitution), restitution[0] == 1.0 or give > 0.0
    wide = [i for i, (low, high) in enumerate(ranges) if low < high]
    borders = [1.0, 2.0, 3.0] if chi[1] > FOLD else [1.0]
    if not wide:
        borders = np.unique(regime_borders(chi[0], restitution[0])).tolist()
    places = SMALLEST if elastic else SMALLEST_LOSSY, borders[-1]
    cuts = [(len(wide), borders[:-1])]
    if chi[0] < FOLD < chi[1]:
        cuts = [(0, [FOLD]), *cuts]

    def ratio(*point: Array) -> Samples:
        *some, place = (each.ravel() for each in point)
        each_chi, e = (np.full(place.size, low) for low, _ in ranges)
        for i, values in zip(wide, some, strict=True):
            (each_chi, e)[i][:] = values
        psi = psi_at(place, each_chi, e) if wide else place
        outgoing, branches = _rebounds(psi, each_chi, e, impact_tolerance, give)
        advance(psi.size)
        return Samples(outgoing / psi, psi * weight(each_chi), branches)

    return patches.fitted(
        ratio,
        [*(ranges[i] for i in wide), places],
        [*(degrees[i] for i in wide), degrees[-1]],
        tolerance,
        cuts=cuts,
        singular=1.0,
        narrowest=patches.NARROWEST if elastic else NARROW,
    )


def _rebounds(
    psi: Array, chi: Array, restitution: Array, tolerance: float, give: float
) -> tuple[Array, NDArray[np.int64]]:
    """Return psi_2 and branches, the phases; one with losses, whose kinks are weak. May raise."""
    if give > 0.0 or np.all(restitution == 1.0):
        outgoing, status, branches = solved(psi, chi, give=give)
    else:
        values, which = np.unique(restitution, return_inverse=True)
        losses = LossNumbers(Loss.VISCOUS, np.array(list(map(_viscous_loss, values)))[which])
        lossy = lossy_rebounds(psi, chi, losses, tolerance=tolerance)
        outgoing, status = lossy.psi_out, lossy.status
        branches = np.zeros(psi.size, dtype=np.int64)
    if np.any(status):
        first = int(np.flatnonzero(status)[0])
        message = Status(int(status[first])).message
        raise refusal("chi", float(chi[first]), f"its rebounds are {message}")
    return outgoing, branches


_viscous_loss = cache(viscous_loss)


@cache
def stored() -> Patches:
    """Return the table that is stored with the package, over all chi and e that are fitted.

    Its error in psi_2 is below 1e-5 for chi up to 1.75, where solid spheres are, and 5e-5 up to
    2.2. Weak losses have curves with more kinks beyond: 5e-4 up to 3, 2e-3 at 4; few impacts are
    off so much, as the root of the mean square is below 1e-5 and 1e-4.
    """
    with np.load(STORED) as arrays:
        parts = (arrays[name] for name in Patches._fields)
        return Patches(*(part.astype(f"{part.dtype.kind}8") for part in parts))


def is_whole(
    chi: float, restitution: float, edges: Array, rows: Array, terms: int, plate: bool
) -> bool:
    """Tell whether a table is that of a law: its ends, its order, no gap in psi_2 at an edge."""
    first = SMALLEST if restitution == 1.0 or plate else SMALLEST_LOSSY
    last, sliding = regime_borders(chi, restitution)[-1], 2.0 * chi * (1.0 + restitution)
    if rows.shape != (edges.size - 1, terms) or edges.ndim != 1:
        return False
    if not np.all(np.isfinite(edges)) or [edges[0], edges[-1]] != [first, last]:
        return False
    places = edges[1:]
    starts = rows @ (-1.0) ** np.arange(rows.shape[1])
    after = np.append(starts[1:], 1.0 - sliding / places[-1])
    gaps = np.abs(rows.sum(axis=1) - after) * places
    return bool(np.all(np.diff(edges) > 0.0) and np.all(gaps < 1e-8))
