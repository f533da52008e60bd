"""One model of several sets of data, some parameters of which are the same for all."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import cast

import numpy as np
from scipy.linalg import block_diag, null_space
from scipy.special import fdtrc

from carom.lab.fitting.estimation import Best, estimate, polished, weighed
from carom.lab.fitting.intervals import ProfiledFit, Settled, profiled, without_weak
from carom.lab.fitting.model import Model, Parameter, plain
from carom.lab.fitting.problem import FitProblem, IncomingMotion, Weights
from carom.quantities.arrays import Array

MANY = 1e9  # degrees of freedom, as good as known
Block = tuple[slice, slice]  # rows and responses of one set


@dataclass(frozen=True, eq=False)
class JointProblem(FitProblem):
    """Sets of data: rows below each other, responses beside each other, nothing where they cross.

    So each set keeps the errors that its own scatter gives.
    """

    parts: tuple[FitProblem, ...] = ()

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """Where each set is."""
        corners = np.cumsum([(0, 0), *(part.measured.shape for part in self.parts)], axis=0)
        ends = pairwise(corners.tolist())
        return tuple((slice(a, c), slice(b, d)) for (a, b), (c, d) in ends)

    @cached_property
    def least_errors(self) -> Array:
        """The errors of the interpolated curves, by response."""
        return np.concatenate([part.least_errors for part in self.parts])

    @property
    def error_freedom(self) -> Array:
        """The degrees of freedom of the errors that are known, by response."""
        return np.concatenate([part.error_freedom for part in self.parts])

    @property
    def on_plate(self) -> bool:
        """Whether plates are struck, which are solved row by row."""
        return any(part.on_plate for part in self.parts)


def joined(parts: Sequence[FitProblem]) -> JointProblem:
    """Return several sets of data as one."""
    names = tuple(name for part in parts for name in part.responses)
    inside = block_diag(*(np.ones(part.measured.shape) for part in parts)) > 0.0
    tables = [part.measured for part in parts], [part.errors for part in parts]
    measured, errors = (np.where(inside, block_diag(*table), np.nan) for table in tables)
    first = parts[0]
    return JointProblem(first.pair, {}, {}, names, measured, errors, first.rows, parts=(*parts,))


@dataclass(frozen=True, eq=False)
class JointModel(Model):
    """Models of several sets; a free parameter that they do not share bears the number of its set.

    `law` and `held` are of no account: each of `parts` has its own.
    """

    problem: JointProblem
    parts: tuple[Model, ...] = ()
    shared: Collection[str] = ()

    def names(self, place: int) -> tuple[str, ...]:
        """Return what the free parameters of a set are called here."""
        own = self.parts[place].free
        return tuple(name if name in self.shared else f"{name}_{place + 1}" for name in own)

    def places(self, place: int) -> list[int]:
        """Return which of the coordinates are those of a set."""
        return [self.free.index(name) for name in self.names(place)]

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """The free parameters, each in the range that all sets allow it."""
        ranges: dict[str, Parameter] = {}
        for place, part in enumerate(self.parts):
            for name, own in zip(self.names(place), part.parameters, strict=True):
                seen = ranges.get(name, own)
                low, high = max(seen.low, own.low), min(seen.high, own.high)
                ranges[name] = seen._replace(name=name, low=low, high=high)
        return tuple(ranges[name] for name in self.free)

    def of_part(self, place: int, at: Array) -> Array:
        """Return the coordinates of a set, of shape (batch, its parameters)."""
        pairs = zip(self.parts[place].parameters, self.places(place), strict=True)
        own = [each.coordinate(self.parameters[i].value(at[:, i])) for each, i in pairs]
        return np.stack(own, axis=-1) if own else np.empty((len(at), 0))

    def expected(self, at: Array, motion: IncomingMotion | None = None) -> Array:
        """Return the responses at coordinates, of shape (batch, rows, responses)."""
        whole = np.zeros((len(at), *self.problem.measured.shape))
        for place, (rows, columns) in enumerate(self.problem.blocks):
            whole[:, rows, columns] = self.parts[place].expected(self.of_part(place, at))
        return whole

    def weights(self, point: Array, sigma: Array, scale: Array) -> Weights:
        """Return the weights at coordinates, those of each set in its place."""
        factors, across = np.tile(np.eye(len(scale)), (len(sigma), 1, 1)), np.eye(len(sigma))
        share = False
        for place, (rows, columns) in enumerate(self.problem.blocks):
            at = self.of_part(place, point[np.newaxis])[0]
            own = self.parts[place].weights(at, sigma[rows, columns], scale[columns])
            factors[rows, columns, columns] = own.factors
            if own.across is not None:
                across[rows, rows], share = own.across, True
        return Weights(factors, across if share else None)

    def holding(self, name: str, value: float) -> "JointModel":
        """Return the model with one of the free parameters held, in all sets that have it."""
        parts = tuple(
            part.holding(plain(name), value) if name in self.names(place) else part
            for place, part in enumerate(self.parts)
        )
        return joint_model(parts, self.shared)

    def together(self, values: Sequence[Mapping[str, float]]) -> dict[str, float]:
        """Return the values of sets by the names here; of what they share, the first one's."""
        whole: dict[str, float] = {}
        for place, own in enumerate(values):
            for name in self.names(place):
                whole.setdefault(name, own[plain(name)])
        return whole


def joint_model(parts: Sequence[Model], shared: Collection[str]) -> JointModel:
    """Return the model of several sets in which parameters of these names are the same for all."""
    problem, law = joined([part.problem for part in parts]), parts[0].law
    model = JointModel(law, problem, (), {}, tuple(parts), tuple(shared))
    names = (name for place in range(len(parts)) for name in model.names(place))
    return replace(model, free=tuple(dict.fromkeys(names)))


def settle_jointly(
    alone: Sequence[Settled], shared: Collection[str], confidence: float
) -> tuple[Best, list[tuple[Settled, ProfiledFit]], float]:
    """Fit sets once more that were fitted alone, with parameters of some names the same for all.

    For each set there is what the joint fit says of it, with intervals; the last number is the
    probability that sets which do share the parameters differ more.
    """
    model = joint_model([each.whole.model for each in alone], shared)
    values = [each.whole.values for each in alone]
    own, each_of = model.together(values), [{name: v[name] for name in shared} for v in values]
    begun = np.array([model.coordinates(own | common) for common in each_of])
    whole = estimate(model, alone[0].best.loss, np.clip(begun, *model.bounds))
    best, groups = without_weak(whole, model.together([each.start for each in alone]))
    profile = profiled(best, confidence)
    parts = []
    for place, each in enumerate(alone):
        names = model.names(place)  # of groups, what is not of other sets
        weak = (tuple(plain(name) for name in group if name in names) for group in groups)
        ends, groups_here = _part_profile(profile, place), tuple(filter(None, weak))
        part = replace(each, best=ends.best, groups=groups_here, whole=_part(whole, place))
        parts.append((part, ends))
    return profile.best, parts, _agreement(model, alone, whole)


def _part(best: Best, place: int) -> Best:
    """Return what a joint fit says of one set.

    `elsewhere` are slopes that tell of its parameters as much as the other sets do.
    """
    model = cast(JointModel, best.model)
    rows, columns = model.problem.blocks[place]
    at, *moved = model.of_part(place, np.stack([best.at, best.at + 1e-3]))
    part, across = model.parts[place], best.weights.across
    own = None if part.problem.bounces is None or across is None else across[rows, rows]
    weights = Weights(best.weights.factors[rows, columns, columns], own)
    used = weights, best.loss, best.sigma[rows, columns], best.scale[columns]
    alone = Best(part, at, *used, result=best.result)
    ratio = (moved[0] - at) / 1e-3  # coordinates of a part are in proportion to those here
    places = model.places(place)
    covariance = best.information.covariance[np.ix_(places, places)] * np.outer(ratio, ratio)
    more = np.linalg.inv(covariance) - alone.information.matrix
    sizes, directions = np.linalg.eigh(more)
    return replace(alone, elsewhere=np.sqrt(np.maximum(sizes, 0.0))[:, np.newaxis] * directions.T)


def _part_profile(profile: ProfiledFit, place: int) -> ProfiledFit:
    """Return the intervals of one set."""
    model = cast(JointModel, profile.best.model)
    places = model.places(place)
    count = len(places)
    ends = model.of_part(place, profile.ends[places].reshape(2 * count, -1))
    own = ends.reshape(count, 2, count)
    return ProfiledFit(_part(profile.best, place), own, profile.open[places])


def _agreement(model: JointModel, alone: Sequence[Settled], whole: Best) -> float:
    """Return the probability of a larger F: by how much the loss rises as parameters are shared.

    Both fits have the errors that the sets have alone, so that contradictions do not enlarge them.
    The degrees of freedom are those of what must vanish where sets share a parameter, as of the
    difference of two means (Welch 1947).
    """
    apart = joint_model(model.parts, ())
    singles = [each.whole for each in alone]
    sigma = block_diag(*(each.sigma for each in singles))
    scale = np.concatenate([each.scale for each in singles])
    start = apart.coordinates(apart.together([each.values for each in singles]))
    best = polished(weighed(apart, whole.loss, np.clip(start, *apart.bounds), sigma, scale))
    shared = replace(best, model=model).descended(whole.at[np.newaxis])
    more = len(best.at) - len(whole.at)
    freedom, _ = best.reliability(_contrasts(model, apart, whole.at))
    rise = max(float(shared.sums[0]) - best.sum, 0.0) / best.spread / more
    return float(fdtrc(more, float(np.min([*freedom, MANY])), rise))


def _contrasts(model: JointModel, apart: JointModel, at: Array) -> Array:
    """Return sums of the coordinates of sets apart that are constant where sets share some."""
    steps = np.vstack([at, at + 1e-3 * np.eye(len(at))])
    moved = np.zeros((len(apart.free), len(at)))
    for place in range(len(model.parts)):
        here, *there = model.of_part(place, steps)
        moved[apart.places(place)] = np.transpose(there - here)
    return np.asarray(null_space(moved.T).T)
