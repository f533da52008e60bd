"""The best fit: a scan, descents, errors from the scatter, lmfit; what the values tell."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
from scipy.special import ndtri, stdtrit

from carom.io.cells import Mask
from carom.io.extras import extra
from carom.lab.fitting import plates, problem as errors
from carom.lab.fitting.least_squares import DIFFERENCE_STEP, Minimum, descend, jacobian
from carom.lab.fitting.model import Model, Parameter
from carom.lab.fitting.problem import FitProblem, Weights
from carom.quantities.arrays import Array

WEAK = 0.3  # standard deviations by which a coordinate changes the values, too few to tell


@dataclass(frozen=True, eq=False)
class Information:
    """Derivatives of residuals, of shape (rows, responses, parameters), in standard deviations.

    `elsewhere`, of shape (values, parameters), are those of other data with the same parameters.
    """

    slopes: Array
    elsewhere: Array | None = None

    @property
    def all_slopes(self) -> Array:
        """The derivatives of all values, of shape (values, parameters)."""
        own = np.concatenate(self.slopes)  # also where there are no parameters
        return own if self.elsewhere is None else np.concatenate([own, self.elsewhere])

    @cached_property
    def matrix(self) -> Array:
        """Fisher's information, of shape (parameters, parameters)."""
        return np.asarray(self.all_slopes.T @ self.all_slopes)

    @cached_property
    def covariance(self) -> Array:
        """Covariance of the coordinates; one that is not told is uncertain by 1/WEAK."""
        sizes, directions = np.linalg.eigh(self.matrix)
        certain = np.maximum(sizes, 0.0) + WEAK**2 * 1e-2
        return np.asarray((directions / certain) @ directions.T)

    @property
    def correlations(self) -> Array:
        """Correlations of the coordinates: of the parameters, too, as these grow with them."""
        deviations = np.sqrt(np.diag(self.covariance))
        ratios = self.covariance / np.outer(deviations, deviations)
        return np.asarray(np.clip(ratios, -1.0, 1.0))

    @property
    def used(self) -> Array:
        """How many of the parameters each response determines."""
        return np.asarray(np.einsum("rjp,pq,rjq->j", self.slopes, self.covariance, self.slopes))

    def shares(self, sums: Array) -> Array:
        """Return variances of sums of coordinates from each response, (sums, responses)."""
        gains = np.einsum("pq,rjq->prj", sums @ self.covariance, self.slopes)
        return np.asarray(np.square(gains).sum(axis=1))


@dataclass(frozen=True, eq=False)
class Best:
    """A model at coordinates, the best ones after a fit, with the loss and errors that count there.

    `scale` tells by how much errors that were given had to be made larger, `others` where descents
    from other starts ended, `result` what lmfit returns, `elsewhere` what other data tell.
    """

    model: Model
    at: Array
    weights: Weights
    loss: errors.RobustLoss
    sigma: Array
    scale: Array
    others: tuple[Array, ...] = ()
    result: Any = None
    elsewhere: Array | None = None

    @property
    def values(self) -> dict[str, float]:
        """Values of all parameters."""
        return self.model.values_at(self.at)

    @property
    def estimated(self) -> Mask:
        """Of which responses the errors come from the scatter."""
        return np.asarray(self.model.problem.unknown.any(axis=0))

    @cached_property
    def expected(self) -> Array:
        """The responses that the fit gives, of shape (rows, responses)."""
        return np.asarray(self.model.expected(self.at[np.newaxis])[0])

    @property
    def residuals(self) -> Array:
        """Residuals in standard deviations, of shape (rows, responses), 0 where not measured."""
        return np.asarray(self.weights.whitened(self.model.problem, self.expected[np.newaxis])[0])

    def roots(self, at: Array) -> Array:
        """Return what has the loss as its sum of squares, of shape (batch, values)."""
        roots = self.loss.root(self.weights.whitened(self.model.problem, self.model.expected(at)))
        return roots.reshape(len(at), self.model.problem.measured.size)

    @cached_property
    def sum(self) -> float:
        """The loss."""
        return float(np.square(self.loss.root(self.residuals)).sum())

    @property
    def deviance(self) -> float:
        """-2 log likelihood."""
        problem = self.model.problem
        return self.sum + self.weights.sizes(problem.present) + problem.count * self.loss.size

    def descended(self, starts: Array, movable: Mask | None = None) -> Minimum:
        """Return minima of the loss from a batch of starting points."""
        return descend(self.roots, starts, self.model.bounds, movable)

    @cached_property
    def rivals(self) -> Minimum:
        """Minima found from other starts."""
        return self.descended(np.reshape(self.others, (len(self.others), len(self.at))))

    @cached_property
    def information(self) -> Information:
        """What the values tell of the free parameters."""
        base = self.loss.root(self.residuals).reshape(1, -1)
        slopes = jacobian(self.roots, self.at[np.newaxis], base, self.model.bounds)[0]
        return Information(slopes.reshape(*self.residuals.shape, -1), self.elsewhere)

    def rises(self, confidence: float) -> Array:
        """Return by how much the loss rises to the ends of the interval of each parameter.

        In units of chi squared: the square of Student's t, a quantile of F(1, freedom); or of chi
        squared if that is infinite.
        """
        level = 0.5 + 0.5 * confidence
        freedom, caution = self.reliability(np.eye(len(self.at)))
        bounded = np.where(np.isfinite(freedom), freedom, 1.0)
        t = np.where(np.isfinite(freedom), stdtrit(bounded, level), ndtri(level))
        return np.asarray(self.spread * (caution * t**2))

    def reliability(self, sums: Array) -> tuple[Array, Array]:
        """Return how well variances of sums are known, these of shape (sums, parameters).

        Degrees of freedom 1/sum(p^2/nu) over responses, p the part of each in a variance (Welch &
        Satterthwaite 1946-47); and what weights from the scatter, uncertain themselves, add to a
        variance: 1 + 4 sum p (1 - p)/nu (Meier 1953).
        """
        shares, doubts = self.information.shares(sums), self._doubts
        parts = shares / np.maximum(shares.sum(axis=1, keepdims=True), 1e-300)
        with np.errstate(divide="ignore"):
            freedom = 1.0 / (parts**2 * doubts).sum(axis=1)
        return freedom, 1.0 + 4.0 * (parts * (1.0 - parts) * doubts).sum(axis=1)

    @property
    def _doubts(self) -> Array:
        """One over the degrees of freedom of errors from the scatter, 0 where they are known."""
        problem = self.model.problem
        own = np.maximum(problem.present.sum(axis=0) - self.information.used, 1.0)
        uncertain = self.estimated | (self.scale > 1.0)
        return np.asarray(1.0 / np.where(uncertain, own, problem.error_freedom))

    @property
    def spread(self) -> float:
        """What the loss rises by, in units of chi squared, where a parameter is one sigma off.

        E[influence^2]/E[slope] (Huber 1981, section 7.6), 1 for squares: that of normal errors, or
        more where those found say so.
        """
        if self.loss.is_square:
            return 1.0
        deviations = self.residuals[self.model.problem.present]
        used = float(self.information.used.sum())

        def ratio(mean: Callable[[Callable[[Array], Array]], float]) -> float:
            return mean(lambda r: self.loss.influence(r) ** 2) / mean(self.loss.slope)

        normal = ratio(lambda f: errors.gaussian_mean(f(errors.NORMAL)))
        return max(normal, ratio(lambda f: errors.mean_over(deviations, f, used)))


def weighed(model: Model, loss: errors.RobustLoss, at: Array, sigma: Array, scale: Array) -> Best:
    """Return a model at coordinates with the weights that it has there."""
    return Best(model, at, model.weights(at, sigma, scale), loss, sigma, scale)


STARTS = 6  # starting points that are followed to the end
LIKELY_FRICTION = np.log([5e-3, 3.0])  # range of the scan
TURNS = 8  # times that errors are estimated and the fit is made anew
FOLLOWED = 3  # minima that are followed with errors of their own
HOPELESS = 20.0  # of -2 log likelihood behind the best, after two turns
MOST_SOLVED = 300  # times that all rows are solved, where parameters act only together
SAME = 0.02  # of a coordinate between ends of descents that are one minimum


def estimate(model: Model, loss: errors.RobustLoss, start: Array | None = None) -> Best:
    """Return the best fit of a model, from starting points or, without them, those of a scan.

    Errors of responses that have none come from the scatter. From there each minimum is followed by
    itself, with errors of its own: the likeliest is the best.
    """
    problem = model.problem
    first, given = errors.first_errors(problem), errors.usable_errors(problem)
    sigma, minima = np.where(problem.unknown, first, given), rough_minima(model, loss, start)
    begun = [_followed(model, loss, each, sigma, 2) for each in minima[:FOLLOWED]]
    least = min(each.deviance for each in begun)
    followed = [
        _followed(model, each.loss, each.at, each.sigma, TURNS)
        for each in begun
        if each.deviance <= least + HOPELESS
    ]
    best = min(followed, key=lambda each: each.deviance)
    others = (each.at for each in (*followed, *begun) if each is not best)
    return replace(polished(best), others=(*others, *minima[FOLLOWED:]))


def rough_minima(model: Model, loss: errors.RobustLoss, start: Array | None = None) -> Array:
    """Return minima with wide errors, the lowest first, from starting points or those of a scan."""
    problem = model.problem
    rough = errors.first_errors(problem)
    wide = np.fmax(errors.usable_errors(problem), rough)
    at = scan(model, loss, wide) if start is None else start
    first = weighed(model, loss, at[0], wide, np.ones(len(problem.responses))).descended(at)
    return distinct(first.at[np.argsort(first.sums)])


def distinct(points: Array) -> Array:
    """Return the points that are not, but for rounding, one of those before."""
    kept: list[Array] = []
    for point in points:
        if all(np.abs(point - other).max(initial=0.0) > SAME for other in kept):
            kept.append(point)
    return np.array(kept)


def _followed(model: Model, loss: errors.RobustLoss, at: Array, sigma: Array, turns: int) -> Best:
    """Estimate the errors from the scatter and descend, in turns."""
    best = weighed(model, loss, at, sigma, np.ones(sigma.shape[1]))
    for turn in range(turns):
        now = _with_errors(best)
        at = now.descended(best.at[np.newaxis]).at[0]
        changes = (now.sigma, best.sigma), (now.scale, best.scale)
        best = weighed(model, now.loss, at, now.sigma, now.scale)
        if turn and all(np.nanmax(np.abs(new / old - 1.0)) < 1e-3 for new, old in changes):
            break
    return best


def _with_errors(best: Best) -> Best:
    """Return the same with the loss, and errors, that the scatter there makes likeliest."""
    problem, loss, residuals = best.model.problem, best.loss, best.residuals
    if not loss.is_square:
        loss = errors.likeliest(residuals[problem.present])
    used = replace(best, loss=loss).information.used
    scattered = errors.scattered(problem, residuals * best.sigma, best.expected, used, loss)
    factors = best.scale * errors.scatter(residuals, problem.present, used, loss)
    widened = np.where(best.estimated, 1.0, np.maximum(factors, 1.0))
    common = best.scale * errors.typical_deviation(residuals, problem.present)
    scale = np.where(errors.too_small(problem.present, widened, common), widened, 1.0)
    sigma = np.where(best.estimated, scattered, best.sigma)
    return weighed(best.model, loss, best.at, sigma, scale)


def polished(best: Best) -> Best:
    """Return the minimum that lmfit finds from here, with its result.

    It needs as many values as parameters; with fewer, or with none free, the point stays.
    """
    lmfit, model = extra("lmfit", "fit", "fit"), best.model
    if not 0 < len(best.at) <= model.problem.count:
        return best
    parameters = lmfit.Parameters()
    for name, value, low, high in zip(model.free, best.at, *model.bounds, strict=True):
        parameters.add(name, value=float(value), min=float(low), max=float(high))
    present = model.problem.present.ravel()

    def of(point: Any) -> Array:
        return np.asarray(best.roots(np.array([list(point.valuesdict().values())]))[0][present])

    ends: dict[str, float] = {"xtol": 1e-9, "ftol": 1e-10}
    if model.problem.on_plate:  # psi_2 is that of the solver, slower and less smooth than a table
        ends |= {"epsfcn": DIFFERENCE_STEP**2, "max_nfev": MOST_SOLVED}
    result = lmfit.minimize(of, parameters, method="leastsq", **ends)
    lowest = np.array(list(result.params.valuesdict().values()))
    before, after = np.square(of(parameters)).sum(), np.square(best.roots(lowest[None])).sum()
    return replace(best, at=lowest if after <= before else best.at, result=result)


def scan(model: Model, loss: errors.RobustLoss, sigma: Array) -> Array:
    """Return a few starting points: the best of a grid over the ranges, unlike each other.

    Valleys along one parameter, the others following, come first: there may be other minima.
    """
    problem = model.problem
    levels = [_levels(each, problem) for each in model.parameters]
    grid = np.array(list(product(*levels)))
    inverse = 1.0 / np.where(problem.present, sigma, 1.0)
    weights = Weights(inverse[:, :, np.newaxis] * np.eye(sigma.shape[1]))
    roots = Best(model, grid[0], weights, loss, sigma, np.ones(sigma.shape[1])).roots(grid)
    sums = np.square(roots).sum(axis=1)
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
    valleys = np.zeros(sums.size, dtype=bool)
    places = np.arange(sums.size).reshape(sums.shape)
    for axis, count in enumerate(sums.shape):
        across = np.moveaxis(sums, axis, 0).reshape(count, -1)
        least, at = across.min(axis=1), across.argmin(axis=1)
        beside = np.concatenate([[np.inf], least, [np.inf]])
        low = (least <= beside[:-2]) & (least <= beside[2:])
        valleys[np.moveaxis(places, axis, 0).reshape(count, -1)[low, at[low]]] = True
    return valleys


def _levels(parameter: Parameter, problem: FitProblem) -> Array:
    """Return the coordinates of a parameter in the scan."""
    if parameter.name == "restitution":
        return _likely_restitutions(problem, 0.35)
    low, high = map(parameter.coordinate, (parameter.low, parameter.high))
    if parameter.name == plates.THICKNESS:
        return np.clip(-plates.give_of(_likely_restitutions(problem, 0.02)), low, high)
    if parameter.name == "friction":
        low, high = LIKELY_FRICTION
    return np.linspace(low, high, parameter.levels + 2)[1:-1]


def _likely_restitutions(problem: FitProblem, least: float) -> Array:
    """Return normal restitutions to start from: what was measured, or a few."""
    measured = dict(zip(problem.responses, problem.measured.T, strict=True))
    if "normal_restitution" in measured:
        ratios = measured["normal_restitution"]
    elif "normal_speed_out" in measured:
        ratios = measured["normal_speed_out"] / problem.motion.normal_speed
    else:
        return np.array([0.6, 0.8, 0.95])
    return np.clip([float(np.nanmedian(ratios))], least, 0.999)
