"""A sweep cut into blocks: boxes of points, each one chunk of every array of a store."""

from collections.abc import Iterator, Sequence
from itertools import product
from math import ceil, prod
from typing import Any

from numpy.typing import NDArray

Box = tuple[slice, ...]
Values = dict[str, NDArray[Any]]

FEWEST, MOST = 1024, 2**14  # points of a block
BLOCKS = 32  # that a sweep of middling size is cut into


def chunk_shape(shape: Sequence[int], cost: int = 1) -> tuple[int, ...]:
    """Return the shape of the blocks of a sweep, filled from its last axis on.

    Blocks have fewer points where each point costs more.
    """
    room = min(max(prod(shape) // BLOCKS, FEWEST // cost), MOST // cost)
    chunks = []
    for length in reversed(shape):
        pieces = ceil(length / max(1, min(length, room)))
        chunks.append(ceil(length / pieces))
        room //= chunks[-1]
    return tuple(reversed(chunks))


def boxes(shape: Sequence[int], chunks: Sequence[int]) -> Iterator[Box]:
    """Yield every block of an array of this shape, the last axis fastest."""
    starts = (range(0, length, chunk) for length, chunk in zip(shape, chunks, strict=True))
    for corner in product(*starts):
        yield tuple(
            slice(start, min(start + chunk, length))
            for start, chunk, length in zip(corner, chunks, shape, strict=True)
        )


def points_in(box: Box) -> int:
    """Return the number of points of a block."""
    return prod(part.stop - part.start for part in box)
