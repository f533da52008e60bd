"""What every sweep is kept in: a labelled dataset, here in memory."""

import json
from collections.abc import Mapping
from hashlib import sha256
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.io.labels import labelled_dataset, spheres
from carom.quantities.refusals import refusal
from carom.sweeps.blocks import Box, Values, boxes
from carom.sweeps.problem import SweepProblem

if TYPE_CHECKING:
    import xarray as xr

MOST = 50_000_000  # points in memory: some GB
LONG = 1000  # values of an axis; the dataset has them as its coordinate


class SweepStopped(RuntimeError):
    """A sweep could not go on; the message says why, what is safe, and how to continue."""


class MemoryRecord:
    """A sweep in memory, of which nothing is left if it is stopped."""

    def __init__(self, problem: SweepProblem) -> None:
        self._problem = problem
        shape = problem.design.shape
        try:
            if prod(shape) > MOST:
                raise MemoryError
            self._arrays = {
                name: np.empty(shape, info.dtype) for name, info in problem.variables().items()
            }
        except MemoryError:
            allowed = "its results do not fit into memory; give a store, --store DIR.zarr (store=)"
            raise refusal("design", f"{prod(shape)} points", allowed) from None
        self.todo = list(boxes(shape, problem.chunks()))

    def write(self, box: Box, values: Values) -> None:
        """Keep a block."""
        for name, part in values.items():
            self._arrays[name][box] = part

    def safe(self) -> str:
        """Return what has been finished, and how to go on."""
        return "nothing is stored; with --store DIR.zarr (store=) you could continue it"

    def dataset(self) -> "xr.Dataset":
        """Return the sweep."""
        return blank_dataset(self._problem, self._arrays)


def blank_dataset(
    problem: SweepProblem, arrays: Mapping[str, NDArray[Any]] | None = None
) -> "xr.Dataset":
    """Return the dataset of a sweep with its coordinates, and with these arrays as variables."""
    known = problem.variables()
    variables = {
        name: (problem.design.dims, values, known[name].attributes)
        for name, values in (arrays or {}).items()
    }
    title = f"sweep of oblique impacts of {spheres(problem.loses)}"
    attributes = {"title": title, "inputs": identity(problem)}
    return labelled_dataset(variables, problem.design.coords(), attributes)


def identity(problem: SweepProblem) -> dict[str, Any]:
    """Return what tells a sweep from others as JSON holds it, a hash for what is long."""
    whole: dict[str, Any] = _condensed(json.loads(json.dumps(problem.description())))
    return whole


def _condensed(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _condensed(part) for name, part in value.items()}
    if isinstance(value, list) and len(value) > LONG:
        digest = sha256(json.dumps(value).encode()).hexdigest()
        return {"length": len(value), "first": value[0], "last": value[-1], "sha256": digest}
    return value
