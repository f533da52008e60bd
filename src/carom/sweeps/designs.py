"""Designs: which impacts a sweep consists of, cut into blocks; here a grid, and samples."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, product
from math import ceil, inf, isfinite, pi, prod
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies.plausibility import doubts_of_values
from carom.dimensionless.numerics.permutation import fractions, secrets
from carom.quantities.arrays import Array, numbers
from carom.quantities.refusals import InputError, one_of, refusal
from carom.quantities.units import counted, number, without_unit
from carom.sweeps.inputs import (
    CHOSEN,
    CODE,
    Choices,
    checked_names,
    input_attributes,
    leaf,
    read_choices,
    variable,
)

Box = tuple[slice, ...]
Values = dict[str, NDArray[Any]]

FEWEST, MOST = 1024, 2**14  # points of a block
BLOCKS = 32  # that a sweep of middling size is cut into


def chunk_shape(shape: Sequence[int], cost: int = 1) -> tuple[int, ...]:
    """Return the shape of the blocks of a sweep, filled from its last axis on.

    Blocks have fewer points where each point costs more.
    """
    room = min(max(prod(shape) // BLOCKS, FEWEST // cost), MOST // cost)
    chunks = []
    for length in reversed(shape):
        pieces = ceil(length / max(1, min(length, room)))
        chunks.append(ceil(length / pieces))
        room //= chunks[-1]
    return tuple(reversed(chunks))


def boxes(shape: Sequence[int], chunks: Sequence[int]) -> Iterator[Box]:
    """Yield every block of an array of this shape, the last axis fastest."""
    starts = (range(0, length, chunk) for length, chunk in zip(shape, chunks, strict=True))
    for corner in product(*starts):
        yield tuple(
            slice(start, min(start + chunk, length))
            for start, chunk, length in zip(corner, chunks, shape, strict=True)
        )


def points_in(box: Box) -> int:
    """Return the number of points of a block."""
    return prod(part.stop - part.start for part in box)


SPACINGS = ("linear", "log")
RANGE = ("from", "to", "spacing")
MOST_VALUES = 10**8  # of an axis, which is in memory


class Range(NamedTuple):
    """From where to where, and whether evenly in the logarithm."""

    start: float
    stop: float
    log: bool

    def at(self, fraction: Array) -> Array:
        """Return the values at fractions of the way, 0 to 1."""
        if self.log:
            return np.asarray(self.start * (self.stop / self.start) ** fraction)
        return np.asarray(self.start + (self.stop - self.start) * fraction)


def read_values(name: str, given: ArrayLike) -> Array:
    """Return the values of an axis in SI units, or raise InputError."""
    key, allowed = leaf(name), "must be a list of finite numbers or texts with units"
    values = np.atleast_1d(numbers(key, given, allowed))
    if values.ndim != 1 or values.size == 0:
        raise refusal(name, given, f"{allowed}, at least one")
    fits = np.isfinite(values) | ((key == "young") & (values == np.inf))
    if not np.all(fits):
        raise refusal(name, float(values[~fits][0]), allowed)
    if key == "angle" and np.abs(values).max() > pi and not _has_text(given):
        raise refusal(name, given, "bare angles are in radians; write '30 deg'")
    return values


def _has_text(given: Any) -> bool:
    return isinstance(given, str) or any(isinstance(value, str) for value in np.atleast_1d(given))


def read_axis(name: str, given: Any) -> Array:
    """Return the values of an axis from a list, or from a range with its number of points."""
    if not isinstance(given, Mapping):
        return read_values(name, given)
    points = counted(f"{name}.points", given.get("points"), 1, MOST_VALUES)
    ends = {key: value for key, value in given.items() if key != "points"}
    reach = read_range(name, ends, apart=points > 1)
    values = reach.at(np.linspace(0.0, 1.0, points))
    if points > 1:
        values[-1] = reach.stop
    return values


def read_range(name: str, given: Any, *, apart: bool = True) -> Range:
    """Return a range from (first, last), or from a mapping with from, to and spacing."""
    whole = _as_table(name, given)
    start, stop = _end(name, "from", whole.get("from")), _end(name, "to", whole.get("to"))
    spacing = whole.get("spacing", SPACINGS[0])
    one_of(f"{name}.spacing", spacing, SPACINGS)
    if apart and start == stop:
        raise refusal(name, start, "a range must not end where it starts")
    if spacing == "log" and min(start, stop) <= 0.0:
        raise refusal(name, min(start, stop), "logarithmic spacing needs positive ends")
    log = spacing == "log"
    if not isfinite(stop - start) or (log and not 0.0 < stop / start < inf):
        raise refusal(name, [start, stop], "these ends are too far apart for floating point")
    return Range(start, stop, log)


def _as_table(name: str, given: Any) -> Mapping[str, Any]:
    ends = np.atleast_1d(without_unit(name, given)[0]) if isinstance(given, np.ndarray) else given
    ends = ends.tolist() if isinstance(ends, np.ndarray) else ends
    if isinstance(ends, list | tuple) and len(ends) == 2:
        return dict(zip(RANGE, ends, strict=False))
    if not isinstance(given, Mapping):
        raise refusal(name, given, "must be a range: (first, last), or {from, to, spacing}")
    for key in given:
        if key not in RANGE:
            allowed = f"a range has {', '.join(RANGE)} and, on a grid, points"
            raise InputError(f"{name}.{key}: unknown; {allowed}")
    return given


def _end(name: str, which: str, value: Any) -> float:
    if value is None:
        raise InputError(f"{name}.{which}: missing; a range needs from and to")
    result = number(leaf(name), value)
    if not isfinite(result):
        raise refusal(f"{name}.{which}", value, "must be finite")
    if leaf(name) == "angle" and abs(result) > pi and not isinstance(value, str):
        allowed = f"a bare angle is in radians; write '{value} deg'"
        raise refusal(f"{name}.{which}", value, allowed)
    return result


MOST_SAMPLES = 10**12  # which leaves room for their places in a float
MOST_SEED = 2**128 - 1


@dataclass(frozen=True, eq=False, init=False)
class Design(ABC):
    """What a sweep needs to know of its points: the names of their inputs, and how these vary.

    `_choices` are what the codes of an input that has names stand for. Points are `_sampled` if
    their inputs are variables along `point`, rather than coordinates.
    """

    names: tuple[str, ...]
    _choices: Choices = field(repr=False)
    _given: Mapping[str, Any] = field(repr=False)
    _sampled: ClassVar[bool] = True

    def __init__(self, choices: Choices, given: Mapping[str, Any], **more: Any) -> None:
        fields = {"names": tuple(given), "_choices": choices, "_given": given, **more}
        for name, value in fields.items():
            object.__setattr__(self, name, value)

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return ("point",)

    @property
    @abstractmethod
    def shape(self) -> tuple[int, ...]:
        """Number of points along every dimension."""

    def _coords(self) -> dict[str, Any]:
        """Return the coordinates for `carom.io.labels.labelled_dataset`, if there are any."""
        return {}

    @abstractmethod
    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box in C order: SI numbers, or codes of choices."""

    @abstractmethod
    def _description(self) -> dict[str, Any]:
        """Return what tells this design from others, as JSON can hold it."""

    def _doubts(self) -> tuple[str, ...]:
        """Return what is hardly meant among the inputs, in words."""
        numbers = [
            (leaf(name), given[:2] if isinstance(given, Range) else given)
            for name, given in self._given.items()
            if name not in self._choices
        ]
        for choice in chain.from_iterable(self._choices.values()):
            numbers += choice.values.items()
        return doubts_of_values(numbers)

    def _described(self, describe: Callable[[Any], Any]) -> dict[str, Any]:
        """Return by input its choices, or what describes its values or range."""
        return {
            name: [choice.description() for choice in self._choices[name]]
            if name in self._choices
            else describe(given)
            for name, given in self._given.items()
        }


@dataclass(frozen=True, eq=False, init=False)
class Grid(Design):
    """Every combination of the values along some axes.

    Parameters
    ----------
    axes : mapping
        The values of each input by its name, e.g. "angle" or "first.radius": a list of numbers or
        of texts with units, an array, or a range such as {"from": "0 deg", "to": "85 deg",
        "points": 86, "spacing": "linear"}, where the spacing "log" is even in the logarithm. For
        "first.material", "second.material" and "second.kind" give a list of names. The last axis
        varies fastest.

    Raises
    ------
    InputError
        If an input is not known or given in two ways, or an axis is empty or not finite.

    Examples
    --------
    >>> import carom
    >>> angle = {"from": "0 deg", "to": "80 deg", "points": 9}
    >>> grid = carom.Grid({"angle": angle, "friction": [0.1]})
    >>> grid.dims, grid.shape
    (('angle', 'friction'), (9, 1))
    """

    _sampled: ClassVar[bool] = False

    def __init__(self, axes: Mapping[str, Any]) -> None:
        choices = _choices("axes", axes)
        values = {
            name: np.arange(len(choices[name]), dtype=CODE)
            if name in choices
            else read_axis(name, axis)
            for name, axis in axes.items()
        }
        super().__init__(choices, values)

    @property
    def dims(self) -> tuple[str, ...]:
        return tuple(variable(name) for name in self.names)

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(values.size for values in self._given.values())

    def _coords(self) -> dict[str, Any]:
        labels = {name: [one.label for one in self._choices[name]] for name in self._choices}
        return {
            dim: (dim, labels.get(name, values), input_attributes(name, self._choices))
            for dim, (name, values) in zip(self.dims, self._given.items(), strict=True)
        }

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        parts = [values[part] for values, part in zip(self._given.values(), box, strict=True)]
        lattice = np.meshgrid(*parts, indexing="ij")
        return {name: at.ravel() for name, at in zip(self.names, lattice, strict=True)}

    def _description(self) -> dict[str, Any]:
        axes = self._described(np.ndarray.tolist)
        return {"kind": "grid", "order": list(self.names), "axes": axes}


@dataclass(frozen=True, eq=False, init=False)
class LatinHypercube(Design):
    """Samples that fill the range of every input evenly (McKay, Beckman & Conover 1979).

    Each of n equal parts of the range of an input holds exactly one sample: x_ij = (p_j(i) +
    u_ij)/n, with permutations p_j and random numbers u_ij in (0, 1).

    Parameters
    ----------
    ranges : mapping
        The range of each input by its name: (first, last), or {"from": ..., "to": ..., "spacing":
        "linear" or "log"}; for "first.material", "second.material" and "second.kind" a list of
        names.
    samples : int
        Number of points n.
    seed : int
        Seed of the random numbers; the same seed gives the same samples.

    Raises
    ------
    InputError
        If an input is not known or given in two ways, or a range is not one.

    Examples
    --------
    >>> import carom
    >>> design = carom.LatinHypercube({"friction": (0.0, 0.5)}, samples=5, seed=1)
    >>> sorted((design.inputs((slice(0, 5),))["friction"] * 10).astype(int).tolist())
    [0, 1, 2, 3, 4]
    """

    samples: int
    seed: int

    def __init__(self, ranges: Mapping[str, Any], *, samples: int, seed: int = 0) -> None:
        choices = _choices("ranges", ranges)
        samples = counted("samples", samples, 1, MOST_SAMPLES)
        seed = counted("seed", seed, 0, MOST_SEED)
        reaches = {
            name: Range(0.0, len(choices[name]), False)
            if name in choices
            else read_range(name, reach)
            for name, reach in ranges.items()
        }
        super().__init__(choices, reaches, samples=samples, seed=seed)

    @property
    def shape(self) -> tuple[int, ...]:
        return (self.samples,)

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        index = np.arange(*box[0].indices(self.samples), dtype=np.uint64)
        words = secrets(self.seed, len(self.names))
        found: dict[str, NDArray[Any]] = {}
        for (name, reach), secret in zip(self._given.items(), words, strict=True):
            values = reach.at(fractions(index, self.samples, secret))
            found[name] = values.astype(CODE) if name in self._choices else values
        return found

    def _description(self) -> dict[str, Any]:
        whole = {"samples": self.samples, "seed": self.seed, "order": list(self.names)}
        return {"kind": "latin hypercube", **whole, "ranges": self._described(Range._asdict)}


def _choices(what: str, given: Any) -> Choices:
    """Return the choices of the inputs that have names; InputError for what is not an input."""
    if not isinstance(given, Mapping):
        raise refusal(what, given, "must be a mapping from names of inputs to values")
    named = (name for name in checked_names(given) if name in CHOSEN)
    return {name: read_choices(name, given[name]) for name in named}
