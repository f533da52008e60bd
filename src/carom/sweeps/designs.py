"""Designs: which impacts a sweep consists of. A full grid, a Latin hypercube, a table of cases."""

from typing import Any, Protocol

from numpy.typing import NDArray

from carom.sweeps.grids import Grid
from carom.sweeps.hypercubes import LatinHypercube
from carom.sweeps.inputs import Box, Choices
from carom.sweeps.tables import Table

__all__ = ["Box", "Design", "Grid", "LatinHypercube", "Table"]


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
        """Return the coordinates for `carom.results.labelled_dataset`."""

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box in C order: SI numbers, or codes of choices."""

    def description(self) -> dict[str, Any]:
        """Return what tells this design from others, as JSON can hold it."""
