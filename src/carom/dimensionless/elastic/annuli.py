"""The memory of the contact of an elastic impact at one instant."""

import numpy as np

from carom.dimensionless.elastic import dense_output as dense
from carom.dimensionless.elastic.memory import MADE, OUTER, SLIP_SIGN
from carom.dimensionless.elastic.motion import STICK, B
from carom.dimensionless.elastic.phases import RETRACED
from carom.dimensionless.elastic.record import MODE, SIGN, STRETCH, Record
from carom.dimensionless.fields.memory import Annulus, Memory
from carom.dimensionless.numerics.arrays import Array


def memory_at(
    record: Record, times: Array, moved: Array, now: dict[str, float], scale: float
) -> Memory:
    """Return the memory at the instant that `now` describes; `scale` is as in `Solution`."""
    d, edge, front = now["penetration"], now["contact_radius"], now["stick_radius"]
    step = int(np.searchsorted(times, now["time"], side="right")) - 1
    node, mirror = record.nodes[step], -1 if scale < 0.0 else 1
    stretch = int(node[STRETCH])
    annuli, inner = [], 0.0

    def inside(annulus: Annulus, x: Array) -> tuple[Array, Array]:
        if annulus.sign:
            sign = annulus.sign * abs(scale)
            return np.full(x.shape, sign), now["displacement"] + sign * (annulus.limit - x * x)
        laid = np.empty((x.size, 2))
        dense.loading_states(record.nodes, record.series, moved, x, laid)
        return scale * laid[:, 0], now["displacement"] - scale * laid[:, 1]

    for row in record.stacks[stretch, : record.depths[stretch]]:
        outer, sign = min(float(row[OUTER]), front), mirror * int(row[SLIP_SIGN])
        if outer > inner:
            annuli.append(Annulus(inner, outer, sign, _limit(record, moved, row)))
            inner = outer
    if edge > inner:
        sign = int(node[SIGN])
        limit = d - sign * now["displacement"] / scale
        sticks = node[MODE] in (STICK, RETRACED)
        annuli.append(Annulus(inner, edge, *((0, np.nan) if sticks else (mirror * sign, limit))))
    return Memory(now["time"], d, now["displacement"], tuple(annuli), inside)


def _limit(record: Record, moved: Array, row: Array) -> float:
    """Return l = d - sigma U when slip made the annulus."""
    made = int(row[MADE])
    if row[SLIP_SIGN] == 0.0 or made >= len(record.series):
        return np.nan
    return float(record.series[made, 0, B] ** 2 - row[SLIP_SIGN] * moved[made, 0])
