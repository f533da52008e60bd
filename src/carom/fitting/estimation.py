"""The best fit: descents from a few starts, errors from the scatter, and lmfit at the end."""

from typing import Any, NamedTuple

import numpy as np

from carom.fitting import errors
from carom.fitting.best import Best, information, normalization
from carom.fitting.least_squares import descend
from carom.fitting.model import Model
from carom.fitting.starts import scan
from carom.io.extras import extra
from carom.io.user_table import Mask
from carom.quantities.arrays import Array

TURNS = 8  # times that errors are estimated and the fit is made anew
FOLLOWED = 3  # minima that are followed with errors of their own
HOPELESS = 20.0  # of -2 log likelihood behind the best, after two turns
SAME = 0.02  # of a coordinate between ends of descents that are one minimum


class _Settling(NamedTuple):
    """Coordinates, the errors there, and what the data say against them: -2 log likelihood."""

    at: Array
    loss: errors.RobustLoss
    sigma: Array
    scale: Array
    against: float


def estimate(model: Model, loss: errors.RobustLoss, start: Array | None = None) -> Best:
    """Return the best fit of a model, from starting points or, without them, those of a scan.

    Errors of responses that have none come from the scatter. From there each minimum is followed by
    itself, with errors of its own: the likeliest is the best.
    """
    problem = model.problem
    unknown = problem.present & ~np.isfinite(problem.errors)
    estimated = np.asarray(unknown.any(axis=0))
    sigma = np.where(unknown, errors.first_errors(problem), errors.usable_errors(problem))
    minima = rough_minima(model, loss, start)
    begun = [_followed(model, loss, each, sigma, estimated, 2) for each in minima[:FOLLOWED]]
    least = min(each.against for each in begun)
    followed = [
        _followed(model, each.loss, each.at, each.sigma, estimated, TURNS)
        for each in begun
        if each.against <= least + HOPELESS
    ]
    found = min(followed, key=lambda each: each.against)
    others = [each.at for each in (*followed, *begun) if each is not found]
    return fitted(
        model,
        found.loss,
        found.at,
        found.sigma,
        found.scale,
        np.array([*others, *minima[FOLLOWED:]]),
    )


def rough_minima(model: Model, loss: errors.RobustLoss, start: Array | None = None) -> Array:
    """Return minima with wide errors, the lowest first, from starting points or those of a scan."""
    problem = model.problem
    rough = errors.first_errors(problem)
    wide = np.fmax(errors.usable_errors(problem), rough)
    at = scan(model, loss, wide) if start is None else start
    weights = model.weights(at[0], wide, np.ones(len(problem.responses)))
    first = descend(model.residuals(weights, loss), at, model.bounds)
    return distinct(first.at[np.argsort(first.sums)])


def fitted(
    model: Model,
    loss: errors.RobustLoss,
    at: Array,
    sigma: Array,
    scale: Array,
    others: Array | None = None,
) -> Best:
    """Return the best fit from a point on, with these errors."""
    unknown = model.problem.present & ~np.isfinite(model.problem.errors)
    weights = model.weights(at, sigma, scale)
    best, result = polished(model, weights, loss, at)
    total = float(np.square(model.residuals(weights, loss)(best[np.newaxis])).sum())
    elsewhere = np.empty((0, len(at))) if others is None or not len(others) else others
    return Best(
        model,
        best,
        total,
        weights,
        loss,
        sigma,
        scale,
        np.asarray(unknown.any(axis=0)),
        elsewhere,
        result,
    )


def distinct(points: Array) -> Array:
    """Return the points that are not, but for rounding, one of those before."""
    kept: list[Array] = []
    for point in points:
        if all(np.abs(point - other).max(initial=0.0) > SAME for other in kept):
            kept.append(point)
    return np.array(kept)


def _followed(
    model: Model, loss: errors.RobustLoss, at: Array, sigma: Array, estimated: Mask, turns: int
) -> _Settling:
    """Estimate the errors from the scatter and descend, in turns."""
    problem, scale = model.problem, np.ones(len(estimated))
    for turn in range(turns):
        weights, before = model.weights(at, sigma, scale), (sigma, scale)
        expected = model.expected(at[np.newaxis])
        residuals = weights.whitened(problem, expected)[0]
        if not loss.is_square:
            loss = errors.likeliest(residuals[problem.present])
        used = information(model, at, weights, loss).used
        found = errors.scattered(problem, residuals * sigma, expected[0], used, loss)
        factors = scale * errors.scatter(residuals, problem.present, used, loss)
        given = np.where(estimated, 1.0, np.maximum(factors, 1.0))
        common = scale * errors.typical_deviation(residuals, problem.present)
        scale = np.where(errors.too_small(problem.present, given, common), given, 1.0)
        sigma = np.where(estimated, found, sigma)
        lowest = descend(
            model.residuals(model.weights(at, sigma, scale), loss), at[np.newaxis], model.bounds
        )
        at = lowest.at[0]
        if turn and all(
            np.nanmax(np.abs(now / then - 1.0)) < 1e-3
            for now, then in zip((sigma, scale), before, strict=True)
        ):
            break
    weights = model.weights(at, sigma, scale)
    total = float(np.square(model.residuals(weights, loss)(at[np.newaxis])).sum())
    return _Settling(at, loss, sigma, scale, total + normalization(model, weights, loss))


def polished(
    model: Model, weights: errors.Weights, loss: errors.RobustLoss, at: Array
) -> tuple[Array, Any]:
    """Return the minimum that lmfit finds from here, and its result.

    It needs as many values as parameters; with fewer, or with none free, the point stays.
    """
    lmfit = extra("lmfit", "fit", "fit")
    if not 0 < len(at) <= model.problem.count:
        return at, None
    parameters = lmfit.Parameters()
    for name, value, low, high in zip(model.free, at, *model.bounds, strict=True):
        parameters.add(name, value=float(value), min=float(low), max=float(high))
    residuals = model.residuals(weights, loss)
    present = model.problem.present.ravel()

    def of(given: Any) -> Array:
        at = np.array([list(given.valuesdict().values())])
        return np.asarray(residuals(at)[0][present])

    result = lmfit.minimize(of, parameters, method="leastsq", xtol=1e-9, ftol=1e-10)
    found = np.array(list(result.params.valuesdict().values()))
    before, after = np.square(of(parameters)).sum(), np.square(residuals(found[None])).sum()
    return (found if after <= before else at), result
