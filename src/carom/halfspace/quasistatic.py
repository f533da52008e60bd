"""The elements of a contact, and one step of it: from one position of the bodies to the next."""

from collections.abc import Sequence
from math import ceil
from typing import Any, NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from carom.halfspace.compliance import Compliance, Materials
from carom.halfspace.traction import at_bound, solve_pressure, solve_traction
from carom.halfspace.transforms import NO_MIRRORS, Field, Mask, Mirrors

MARGIN = 1.06  # of the grid over the largest contact
TOLERANCE = 1e-6  # of the overlap, and of the largest bound
EXCHANGED = 1e-5  # of either, in an exchange between normal and tangential contact
TURNED = 1e-3  # of the largest pressure, by the direction of slip
MOST_EXCHANGES = 60
FIRST_TOLERANCE, NEXT_TOLERANCE = (1e-3, 0.03)  # first, and then of what changes
RELAXED = 0.8  # of a change of direction: friction turned one way makes slip turn back
TINY = 1e-300  # tractions of no motion are zero
TURNING_EXCHANGES = 8  # exchanges after which the direction of slip is left as it is
SLIPPING = 1e-5  # of its bound: as near to that a traction slips

CLOSING = 1e-3  # of the approach: a gap that closes by less tells nothing of the edge
LARGEST_TURN = 0.5  # its cosine: slip that turns by more in a step starts anew


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


class ContactState(NamedTuple):
    """The contact at an instant: the bodies, what belongs to their position, and the last step."""

    depth: float  # d, approach of the bodies
    displacement: Field  # U along x and y, and the turn about the normal, shape (3,)
    pressure: Field  # shape (n, n)
    traction: Field  # of the first body on the second, over friction, shape (2, n, n)
    bound: Field  # that friction sets to the traction
    yielded: Field  # tangential displacement that the surfaces gave way, shape (2, n, n)
    gap: Field  # between the surfaces
    aside: Field  # see `second_order`
    slip: Field  # over the length of the step, where there is any
    rates: Sequence[Field]  # of pressure and traction
    length: float  # of the step

    @property
    def loads(self) -> tuple[Field, Field]:
        return self.pressure, self.traction


class ContactStep(NamedTuple):
    """What one step leads to."""

    state: ContactState
    moved: Field  # bodies less surfaces, since they touch, shape (2, n, n)
    heading: Field  # where that moves at the end of the step: what slips has its traction along it

    @property
    def touching(self) -> Mask:
        """Elements that bear pressure."""
        return self.state.pressure > 0.0

    @property
    def slips(self) -> Mask:
        """Elements whose traction is as large as friction allows."""
        return slipping(self.state.traction, self.state.bound)


class Patch:
    """Two bodies on a grid: a paraboloid and what it is pressed against."""

    def __init__(self, compliance: Compliance) -> None:
        self.compliance = compliance
        self.grid = Grid(compliance.size, compliance.spacing, compliance.mirrors)

    @classmethod
    def across(cls, elements: int, materials: Materials, mirrors: Mirrors = NO_MIRRORS) -> "Patch":
        """Return the patch with so many elements across the contact of radius 1."""
        size = elements_across(elements)
        return cls(Compliance(size, 2.0 / elements, materials, mirrors))

    def untouched(self) -> ContactState:
        """Return the state at the first touch."""
        apart = self.grid.apart
        none, nothing = np.zeros_like(apart), np.zeros((2, *apart.shape))
        surfaces = (none, nothing, none, nothing, apart, nothing, nothing)
        return ContactState(0.0, np.zeros(3), *surfaces, (none, nothing), 1.0)

    def bound(self, pressure: Field) -> Field:
        """Return what friction bears under a pressure, over the coefficient of friction."""
        return pressure

    def advance(
        self, state: ContactState, depth: float, displacement: Field, length: float = 1.0
    ) -> ContactStep:
        """Return the contact after the bodies have moved in a straight line, to second order.

        Elements stick from their own touch on; traction is along the slip at the end of the step.
        """
        carried = self.grid.carried(displacement - state.displacement)
        followed, approach = carried + state.yielded, depth - state.depth
        open_ = np.where(state.pressure > 0.0, 0.0, state.gap)
        early = before_touch(open_, carried, approach, state.aside)
        share = length / (length + state.length)
        start = (now + length * rate for now, rate in zip(state.loads, state.rates, strict=True))
        balanced = self._balance(_Asked(depth, followed, early, state.slip, share), *start)
        rates = [
            (now - last) / length for now, last in zip(balanced.loads, state.loads, strict=True)
        ]
        closed = np.where(balanced.gap > 0.0, state.gap - balanced.gap, 0.0)
        aside = aside_of_bodies(closed, followed - balanced.yielded, carried, approach)
        slip = np.where(slipping(balanced.loads[1], balanced.bound), balanced.moved / length, 0.0)
        surfaces = (*balanced.loads, balanced.bound, balanced.yielded, balanced.gap, aside, slip)
        reached = ContactState(depth, displacement, *surfaces, rates, length)
        return ContactStep(reached, balanced.moved, balanced.moved - balanced.turn)

    def _balance(self, asked: "_Asked", pressure: Field, traction: Field) -> "_Balance":
        """Return normal and tangential contact and slip direction, solved in turns."""
        surface = self.compliance
        turn, rough = np.zeros_like(traction), FIRST_TOLERANCE if surface.couples else 0.0
        for count in range(MOST_EXCHANGES):
            before, used = (pressure, traction), turn
            overlap = asked.depth - self.grid.apart - surface.normal_of_traction(traction)
            finer = max(TOLERANCE, rough)
            pressure, sunk = solve_pressure(surface, overlap, pressure, finer)
            skewed = surface.tangential_of_pressure(pressure)
            since = asked.followed - np.where(pressure > 0.0, asked.early, 0.0)
            pull = since - skewed - used
            bound = self.bound(pressure)
            traction, dragged = solve_traction(surface, pull, bound, traction, finer)
            moved = since - skewed - dragged
            if count < TURNING_EXCHANGES:
                slips = slipping(traction, bound)
                turned = turn_to_end(moved, slips, asked.slip, asked.share)
                turn = used + RELAXED * (turned - used)
            change = _change(before, (pressure, traction)) if surface.couples else 0.0
            own = pressure.max() * surface.tangential_diagonal
            straight = np.abs(turn - used).max() <= TURNED * own
            if straight and max(change, 3.0 * rough) <= EXCHANGED:
                gap = np.maximum(sunk - overlap, 0.0)
                return _Balance((pressure, traction), bound, skewed + dragged, gap, moved, used)
            rough = min(rough, NEXT_TOLERANCE * change)
        product = surface.materials.friction * abs(surface.materials.beta)
        raise RuntimeError(
            f"normal and tangential contact differ after {MOST_EXCHANGES} exchanges; friction "
            f"times Dundurs' beta is {product:.3g}, and boundary elements need about 1 at most"
        )


class _Asked(NamedTuple):
    """What a step is about: positions, and what is known of slip."""

    depth: float
    followed: Field  # what the surfaces gave way before, and the motion of the bodies since
    early: Field  # of that, what comes before they touch
    slip: Field  # of the last step
    share: float  # of the time between the middles of steps, that the end of this one is ahead


class _Balance(NamedTuple):
    """What a step comes to."""

    loads: tuple[Field, Field]
    bound: Field
    yielded: Field
    gap: Field
    moved: Field
    turn: Field  # of the slip, what is not along its direction at the end


def slipping(traction: Field, bound: Field) -> Mask:
    """Return the elements whose traction is as large as friction allows."""
    return np.asarray((bound > 0.0) & at_bound(traction, bound, SLIPPING))


def _change(before: tuple[Field, Field], after: tuple[Field, Field]) -> float:
    """Return the largest change of pressure or traction, as a share of the largest."""
    pairs = zip(before, after, strict=True)
    return max(float(np.abs(new - old).max() / max(np.abs(new).max(), TINY)) for old, new in pairs)


def before_touch(gap: Field, carried: Field, approach: float, aside: Field) -> Field:
    """Return how far surfaces that do not touch yet move along each other before they do.

    Outside the edge both gap and motion fall as the distance to the power 3/2, so that motion goes
    with the closing of the gap: as that of the bodies does with their approach, and `aside` more.
    """
    if approach <= 0.0:
        return np.zeros_like(carried)
    return gap * (carried / approach + aside)


def aside_of_bodies(closed: Field, moved: Field, carried: Field, approach: float) -> Field:
    """Return surfaces' motion over the closing of their gap, less the bodies'; 0 if none closes."""
    tells = closed > max(CLOSING * approach, 0.0)
    if approach <= 0.0 or not tells.any():
        return np.zeros_like(moved)
    return np.where(tells, moved / np.where(tells, closed, 1.0) - carried / approach, 0.0)


def turn_to_end(moved: Field, slips: Mask, last: Field, share: float) -> Field:
    """Return what of the slip in a step is not along its direction at the end of the step.

    The slip of this step and the `last` tell directions in the middle; the end is `share` ahead.
    """
    middle, before = _unit(moved), _unit(last)
    end = _unit(middle + share * (middle - before))
    turns = slips & (np.sum(middle * before, axis=0) > LARGEST_TURN)
    return np.where(turns, moved - np.sum(moved * end, axis=0) * end, 0.0)


def _unit(vectors: Field) -> Field:
    size = np.hypot(*vectors)
    return vectors / np.where(size > 0.0, size, 1.0)
