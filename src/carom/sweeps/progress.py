"""How far a sweep is: points, rate and time left."""

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tqdm import tqdm

PATIENCE = 2.0  # seconds before a bar appears


def progress_bar(points: int, done: int, shown: bool | None) -> "tqdm[None]":
    """Return a bar on stderr that appears after two seconds; by default on a terminal only."""
    from tqdm import tqdm

    return tqdm(
        total=points,
        initial=done,
        disable=None if shown is None else not shown,
        unit=" points",
        unit_scale=True,
        delay=PATIENCE,
        file=sys.stderr,
        dynamic_ncols=True,
    )
