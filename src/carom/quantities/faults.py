"""All faults of what a user gives in one message, instead of one a run."""

from typing import Self

from carom.quantities.refusals import InputError

MOST_LISTED = 12  # faults in one message


class Faults:
    """What is wrong with a file: collected inside its context, and told in one message after it.

    Examples
    --------
    >>> from carom.quantities.faults import Faults
    >>> with Faults() as faults:
    ...     faults.add("angle: column missing")
    ...     faults.add("spin: not a number in line 3")
    Traceback (most recent call last):
    carom.InputError: 2 faults: (1) angle: column missing; (2) spin: not a number in line 3
    """

    def __init__(self) -> None:
        self._messages: list[str] = []
        self._collecting = False

    def __enter__(self) -> Self:
        self._collecting = True
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        self._collecting = False
        if isinstance(error, InputError) and str(error) != self._message():
            self._messages.append(str(error))
        if self._messages and (error is None or isinstance(error, Exception)):
            raise InputError(self._message()) from None

    def add(self, message: str) -> None:
        """Collect a fault; outside of the context raise InputError."""
        if not self._collecting:
            raise InputError(message)
        self._messages.append(message)

    def settle(self) -> None:
        """Raise InputError if there are faults so far, before costly work."""
        if self._messages:
            raise InputError(self._message())

    def _message(self) -> str:
        messages = list(dict.fromkeys(self._messages))
        if len(messages) == 1:
            return messages[0]
        listed = "; ".join(f"({i}) {text}" for i, text in enumerate(messages[:MOST_LISTED], 1))
        more = f"; and {len(messages) - MOST_LISTED} more" if len(messages) > MOST_LISTED else ""
        return f"{len(messages)} faults: {listed}{more}"
