"""Where the search for the best fit starts: the valleys of a scan over the ranges."""

from itertools import product

import numpy as np

from carom.fitting import errors
from carom.fitting.model import Model
from carom.fitting.problem import FitProblem
from carom.io.user_table import Mask
from carom.quantities.arrays import Array

STARTS = 6  # starting points that are followed to the end
FINE = {  # levels of the scan
    "friction": 25,
    "kappa": 12,
    "tangential_restitution": 9,
    "loss_time": 40,
    "yield_velocity": 40,
}


def scan(model: Model, loss: errors.RobustLoss, sigma: Array) -> Array:
    """Return a few starting points: the best of a grid over the ranges, unlike each other.

    Valleys along one parameter, the others following, come first: there may be other minima.
    """
    levels = [_levels(model, name) for name in model.free]
    grid = np.array(list(product(*levels)))
    inverse = 1.0 / np.where(model.problem.present, sigma, 1.0)
    weights = errors.Weights(inverse[:, :, np.newaxis] * np.eye(sigma.shape[1]))
    sums = np.square(model.residuals(weights, loss)(grid)).sum(axis=1)
    chosen: list[int] = []
    apart = np.array([max(np.ptp(column), 1e-9) for column in grid.T]) / 8.0
    valley = _valleys(sums.reshape([len(each) for each in levels]))
    for place in np.lexsort((sums, ~valley)):
        if all(np.any(np.abs(grid[place] - grid[other]) > apart) for other in chosen):
            chosen.append(int(place))
        if len(chosen) == STARTS:
            break
    return grid[chosen]


def _valleys(sums: Array) -> Mask:
    """Return which points of a grid, counted in one row, are least along one of its axes.

    Along an axis counts the least of all points with the same place on it.
    """
    found = np.zeros(sums.size, dtype=bool)
    places = np.arange(sums.size).reshape(sums.shape)
    for axis, count in enumerate(sums.shape):
        across = np.moveaxis(sums, axis, 0).reshape(count, -1)
        least, at = across.min(axis=1), across.argmin(axis=1)
        beside = np.concatenate([[np.inf], least, [np.inf]])
        low = (least <= beside[:-2]) & (least <= beside[2:])
        found[np.moveaxis(places, axis, 0).reshape(count, -1)[low, at[low]]] = True
    return found


def _levels(model: Model, name: str) -> Array:
    """Return the coordinates of a parameter in the scan."""
    if name == "restitution":
        return _likely_restitutions(model.problem)
    if name not in FINE:
        return np.zeros(1)
    place = model.free.index(name)
    low, high = model.bounds.low[place], model.bounds.high[place]
    if name == "friction":
        low, high = np.log(5e-3), np.log(3.0)
    return np.linspace(low, high, FINE[name] + 2)[1:-1]


def _likely_restitutions(problem: FitProblem) -> Array:
    """Return normal restitutions to start from: what was measured, or a few."""
    measured = dict(zip(problem.responses, problem.measured.T, strict=True))
    if "normal_restitution" in measured:
        found = measured["normal_restitution"]
    elif "normal_speed_out" in measured:
        found = measured["normal_speed_out"] / problem.motion.normal_speed
    else:
        return np.array([0.6, 0.8, 0.95])
    return np.clip([float(np.nanmedian(found))], 0.35, 0.999)
