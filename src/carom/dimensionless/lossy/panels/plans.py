"""How long a panel is to be, on which clock, and how to try again."""

from typing import NamedTuple

from carom.dimensionless.lossy.panels.collocation import EVEN, FLAT_END, FLAT_ENDS, FLAT_START
from carom.dimensionless.numerics.kernels import kernel

FIRST, LONGEST, SHORTEST = 0.3, 0.8, 1e-8  # lengths of panels
TOLERANCE = 1e-9  # of a panel; keeps psi_2 to 1e-8 max(1, |psi_1|)
TRIALS = 60  # of a panel
EARLY = 5e-4  # part of a panel in which zones that begin with it are too thin to be told
NEAR, NEAR_FLAT = 1e-9, 1e-5  # part of a panel: a change so near its end is its end
ORDER = 9.0  # of the error of a panel in its length, about
NORMAL_WEIGHT = 30.0  # of the error of the normal motion, which is cheap to keep small
SAFETY, STEEPEST, GROWTH = 0.8, 0.2, 4.0


class Plan(NamedTuple):
    """How a panel is to be solved: its length, its clock, and what lies at either end of it.

    `change` is what happens at its end, 0 if nothing does.
    """

    length: float
    clock: int
    natural: float  # length that accuracy alone would allow
    from_change: bool
    change: int
    to_stage_end: bool
    flat_is_worse: bool
    error: float  # with an even clock


@kernel
def with_length(plan: Plan, h: float, natural: float, change: int, to_end: bool) -> Plan:
    """Return a plan with another length and end."""
    return Plan(
        h, plan.clock, natural, plan.from_change, change, to_end, plan.flat_is_worse, plan.error
    )


@kernel
def with_clock(plan: Plan, kind: int, flat_is_worse: bool, error: float) -> Plan:
    """Return a plan with another clock."""
    return Plan(
        plan.length,
        kind,
        plan.natural,
        plan.from_change,
        plan.change,
        plan.to_stage_end,
        flat_is_worse,
        error,
    )


@kernel
def revised(plan: Plan, error: float, tolerance: float) -> Plan:
    """Return how to try again after too large an error: with a flat clock once, or shorter."""
    rooted = plan.from_change or plan.change != 0
    if plan.clock == EVEN and rooted and not plan.flat_is_worse:
        kind = (FLAT_START if plan.from_change else 0) + (FLAT_END if plan.change != 0 else 0)
        return with_clock(plan, kind, False, error)
    if plan.clock != EVEN and error > plan.error:
        error = plan.error
        plan = with_clock(plan, EVEN, True, error)
    elif plan.clock == FLAT_END or plan.clock == FLAT_ENDS:
        plan = with_clock(plan, plan.clock - FLAT_END, plan.flat_is_worse, error)
    h = plan.length * max(STEEPEST, SAFETY * (tolerance / error) ** (1.0 / ORDER))
    return with_length(plan, h, h, 0, False)
