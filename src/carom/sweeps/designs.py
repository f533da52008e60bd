"""Designs: which impacts a sweep consists of. Here a full grid and a Latin hypercube."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import chain
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from carom.bodies.plausibility import doubts_of_values
from carom.dimensionless.numerics.permutation import fractions, secrets
from carom.quantities.refusals import refusal
from carom.quantities.units import counted
from carom.sweeps.axes import Range, read_axis, read_range
from carom.sweeps.blocks import Box
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

MOST = 10**12  # samples, which leaves room for their places in a float
MOST_SEED = 2**128 - 1


@dataclass(frozen=True, eq=False, init=False)
class Design(ABC):
    """What a sweep needs to know of its points: the names of their inputs, and how these vary.

    `choices` are what the codes of an input that has names stand for. Points are `sampled` if their
    inputs are variables along `point`, rather than coordinates. `_given` has the values or the
    range of each input. A box is a slice of every dimension.
    """

    names: tuple[str, ...]
    choices: Choices
    _given: Mapping[str, Any] = field(repr=False)
    sampled: ClassVar[bool] = True

    def __init__(self, choices: Choices, given: Mapping[str, Any], **more: Any) -> None:
        fields = {"names": tuple(given), "choices": choices, "_given": given, **more}
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

    def coords(self) -> dict[str, Any]:
        """Return the coordinates for `carom.io.labels.labelled_dataset`, if there are any."""
        return {}

    @abstractmethod
    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box in C order: SI numbers, or codes of choices."""

    @abstractmethod
    def description(self) -> dict[str, Any]:
        """Return what tells this design from others, as JSON can hold it."""

    def doubts(self) -> tuple[str, ...]:
        """Return what is hardly meant among the inputs, in words."""
        numbers = [
            (leaf(name), given[:2] if isinstance(given, Range) else given)
            for name, given in self._given.items()
            if name not in self.choices
        ]
        for choice in chain.from_iterable(self.choices.values()):
            numbers += choice.values.items()
        return doubts_of_values(numbers)

    def _described(self, describe: Callable[[Any], Any]) -> dict[str, Any]:
        """Return by input its choices, or what describes its values or range."""
        return {
            name: [choice.description() for choice in self.choices[name]]
            if name in self.choices
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

    sampled: ClassVar[bool] = False

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
        """Names of the dimensions, one per axis."""
        return tuple(variable(name) for name in self.names)

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of every axis."""
        return tuple(values.size for values in self._given.values())

    def coords(self) -> dict[str, Any]:
        """Return every axis with its unit and meaning."""
        labels = {name: [one.label for one in self.choices[name]] for name in self.choices}
        return {
            dim: (dim, labels.get(name, values), input_attributes(name, self.choices))
            for dim, (name, values) in zip(self.dims, self._given.items(), strict=True)
        }

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box."""
        parts = [values[part] for values, part in zip(self._given.values(), box, strict=True)]
        lattice = np.meshgrid(*parts, indexing="ij")
        return {name: at.ravel() for name, at in zip(self.names, lattice, strict=True)}

    def description(self) -> dict[str, Any]:
        """Return the values of every axis."""
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
        samples = counted("samples", samples, 1, MOST)
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
        """Number of samples."""
        return (self.samples,)

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box."""
        index = np.arange(*box[0].indices(self.samples), dtype=np.uint64)
        words = secrets(self.seed, len(self.names))
        found: dict[str, NDArray[Any]] = {}
        for (name, reach), secret in zip(self._given.items(), words, strict=True):
            values = reach.at(fractions(index, self.samples, secret))
            found[name] = values.astype(CODE) if name in self.choices else values
        return found

    def description(self) -> dict[str, Any]:
        """Return the ranges, the number of samples and the seed."""
        whole = {"samples": self.samples, "seed": self.seed, "order": list(self.names)}
        return {"kind": "latin hypercube", **whole, "ranges": self._described(Range._asdict)}


def _choices(what: str, given: Any) -> Choices:
    """Return the choices of the inputs that have names; InputError for what is not an input."""
    if not isinstance(given, Mapping):
        raise refusal(what, given, "must be a mapping from names of inputs to values")
    named = (name for name in checked_names(given) if name in CHOSEN)
    return {name: read_choices(name, given[name]) for name in named}
