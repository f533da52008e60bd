"""The exact rebound over a range of chi, by its older name."""

from carom.laws.exact import ReboundLaw


class MixtureLaw(ReboundLaw):
    """The exact rebound over a range of chi: `ReboundLaw((low, high))`.

    Parameters
    ----------
    low, high : float
        The range of chi, `0.5 <= low < high <= 5`.

    Raises
    ------
    InputError
        If the range is empty, begins below 0.5 or ends above 5.

    Examples
    --------
    >>> import carom
    >>> law = carom.laws.MixtureLaw(1.2, 1.5)
    >>> law([0.5, 1.5, -3.5], [1.25, 1.44, 1.5]).round(6)
    array([-0.079793, -0.429967,  1.471999])
    """

    def __init__(self, low: float, high: float) -> None:
        super().__init__((low, high))

    @property
    def low(self) -> float:
        """The least chi."""
        return self._ends[0]

    @property
    def high(self) -> float:
        """The largest chi."""
        return self._ends[1]
