"""What was measured, and errors of it: a robust loss, weights, scatter from which errors come."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaln

from carom.bodies.kinematics import Tangential
from carom.bodies.observables import convert_observables
from carom.bodies.pairs import Pair
from carom.io.cells import Mask
from carom.io.user_table import UserTable
from carom.lab.fitting.plates import THICKNESS
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY

SAME_ANGLE = np.radians(0.1)  # of incidence
NO_SPEED = 1e-9  # along the surface, as a part of the speed
STEEPEST = np.radians(89.9)


class Bounces(NamedTuple):
    """Successive bounces: the flight after a row is that before the row with the next place.

    `share` is the part of their variance that comes from readings, which two rows have in common.
    """

    places: NDArray[np.int64]
    are_times: bool
    share: float = 1.0


class IncomingMotion(NamedTuple):
    """Motion before the impacts, one a row, in SI units; and thicknesses of the plates struck."""

    normal_speed: Array
    tangential_speed: Array
    spin: Array
    spin2: Array
    thickness: Array | None = None


@dataclass(frozen=True, eq=False)
class FitProblem:
    """Measured rebounds in SI units: `measured` and `errors` have the shape (rows, responses).

    NaN stands for what was not measured, and for errors that are not known; `doi` is that of the
    publication, if the data tell it. If nobody `knows_friction`, that of the pair is a guess.
    `remarks` say how columns were read, `bounces` which rows share readings. There were so many
    `trials`; where rows are means of groups, `freedom` is that of their errors, by response.
    """

    pair: Pair
    before: Mapping[str, Array]
    before_errors: Mapping[str, Array]
    responses: tuple[str, ...]
    measured: Array
    errors: Array
    rows: UserTable
    ignored: tuple[str, ...] = ()
    knows_friction: bool = True
    doi: str = ""
    remarks: tuple[str, ...] = ()
    bounces: Bounces | None = None
    trials: int = 0
    freedom: Mapping[str, float] = field(default_factory=dict)

    @property
    def present(self) -> Mask:
        """Where there is a measured value."""
        return np.isfinite(self.measured)

    @property
    def count(self) -> int:
        """The number of measured values."""
        return int(self.present.sum())

    @property
    def error_freedom(self) -> Array:
        """The degrees of freedom of the errors that are known, by response."""
        return np.array([self.freedom.get(name, np.inf) for name in self.responses])

    @property
    def unknown(self) -> Mask:
        """Where there is a measured value without a standard deviation."""
        return self.present & ~np.isfinite(self.errors)

    @property
    def all_errors_known(self) -> bool:
        """Whether every measured value has a standard deviation."""
        return not self.unknown.any()

    @property
    def exact(self) -> list[str]:
        """What is taken as exact of the motion before: columns without errors that are not zero."""
        moving = [name for name, values in self.before.items() if np.any(values)]
        return [name for name in moving if name not in self.before_errors]

    @property
    def has_speeds(self) -> bool:
        """Whether speeds are known, not only ratios of them."""
        return bool({"speed", "normal_speed"} & set(self.before))

    @property
    def is_normal(self) -> bool:
        """Whether every impact is a normal one, and nothing moves sideways."""
        return bool(np.all(np.abs(self.contact_velocity) <= NO_SPEED * self.motion.normal_speed))

    @property
    def on_plate(self) -> bool:
        """Whether a plate is struck, which gives the restitution."""
        return self.pair.thickness is not None

    @property
    def is_one(self) -> bool:
        """Whether every impact that was measured has the same incidence, to either side."""
        slopes = np.abs(self.contact_velocity / self.motion.normal_speed)
        return bool(np.ptp(np.arctan(slopes[self.present.any(axis=1)])) < SAME_ANGLE)

    @cached_property
    def motion(self) -> IncomingMotion:
        """The motion before, as it was measured."""
        return self.moved({})

    @cached_property
    def contact_velocity(self) -> Array:
        """Tangential velocity of the contact point before."""
        along: Any = Tangential(*self.motion[1:4])  # type: ignore[arg-type]
        return np.asarray(along.contact_velocity(self.pair))

    @cached_property
    def least_errors(self) -> Array:
        """The errors of the interpolated curves, by response."""
        speed = float(np.median(np.hypot(*self.motion[:2])))  # of whose order a response is
        units = {"rad/s": speed / self.pair.first.radius, "m/s": speed}
        units["s"] = float(self.pair.scales(speed).time)
        usual = np.array([units.get(GLOSSARY[name].unit, 1.0) for name in self.responses])
        sizes = np.abs(self.measured)
        largest = np.minimum(np.nanmax(sizes, axis=0), LARGER * np.nanmedian(sizes, axis=0))
        return np.asarray(RESOLVED * np.maximum(largest, NEARLY_ZERO * usual))

    def moved(self, changes: Mapping[str, Array]) -> IncomingMotion:
        """Return the motion before with some of its columns changed by so much."""
        quantities = {name: values + changes.get(name, 0.0) for name, values in self.before.items()}
        thickness = quantities.pop(THICKNESS, None)
        for name in {"angle", "contact_angle"} & set(quantities):
            quantities[name] = np.clip(quantities[name], -STEEPEST, STEEPEST)
        if not self.has_speeds:
            quantities["normal_speed"] = np.ones(len(self.measured))
        names, nothing = ("normal_speed", "tangential_speed"), np.zeros(len(self.measured))
        speeds = (convert_observables(self.pair, known=quantities, wanted=name) for name in names)
        spins = (quantities.get(name, nothing) for name in ("spin", "spin2"))
        return IncomingMotion(*speeds, *spins)._replace(thickness=thickness)

    @cached_property
    def shaken(self) -> tuple[tuple[IncomingMotion, IncomingMotion], ...]:
        """The motion with each of its uncertain columns one standard deviation up, and down."""
        return tuple(
            (self.moved({name: error}), self.moved({name: -error}))
            for name, error in self.before_errors.items()
        )


NORMAL = np.linspace(-10.0, 10.0, 2001)  # where means over a normal distribution are taken
NORMAL_DENSITY = np.exp(-0.5 * NORMAL**2)
SURE = 3.09  # standard deviations beyond which errors that were given are called too small
RESOLVED = 1e-4  # of the largest measured value: errors below are those of the curves
OUTLIER = 4.0  # in standard deviations
LARGER = 10.0  # times the median: larger values are outliers before anything is fitted
NEARLY_ZERO = 1e-2  # of what a response may be
SHARES = (0.0, 0.5, 0.99)  # of a variance that go like the value squared
LARGEST = 1e70  # residual whose powers do not overflow
DEGREES = (3.0, 5.0, 10.0, 30.0)  # of freedom of Student's t
TRUSTED = 10.0  # values that a normal distribution counts for where a mean over few is taken


@dataclass(frozen=True)
class RobustLoss:
    """Loss (nu + 1) log(1 + r^2/nu) of a residual r in standard deviations.

    -2 log likelihood of Student's t with nu degrees of freedom (Lange, Little & Taylor 1989): about
    r^2 (nu + 1)/nu for small r, while outliers hardly pull. With nu infinite it is r^2.
    """

    degrees: float = 5.0

    @property
    def size(self) -> float:
        """-2 log of the density of a residual of zero."""
        if self.is_square:
            return float(np.log(2.0 * np.pi))
        half = 0.5 * self.degrees
        return float(np.log(self.degrees * np.pi) - 2.0 * (gammaln(half + 0.5) - gammaln(half)))

    @property
    def is_square(self) -> bool:
        """Whether it is the loss of least squares."""
        return self.degrees == np.inf

    def root(self, residual: Array) -> Array:
        """Return the residual whose square is the loss, of the same sign."""
        if self.is_square:
            return residual
        r = np.clip(residual, -LARGEST, LARGEST)
        return np.copysign(np.sqrt((self.degrees + 1.0) * np.log1p(r**2 / self.degrees)), r)

    def weight(self, residual: Array) -> Array:
        """Return the weight of a residual in a mean."""
        if self.is_square:
            return np.ones_like(residual)
        square = np.clip(residual, -LARGEST, LARGEST) ** 2
        return np.asarray((self.degrees + 1.0) / (self.degrees + square))

    def influence(self, residual: Array) -> Array:
        """Return half the derivative of the loss."""
        return np.asarray(residual * self.weight(residual))

    def slope(self, residual: Array) -> Array:
        """Return the derivative of the influence."""
        if self.is_square:
            return np.ones_like(residual)
        d, square = self.degrees, np.clip(residual, -LARGEST, LARGEST) ** 2
        return np.asarray((d + 1.0) * (d - square) / (d + square) ** 2)


def gaussian_mean(values: Array) -> float:
    """Return the mean of a function, given at NORMAL, over a standard normal distribution."""
    return float((values * NORMAL_DENSITY).sum() / NORMAL_DENSITY.sum())


@dataclass(frozen=True, eq=False)
class Weights:
    """What makes residuals independent and of unit variance: inverse Cholesky factors by row.

    Where rows share readings `across` is that of the correlations of the only response.
    """

    factors: Array
    across: Array | None = None

    def whitened(self, problem: FitProblem, expected: Array) -> Array:
        """Return the residuals in standard deviations, 0 where nothing was measured."""
        residual = np.where(problem.present, problem.measured - expected, 0.0)
        whitened = np.einsum("rij,brj->bri", self.factors, residual)
        return np.asarray(whitened if self.across is None else self.across @ whitened)

    def sizes(self, present: Mask) -> float:
        """Return the logarithm of the determinant of the covariances."""
        across = 1.0 if self.across is None else np.diag(self.across)[:, np.newaxis]
        return -2.0 * float(np.log((across * np.einsum("rjj->rj", self.factors))[present]).sum())


def shared_readings(
    problem: FitProblem, bounces: Bounces, gains: Array, scale: float
) -> tuple[Array, Array]:
    """Return the correlations of the residuals of successive bounces, and factors of their sizes.

    With errors d of the speeds in flight a residual is d - g d', d' that of the flight before and
    g the restitution; where times of bounces are read, d is the difference of errors of two. What
    scatters by more than given errors is that of the bounces themselves, without correlation.
    """
    there, rows = problem.present[:, 0], np.arange(len(gains))
    known, share = problem.all_errors_known, bounces.share
    after, before = np.ones(len(rows)), gains
    if known:
        none = np.zeros(len(rows))
        share, after = 1.0 / scale**2, np.where(there, problem.errors[:, 0], 1.0)
        before = gains * problem.before_errors.get("normal_speed", none)
    slopes = np.zeros((len(rows), int(bounces.places.max()) + 2))
    slopes[rows, bounces.places], slopes[rows, bounces.places + 1] = -before, after
    if bounces.are_times:
        slopes = np.diff(slopes, axis=1, prepend=0.0, append=0.0) / np.sqrt(2.0)
    sizes = np.sqrt(np.square(slopes).sum(axis=1))
    correlations = slopes @ slopes.T / np.outer(sizes, sizes) * np.outer(there, there)
    larger = sizes / np.hypot(after, before) if known else np.ones(len(rows))
    return share * correlations + np.diag(1.0 - share * there), larger


def first_errors(problem: FitProblem) -> Array:
    """Return errors to begin with where none are known: a part of the spread of each response."""
    low, high = np.nanpercentile(problem.measured, (10.0, 90.0), axis=0)
    spread = (high - low) / 2.56  # few outliers do not move it
    return np.asarray(0.1 * spread + problem.least_errors)


def usable_errors(problem: FitProblem) -> Array:
    """Return the errors that were given, none smaller than that of the curves."""
    return np.maximum(problem.errors, problem.least_errors)


def mean_over(values: Array, function: Callable[[Array], Array], used: float = 0.0) -> float:
    """Return the mean of a function over residuals, a few of a normal distribution among them."""
    count = max(values.size - used, 1.0)
    own = values.size * float(function(values).mean()) / count
    return (count * own + TRUSTED * gaussian_mean(function(NORMAL))) / (count + TRUSTED)


def scattered(
    problem: FitProblem, deviations: Array, expected: Array, used: Array, loss: RobustLoss
) -> Array:
    """Return standard deviations of responses, of shape (rows, responses), from how they scatter.

    Angles and ratios scatter by a constant, sigma = s; speeds and spins by a constant and a share
    of the value, sigma^2 = s^2 (1 - a + a y^2/median(y)^2), y the expected values. Variances are a
    mean over a, weighted by the likelihood (Burnham & Anderson 2002, section 4.2); in least squares
    they are constant.
    """
    shares = np.array(SHARES[:1] if loss.is_square else SHARES)[:, np.newaxis]
    sigma, least = np.ones((len(shares), *problem.present.shape)), problem.least_errors
    for place, there in enumerate(problem.present.T):
        sizes = expected[there, place] ** 2 / max(np.median(expected[there, place] ** 2), 1e-300)
        parts = shares * (GLOSSARY[problem.responses[place]].unit in ("m/s", "rad/s"))
        shapes = np.sqrt(1.0 - parts + parts * sizes)
        scales = _scales(deviations[there, place] / shapes, used[place], loss)
        sigma[:, there, place] = np.maximum(scales[:, np.newaxis] * shapes, least[place])
    own, there = sigma[:, problem.present], deviations[problem.present]
    against = (2.0 * np.log(own) + loss.root(there / own) ** 2).sum(axis=1)
    weights = np.exp(-0.5 * (against - against.min()))
    return np.asarray(np.sqrt(np.tensordot(weights / weights.sum(), sigma**2, axes=1)))


def likeliest(residuals: Array) -> RobustLoss:
    """Return the loss with those degrees of freedom by which residuals are likeliest."""

    def against(loss: RobustLoss) -> float:
        return float((loss.root(residuals) ** 2 + loss.size).sum())

    return min((RobustLoss(degrees) for degrees in DEGREES), key=against)


def scatter(residuals: Array, present: Mask, used: Array, loss: RobustLoss) -> Array:
    """Return by how much the scatter of each response exceeds its errors."""
    columns = zip(residuals.T, present.T, used, strict=True)
    return np.array(
        [float(_scales(r[there], part, loss)) if there.any() else 1.0 for r, there, part in columns]
    )


def _scales(residuals: Array, used: float, loss: RobustLoss) -> Array:
    """Return the scales of residuals along the last axis: mean r psi(r) as normal ones have it."""
    kept = max(1.0 - used / residuals.shape[-1], 0.05)
    wanted = kept * gaussian_mean(NORMAL * loss.influence(NORMAL))
    factor = np.sqrt(np.mean(residuals**2, axis=-1))
    for _ in range(50):
        scaled = residuals / np.maximum(factor, 1e-300)[..., np.newaxis]
        step = np.sqrt(np.mean(scaled * loss.influence(scaled), axis=-1) / wanted)
        factor = factor * step
        if np.all((np.abs(step - 1.0) < 1e-5) | (factor == 0.0)):
            break
    return np.asarray(factor)


def typical_deviation(residuals: Array, present: Mask) -> Array:
    """Return the median deviation of each response, in its errors; few outliers do not move it."""
    shown = np.where(present, np.abs(residuals), np.nan)
    return np.asarray(np.nanmedian(shown, axis=0) / 0.6745)


def too_small(present: Mask, factors: Array, typical: Array) -> Mask:
    """Tell which scatter is larger than errors that were given allow.

    Chi squared (Wilson & Hilferty 1931) and the median deviation (Huber 1981, section 5.1) must
    both say so: not a few outliers, but most of the values.
    """
    counts = np.maximum(present.sum(axis=0), 1)
    bound = (1.0 - 2.0 / (9.0 * counts) + SURE * np.sqrt(2.0 / (9.0 * counts))) ** 1.5
    return np.asarray((factors > bound) & (typical > 1.0 + SURE * 1.17 / np.sqrt(counts)))
