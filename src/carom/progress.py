"""How far long work is: what is done, rate and time left."""

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tqdm import tqdm

PATIENCE = 2.0  # seconds before a bar appears


def progress_bar(unit: str, total: int, done: int, shown: bool | None) -> "tqdm[None]":
    """Return a bar on stderr that appears after two seconds; by default on a terminal only."""
    from tqdm import tqdm

    return tqdm(
        total=total,
        initial=done,
        disable=None if shown is None else not shown,
        unit=f" {unit}",
        unit_scale=True,
        delay=PATIENCE,
        file=sys.stderr,
        dynamic_ncols=True,
    )
