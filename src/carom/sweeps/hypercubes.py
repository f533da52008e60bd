"""Latin hypercubes: samples that fill the range of every input evenly."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from carom.quantities import counted, refusal
from carom.sweeps.inputs import (
    CHOSEN,
    CODE,
    Box,
    Choices,
    as_mapping,
    checked_names,
    fill_record,
    read_choices,
)
from carom.sweeps.permutation import fractions, secrets
from carom.sweeps.ranges import Range, read_range

MOST = 10**12  # samples, which leaves room for their places in a float


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
