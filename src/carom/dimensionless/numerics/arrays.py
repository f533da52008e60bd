"""What kernels take and give: arrays of a type and a number of dimensions, contiguous."""

from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array as Array


class ArrayType(NamedTuple):
    """The type of an array: that of its items, and the number of its dimensions.

    Annotations of kernels carry it themselves, since NumPy's own have changed their inner form from
    one version to the next. Items of type `np.floating` may be of any floating type.
    """

    dtype: Any
    ndim: int


Vector = Annotated[Array, ArrayType(np.float64, 1)]
Matrix = Annotated[Array, ArrayType(np.float64, 2)]
Cube = Annotated[Array, ArrayType(np.float64, 3)]
Codes = Annotated[NDArray[np.int8], ArrayType(np.int8, 1)]
CodePairs = Annotated[NDArray[np.int8], ArrayType(np.int8, 2)]
Counts = Annotated[NDArray[np.int64], ArrayType(np.int64, 1)]
CountTable = Annotated[NDArray[np.int64], ArrayType(np.int64, 2)]
Flags = Annotated[NDArray[np.bool_], ArrayType(np.bool_, 1)]
Words = Annotated[NDArray[np.uint64], ArrayType(np.uint64, 1)]
