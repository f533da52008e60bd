"""What kernels take and give: arrays of a type and a number of dimensions, contiguous."""

from typing import Annotated

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

Vector = Annotated[Array, 1]
Matrix = Annotated[Array, 2]
Cube = Annotated[Array, 3]
Codes = Annotated[NDArray[np.int8], 1]
CodePairs = Annotated[NDArray[np.int8], 2]
Counts = Annotated[NDArray[np.int64], 1]
CountTable = Annotated[NDArray[np.int64], 2]
Flags = Annotated[NDArray[np.bool_], 1]
Words = Annotated[NDArray[np.uint64], 1]
