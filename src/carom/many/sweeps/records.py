"""What every sweep is kept in, here in memory; and what came of it, in few numbers."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from hashlib import sha256
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.io.labels import labelled_dataset
from carom.many.sweeps.designs import Box, Values, boxes, chunk_shape
from carom.many.sweeps.points import WITH_RESULTS, PointStatus
from carom.many.sweeps.problem import SweepProblem
from carom.quantities.refusals import refusal

if TYPE_CHECKING:
    import xarray as xr

MOST_IN_MEMORY = 50_000_000  # points: some GB
LONG_AXIS = 1000  # values of an axis; the dataset has them as its coordinate


class SweepStopped(RuntimeError):
    """A sweep could not go on; the message says why, what is safe, and how to continue."""


class MemoryRecord:
    """A sweep in memory, of which nothing is left if it is stopped."""

    def __init__(self, problem: SweepProblem) -> None:
        self._problem = problem
        shape = problem.design.shape
        try:
            if prod(shape) > MOST_IN_MEMORY:
                raise MemoryError
            self._arrays = {
                name: np.empty(shape, info.dtype) for name, info in problem.variables().items()
            }
        except MemoryError:
            allowed = "its results do not fit into memory; give a store, --store DIR.zarr (store=)"
            raise refusal("design", f"{prod(shape)} points", allowed) from None
        self.todo = list(boxes(shape, problem.chunks()))

    def write(self, box: Box, values: Values) -> None:
        for name, part in values.items():
            self._arrays[name][box] = part

    def safe(self) -> str:
        """Return what has been finished, and how to go on."""
        return "nothing is stored; with --store DIR.zarr (store=) you could continue it"

    def dataset(self) -> "xr.Dataset":
        return blank_dataset(self._problem, self._arrays)


def blank_dataset(
    problem: SweepProblem, arrays: Mapping[str, NDArray[Any]] | None = None
) -> "xr.Dataset":
    """Return the dataset of a sweep with its coordinates, and with these arrays as variables."""
    infos = problem.variables()
    variables = {
        name: (problem.design.dims, values, infos[name].attributes)
        for name, values in (arrays or {}).items()
    }
    title = f"sweep of oblique impacts of {problem.bodies}"
    attributes = {"title": title, "inputs": identity(problem)}
    return labelled_dataset(variables, problem.design._coords(), attributes)


def identity(problem: SweepProblem) -> dict[str, Any]:
    """Return what tells a sweep from others as JSON holds it, a hash for what is long."""
    whole: dict[str, Any] = _condensed(json.loads(json.dumps(problem.description(), default=dict)))
    return whole


def _condensed(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _condensed(part) for name, part in value.items()}
    if isinstance(value, list) and len(value) > LONG_AXIS:
        digest = sha256(json.dumps(value).encode()).hexdigest()
        return {"length": len(value), "first": value[0], "last": value[-1], "sha256": digest}
    return value


MAIN = (
    *("rebound_speed", "rebound_angle", "spin_out", "normal_restitution"),
    *("tangential_restitution", "dissipated_energy", "lost_energy", "shear_lost_energy"),
)


class Summary(NamedTuple):
    """How many points a sweep has, how they fared, and from where to where its results go."""

    sizes: dict[str, int]
    statuses: dict[str, int]
    ranges: dict[str, tuple[float, float]]  # of what is finite; NaN if nothing is
    solved: int  # points

    @property
    def points(self) -> int:
        return sum(self.statuses.values())


def summary(dataset: "xr.Dataset", names: Sequence[str] | None = None) -> Summary:
    """Return the summary of a sweep, with the ranges of these of its results."""
    status = dataset["status"]
    shown = [name for name in names or MAIN if name in dataset]
    counts: Counter[int] = Counter()
    ranges = dict.fromkeys(shown, (np.nan, np.nan))
    for box in boxes(status.shape, status.encoding.get("chunks") or chunk_shape(status.shape)):
        values, numbers = np.unique(status[box].values, return_counts=True)
        counts.update(dict(zip(values.tolist(), numbers.tolist(), strict=True)))
        for name in shown:
            values = dataset[name][box].values
            if (finite := values[np.isfinite(values)]).size:
                least, most = np.fmin(ranges[name][0], finite.min()), finite.max()
                ranges[name] = float(least), float(np.fmax(ranges[name][1], most))
    statuses = {PointStatus(value).message: n for value, n in sorted(counts.items())}
    solved = sum(counts[status] for status in WITH_RESULTS)
    return Summary({str(n): size for n, size in dataset.sizes.items()}, statuses, ranges, solved)
