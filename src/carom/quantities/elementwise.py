"""Functions that take numbers and arrays alike: a number in gives a plain float, not a NumPy one.

With them a formula is written once, for one impact and for a block of many; such formulas are
annotated as those of one impact. What has no value is NaN or infinite, as in IEEE arithmetic, and
nothing is raised.
"""

from collections.abc import Callable
from typing import Any

import numpy as np


def _elementwise(function: Callable[..., Any]) -> Callable[..., Any]:
    def of_numbers_or_arrays(*arguments: Any) -> Any:
        with np.errstate(all="ignore"):
            result = function(*arguments)
        return result if np.ndim(result) else result.item()

    return of_numbers_or_arrays


isfinite: Callable[[float], bool] = _elementwise(np.isfinite)
sqrt: Callable[[float], float] = _elementwise(np.sqrt)
cos: Callable[[float], float] = _elementwise(np.cos)
sin: Callable[[float], float] = _elementwise(np.sin)
copysign: Callable[[float, float], float] = _elementwise(np.copysign)
hypot: Callable[[float, float], float] = _elementwise(np.hypot)
arctan2: Callable[[float, float], float] = _elementwise(np.arctan2)
quotient: Callable[[float, float], float] = _elementwise(np.divide)
where: Callable[[bool, float, float], float] = _elementwise(np.where)
