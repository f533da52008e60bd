"""Full grids: every combination of the values along some axes."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from carom.sweeps.inputs import (
    CHOSEN,
    CODE,
    Array,
    Box,
    Choices,
    as_mapping,
    checked_names,
    fill_record,
    input_attributes,
    read_choices,
    variable,
)
from carom.sweeps.ranges import read_axis


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
