"""One panel of an impact: motion and memory solved together, at its nodes."""

from typing import NamedTuple

from carom.dimensionless._jit import kernel
from carom.dimensionless.lossy import memory, normal
from carom.dimensionless.lossy.collocation import (
    CLOCKS,
    INTEGRALS,
    NODES,
    PLACES,
    evaluate,
    expand,
    integrate,
)
from carom.dimensionless.lossy.memory import (
    A0,
    A1,
    ACTIVE,
    LAID,
    LAID_A,
    LAID_B,
    MAX_PIECES,
    MOVED,
    PANEL,
    R0,
    R1,
    RADIUS,
    SIGN,
    W0,
    W1,
    X0,
    X1,
    Pieces,
)
from carom.dimensionless.lossy.normal import Motion, Stage
from carom.dimensionless.lossy.work import PSI, SPEED, Work

MAX_ITERATIONS = 30
SETTLED = 1e-13
THIN = 1e-5  # part of the contact: zones that are narrower are not told


class Panel(NamedTuple):
    """A panel of time: its number, clock and length, and how many pieces of memory it finds."""

    number: int
    clock: int
    length: float
    pieces: int


class Cut(NamedTuple):
    """The memory at an instant: Q, what sticks, what slips of either sign, a code of the zones.

    `stuck` is a width; `plus` and `minus` are integrals of D - s over what slips.
    """

    force: float
    stuck: float
    plus: float
    minus: float
    zones: int


@kernel
def lay(work: Work, panel: Panel, x: float, b: float, u: float) -> None:
    """Write the piece that the panel has laid up to x."""
    piece, b0, u0 = work.laid[0], work.values[RADIUS, 0], work.values[MOVED, 0]
    piece[SIGN], piece[PANEL], piece[X0], piece[X1] = 0.0, panel.number, -1.0, x
    piece[R0], piece[R1] = b0, b
    piece[A0], piece[A1] = b0 * b0 - u0, b * b - u
    piece[W0], piece[W1] = 0.0, evaluate(work.series[panel.number, LAID], x)


@kernel
def cut_memory(
    work: Work, motion: Motion, panel: Panel, x: float, b: float, v: float, u: float
) -> Cut:
    """Return the memory at a place of a panel, where the edge, the speed and U are these."""
    d = normal.limit(motion, b, v)
    p, m = d - u, d + u
    total, stuck, plus, minus, broad = 0.0, 0.0, 0.0, 0.0, 0.0
    code, now, last = 0, 0, 0
    laying = motion.stage != Stage.UNLOADING.value
    if laying:
        lay(work, panel, x, b, u)
    for i in range(panel.pieces + laying):
        piece = work.pieces[i] if i < panel.pieces else work.laid[0]
        if piece[R0] >= b:
            break
        if memory.is_whole(piece, p, m, b):
            width = piece[R1] - piece[R0]
            total += memory.force(piece, u)
            stuck += width
            zone = int(piece[SIGN]) + 5
            broad = width if zone != now else broad + width
            now = zone
            if zone != last and broad > THIN * b:
                code = code * 7 + zone
                last = zone
            continue
        source = int(piece[PANEL]) if piece[SIGN] == 0.0 else 0
        for k in range(memory.cut(piece, work.series[source], p, m, b, work.parts)):
            part = work.parts[k]
            width = part[R1] - part[R0]
            total += memory.force(part, u)
            zone = int(part[SIGN]) + (2 if part[PANEL] == ACTIVE else 5)
            if part[PANEL] != ACTIVE:
                stuck += width
            elif part[SIGN] > 0.0:
                plus += d * width - memory.cubes(part[R0], part[R1])
            else:
                minus += d * width - memory.cubes(part[R0], part[R1])
            broad = width if zone != now else broad + width
            now = zone
            if zone != last and broad > THIN * b:
                code = code * 7 + zone
                last = zone
    return Cut(total, stuck, plus, minus, code)


@kernel
def solve_panel(work: Work, motion: Motion, panel: Panel) -> bool:
    """Solve for U and psi at the nodes, b and v being there; tell whether the iteration settled.

    psi = psi_0 - (15/2) chi integral of b Q, by Newton's method in which only the stuck width of
    the first iterate gives dQ/dU.
    """
    values, rates, series = work.values, work.rates, work.series[panel.number]
    b, psi, h = values[RADIUS], values[PSI], panel.length
    psi0, u0 = psi[0], values[MOVED, 0]
    expand(b, series[RADIUS])
    start = cut_memory(work, motion, panel, -1.0, b[0], values[SPEED, 0], u0)
    for j in range(NODES):
        psi[j] = psi0 - 7.5 * motion.chi * b[0] * start.force * h * CLOCKS[panel.clock, j]
    for iteration in range(MAX_ITERATIONS):
        follow(work, motion, panel, u0)
        for j in range(NODES):
            cut = cut_memory(
                work, motion, panel, PLACES[j], b[j], values[SPEED, j], values[MOVED, j]
            )
            work.zones[j] = cut.zones
            rates[1, j] = -7.5 * motion.chi * b[j] * cut.force
            rates[2, j] = -7.5 * motion.chi * b[j] * cut.stuck
        if iteration == 0:
            factorise(work, panel)
        integrate(panel.clock, psi0, h, rates[1], rates[0])
        for j in range(NODES):
            rates[0, j] -= psi[j]
        back_substitute(work)
        change = 0.0
        for j in range(NODES):
            psi[j] += rates[0, j]
            change = max(change, abs(rates[0, j]))
        psi[0] = psi0
        if change <= SETTLED * (1.0 + abs(psi0)):
            follow(work, motion, panel, u0)
            expand(psi, series[PSI])
            expand(values[SPEED], series[SPEED])
            return True
    return False


@kernel
def follow(work: Work, motion: Motion, panel: Panel, u0: float) -> None:
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
    for row in (LAID, LAID_A, LAID_B):
        expand(values[row], series[row])


@kernel
def factorise(work: Work, panel: Panel) -> None:
    """Write I - h^2 S diag(-(15/2) chi b X) S diag(2 b) as L R, S being the integral."""
    s, h, b, matrix = INTEGRALS[panel.clock], panel.length, work.values[RADIUS], work.matrix
    for i in range(NODES):
        for j in range(NODES):
            total = 0.0
            for k in range(NODES):
                total += s[i, k] * work.rates[2, k] * s[k, j]
            matrix[i, j] = -h * h * total * 2.0 * b[j]
        matrix[i, i] += 1.0
    for k in range(NODES):
        for i in range(k + 1, NODES):
            matrix[i, k] /= matrix[k, k]
            for j in range(k + 1, NODES):
                matrix[i, j] -= matrix[i, k] * matrix[k, j]


@kernel
def back_substitute(work: Work) -> None:
    """Solve L R x = y; y is the first row of the rates, and so is x."""
    matrix, y = work.matrix, work.rates[0]
    for i in range(NODES):
        for j in range(i):
            y[i] -= matrix[i, j] * y[j]
    for i in range(NODES - 1, -1, -1):
        for j in range(i + 1, NODES):
            y[i] -= matrix[i, j] * y[j]
        y[i] /= matrix[i, i]


@kernel
def commit(work: Work, motion: Motion, panel: Panel) -> int:
    """Cut the memory for good at the end of a panel; return how many pieces are left."""
    last = NODES - 1
    b, v, u = work.values[RADIUS, last], work.values[SPEED, last], work.values[MOVED, last]
    d = normal.limit(motion, b, v)
    laying = motion.stage != Stage.UNLOADING.value
    if laying:
        lay(work, panel, 1.0, b, u)
    made = 0
    for i in range(panel.pieces + laying):
        piece = work.pieces[i] if i < panel.pieces else work.laid[0]
        if piece[R0] >= b:
            break
        source = int(piece[PANEL]) if piece[SIGN] == 0.0 else 0
        for k in range(memory.cut(piece, work.series[source], d - u, d + u, b, work.parts)):
            made = append(work.spare, made, work.parts[k])
    for i in range(made):
        work.pieces[i] = work.spare[i]
        if work.pieces[i, PANEL] == ACTIVE:
            work.pieces[i, PANEL] = memory.PAST
    return made


@kernel
def append(pieces: Pieces, made: int, part: Pieces) -> int:
    """Append a part, joined to the one before if both slip alike; return how many there are."""
    before = made - 1
    slips = made > 0 and part[PANEL] == ACTIVE and pieces[before, PANEL] == ACTIVE
    if slips and pieces[before, SIGN] == part[SIGN]:
        pieces[before, R1], pieces[before, A1] = part[R1], part[A1]
        return made
    if made < MAX_PIECES:
        pieces[made] = part
        made += 1
    return made
