"""psi_2 of many (psi_1, chi, e) at once: interpolated between curves that are solved for once."""

import numpy as np
from numpy.typing import NDArray

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


def borders(chi: Array, restitution: Array) -> Array:
    """Return |psi_1| at the ends of the panels, 0 and the kinks, along a new last axis."""
    impulse = np.maximum(chi * (1.0 + restitution), 1.0)
    zero = np.zeros_like(impulse)
    return np.stack((zero, zero + 1.0, impulse, 2.0 * impulse - 1.0), axis=-1)


def psi_out(psi: Array, chi: Array, restitution: Array) -> Array:
    """Return psi_2, odd in psi_1, of shape (batch, points); chi and e have the shape (batch,).

    Cubic interpolation of psi_2/psi_1 in the angle of Chebyshev nodes between the kinks, in log chi and in e, of
    curves that are solved for when first needed, and kept. The error is below 1e-4 for
    0.1 <= chi <= 1.75, where solid spheres are, and below 2e-2 up to 4, with its many kinks.
    """
    codes, weights = _stencils(chi, restitution)
    curves = np.einsum("bs,bsk->bk", weights, _curves(codes))
    speed, ends = np.abs(psi), borders(chi, restitution)
    slides = (2.0 * chi * (1.0 + restitution))[:, np.newaxis]
    ratio = _interpolated(curves, ends, speed)
    return np.where(speed < ends[:, -1:], psi * ratio, psi - np.copysign(slides, psi))


def regimes(psi: Array, chi: float, restitution: float) -> NDArray[np.int8]:
    """Return the place of the regime of each psi_1 in `carom.curves.REGIMES`."""
    ends = borders(np.array(chi), np.array(restitution))[1:]
    return np.searchsorted(ends, np.abs(psi), side="right").astype(np.int8)


def on_grid(chi: Array) -> Array:
    """Return the nearest chi of which a curve is kept."""
    return np.asarray(FOLD * np.exp(LOG_CHI * np.round(np.log(chi / FOLD) / LOG_CHI)))


def _interpolated(curves: Array, ends: Array, speed: Array) -> Array:
    """Return psi_2/psi_1 of curves, one a row, at |psi_1|."""
    kinks = (ends[:, i, np.newaxis] for i in range(1, PANELS))
    panel = sum((speed >= kink for kink in kinks), np.zeros(speed.shape, dtype=np.int64))
    start = np.take_along_axis(ends, panel, axis=1)
    width = np.take_along_axis(ends, panel + 1, axis=1) - start
    part = np.clip((speed - start) / np.maximum(width, 1e-12), 0.0, 1.0)
    place = np.arccos(1.0 - 2.0 * part) * ((NODES - 1) / np.pi)
    cell = np.clip(place.astype(np.int64), 1, NODES - 3)
    index = panel * NODES + cell - 1
    weights = _cubic(place - cell)
    rows = NODES * PANELS * np.arange(len(curves))[:, np.newaxis]
    values = curves.ravel()
    return sum(  # type: ignore[no-any-return]
        weights[..., j] * values.take(index + (rows + j)) for j in range(4)
    )


def _cubic(part: Array) -> Array:
    """Return the weights of the values at -1, 0, 1, 2 (Lagrange), along a new last axis."""
    below, above, far = part + 1.0, part - 1.0, part - 2.0
    return np.stack(
        (
            -part * above * far / 6.0,
            below * above * far / 2.0,
            -below * part * far / 2.0,
            below * part * above / 6.0,
        ),
        axis=-1,
    )


def _stencils(chi: Array, restitution: Array) -> tuple[Indices, Array]:
    """Return codes of the 16 curves around each (chi, e), and their weights."""
    along_chi = np.log(chi / FOLD) / LOG_CHI
    along_e = np.minimum((1.0 - restitution) / STEP_E, 1.0 / STEP_E)
    low = np.floor(along_chi).astype(np.int64) - 1
    first = np.where(along_chi >= 0.0, np.maximum(low, 0), np.minimum(low, -3))
    start = np.clip(np.floor(along_e).astype(np.int64) - 1, 0, round(1.0 / STEP_E) - 3)
    weights = (
        _cubic(along_chi - first - 1)[:, :, np.newaxis]
        * _cubic(along_e - start - 1)[:, np.newaxis, :]
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
