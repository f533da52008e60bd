"""The borders between regimes on a map of psi_1 and chi, as variables of its dataset."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.impacts.border_curves import border_curves
from carom.impacts.sequences import Sequences
from carom.io.progress import Progress, advancing
from carom.quantities.arrays import Array

TOLERANCE = 1e-6  # of points of a border
COARSE = 1e-3  # the same with losses, as such an impact takes a hundred times as long
MORE, COARSE_MORE = 20.0, 0.5  # impacts to refine borders, to those that find them on the grid


def border_variables(
    psi: Array, chi: Array, numbers: NDArray[np.int64], sequences: Sequences, progress: Progress
) -> dict[str, Any]:
    """Return the borders on a map whose sequences have these numbers, shape (chi, psi)."""
    (x, columns), (y, rows) = (np.unique(line, return_index=True) for line in (psi, chi))
    plain = sequences.losses is None
    tolerance, more = (TOLERANCE, MORE) if plain else (COARSE, COARSE_MORE)
    shown = False if callable(progress) else progress  # which counts the rows of the map
    with advancing("finding the borders of the regimes", None, shown, unit="impacts") as advance:

        def tell(psis: Array, chis: Array) -> NDArray[np.int64]:
            found = sequences.of(psis, chis)
            advance(psis.size)
            return found

        with np.errstate(over="ignore", invalid="ignore"):  # where values are out of all proportion
            curves = border_curves((x, y), numbers[np.ix_(rows, columns)], tell, tolerance, more)
    points = np.concatenate([np.empty((0, 2)), *(curve.points for curve in curves)])
    names = np.array(sequences.names, dtype=np.str_)
    left, right = np.array([curve[:2] for curve in curves], dtype=np.int64).reshape(-1, 2).T
    belongs = np.repeat(np.arange(len(curves)), [len(curve.points) for curve in curves])
    side = "sequence of phases on the {} of a border, in the direction of its points"
    return {
        "border_psi": ("border_point", points[:, 0]),
        "border_chi": ("border_point", points[:, 1]),
        "border_number": ("border_point", belongs.astype(np.int32)),
        "border_left": ("border_curve", names[left], {"long_name": side.format("left")}),
        "border_right": ("border_curve", names[right], {"long_name": side.format("right")}),
        "border_tolerance": tolerance,
    }
