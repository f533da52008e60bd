"""One quasi-static step of the contact: from one position of the bodies to the next."""

from math import ceil
from typing import NamedTuple

import numpy as np
import scipy.fft

from carom.halfspace.compliance import Compliance, Materials
from carom.halfspace.influence import Field, Mask
from carom.halfspace.traction import solve_pressure, solve_traction

EXCHANGES = 60  # between normal and tangential contact of unlike materials
MARGIN = 1.06  # of the grid over the largest contact


class Tolerances(NamedTuple):
    """How far the solvers go: of the overlap, of the largest bound, of either in an exchange."""

    normal: float = 1e-6
    tangential: float = 1e-6
    exchange: float = 1e-5
    touch: float = 1e-3  # only to see which elements touch


DEFAULT = Tolerances()


class ContactState(NamedTuple):
    """The contact at an instant: position of the bodies and the tractions that belong to it."""

    depth: float  # d, approach of the bodies
    displacement: Field  # U, tangential, shape (2,)
    pressure: Field  # shape (n, n)
    traction: Field  # of the first body on the second, over friction, shape (2, n, n)
    yielded: Field  # tangential displacement that the surfaces gave way, shape (2, n, n)


class ContactStep(NamedTuple):
    """What one step leads to."""

    state: ContactState
    moved: Field  # U less what the surfaces gave way, in this step, shape (2, n, n)
    gripped: Mask  # elements under friction in this step: not those that touch since its middle


class Patch:
    """Two bodies on a square grid: a paraboloid and what it is pressed against.

    The first contact is in the middle of the grid, where four elements meet.
    """

    def __init__(self, compliance: Compliance, tolerances: Tolerances = DEFAULT) -> None:
        self.compliance, self.tolerances = compliance, tolerances
        size = compliance.size
        self.line = (np.arange(size) - 0.5 * (size - 1)) * compliance.spacing
        self.gap = 0.5 * (self.line[:, None] ** 2 + self.line[None, :] ** 2)
        self.element = compliance.spacing**2

    @classmethod
    def across(
        cls, elements: int, materials: Materials, tolerances: Tolerances = DEFAULT
    ) -> "Patch":
        """Return the patch with so many elements across the contact of radius 1."""
        size = 2 * ceil(0.5 * MARGIN * elements + 1.0)
        while scipy.fft.next_fast_len(size, real=True) != size:
            size += 2
        return cls(Compliance(size, 2.0 / elements, materials), tolerances)

    def untouched(self) -> ContactState:
        """Return the state at the first touch."""
        size = self.compliance.size
        nothing = np.zeros((2, size, size))
        return ContactState(0.0, np.zeros(2), nothing[0], nothing, nothing)

    def advance(self, state: ContactState, depth: float, displacement: Field) -> ContactStep:
        """Return the contact after the bodies have moved in a straight line.

        Elements that come to touch in the second half of the step take no traction yet and stick
        from its end on, those of the first half stick from its beginning: to second order in the
        step, each then sticks from its own touch. For unlike materials the normal and the
        tangential contact are solved in turns, each with the other's result.
        """
        late = self._late(state, depth)
        pressure, traction = state.pressure, state.traction
        given = (displacement - state.displacement)[:, None, None] + state.yielded
        for _ in range(EXCHANGES):
            before = pressure, traction
            overlap = self._overlap(depth, traction)
            pressure = solve_pressure(self.compliance, overlap, pressure, self.tolerances.normal)
            skewed = self.compliance.tangential_of_pressure(pressure)
            bound = np.where(late, 0.0, pressure)
            traction, dragged = solve_traction(
                self.compliance, given - skewed, bound, traction, self.tolerances.tangential
            )
            yielded = dragged + skewed
            if not self.compliance.couples or self._settled(before, (pressure, traction)):
                reached = ContactState(depth, displacement, pressure, traction, yielded)
                return ContactStep(reached, given - yielded, bound > 0.0)
        product = self.compliance.materials.friction * abs(self.compliance.materials.beta)
        raise RuntimeError(
            f"normal and tangential contact do not agree in {EXCHANGES} exchanges; friction times "
            f"Dundurs' beta is {product:.3g}, boundary elements want about 1 at most"
        )

    def _overlap(self, depth: float, traction: Field) -> Field:
        return depth - self.gap - self.compliance.normal_of_traction(traction)

    def _late(self, state: ContactState, depth: float) -> Mask:
        """Return the elements that come to touch in the second half of a step."""
        if depth <= state.depth:
            return np.zeros(self.gap.shape, dtype=bool)
        overlap = self._overlap(0.5 * (state.depth + depth), state.traction)
        middle = solve_pressure(self.compliance, overlap, state.pressure, self.tolerances.touch)
        apart = middle <= self.tolerances.normal * middle.max()
        return np.asarray((state.pressure == 0.0) & apart)

    def _settled(self, before: tuple[Field, Field], after: tuple[Field, Field]) -> bool:
        return all(
            np.abs(new - old).max() <= self.tolerances.exchange * np.abs(new).max()
            for old, new in zip(before, after, strict=True)
        )
