"""One panel of an impact: motion and memory solved together, at its nodes."""

from typing import NamedTuple

from carom.dimensionless.lossy.panels import normal
from carom.dimensionless.lossy.panels.collocation import (
    CLOCKS,
    NODES,
    PLACES,
    evaluate,
    expand,
    integrate,
)
from carom.dimensionless.lossy.panels.newton import (
    MAX_ITERATIONS,
    SETTLED,
    Panel,
    State,
    correct,
    factorise,
    guess,
    state_at_node,
)
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.pieces import (
    A0,
    A1,
    MAX_PIECES,
    PANEL,
    R0,
    R1,
    S0,
    S1,
    SIGN,
    W0,
    W1,
    X0,
    X1,
    Pieces,
)
from carom.dimensionless.lossy.panels.work import (
    LAID,
    LAID_A,
    LAID_B,
    LAID_SQUARE,
    MOVED,
    PSI,
    RADIUS,
    SPEED,
    Arrays,
)
from carom.dimensionless.lossy.yielding import memory
from carom.dimensionless.lossy.yielding.memory import ACTIVE
from carom.dimensionless.numerics.kernels import kernel

ZONES, SLIPS_FORTH, SLIPS_BACK = 7, 3, 1  # codes of zones; what sticks has 4, 5, 6
THIN = 1e-5  # part of the contact: zones that are narrower are not told


class Cut(NamedTuple):
    """The memory at an instant: Q, what sticks, what slips of either sign, a code of the zones.

    `stuck` is a width, `stored` the integral of q^2.
    """

    force: float
    stuck: float
    stored: float
    plus: bool
    minus: bool
    zones: int


@kernel
def lay(work: Arrays, panel: Panel, x: float, b: float, u: float) -> None:
    """Write the piece that the panel has laid up to x behind the others."""
    pieces, i, b0, u0 = work.pieces, panel.pieces, work.values[RADIUS, 0], work.values[MOVED, 0]
    pieces[i, SIGN], pieces[i, PANEL] = 0.0, panel.number
    pieces[i, X0], pieces[i, X1] = -1.0, x
    pieces[i, R0], pieces[i, R1] = b0, b
    pieces[i, A0], pieces[i, A1] = b0 * b0 - u0, b * b - u
    pieces[i, W0], pieces[i, S0] = 0.0, 0.0
    pieces[i, W1] = evaluate(work.series, panel.number, LAID, x)
    pieces[i, S1] = evaluate(work.series, panel.number, LAID_SQUARE, x)


@kernel
def cut_memory(work: Arrays, motion: Motion, panel: Panel, x: float, now: State) -> Cut:
    """Return the memory at a place of a panel, in this state."""
    b, u = now.radius, now.moved
    pieces, parts, series = work.pieces, work.parts, work.series
    d = normal.limit(motion, b, now.speed)
    p, m = d - u, d + u
    total, stuck, stored, broad = 0.0, 0.0, 0.0, 0.0
    plus, minus, code, zone_before, last = False, False, 0, 0, 0
    laying = motion.stage != Stage.UNLOADING.value
    if laying:
        lay(work, panel, x, b, u)
    for i in range(panel.pieces + laying):
        if pieces[i, R0] >= b:
            break
        for k in range(memory.cut(pieces, i, series, p, m, b, parts)):
            r0, r1, sign = parts[k, R0], parts[k, R1], int(parts[k, SIGN])
            total += memory.force(parts, k, u)
            stored += memory.square(parts, k, u)
            zone = sign + 5
            if parts[k, SIGN] == 0.0 or parts[k, PANEL] != ACTIVE:
                stuck += r1 - r0
            elif sign > 0:
                zone = SLIPS_FORTH
                plus = True
            else:
                zone = SLIPS_BACK
                minus = True
            broad = r1 - r0 if zone != zone_before else broad + r1 - r0
            zone_before = zone
            if zone != last and broad > THIN * b:
                code = code * ZONES + zone
                last = zone
    return Cut(total, stuck, stored, plus, minus, code)


@kernel
def solve_panel(work: Arrays, motion: Motion, panel: Panel, before: Panel) -> bool:
    """Solve for U and psi at the nodes, b and v being there; tell whether the iteration settled.

    `before` is the same panel as it was tried last, its length 0 if it was not.

    psi = psi_0 - (15/2) chi integral of b Q, by Newton's method in which only the stuck width of
    the first iterate gives dQ/dU.
    """
    values, rates, series = work.values, work.rates, work.series[panel.number]
    b, psi, h = values[RADIUS], values[PSI], panel.length
    psi0, u0 = psi[0], values[MOVED, 0]
    expand(b, series[RADIUS])
    if not guess(work, panel, before):
        start = cut_memory(work, motion, panel, -1.0, state_at_node(work, 0))
        for j in range(NODES):
            psi[j] = psi0 - 7.5 * motion.chi * b[0] * start.force * h * CLOCKS[panel.clock, j]
    for iteration in range(MAX_ITERATIONS):
        follow(work, motion, panel, u0)
        for j in range(NODES):
            cut = cut_memory(work, motion, panel, PLACES[j], state_at_node(work, j))
            work.zones[j] = cut.zones
            rates[1, j] = -7.5 * motion.chi * b[j] * cut.force
            rates[2, j] = -7.5 * motion.chi * b[j] * cut.stuck
        if iteration == 0:
            factorise(work, panel, 0.0)
        change = correct(work, panel, psi0)
        if change <= SETTLED * (1.0 + abs(psi0)):
            follow(work, motion, panel, u0)
            expand(psi, series[PSI])
            expand(values[SPEED], series[SPEED])
            return True
    return False


@kernel
def follow(work: Arrays, motion: Motion, panel: Panel, u0: float) -> None:
    """Write U that follows from psi, and the series of what is laid."""
    values, rates, series = work.values, work.rates, work.series[panel.number]
    b, u, h = values[RADIUS], values[MOVED], panel.length
    for j in range(NODES):
        rates[0, j] = 2.0 * b[j] * values[PSI, j]
    integrate(panel.clock, u0, h, rates[0], u)
    expand(u, series[MOVED])
    if motion.stage == Stage.UNLOADING.value:
        return
    for j in range(NODES):
        rates[0, j] = u[j] * normal.edge_rate(motion, b[j], values[SPEED, j])
        values[LAID_A, j], values[LAID_B, j] = b[j] * b[j] - u[j], b[j] * b[j] + u[j]
    integrate(panel.clock, 0.0, h, rates[0], values[LAID])
    for j in range(NODES):
        rates[0, j] *= u[j]
    integrate(panel.clock, 0.0, h, rates[0], values[LAID_SQUARE])
    for row in (LAID, LAID_SQUARE, LAID_A, LAID_B):
        expand(values[row], series[row])


@kernel
def commit(work: Arrays, motion: Motion, panel: Panel) -> int:
    """Cut the memory for good at the end of a panel; return how many pieces are left."""
    now = state_at_node(work, NODES - 1)
    b, d = now.radius, normal.limit(motion, now.radius, now.speed)
    p, m = d - now.moved, d + now.moved
    laying = motion.stage != Stage.UNLOADING.value
    if laying:
        lay(work, panel, 1.0, b, now.moved)
    made = 0
    for i in range(panel.pieces + laying):
        if work.pieces[i, R0] >= b:
            break
        for k in range(memory.cut(work.pieces, i, work.series, p, m, b, work.parts)):
            made = append(work.spare, made, work.parts, k)
    for i in range(made):
        memory.copy(work.spare, i, work.pieces, i)
        if work.pieces[i, PANEL] == ACTIVE:
            work.pieces[i, PANEL] = memory.PAST
    return made


@kernel
def append(pieces: Pieces, made: int, parts: Pieces, k: int) -> int:
    """Append a part, joined to the one before if both slip alike; return how many there are."""
    before = made - 1
    slips = made > 0 and parts[k, PANEL] == ACTIVE and pieces[before, PANEL] == ACTIVE
    if slips and pieces[before, SIGN] == parts[k, SIGN]:
        pieces[before, R1], pieces[before, A1] = parts[k, R1], parts[k, A1]
        return made
    if made < MAX_PIECES - 1:
        memory.copy(parts, k, pieces, made)
        made += 1
    return made
