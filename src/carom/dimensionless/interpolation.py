"""psi_2 of many (psi_1, chi, e) at once: interpolated in a table of curves that was solved for."""

from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, plain
from carom.dimensionless.rebounds import regime_borders

TABLE = "data/fit_curves.npz"  # made by studies/fit_curves.py
NODES = np.array([33, 129, 33])  # on the panels of a curve; even in arccos, for roots at the kinks
PANELS = len(NODES)
FIRST = np.concatenate(([0], np.cumsum(NODES)))  # place of the first node of a panel
FOLD = 0.5  # chi at which the borders of the regimes meet: no stencil reaches across
LOG_CHI, LOWEST, HIGHEST = 0.025, -28, 84  # spacing of curves in log(chi/FOLD), first, last
ROOT_LOSS, LOSSES = 0.05, 18  # spacing of curves in sqrt(1 - e), and their number
LEAST_CHI, MOST_CHI = (FOLD * float(np.exp(LOG_CHI * i)) for i in (LOWEST, HIGHEST))
LEAST_E = 0.3  # somewhat above the last curve
SMALLEST = 1e-4  # psi_1 that stands for 0
THROUGHOUT = PANELS  # the regime of gross slip throughout


def panel_starts(chi: Any, restitution: Any) -> Array:
    """Return |psi_1| where panels begin, along a new last axis: 0 and the borders of regimes."""
    edges = regime_borders(chi, restitution)
    return np.concatenate((np.zeros_like(edges[..., :1]), edges), axis=-1)


def psi_out(psi: Array, chi: Array, restitution: Array) -> Array:
    """Return psi_2, odd in psi_1, of shape (batch, points); chi and e have the shape (batch,).

    Cubic interpolation of psi_2/psi_1 in the angle of Chebyshev nodes between the kinks, in log chi
    and in sqrt(1 - e); psi_1 - 2 chi (1 + e) beyond the last kink. The error is below 5e-5 for chi
    from 0.5 to 1.75, where solid spheres are, and 2e-4 up to 2.2; for weak losses it grows to 2e-3
    at chi = 3 and 5e-3 at 4, where curves have more kinks, and is 3e-3 just below chi = 1/2.
    """
    curves = _blended(chi, restitution)
    result = np.empty(psi.shape)
    slide = 2.0 * chi * (1.0 + restitution)
    interpolate(curves, panel_starts(chi, restitution), slide, np.ascontiguousarray(psi), result)
    return result


def regimes(psi: Array, chi: float, restitution: float) -> NDArray[np.int8]:
    """Return the place of the regime of each psi_1 in `carom.impacts.curves.REGIMES`."""
    ends = regime_borders(chi, restitution)
    return np.searchsorted(ends, np.abs(psi), side="right").astype(np.int8)


@entry_point()
def interpolate(curves: Matrix, starts: Matrix, slide: Vector, psi: Matrix, result: Matrix) -> None:
    """Write psi_2 of all points, from the values at the nodes, a row of either for a curve."""
    for row in range(psi.shape[0]):
        for point in range(psi.shape[1]):
            speed = abs(psi[row, point])
            panel = -1
            for later in range(PANELS + 1):
                if speed >= starts[row, later]:
                    panel = later
            out = speed - slide[row]
            if panel < PANELS:
                width = starts[row, panel + 1] - starts[row, panel]
                part = (speed - starts[row, panel]) / width
                place = np.arccos(1.0 - 2.0 * part) * ((NODES[panel] - 1) / np.pi)
                cell = min(max(int(place), 1), NODES[panel] - 3)
                first = FIRST[panel] + cell - 1
                one, two, three, four = cubic(place - cell)
                near = curves[row, first : first + 4]
                out = speed * (one * near[0] + two * near[1] + three * near[2] + four * near[3])
            result[row, point] = out if psi[row, point] >= 0.0 else -out


@entry_point()
def cubic(part: float) -> tuple[float, float, float, float]:
    """Return the weights of the values at -1, 0, 1, 2 (Lagrange) for a place between 0 and 1."""
    below, above, far = part + 1.0, part - 1.0, part - 2.0
    return (
        -part * above * far / 6.0,
        below * above * far / 2.0,
        -below * part * far / 2.0,
        below * part * above / 6.0,
    )


def grid() -> tuple[Array, Array]:
    """Return chi and e of the curves of the table."""
    chi = FOLD * np.exp(LOG_CHI * np.arange(LOWEST, HIGHEST + 1))
    return np.asarray(chi), np.asarray(1.0 - (ROOT_LOSS * np.arange(LOSSES)) ** 2)


def nodes(chi: Array, restitution: float) -> Array:
    """Return psi_1 at the nodes of curves of one e, of shape (curves, nodes)."""
    starts, rows = panel_starts(chi, restitution), []
    for panel, count in enumerate(NODES):
        part = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, count))
        low, high = starts[:, panel, np.newaxis], starts[:, panel + 1, np.newaxis]
        rows.append(low + (high - low) * part)
    return np.maximum(np.concatenate(rows, axis=1), SMALLEST)


@cache
def table() -> Array:
    """Return the table, of shape (chi, e, values)."""
    with files("carom").joinpath(TABLE).open("rb") as stream, np.load(stream) as stored:
        values = stored["curves"].astype(np.float64)
    values.setflags(write=False)
    return np.asarray(values)


def _blended(chi: Array, restitution: Array) -> Array:
    """Return curves at any (chi, e), one a row, from the 16 around each."""
    along_chi = np.log(chi / FOLD) / LOG_CHI - LOWEST
    fold = -LOWEST
    low = np.floor(along_chi).astype(np.int64) - 1
    first = np.where(along_chi >= fold, np.maximum(low, fold), np.minimum(low, fold - 3))
    first = np.clip(first, 0, HIGHEST - LOWEST - 3)
    along_e = np.sqrt(np.maximum(1.0 - restitution, 0.0)) / ROOT_LOSS
    start = np.clip(np.floor(along_e).astype(np.int64) - 1, 0, LOSSES - 4)
    weights = np.einsum("bi,bj->bij", _weights(along_chi - first), _weights(along_e - start))
    steps = np.arange(4)
    rows = (first[:, np.newaxis] + steps)[:, :, np.newaxis]
    columns = (start[:, np.newaxis] + steps)[:, np.newaxis, :]
    return np.asarray(np.einsum("bij,bijk->bk", weights, table()[rows, columns]))


def _weights(place: Array) -> Array:
    """Return the weights of four values in a row for places counted from the first."""
    weights: Any = plain(cubic)  # of arrays, too
    return np.stack(weights(place - 1.0), axis=-1)
