"""Stick, slip and gross slip as a solution on a grid shows them."""

from itertools import groupby, pairwise
from typing import NamedTuple

import numpy as np

from carom.halfspace.influence import Field
from carom.quantities.causes import Cause, cause_between

SHARE = 0.02  # of the contact: as little as this of a zone is the grid's
SHORTEST = 0.02  # of the contact time


class SlipStage(NamedTuple):
    """A stretch of time in which all sticks, all slips, or both; `cause` is what ends it."""

    kind: str
    sign: int  # of slip along the direction of the motion before
    start: float
    end: float
    cause: str


def stages(time: Field, slipping: Field, sign: Field) -> tuple[SlipStage, ...]:
    """Return the stages of an impact, those too short for the grid left out.

    `slipping` is the share of the contact that slips in the step that ends at each time, `sign` the
    sign of that slip.
    """
    kinds = [_kind(*step) for step in zip(slipping[1:-1], sign[1:-1], strict=True)]
    runs = [(kind, len(list(group))) for kind, group in groupby(kinds)]
    starts = np.cumsum([0, *(length for _, length in runs)])
    long = [
        (kind, float(time[first]))
        for (kind, length), first in zip(runs, starts, strict=False)
        if time[first + length] - time[first] >= SHORTEST * time[-1]
    ] or [(kinds[0], 0.0)]
    kept = [next(group) for _, group in groupby(long, key=lambda item: item[0])]
    begins = [0.0, *(start for _, start in kept[1:])]
    ends = [*begins[1:], float(time[-1])]
    changes = pairwise(kind for (kind, _), _ in kept)
    causes = [*(cause_between(*change).message for change in changes), Cause.SEPARATION.message]
    return tuple(
        SlipStage(kind, sign, begin, end, cause)
        for ((kind, sign), _), begin, end, cause in zip(kept, begins, ends, causes, strict=True)
    )


def _kind(slipping: float, sign: float) -> tuple[str, int]:
    if slipping <= SHARE:
        return "stick", 0
    return "slip" if slipping < 1.0 - SHARE else "gross slip", int(sign)
