"""What came of a sweep, in few numbers; read block by block."""

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.sweeps.blocks import boxes, chunk_shape
from carom.sweeps.points import PointStatus

if TYPE_CHECKING:
    import xarray as xr

MAIN = (
    "rebound_speed",
    "rebound_angle",
    "spin_out",
    "normal_restitution",
    "tangential_restitution",
    "dissipated_energy",
    "lost_energy",
    "shear_lost_energy",
)


class Summary(NamedTuple):
    """How many points a sweep has, how they fared, and from where to where its results go."""

    sizes: dict[str, int]
    statuses: dict[str, int]
    ranges: dict[str, tuple[float, float]]  # of what is finite; NaN if nothing is
    solved: int  # points

    @property
    def points(self) -> int:
        """The number of points."""
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
            ranges[name] = _extended(ranges[name], dataset[name][box].values)
    statuses = {PointStatus(value).message: n for value, n in sorted(counts.items())}
    solved = counts[PointStatus.SOLVED] + counts[PointStatus.STRENGTH_NOT_KNOWN]
    return Summary({str(n): size for n, size in dataset.sizes.items()}, statuses, ranges, solved)


def _extended(span: tuple[float, float], values: NDArray[Any]) -> tuple[float, float]:
    known = values[np.isfinite(values)]
    if not known.size:
        return span
    return float(np.fmin(span[0], known.min())), float(np.fmax(span[1], known.max()))
