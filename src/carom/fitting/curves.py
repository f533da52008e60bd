"""psi_2 of many (psi_1, chi, e) at once: interpolated between curves that are solved for once."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless._jit import kernel
from carom.dimensionless.rebounds import solved

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

PANELS, NODES = 3, 29  # of a curve, between its kinks; even in arccos, for roots at the kinks
LOG_CHI, STEP_E = 0.04, 0.05  # spacing of the curves
FOLD = 0.5  # chi at which the borders of the regimes meet: no stencil reaches across
SMALLEST = 1e-6  # psi_1 that stands for zero, where psi_2/psi_1 has a limit
CODES = 64  # more than there are curves along e
THROUGHOUT = PANELS  # the last regime: gross slip throughout

_KEPT: dict[int, Array] = {}


def solved_curve(psi: Array, chi: Array, restitution: Array) -> Array:
    """Return psi_2 point by point, solved for."""
    return solved(psi, 0.5 * chi * (1.0 + restitution))[0]


def borders(chi: Any, restitution: Any) -> Array:
    """Return |psi_1| at the ends of the panels, 0 and the kinks, along a new last axis."""
    impulse = np.maximum(chi * (1.0 + restitution), 1.0)
    zero = np.zeros_like(impulse)
    return np.stack((zero, zero + 1.0, impulse, 2.0 * impulse - 1.0), axis=-1)


def psi_out(psi: Array, chi: Array, restitution: Array) -> Array:
    """Return psi_2, odd in psi_1, of shape (batch, points); chi and e have the shape (batch,).

    Cubic interpolation of psi_2/psi_1 in the angle of Chebyshev nodes between the kinks, in log chi
    and in e, between curves that are solved for when first needed, and kept. The error is below
    1e-4 for 0.1 <= chi <= 1.7, and below 1e-2 up to 4, where psi_2 has more kinks.
    """
    codes, weights = _stencils(chi, restitution)
    curves = np.einsum("bs,bsk->bk", weights, _curves(codes))
    result = np.empty(psi.shape)
    slide = 2.0 * chi * (1.0 + restitution)
    interpolate(curves, borders(chi, restitution), slide, np.ascontiguousarray(psi), result)
    return result


def regimes(psi: Array, chi: float, restitution: float) -> NDArray[np.int8]:
    """Return the place of the regime of each psi_1 in `carom.curves.REGIMES`."""
    ends = borders(chi, restitution)[1:]
    return np.searchsorted(ends, np.abs(psi), side="right").astype(np.int8)


def on_grid(chi: Array) -> Array:
    """Return the nearest chi of which a curve is kept."""
    return np.asarray(FOLD * np.exp(LOG_CHI * np.round(np.log(chi / FOLD) / LOG_CHI)))


@kernel
def interpolate(curves: Array, ends: Array, slide: Array, psi: Array, result: Array) -> None:
    """Write psi_2 of all points, from psi_2/psi_1 at the nodes, a row of either for a curve."""
    for row in range(psi.shape[0]):
        for point in range(psi.shape[1]):
            speed = abs(psi[row, point])
            if speed >= ends[row, PANELS]:
                result[row, point] = psi[row, point] - np.copysign(slide[row], psi[row, point])
                continue
            panel = 0
            for later in range(1, PANELS):
                if speed >= ends[row, later]:
                    panel = later
            start = ends[row, panel]
            part = (speed - start) / (ends[row, panel + 1] - start)
            place = np.arccos(1.0 - 2.0 * part) * ((NODES - 1) / np.pi)
            cell = min(max(int(place), 1), NODES - 3)
            first = panel * NODES + cell - 1
            one, two, three, four = cubic(place - cell)
            near = curves[row, first : first + 4]
            ratio = one * near[0] + two * near[1] + three * near[2] + four * near[3]
            result[row, point] = psi[row, point] * ratio


@kernel
def cubic(part: float) -> tuple[float, float, float, float]:
    """Return the weights of the values at -1, 0, 1, 2 (Lagrange) for a place between 0 and 1."""
    below, above, far = part + 1.0, part - 1.0, part - 2.0
    return (
        -part * above * far / 6.0,
        below * above * far / 2.0,
        -below * part * far / 2.0,
        below * part * above / 6.0,
    )


def _weights(part: Any) -> Array:
    return np.stack(cubic.py_func(part), axis=-1)  # type: ignore[attr-defined]


def _stencils(chi: Array, restitution: Array) -> tuple[Indices, Array]:
    """Return codes of the 16 curves around each (chi, e), and their weights."""
    along_chi = np.log(chi / FOLD) / LOG_CHI
    along_e = np.minimum((1.0 - restitution) / STEP_E, 1.0 / STEP_E)
    low = np.floor(along_chi).astype(np.int64) - 1
    first = np.where(along_chi >= 0.0, np.maximum(low, 0), np.minimum(low, -3))
    start = np.clip(np.floor(along_e).astype(np.int64) - 1, 0, round(1.0 / STEP_E) - 3)
    weights = (
        _weights(along_chi - first - 1)[:, :, np.newaxis]
        * _weights(along_e - start - 1)[:, np.newaxis, :]
    )
    steps = np.arange(4)
    codes = (CODES * (first[:, np.newaxis] + steps))[:, :, np.newaxis] + (
        start[:, np.newaxis] + steps
    )[:, np.newaxis, :]
    flat, codes = weights.reshape(-1, 16), codes.reshape(-1, 16)
    main = np.take_along_axis(codes, np.argmax(np.abs(flat), axis=1)[:, np.newaxis], axis=1)
    needed = np.abs(flat) > 1e-9
    return np.where(needed, codes, main), np.where(needed, flat, 0.0)


def _curves(codes: Indices) -> Array:
    """Return the curves of these codes, shape (batch, 16, nodes), solving for those not kept."""
    unique, places = np.unique(codes, return_inverse=True)
    missing = np.array([code for code in unique.tolist() if code not in _KEPT], dtype=np.int64)
    if missing.size:
        _KEPT.update(zip(missing.tolist(), _new_curves(missing), strict=True))
    table = np.stack([_KEPT[code] for code in unique.tolist()])
    return table[places.reshape(codes.shape)]


def _new_curves(codes: Indices) -> Array:
    chi = FOLD * np.exp(LOG_CHI * (codes // CODES))
    restitution = 1.0 - STEP_E * (codes % CODES)
    ends = borders(chi, restitution)[:, :, np.newaxis]
    part = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, NODES))
    psi = np.maximum(ends[:, :-1] + (ends[:, 1:] - ends[:, :-1]) * part, SMALLEST)
    shape = psi.shape
    chis, es = (np.broadcast_to(x[:, np.newaxis, np.newaxis], shape) for x in (chi, restitution))
    found = solved_curve(psi.ravel(), chis.ravel(), es.ravel())
    return (found / psi.ravel()).reshape(len(codes), PANELS * NODES)
