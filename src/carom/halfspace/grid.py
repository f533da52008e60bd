"""The elements of a contact: where they are, what their tractions add to."""

from math import ceil
from typing import Any

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from carom.halfspace.transforms import Field, Mirrors

MARGIN = 1.06  # of the grid over the largest contact


class Grid:
    """Square elements around the first touch, which is in the middle, where four of them meet.

    Of mirrored axes only the positive side is kept; `element` is the area for which a kept element
    stands, `apart` the gap of the undeformed bodies at first touch, `modes` the displacements by
    which the bodies move along x, along y and about the normal, as far as the mirrors allow them.
    """

    def __init__(self, size: int, spacing: float, mirrors: Mirrors) -> None:
        self.size, self.spacing, self.mirrors = size, spacing, mirrors
        self.line = (np.arange(size) - 0.5 * (size - 1)) * spacing
        sides = [self.line[size // 2 :] if one else self.line for one in mirrors]
        x, y = np.meshgrid(*sides, indexing="ij")
        self.apart = 0.5 * (x**2 + y**2)
        self.element = mirrors.copies * spacing**2
        none, every = np.zeros_like(x), np.ones_like(x)
        along_y = none if any(mirrors) else every
        turn = [none, none] if mirrors.y else [-y, x]
        self.modes = np.array([[every, none], [none, along_y], turn])

    def force(self, pressure: Field) -> float:
        """Return what a pressure adds to."""
        return self.element * float(pressure.sum())

    def drag(self, traction: Field) -> Field:
        """Return what a traction adds to along x and y, and its moment about the normal."""
        return self.element * np.tensordot(self.modes, traction, 3)

    def carried(self, displacement: Field) -> Field:
        """Return the displacement of the surfaces with that of the bodies, shape (3,)."""
        return np.tensordot(displacement, self.modes, 1)

    def whole(self, field: NDArray[Any], odd: bool = False) -> NDArray[Any]:
        """Return a field, or a mask, on both sides of the mirrors."""
        for axis, mirrored in zip((-2, -1), self.mirrors, strict=True):
            if mirrored:
                other = np.flip(field, axis)
                field = np.concatenate([-other if odd else other, field], axis)
        return field

    def whole_vector(self, field: Field) -> Field:
        """Return tractions or displacements on both sides of the mirrors."""
        return np.stack([self.whole(field[0]), self.whole(field[1], odd=True)])


def elements_across(elements: int) -> int:
    """Return the size of a grid with so many elements across the largest contact."""
    size = 2 * ceil(0.5 * MARGIN * elements + 1.0)
    while scipy.fft.next_fast_len(size, real=True) != size:
        size += 2
    return size
