"""What one simulation of the study is called, and what it tells."""

from typing import NamedTuple


class Run(NamedTuple):
    """One simulation: `at` is what is varied beside law and friction, `step` the time step over
    that of the study."""

    experiment: str
    law: str
    friction: float
    restitution: float
    at: float
    seed: int
    size: int
    step: float = 1.0


class Found(NamedTuple):
    """A number that a simulation gave: `where` in time or strain."""

    quantity: str
    where: float
    value: float
