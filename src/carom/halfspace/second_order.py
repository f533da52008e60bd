"""What makes a step of the contact second order: elements that come to touch, slip that turns."""

import numpy as np

from carom.halfspace.influence import Field, Mask

CLOSING = 1e-3  # of the approach: a gap that closes by less tells nothing of the edge
LARGEST_TURN = 0.5  # its cosine: slip that turns by more in a step starts anew


def before_touch(gap: Field, carried: Field, approach: float, aside: Field) -> Field:
    """Return how far surfaces that do not touch yet move along each other before they do.

    Outside the edge both gap and motion fall as the distance to the power 3/2, so that motion goes
    with the closing of the gap: as that of the bodies does with their approach, and `aside` more.
    """
    if approach <= 0.0:
        return np.zeros_like(carried)
    return gap * (carried / approach + aside)


def aside_of_bodies(closed: Field, moved: Field, carried: Field, approach: float) -> Field:
    """Return the motion of the surfaces over the closing of their gap, less that of the bodies.

    Where nothing closes it is zero. `moved` is the motion in a step, `closed` what the gap did.
    """
    tells = closed > max(CLOSING * approach, 0.0)
    if approach <= 0.0 or not tells.any():
        return np.zeros_like(moved)
    return np.where(tells, moved / np.where(tells, closed, 1.0) - carried / approach, 0.0)


def turn_to_end(moved: Field, slips: Mask, last: Field, share: float) -> Field:
    """Return what of the slip in a step is not along its direction at the end of the step.

    The slip of this step and of the `last` tell the direction in the middle of each; the end is
    ahead of this middle by `share` of the time between them.
    """
    middle, before = _unit(moved), _unit(last)
    end = _unit(middle + share * (middle - before))
    turns = slips & (np.sum(middle * before, axis=0) > LARGEST_TURN)
    return np.where(turns, moved - np.sum(moved * end, axis=0) * end, 0.0)


def _unit(vectors: Field) -> Field:
    size = np.hypot(*vectors)
    return vectors / np.where(size > 0.0, size, 1.0)
