"""What a table of the exact rebound holds: series of r between kinks, with and without losses.

psi_1 - psi_2 = x (1 - r), x = psi_1/(1 + bend psi_1). Without losses the bend is zero, so that
r = psi_2/psi_1. With losses gross slip throughout is a limit only: psi_2 exceeds psi_1 - S,
S = 2 chi (1 + e), by a part that dies away as 1/psi_1, due to the belt laid in stick at the edge.
With bend = 1/S all psi_1 lie in 0 <= x < S, and r(S) = 0 is that limit.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.losses import KelvinVoigt
from carom.dimensionless.elastic.batch import solved
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.numerics.chebyshev import Panels, fitted
from carom.dimensionless.rebounds import rebound, regime_borders
from carom.io.progress import advancing
from carom.laws.rules import DEGREE
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal

Branches = NDArray[np.int64]

LARGEST_CHI = 100.0  # tables of larger ones would take minutes
SMALLEST, LOSSY_SMALLEST = 1e-6, 1e-3  # psi_1: below, r is that of the first panel
TOLERANCE = 4e-10  # of the tail of a series; the error stays below 1e-9
LOSSY_TOLERANCE = 1e-7
FAR, END = 1e4, 1e12  # psi_1/S: beyond, what is lacking is taken for c/psi_1; for nothing


class Reach(NamedTuple):
    """How large a loss of psi can be, 2 chi (1 + e), and how psi_1 is bent to a finite range."""

    sliding: float
    bend: float

    def bent(self, psi: Array) -> Array:
        """Return x at psi_1 >= 0."""
        return psi / (1.0 + self.bend * psi)

    def straight(self, x: Array) -> Array:
        """Return psi_1 at x."""
        return x / (1.0 - self.bend * x)


def reach_of(chi: float, restitution: float) -> Reach:
    """Return the reach of the rebounds at one chi and e."""
    sliding = 2.0 * chi * (1.0 + restitution)
    return Reach(sliding, 0.0 if restitution == 1.0 else 1.0 / sliding)


def panel_ends(chi: float, restitution: float) -> list[float]:
    """Return psi_1 between which panels lie, of the first and the last and of known kinks."""
    if restitution != 1.0:
        return [LOSSY_SMALLEST, END * reach_of(chi, restitution).sliding]
    return [SMALLEST, *np.unique(regime_borders(chi)).tolist()]


def elastic_panels(chi: float) -> Panels:
    """Return the table of r = psi_2/psi_1 between the regime borders."""
    with advancing("table of rebounds", None, unit="impacts") as advance:

        def ratio(psi: Array) -> tuple[Array, Branches]:
            outgoing, status, sequence = solved(psi, np.full(psi.size, chi))
            _refuse_unsolved(chi, status)
            advance(psi.size)
            return outgoing / psi, sequence

        return fitted(ratio, panel_ends(chi, 1.0), DEGREE, TOLERANCE, singular=(1.0,))


def lossy_panels(chi: float, restitution: float) -> Panels:
    """Return the table of r at one e, found by its error alone; a bar tells of it after 2 s."""
    reach, ends = reach_of(chi, restitution), panel_ends(chi, restitution)
    loss = KelvinVoigt(restitution=restitution)
    with advancing("table of rebounds", None, unit="impacts") as advance:

        def outgoing(psi: Array) -> Array:
            psi_out, status = rebound(psi, chi, normal=loss, return_status=True)
            _refuse_unsolved(chi, status)
            advance(psi.size)
            return np.asarray(psi_out)

        far = FAR * reach.sliding
        lacking = far * (outgoing(np.array([far]))[0] - (far - reach.sliding))

        def ratio(x: Array) -> tuple[Array, Branches]:
            psi = reach.straight(x)
            lost, near = reach.sliding - lacking / psi, psi < far
            lost[near] = psi[near] - outgoing(psi[near])
            return 1.0 - lost / x, np.zeros(x.size, dtype=np.int64)

        found = fitted(ratio, list(reach.bent(np.array(ends))), DEGREE, LOSSY_TOLERANCE)
    edges = reach.straight(found.edges)
    edges[[0, -1]] = ends
    return Panels(edges, found.coefficients)


def _refuse_unsolved(chi: float, status: NDArray[np.int8]) -> None:
    if np.any(status):
        message = Status(int(status[status != 0][0])).message
        raise refusal("chi", chi, f"its rebounds are {message}")
