"""What a collision needs of a law: restitution, and the change of the tangential velocity."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Matrix, Vector
from carom.dimensionless.numerics.kernels import kernel
from carom.quantities.arrays import Array

DEGREE = 10  # of a series, even: known to the compiler, which unrolls its sum
LARGEST = 1e300  # a bound on slopes, so that no infinity times zero occurs


class Rule(NamedTuple):
    """A law for one pair of bodies, as numbers.

    With the slope w = scale * V_x/V_n of the approach the contact point loses the part
    1 + beta = min(series, sliding/w) of its tangential velocity, beta = -V_x'/V_x, and
    V_n' = -restitution * V_n. The series has the powers of (slopes * w + shifts) on the panel that
    starts at the last of `edges` not above w.
    """

    restitution: float
    scale: float
    sliding: float
    edges: Vector  # (n,)
    slopes: Vector  # (n,)
    shifts: Vector  # (n,)
    powers: Matrix  # (n, DEGREE + 1), or (1, 1) of a constant


def constant_rule(restitution: float, sliding: float, one_plus_beta: float) -> Rule:
    """Return the rule of a law with one beta, up to the bound of sliding."""
    zero, power = np.zeros(1), np.full((1, 1), one_plus_beta)
    return frozen(Rule(restitution, 1.0, sliding, zero, zero, zero, power))


def frozen(rule: Rule) -> Rule:
    """Return the rule, its arrays protected: one compiled kernel serves all rules."""
    for values in rule[3:]:
        values.setflags(write=False)
    return rule


@kernel
def find_panels(slope: Array, count: int, edges: Array, panel: NDArray[np.int32]) -> None:
    """Write the panel of each slope: a binary search, side by side for all."""
    panel[:count] = 0
    width = edges.size
    for _ in range(64):
        if width <= 1:
            break
        half = width >> 1
        for i in range(count):
            ahead = panel[i] + half
            panel[i] = ahead if slope[i] >= edges[ahead] else panel[i]
        width -= half


@kernel
def one_plus_beta(
    slope: Array, count: int, rule: Rule, panel: NDArray[np.int32], out: Array
) -> None:
    """Write 1 + beta at each slope; `panel` is scratch space of the same size."""
    if rule.powers.shape[1] == 1:
        out[:count] = rule.powers[0, 0]
    else:
        series(slope, count, rule, panel, out)
    for i in range(count):  # beyond [0, 2] energy would grow
        bound = min(2.0, rule.sliding / slope[i])
        out[i] = max(0.0, bound if bound < out[i] else out[i])


@kernel
def series(slope: Array, count: int, rule: Rule, panel: NDArray[np.int32], out: Array) -> None:
    """Write the series at each slope, two powers at a time."""
    find_panels(slope, count, rule.edges, panel)
    for i in range(count):
        powers = rule.powers[panel[i]]
        place = rule.slopes[panel[i]] * slope[i] + rule.shifts[panel[i]]
        square = place * place
        value = powers[DEGREE]
        for term in range(DEGREE - 1, 0, -2):
            value = value * square + (powers[term] * place + powers[term - 1])
        out[i] = value
