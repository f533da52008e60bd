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
from carom.many.sweeps import inputs as known
from carom.quantities.arrays import Array, numbers, refuse_where
from carom.quantities.refusals import checked_type, one_of, refusal, refuse
from carom.quantities.units import counted, number, without_unit

Box = tuple[slice, ...]
Values = dict[str, NDArray[Any]]

FEWEST, MOST = 1024, 2**14  # points of a block
USUAL_BLOCKS = 32  # that a sweep of middling size is cut into


def chunk_shape(shape: Sequence[int], cost: int = 1) -> tuple[int, ...]:
    """Return the shape of blocks, filled from the last axis on, smaller where points cost more."""
    room = min(max(prod(shape) // USUAL_BLOCKS, FEWEST // cost), MOST // cost)
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


def read_values(name: str, axis: ArrayLike) -> Array:
    """Return the values of an axis in SI units, or raise InputError."""
    key, allowed = known.leaf(name), "must be a list of finite numbers or texts with units"
    values = np.atleast_1d(numbers(key, axis, allowed))
    line = values.ndim == 1 and values.size > 0
    refuse(not line and refusal(name, axis, f"{allowed}, at least one"))
    fits = np.isfinite(values) | ((key == "young") & (values == np.inf))
    refuse_where(name, values, ~fits, allowed)
    if key == "angle" and np.abs(values).max() > pi:
        texts = isinstance(axis, str) or any(isinstance(each, str) for each in np.atleast_1d(axis))
        refuse(not texts and refusal(name, axis, "bare angles are in radians; write '30 deg'"))
    return values


def read_axis(name: str, axis: Any) -> Array:
    """Return the values of an axis from a list, or from a range with its number of points."""
    if not isinstance(axis, Mapping):
        return read_values(name, axis)
    points = counted(f"{name}.points", axis.get("points"), 1, MOST_VALUES)
    ends = {key: value for key, value in axis.items() if key != "points"}
    reach = read_range(name, ends, apart=points > 1)
    values = reach.at(np.linspace(0.0, 1.0, points))
    if points > 1:
        values[-1] = reach.stop
    return values


def read_range(name: str, reach: Any, *, apart: bool = True) -> Range:
    """Return a range from (first, last), or from a mapping with from, to and spacing."""
    whole = _as_table(name, reach)
    start, stop = _end(name, "from", whole.get("from")), _end(name, "to", whole.get("to"))
    spacing = whole.get("spacing", SPACINGS[0])
    one_of(f"{name}.spacing", spacing, SPACINGS)
    least, log = min(start, stop), spacing == "log"
    refuse(
        apart and start == stop and refusal(name, start, "a range must not end where it starts"),
        log and least <= 0.0 and refusal(name, least, "logarithmic spacing needs positive ends"),
    )
    if not isfinite(stop - start) or (log and not 0.0 < stop / start < inf):
        raise refusal(name, [start, stop], "these ends are too far apart for floating point")
    return Range(start, stop, log)


def _as_table(name: str, reach: Any) -> Mapping[str, Any]:
    ends = np.atleast_1d(without_unit(name, reach)[0]) if isinstance(reach, np.ndarray) else reach
    ends = ends.tolist() if isinstance(ends, np.ndarray) else ends
    if isinstance(ends, list | tuple) and len(ends) == 2:
        return dict(zip(RANGE, ends, strict=False))
    allowed = "must be a range: (first, last), or {from, to, spacing}"
    table = checked_type(name, reach, Mapping, allowed)
    words = f"a range has {', '.join(RANGE)} and, on a grid, points"
    refuse(*(f"{name}.{key}: unknown; {words}" for key in table if key not in RANGE))
    return table


def _end(name: str, which: str, value: Any) -> float:
    refuse(value is None and f"{name}.{which}: missing; a range needs from and to")
    result = number(known.leaf(name), value)
    bare = known.leaf(name) == "angle" and abs(result) > pi and not isinstance(value, str)
    allowed = bare and f"a bare angle is in radians; write '{value} deg'"
    allowed = allowed if isfinite(result) else "must be finite"
    refuse(allowed and refusal(f"{name}.{which}", value, allowed))
    return result


MOST_SAMPLES = 10**12  # which leaves room for their places in a float
MOST_SEED = 2**128 - 1


@dataclass(frozen=True, eq=False, init=False)
class Design(ABC):
    """What a sweep needs to know of its points: the names of their inputs, and how these vary.

    `_choices` are what codes of names stand for; `_sampled` inputs are variables along `point`.
    """

    names: tuple[str, ...]
    _choices: known.Choices = field(repr=False)
    _by_input: Mapping[str, Any] = field(repr=False)
    _sampled: ClassVar[bool] = True

    def __init__(self, choices: known.Choices, by_input: Mapping[str, Any], **more: Any) -> None:
        fields = {"names": tuple(by_input), "_choices": choices, "_by_input": by_input, **more}
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
            (known.leaf(name), values[:2] if isinstance(values, Range) else values)
            for name, values in self._by_input.items()
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
            else describe(values)
            for name, values in self._by_input.items()
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
    >>> angle = {"from": "0 deg", "to": "80 deg", "points": 9}
    >>> grid = carom.Grid({"angle": angle, "friction": [0.1]})
    >>> grid.dims, grid.shape
    (('angle', 'friction'), (9, 1))
    """

    _sampled: ClassVar[bool] = False

    def __init__(self, axes: Mapping[str, Any]) -> None:
        choices = _choices("axes", axes)
        values = {
            name: np.arange(len(choices[name]), dtype=known.CODE)
            if name in choices
            else read_axis(name, axis)
            for name, axis in axes.items()
        }
        super().__init__(choices, values)

    @property
    def dims(self) -> tuple[str, ...]:
        return tuple(known.variable(name) for name in self.names)

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(values.size for values in self._by_input.values())

    def _coords(self) -> dict[str, Any]:
        labels = {name: [one.label for one in self._choices[name]] for name in self._choices}
        return {
            dim: (dim, labels.get(name, values), known.input_attributes(name, self._choices))
            for dim, (name, values) in zip(self.dims, self._by_input.items(), strict=True)
        }

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        parts = [values[part] for values, part in zip(self._by_input.values(), box, strict=True)]
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
        inputs: dict[str, NDArray[Any]] = {}
        for (name, reach), secret in zip(self._by_input.items(), words, strict=True):
            values = reach.at(fractions(index, self.samples, secret))
            inputs[name] = values.astype(known.CODE) if name in self._choices else values
        return inputs

    def _description(self) -> dict[str, Any]:
        whole = {"samples": self.samples, "seed": self.seed, "order": list(self.names)}
        return {"kind": "latin hypercube", **whole, "ranges": self._described(Range._asdict)}


def _choices(what: str, values: Any) -> known.Choices:
    """Return the choices of the inputs that have names; InputError for what is not an input."""
    inputs = checked_type(what, values, Mapping, "must be a mapping from names of inputs to values")
    named = (name for name in known.checked_names(inputs) if name in known.CHOSEN)
    return {name: known.read_choices(name, inputs[name]) for name in named}
