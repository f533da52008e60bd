"""Where the structure of an impact changes inside a panel: what slips where, and which way."""

import numpy as np

from carom.dimensionless._jit import kernel
from carom.dimensionless.lossy import normal
from carom.dimensionless.lossy.collocation import FLAT_ENDS, FLAT_START, NODES, PLACES, evaluate
from carom.dimensionless.lossy.memory import MOVED, RADIUS
from carom.dimensionless.lossy.normal import Motion, Stage
from carom.dimensionless.lossy.panels import Panel, cut_memory
from carom.dimensionless.lossy.work import PSI, SPEED, Work

EARLY = 5e-4  # part of a panel in which zones that begin with it are too thin to be told
TO = 0.9999  # place up to which the structure is looked at
BISECTIONS = 36
LEVEL = 1e-9  # a limit that falls more slowly does not fall


@kernel
def signs(motion: Motion, zones: int, b: float, v: float, psi: float) -> int:
    """Return a number for the zones, and for which way limits and laid contact go.

    It holds whether either limit is falling, and while loading whether A and B, laid at the edge,
    rise outwards: pieces are to be monotone.
    """
    pace = normal.limit_rate(motion, b, v)
    code = (zones * 2 + (psi > pace + LEVEL)) * 2 + (-psi > pace + LEVEL)
    if motion.stage == Stage.UNLOADING.value:
        return code
    laid = normal.edge_rate(motion, b, v)
    return (code * 2 + (psi > laid + LEVEL)) * 2 + (-psi > laid + LEVEL)


@kernel
def zones_at(work: Work, motion: Motion, panel: Panel, x: float) -> int:
    """Return a number for the zones at a place of a solved panel."""
    series, n = work.series, panel.number
    b, v, u = (
        evaluate(series, n, RADIUS, x),
        evaluate(series, n, SPEED, x),
        evaluate(series, n, MOVED, x),
    )
    return cut_memory(work, motion, panel, x, b, v, u).zones


@kernel
def structure(work: Work, motion: Motion, panel: Panel, x: float) -> int:
    """Return a number for what happens at a place of a solved panel."""
    series, n = work.series, panel.number
    b, v, psi = (
        evaluate(series, n, RADIUS, x),
        evaluate(series, n, SPEED, x),
        evaluate(series, n, PSI, x),
    )
    return signs(motion, zones_at(work, motion, panel, x), b, v, psi)


@kernel
def structure_at_node(work: Work, motion: Motion, j: int) -> int:
    """Return the same at a node."""
    values = work.values
    return signs(motion, work.zones[j], values[RADIUS, j], values[SPEED, j], values[PSI, j])


@kernel
def first_change(work: Work, motion: Motion, panel: Panel) -> float:
    """Return where in a solved panel the structure first changes, 2 if nowhere inside."""
    flat = panel.clock == FLAT_START or panel.clock == FLAT_ENDS
    low = 2.0 * (np.sqrt(EARLY) if flat else EARLY) - 1.0
    own = structure(work, motion, panel, low)
    for j in range(1, NODES):
        high = PLACES[j] if j < NODES - 1 else TO
        if high <= low:
            continue
        inside = j < NODES - 1
        now = structure_at_node(work, motion, j) if inside else structure(work, motion, panel, TO)
        if now != own:
            return change_between(work, motion, panel, low, high, own)
        low = high
    return 2.0


@kernel
def change_between(
    work: Work, motion: Motion, panel: Panel, low: float, high: float, own: int
) -> float:
    """Return where between two places the structure ceases to be this, by bisection."""
    series, n = work.series, panel.number
    zones = zones_at(work, motion, panel, low)
    steady = zones == zones_at(work, motion, panel, high)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if not steady:
            zones = zones_at(work, motion, panel, middle)
        b, v = evaluate(series, n, RADIUS, middle), evaluate(series, n, SPEED, middle)
        if signs(motion, zones, b, v, evaluate(series, n, PSI, middle)) == own:
            low = middle
        else:
            high = middle
    return high
