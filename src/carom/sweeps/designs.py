"""Designs: which impacts a sweep consists of. A full grid, a Latin hypercube, a table of cases."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array
from carom.quantities.units import counted, refusal
from carom.sweeps.axes import Range, read_axis, read_range
from carom.sweeps.inputs import (
    CHOSEN,
    CODE,
    Box,
    Choices,
    as_mapping,
    checked_names,
    fill_record,
    input_attributes,
    read_choices,
    variable,
)
from carom.sweeps.permutation import fractions, secrets
from carom.sweeps.tables import Table

__all__ = ["Box", "Design", "Grid", "LatinHypercube", "Table"]
MOST = 10**12  # samples, which leaves room for their places in a float


@dataclass(frozen=True, eq=False, init=False)
class Grid:
    """Every combination of the values along some axes.

    Parameters
    ----------
    axes : mapping
        By name of input, e.g. "angle" or "first.radius": a list of numbers or of texts with units,
        an array, or a range such as {"from": "0 deg", "to": "85 deg", "points": 86, "spacing":
        "linear"} ("log" spaces evenly in the logarithm). For "first.material", "second.material"
        and "second.kind" a list of names. The last axis varies fastest.

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

    names: tuple[str, ...]
    choices: Choices
    _axes: tuple[Array, ...] = field(repr=False)
    sampled: ClassVar[bool] = False

    def __init__(self, axes: Mapping[str, Any]) -> None:
        names = checked_names(as_mapping("axes", axes))
        choices = {name: read_choices(name, axes[name]) for name in names if name in CHOSEN}
        values = (
            np.arange(len(choices[name]), dtype=CODE)
            if name in choices
            else read_axis(name, axes[name])
            for name in names
        )
        fill_record(self, names=names, choices=choices, _axes=tuple(values))

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions, one per axis."""
        return tuple(variable(name) for name in self.names)

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of every axis."""
        return tuple(values.size for values in self._axes)

    def coords(self) -> dict[str, Any]:
        """Return every axis with its unit and meaning."""
        return {
            variable(name): (
                variable(name),
                [choice.label for choice in self.choices[name]] if name in self.choices else values,
                input_attributes(name, self.choices),
            )
            for name, values in zip(self.names, self._axes, strict=True)
        }

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box."""
        parts = [values[part] for values, part in zip(self._axes, box, strict=True)]
        lattice = np.meshgrid(*parts, indexing="ij")
        return {name: at.ravel() for name, at in zip(self.names, lattice, strict=True)}

    def description(self) -> dict[str, Any]:
        """Return the values of every axis."""
        axes = {
            name: [choice.description() for choice in self.choices[name]]
            if name in self.choices
            else values.tolist()
            for name, values in zip(self.names, self._axes, strict=True)
        }
        return {"kind": "grid", "order": list(self.names), "axes": axes}


class Design(Protocol):
    """What a sweep needs to know of its points; box: a slice of every dimension."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the inputs."""

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of points along every dimension."""

    @property
    def choices(self) -> Choices:
        """What the codes of an input that has names stand for."""

    @property
    def sampled(self) -> bool:
        """Whether inputs are variables along `point`, rather than coordinates."""

    def coords(self) -> dict[str, Any]:
        """Return the coordinates for `carom.io.labels.labelled_dataset`."""

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box in C order: SI numbers, or codes of choices."""

    def description(self) -> dict[str, Any]:
        """Return what tells this design from others, as JSON can hold it."""


@dataclass(frozen=True, eq=False, init=False)
class LatinHypercube:
    """Samples that fill the range of every input evenly (McKay, Beckman & Conover 1979).

    x_ij = (p_j(i) + u_ij)/n with permutations p_j and random u_ij in (0, 1), each computed where it
    is needed: of n equal parts of the range of an input each holds exactly one sample.

    Parameters
    ----------
    ranges : mapping
        By name of input: (first, last), or {"from": ..., "to": ..., "spacing": "linear" or "log"};
        for "first.material", "second.material" and "second.kind" a list of names.
    samples : int
        Number of points n.
    seed : int
        Which of the samples of this kind.

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

    names: tuple[str, ...]
    choices: Choices
    samples: int
    seed: int
    _ranges: tuple[Range, ...] = field(repr=False)
    dims: ClassVar[tuple[str, ...]] = ("point",)
    sampled: ClassVar[bool] = True

    def __init__(self, ranges: Mapping[str, Any], *, samples: int, seed: int = 0) -> None:
        names = checked_names(as_mapping("ranges", ranges))
        choices = {name: read_choices(name, ranges[name]) for name in names if name in CHOSEN}
        read = (
            Range(0.0, len(choices[name]), False)
            if name in choices
            else read_range(name, ranges[name])
            for name in names
        )
        fill_record(
            self,
            names=names,
            choices=choices,
            samples=_counted(samples),
            seed=counted("seed", seed, 0),
            _ranges=tuple(read),
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of samples."""
        return (self.samples,)

    def coords(self) -> dict[str, Any]:
        """Return no coordinates: the inputs are variables."""
        return {}

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box."""
        index = np.arange(*box[0].indices(self.samples), dtype=np.uint64)
        words = secrets(self.seed, len(self.names))
        found: dict[str, NDArray[Any]] = {}
        for name, reach, secret in zip(self.names, self._ranges, words, strict=True):
            values = reach.at(fractions(index, self.samples, secret))
            found[name] = values.astype(CODE) if name in self.choices else values
        return found

    def description(self) -> dict[str, Any]:
        """Return the ranges, the number of samples and the seed."""
        ranges = {
            name: [choice.description() for choice in self.choices[name]]
            if name in self.choices
            else reach._asdict()
            for name, reach in zip(self.names, self._ranges, strict=True)
        }
        whole = {"samples": self.samples, "seed": self.seed, "order": list(self.names)}
        return {"kind": "latin hypercube", **whole, "ranges": ranges}


def _counted(samples: int) -> int:
    if counted("samples", samples, 1) > MOST:
        raise refusal("samples", samples, f"must be at most {MOST:g}")
    return int(samples)
