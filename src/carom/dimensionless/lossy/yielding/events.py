"""Where the structure of an impact changes inside a panel: what slips where, and which way."""

import numpy as np

from carom.dimensionless.lossy.panels import normal
from carom.dimensionless.lossy.panels.collocation import FLAT_ENDS, FLAT_START, NODES, PLACES
from carom.dimensionless.lossy.panels.newton import Panel, State, state_at, state_at_node
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.plans import EARLY
from carom.dimensionless.lossy.panels.work import Arrays
from carom.dimensionless.lossy.yielding.panels import cut_memory
from carom.dimensionless.numerics.kernels import kernel

TO = 0.9999  # place up to which the structure is looked at
BISECTIONS = 36
LEVEL = 1e-8  # a limit that falls more slowly does not fall


@kernel
def signs(motion: Motion, zones: int, now: State) -> int:
    """Return a number for the zones, and for which way limits and laid contact go.

    It holds whether either limit is falling, and while loading whether A and B, laid at the edge,
    rise outwards: pieces are to be monotone.
    """
    pace = LEVEL + normal.limit_rate(motion, now.radius, now.speed)
    code = (zones * 2 + (now.psi > pace)) * 2 + (-now.psi > pace)
    if motion.stage == Stage.UNLOADING.value:
        return code
    laid = LEVEL + normal.edge_rate(motion, now.radius, now.speed)
    return (code * 2 + (now.psi > laid)) * 2 + (-now.psi > laid)


@kernel
def zones_at(work: Arrays, motion: Motion, panel: Panel, x: float) -> int:
    """Return a number for the zones at a place of a solved panel."""
    return cut_memory(work, motion, panel, x, state_at(work, panel, x)).zones


@kernel
def structure(work: Arrays, motion: Motion, panel: Panel, x: float) -> int:
    """Return a number for what happens at a place of a solved panel."""
    return signs(motion, zones_at(work, motion, panel, x), state_at(work, panel, x))


@kernel
def first_change(work: Arrays, motion: Motion, panel: Panel) -> float:
    """Return where in a solved panel the structure first changes, 2 if nowhere inside."""
    flat = panel.clock == FLAT_START or panel.clock == FLAT_ENDS
    low = 2.0 * (np.sqrt(EARLY) if flat else EARLY) - 1.0
    own = structure(work, motion, panel, low)
    for j in range(1, NODES):
        high = PLACES[j] if j < NODES - 1 else TO
        if high <= low:
            continue
        if j < NODES - 1:
            found = signs(motion, work.zones[j], state_at_node(work, j))
        else:
            found = structure(work, motion, panel, TO)
        if found != own:
            return change_between(work, motion, panel, low, high, own)
        low = high
    return 2.0


@kernel
def change_between(
    work: Arrays, motion: Motion, panel: Panel, low: float, high: float, own: int
) -> float:
    """Return where between two places the structure ceases to be this, by bisection."""
    zones = zones_at(work, motion, panel, low)
    steady = zones == zones_at(work, motion, panel, high)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if not steady:
            zones = zones_at(work, motion, panel, middle)
        if signs(motion, zones, state_at(work, panel, middle)) == own:
            low = middle
        else:
            high = middle
    return high
