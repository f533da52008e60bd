"""One panel of a viscoelastic impact: motion and memory solved together, at its nodes."""

import numpy as np

from carom.dimensionless.lossy.viscoelastic import contact, normal, work as at
from carom.dimensionless.lossy.viscoelastic.contact import Mode, piece_force, rim, row_of
from carom.dimensionless.lossy.viscoelastic.normal import Motion
from carom.dimensionless.lossy.viscoelastic.work import NODES, PLACES, Arrays, Panel, state_at_node
from carom.dimensionless.numerics.kernels import kernel

chebyshev = np.polynomial.chebyshev
# What makes derivatives by the even clock of values at the nodes.
SLOPES = np.ascontiguousarray(2.0 * chebyshev.chebval(PLACES, chebyshev.chebder(at.TO_SERIES)).T)
MOST_ITERATIONS = 30
PSI_SETTLED = 1e-13


@kernel
def solve_panel(work: Arrays, motion: Motion, panel: Panel, before: Panel) -> bool:
    """Solve for U and psi at the nodes, b and v being there; tell whether the iteration settled.

    `before` is the same panel as it was tried last, its length 0 if it was not.

    psi = psi_0 - (15/2) chi integral of b Q, by Newton's method in which only the stuck radius of
    the first iterate gives dQ/dT.
    """
    values, rates, series = work.values, work.rates, work.series[panel.number]
    b, psi = values[at.RADIUS], values[at.PSI]
    psi0, u0 = psi[0], values[at.MOVED, 0]
    follow_normal(work, panel)
    whole = panel.pieces - 1 if contact.ring_of(work).mode == Mode.RETREATS else panel.pieces
    work.ring[at.WHOLE] = 0.0
    for i in range(whole):
        work.ring[at.WHOLE] += piece_force(work.pieces, i)
    if not guess(work, panel, before):
        psi[:] = psi0
    for iteration in range(MOST_ITERATIONS):
        follow(work, motion, panel, u0)
        for j in range(NODES):
            now = state_at_node(work, j)
            border = contact.front(work, motion, panel, now)
            values[at.FRONT, j] = border.radius * border.radius
            force = contact.force(work, motion, panel, PLACES[j], now, border)
            rates[1, j] = -7.5 * motion.chi * b[j] * force
            rates[2, j] = -7.5 * motion.chi * b[j] * border.radius
        if iteration == 0:
            factorise(work, panel, motion.alpha)
        change = correct(work, panel, psi0)
        if change <= PSI_SETTLED * (1.0 + abs(psi0)):
            follow(work, motion, panel, u0)
            at.expand(psi, series[at.PSI])
            at.expand(values[at.FRONT], series[at.FRONT])
            return True
    return False


@kernel
def follow_normal(work: Arrays, panel: Panel) -> None:
    """Write time, and the series of the normal motion."""
    values, rates, series = work.values, work.rates, work.series[panel.number]
    for j in range(NODES):
        rates[0, j] = 2.0 * values[at.RADIUS, j]
    at.integrate(panel.clock, values[at.TIME, 0], panel.length, rates[0], values[at.TIME])
    for row in (at.RADIUS, at.SPEED, at.TIME):
        at.expand(values[row], series[row])


@kernel
def follow(work: Arrays, motion: Motion, panel: Panel, u0: float) -> None:
    """Write U that follows from psi, and the series of what is laid."""
    values, rates, series = work.values, work.rates, work.series[panel.number]
    for j in range(NODES):
        rates[0, j] = 2.0 * values[at.RADIUS, j] * values[at.PSI, j]
    at.integrate(panel.clock, u0, panel.length, rates[0], values[at.MOVED])
    at.expand(values[at.MOVED], series[at.MOVED])
    mode = contact.ring_of(work).mode
    if mode == Mode.STICKS:
        lay_at_edge(work, motion, panel)
    elif mode == Mode.RETURNS:
        lay_at_front(work, motion, panel)
    else:
        return
    for row in (at.LAID, at.LAID_SQUARE, at.LAID_A, at.LAID_B, at.LAID_RADIUS):
        at.expand(values[row], series[row])


@kernel
def lay_at_edge(work: Arrays, motion: Motion, panel: Panel) -> None:
    """Write what the edge lays, c = -U, and the integrals of U db and U^2 db."""
    values, rates = work.values, work.rates
    b, u = values[at.RADIUS], values[at.MOVED]
    for j in range(NODES):
        values[at.LAID_RADIUS, j] = b[j]
        values[at.LAID_A, j], values[at.LAID_B, j] = b[j] * b[j] - u[j], b[j] * b[j] + u[j]
        rates[0, j] = u[j] * normal.edge_rate(motion, b[j], values[at.SPEED, j])
    at.integrate(panel.clock, 0.0, panel.length, rates[0], values[at.LAID])
    for j in range(NODES):
        rates[0, j] *= u[j]
    at.integrate(panel.clock, 0.0, panel.length, rates[0], values[at.LAID_SQUARE])


@kernel
def lay_at_front(work: Arrays, motion: Motion, panel: Panel) -> None:
    """Write what a front lays that returns, and the integral of r over the level."""
    values, rates, sign = work.values, work.rates, contact.ring_of(work).sign
    levels = values[row_of(sign)]
    for j in range(NODES):
        now = state_at_node(work, j)
        r = contact.front(work, motion, panel, now).radius
        if j == 0:
            r = rim(work.pieces, panel.pieces)
        levels[j] = contact.level_now(motion, sign, now)
        values[at.LAID_RADIUS, j] = r
        values[row_of(-sign), j] = 2.0 * r * r - levels[j]
    for j in range(NODES):
        slope = 0.0
        for k in range(NODES):
            slope += SLOPES[j, k] * levels[k]
        rates[0, j] = values[at.LAID_RADIUS, j] * slope
    at.integrate(at.EVEN, 0.0, 1.0, rates[0], values[at.LAID])


@kernel
def guess(work: Arrays, panel: Panel, before: Panel) -> bool:
    """Write psi as it was when the panel was tried last, if it was longer; tell whether so."""
    if before.length < panel.length:
        return False
    ratio = panel.length / before.length
    for j in range(1, NODES):
        part = min(at.CLOCKS[panel.clock, j] * ratio, 1.0)
        x = at.place_of_clock(before.clock, part)
        work.values[at.PSI, j] = at.evaluate(work.series, panel.number, at.PSI, x)
    return True


@kernel
def correct(work: Arrays, panel: Panel, psi0: float) -> float:
    """Do a step of Newton's method, from the rates of psi; return by how much psi has changed."""
    rates, psi, change = work.rates, work.values[at.PSI], 0.0
    at.integrate(panel.clock, psi0, panel.length, rates[1], rates[0])
    for j in range(NODES):
        rates[0, j] -= psi[j]
    back_substitute(work)
    for j in range(NODES):
        psi[j] += rates[0, j]
        change = max(change, abs(rates[0, j]))
    psi[0] = psi0
    return change


@kernel
def factorise(work: Arrays, panel: Panel, alpha: float) -> None:
    """Write I - h S diag(-(15/2) chi b X) (h S diag(2 b) + alpha) as L R; S integrates."""
    s, h, b = at.INTEGRALS[panel.clock], panel.length, work.values[at.RADIUS]
    matrix = work.matrix
    for i in range(NODES):
        for j in range(NODES):
            total = 0.0
            for k in range(NODES):
                total += s[i, k] * work.rates[2, k] * s[k, j]
            direct = h * s[i, j] * work.rates[2, j] * alpha
            matrix[i, j] = -h * h * total * 2.0 * b[j] - direct
        matrix[i, i] += 1.0
    for k in range(NODES):
        for i in range(k + 1, NODES):
            matrix[i, k] /= matrix[k, k]
            for j in range(k + 1, NODES):
                matrix[i, j] -= matrix[i, k] * matrix[k, j]


@kernel
def back_substitute(work: Arrays) -> None:
    """Solve L R x = y; y is the first row of the rates, and so is x."""
    matrix, y = work.matrix, work.rates[0]
    for i in range(NODES):
        for j in range(i):
            y[i] -= matrix[i, j] * y[j]
    for i in range(NODES - 1, -1, -1):
        for j in range(i + 1, NODES):
            y[i] -= matrix[i, j] * y[j]
        y[i] /= matrix[i, i]
