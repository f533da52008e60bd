"""Numbers for arrays and kernels, each with its words: statuses of points, what ends a phase."""

from enum import IntEnum
from typing import Self


class WordedStatus(IntEnum):
    """A status for arrays of int8, 0 where all is well; its `message` says in words what it is."""

    message: str

    def __new__(cls, value: int, message: str = "") -> Self:  # to look one up takes the value alone
        """Return the member of this number and these words."""
        member = int.__new__(cls, value)
        member._value_ = value
        member.message = message
        return member


class Cause(WordedStatus):
    """What ends a phase, as a number for kernels; its `message` says it in words."""

    FIRST_TOUCH = 0, "first touch"
    EDGE_AT_LIMIT = 1, "edge reaches friction limit"
    SLIP_STOPS = 2, "slip stops"
    RING_CLOSES = 3, "slip ring closes"
    FRONT_AT_CENTRE = 4, "slip front reaches centre"
    SEPARATION = 5, "separation"
    UNRESOLVED = 6, "not resolved"
    STICK_ZONE_VANISHES = 7, "stick zone vanishes"


def cause_between(kind: str, following: str) -> Cause:
    """Return what ends a phase where only its kind and that of the next phase are known."""
    if kind == "stick":
        return Cause.EDGE_AT_LIMIT
    spreads = kind == "slip" and following == "gross slip"
    return Cause.STICK_ZONE_VANISHES if spreads else Cause.SLIP_STOPS
