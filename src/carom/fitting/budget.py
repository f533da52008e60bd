"""Which measured quantity costs how much of the uncertainty of each parameter."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from carom.fitting.estimation import Best
from carom.quantities.arrays import Array

ELSEWHERE = "the other data"
NEAR_ZERO = 1e-6  # of a residual, below which its root loss is taken to be linear


@dataclass(frozen=True, eq=False)
class Budget:
    """`shares`, of shape (quantities, parameters): parts of the variance of each parameter."""

    quantities: tuple[str, ...]
    parameters: tuple[str, ...]
    shares: Array


def budget(best: Best) -> Budget:
    """Return the parts that the errors of each column have in the variances of a fit.

    To first order an error v of a row, in the unit of the responses, moves the coordinates by
    C S^T D W v: W makes residuals independent, D is the slope of the root of the loss, S that of
    the roots over the coordinates, and C = (S^T S)^-1. The covariance of a row is the sum of v v^T
    over the columns (`Model.weights`), so that the parts are those of a sum of squares. Readings
    that are after one bounce and before the next are one quantity.
    """
    if best.weights.across is not None:
        whole = np.ones((1, len(best.model.free)))
        return Budget(best.model.problem.responses, best.model.free, whole)
    r = np.where(np.abs(best.residuals) > NEAR_ZERO, best.residuals, NEAR_ZERO)
    slope = best.loss.influence(r) / best.loss.root(r)  # of the root, least for outliers
    gain = best.information.slopes @ best.information.covariance
    names, squares = [], []
    for name, errors in _errors_by_column(best):
        whitened = slope * np.einsum("rij,rj->ri", best.weights.factors, errors)
        names.append(name)
        squares.append(np.square(np.einsum("rj,rjp->rp", whitened, gain)).sum(axis=0))
    if best.elsewhere is not None:
        names.append(ELSEWHERE)
        squares.append(np.square(best.elsewhere @ best.information.covariance).sum(axis=0))
    parts = np.reshape(squares, (len(names), len(best.model.free)))
    return Budget(tuple(names), best.model.free, parts / parts.sum(axis=0))


def _errors_by_column(best: Best) -> Iterator[tuple[str, Array]]:
    """Yield each uncertain column, and what one standard deviation of it does to the responses."""
    problem, at = best.model.problem, best.at[np.newaxis]
    for name, (up, down) in zip(problem.before_errors, problem.shaken, strict=True):
        change = 0.5 * (best.model.expected(at, up)[0] - best.model.expected(at, down)[0])
        yield name, np.where(problem.present, best.scale * change, 0.0)
    for place, name in enumerate(problem.responses):
        own = np.zeros(problem.measured.shape)
        own[:, place] = np.where(problem.present, best.scale * best.sigma, 0.0)[:, place]
        yield name, own
