"""One panel of a viscoelastic impact: motion and memory solved together, at its nodes."""

import numpy as np

from carom.dimensionless.lossy.panels import normal
from carom.dimensionless.lossy.panels.collocation import (
    EVEN,
    NODES,
    PLACES,
    TO_SERIES,
    expand,
    integrate,
)
from carom.dimensionless.lossy.panels.newton import (
    MAX_ITERATIONS,
    SETTLED,
    Panel,
    correct,
    factorise,
    guess,
    state_at_node,
)
from carom.dimensionless.lossy.panels.normal import Motion
from carom.dimensionless.lossy.panels.work import (
    FRONT,
    LAID,
    LAID_A,
    LAID_B,
    LAID_RADIUS,
    LAID_SQUARE,
    MOVED,
    PSI,
    RADIUS,
    SPEED,
    TIME,
    Arrays,
)
from carom.dimensionless.lossy.viscoelastic.memory import rim, row_of
from carom.dimensionless.lossy.viscoelastic.ring import (
    RETURNS,
    STICKS,
    add_up,
    force,
    front,
    level_now,
    ring_of,
)
from carom.dimensionless.numerics.kernels import kernel


def _slopes() -> np.ndarray:
    """Return the matrix that makes derivatives by the even clock of values at the nodes."""
    chebyshev = np.polynomial.chebyshev
    slopes = [chebyshev.chebval(PLACES, chebyshev.chebder(series)) for series in TO_SERIES.T]
    return np.ascontiguousarray(2.0 * np.array(slopes).T)


SLOPES = _slopes()


@kernel
def solve_panel(work: Arrays, motion: Motion, panel: Panel, before: Panel) -> bool:
    """Solve for U and psi at the nodes, b and v being there; tell whether the iteration settled.

    `before` is the same panel as it was tried last, its length 0 if it was not.

    psi = psi_0 - (15/2) chi integral of b Q, by Newton's method in which only the stuck radius of
    the first iterate gives dQ/dT.
    """
    values, rates, series = work.values, work.rates, work.series[panel.number]
    b, psi = values[RADIUS], values[PSI]
    psi0, u0 = psi[0], values[MOVED, 0]
    follow_normal(work, panel)
    add_up(work, panel)
    if not guess(work, panel, before):
        psi[:] = psi0
    for iteration in range(MAX_ITERATIONS):
        follow(work, motion, panel, u0)
        for j in range(NODES):
            now = state_at_node(work, j)
            at = front(work, motion, panel, now, values[TIME, j])
            values[FRONT, j] = at.radius * at.radius
            rates[1, j] = -7.5 * motion.chi * b[j] * force(work, motion, panel, PLACES[j], now, at)
            rates[2, j] = -7.5 * motion.chi * b[j] * at.radius
        if iteration == 0:
            factorise(work, panel, motion.alpha)
        change = correct(work, panel, psi0)
        if change <= SETTLED * (1.0 + abs(psi0)):
            follow(work, motion, panel, u0)
            expand(psi, series[PSI])
            expand(values[FRONT], series[FRONT])
            return True
    return False


@kernel
def follow_normal(work: Arrays, panel: Panel) -> None:
    """Write time, and the series of the normal motion."""
    values, rates, series = work.values, work.rates, work.series[panel.number]
    for j in range(NODES):
        rates[0, j] = 2.0 * values[RADIUS, j]
    integrate(panel.clock, values[TIME, 0], panel.length, rates[0], values[TIME])
    for row in (RADIUS, SPEED, TIME):
        expand(values[row], series[row])


@kernel
def follow(work: Arrays, motion: Motion, panel: Panel, u0: float) -> None:
    """Write U that follows from psi, and the series of what is laid."""
    values, rates, series = work.values, work.rates, work.series[panel.number]
    for j in range(NODES):
        rates[0, j] = 2.0 * values[RADIUS, j] * values[PSI, j]
    integrate(panel.clock, u0, panel.length, rates[0], values[MOVED])
    expand(values[MOVED], series[MOVED])
    mode = ring_of(work).mode
    if mode == STICKS:
        lay_at_edge(work, motion, panel)
    elif mode == RETURNS:
        lay_at_front(work, motion, panel)
    else:
        return
    for row in (LAID, LAID_SQUARE, LAID_A, LAID_B, LAID_RADIUS):
        expand(values[row], series[row])


@kernel
def lay_at_edge(work: Arrays, motion: Motion, panel: Panel) -> None:
    """Write what the edge lays, c = -U, and the integrals of U db and U^2 db."""
    values, rates = work.values, work.rates
    b, u = values[RADIUS], values[MOVED]
    for j in range(NODES):
        values[LAID_RADIUS, j] = b[j]
        values[LAID_A, j], values[LAID_B, j] = b[j] * b[j] - u[j], b[j] * b[j] + u[j]
        rates[0, j] = u[j] * normal.edge_rate(motion, b[j], values[SPEED, j])
    integrate(panel.clock, 0.0, panel.length, rates[0], values[LAID])
    for j in range(NODES):
        rates[0, j] *= u[j]
    integrate(panel.clock, 0.0, panel.length, rates[0], values[LAID_SQUARE])


@kernel
def lay_at_front(work: Arrays, motion: Motion, panel: Panel) -> None:
    """Write what a front lays that returns, and the integral of r over the level."""
    values, rates, sign = work.values, work.rates, ring_of(work).sign
    levels = values[row_of(sign)]
    for j in range(NODES):
        now = state_at_node(work, j)
        r = front(work, motion, panel, now, values[TIME, j]).radius
        if j == 0:
            r = rim(work.pieces, panel.pieces)
        levels[j] = level_now(motion, sign, now)
        values[LAID_RADIUS, j] = r
        values[row_of(-sign), j] = 2.0 * r * r - levels[j]
    for j in range(NODES):
        slope = 0.0
        for k in range(NODES):
            slope += SLOPES[j, k] * levels[k]
        rates[0, j] = values[LAID_RADIUS, j] * slope
    integrate(EVEN, 0.0, 1.0, rates[0], values[LAID])
