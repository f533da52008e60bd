"""What became of each point of a batch: a number for arrays, and its words."""

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
