"""What the simulations say: means over seeds, differences from the exact law, and their bars.

Laws of Hertz's normal force that share a seed start from the same spheres, and so do those of
linear springs. A bar is the standard error of a mean over seeds. As seeds are few, their scatter is
pooled over the laws that start from the same spheres; they go up and down together, so that the bar
of two seeds is a rough one.
"""

from collections.abc import Callable
from math import exp, log, sqrt
from typing import NamedTuple

import numpy as np

from bulk import simulations
from bulk.contact_laws import EXACT, LAWS, named

Sample = dict[int, float]  # by seed
COMPARED = {law.name for law in LAWS}


class Mean(NamedTuple):
    """A mean and its bar."""

    value: float
    bar: float

    def scaled(self, factor: float) -> "Mean":
        """Return it in another unit."""
        return Mean(factor * self.value, factor * self.bar)

    def text(self, digits: int) -> str:
        """Return it with its bar in units of the last digit, as 0.340(11), or whole, 17.1(1.5)."""
        bar = f"{self.bar:.{digits}f}" if self.bar >= 1.0 else f"{self.bar * 10**digits:.0f}"
        return f"{self.value:.{digits}f}({bar})"


class Cell(NamedTuple):
    """A quantity that an experiment gave with a law."""

    experiment: str
    law: str
    friction: float
    restitution: float
    at: float
    quantity: str
    where: float
    size: int
    step: float = 1.0


def _read() -> dict[Cell, Sample]:
    cells: dict[Cell, Sample] = {}
    for run, numbers in simulations.read().items():
        for found in numbers:
            key = (*run[:5], found.quantity, found.where, run.size, run.step)
            cells.setdefault(Cell(*key), {})[run.seed] = found.value
    return cells


CELLS = _read()


def _compared(cell: Cell, compare: Callable[[float, float], float]) -> Sample:
    """Return a law compared with the exact one, by the seeds of both."""
    mine, exact = CELLS[cell], CELLS[cell._replace(law=EXACT.name)]
    return {seed: compare(mine[seed], exact[seed]) for seed in mine.keys() & exact.keys()}


def _mean(cell: Cell, sample: Callable[[Cell], Sample], laws: list[Cell]) -> Mean:
    """Return the mean of a sample, its bar by the scatter over seeds of those of some laws."""
    samples = [list(sample(other).values()) for other in laws]
    freedom = sum(len(each) - 1 for each in samples if each)
    squares = sum(len(each) * np.var(each) for each in samples if each)
    values = list(sample(cell).values())
    scatter = sqrt(squares / freedom) if freedom else float("nan")
    return Mean(float(np.mean(values)), scatter / sqrt(len(values)))


def _alike(cell: Cell) -> list[Cell]:
    """Return this cell and those of the laws that start from the same spheres."""
    linear = named(cell.law).linear if cell.law in COMPARED else None
    laws = [law.name for law in LAWS if law.linear == linear and law.name != cell.law]
    cells = (cell._replace(law=law) for law in (cell.law, *laws))
    return [other for other in cells if other in CELLS]


def _others(cell: Cell) -> list[Cell]:
    """Return those of them that are compared with the exact law."""
    return [other for other in _alike(cell) if other.law != EXACT.name]


def mean(cell: Cell) -> Mean:
    """Return the mean of a quantity."""
    return _mean(cell, lambda each: CELLS[each], _alike(cell))


def excess(cell: Cell) -> Mean:
    """Return the mean difference from the exact law."""
    return _mean(
        cell, lambda each: _compared(each, lambda mine, exact: mine - exact), _others(cell)
    )


def ratio(cell: Cell) -> Mean:
    """Return the geometric mean of a quantity over that of the exact law."""
    logs = _mean(
        cell, lambda each: _compared(each, lambda mine, exact: log(mine / exact)), _others(cell)
    )
    return Mean(exp(logs.value), exp(logs.value) * logs.bar)
