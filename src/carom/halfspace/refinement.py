"""How finely an impact is solved, and what coarser grids tell of the error."""

from typing import NamedTuple

LEAST = 0.3  # of the last but one refinement: what errors of both signs may hide in the last
MOST = 3.0  # refinements of the last kind are still to come, if they do not get smaller


class Resolution(NamedTuple):
    """Elements across the largest contact, and steps in the duration of Hertz's impact."""

    elements: int = 64
    steps: int = 300

    @property
    def half(self) -> "Resolution":
        """Half as fine in space and time."""
        return Resolution(max(self.elements // 2, 2), max(self.steps // 2, 2))


STANDARD = Resolution()


def refinement_error(quarter: float, half: float, whole: float) -> float:
    """Return about the error of a number that was found on a whole grid, half and a quarter of it.

    The last change, as for an error of first order in the grid; more where changes fall by less
    than that, less than half, by their geometric series; and at least three tenths of the change
    before.
    """
    before, last = abs(half - quarter), abs(whole - half)
    slow = before < 2.0 * last
    series = last * min(last / (before - last), MOST) if before > last else MOST * last
    return max(series if slow else last, LEAST * before)
