"""What page and figures ask the table for, experiment by experiment."""

import numpy as np

from bulk import decay, drum, gas, modulus, shear
from bulk.contact_laws import EXACT
from bulk.results import CELLS, Cell, Mean, mean

LATER = 49.0  # durations of an impact after the boost


def left(law: str, friction: float, restitution: float, where: float = LATER) -> Cell:
    """Return the kinetic energy left in a packing."""
    return Cell("decay", law, friction, restitution, 0.0, "kinetic", where, decay.SIZE)


def sheared(law: str, friction: float, strain: float, quantity: str) -> Cell:
    """Return a quantity of a packing sheared to and fro."""
    return Cell("modulus", law, friction, 1.0, strain, quantity, strain, modulus.SIZE)


def flowing(law: str, friction: float, inertia: float, quantity: str) -> Cell:
    """Return a quantity of simple shear."""
    return Cell("shear", law, friction, 0.9, inertia, quantity, inertia, shear.SIZE)


def turned(law: str, friction: float, quantity: str) -> Cell:
    """Return an angle of the drum."""
    size = round(2 * drum.RADIUS)
    return Cell("drum", law, friction, 0.9, drum.FROUDE, quantity, drum.FROUDE, size)


def cooled(law: str, friction: float, quantity: str, time: float) -> Cell:
    """Return a part of the energy of a gas."""
    return Cell("gas", law, friction, 1.0, gas.FRACTION, quantity, time, gas.SIZE)


def over_blocks(cell: Cell) -> Mean:
    """Return the mean over seeds, its bar from blocks of the runs or the seeds, the larger."""
    values, errors = CELLS[cell], CELLS[cell._replace(quantity=cell.quantity + "_error")]
    bar = float(np.sqrt(sum(error**2 for error in errors.values())) / len(errors))
    return Mean(float(np.mean(list(values.values()))), float(np.nanmax([bar, mean(cell).bar])))


def both_ways(friction: float, quantity: str, time: float) -> tuple[Mean, Mean]:
    """Return what is left in a gas by time stepping and by events, bars by their common scatter."""
    cell = cooled(EXACT.name, friction, quantity, time)
    samples = [list(CELLS[each].values()) for each in (cell, cell._replace(law=gas.EVENTS))]
    squares = sum(len(sample) * np.var(sample) for sample in samples)
    scatter = np.sqrt(squares / (sum(map(len, samples)) - 2))
    one, other = (
        Mean(float(np.mean(sample)), float(scatter / np.sqrt(len(sample)))) for sample in samples
    )
    return one, other
