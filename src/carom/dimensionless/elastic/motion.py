"""Equations of motion of an oblique impact, as recurrences for their Taylor series.

The time variable tau, d(tau) = dt/(2 b) with b = sqrt(d) the contact radius, turns the motion into

    b' = v,   v' = -(5/2) b^2 (b^2 + (3/2) lambda v),
    psi' = -(15/2) chi b Q,   Q' = 2 b (psi a + sigma v (b - a)),

analytic at the first touch, at the turning point and at the last touch alike (a = b in stick, 0 in
gross slip). lambda is by how much a plate gives way (Zener 1941), 0 for a thick wall.

In a slip ring the front a retreats through memory that was laid while the contact grew, so that
(a, v_a, psi_a, Q_a) is the loading state met once more, run backwards. The front's condition
F(s_a) = l ties its clock tau_a to the contact's clock tau by

    -d(tau_a)/d(tau) = N/D,   N = b (sigma psi - v),   D = a (v_a - sigma psi_a),

or D = 2 a in memory left by slip of the other sign. Series are in the faster of the two clocks, so
that they are regular when slip stops (N = 0) and when the front reaches the centre (D = 0); where
slip starts after stick N = D = 0, N/D = 1 and the recurrence is shifted by one order.
"""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.kernels import kernel

Series = NDArray[np.float64]  # one row per order, one column per variable; row 0 is the state

ORDER = 18

# Contact radius, normal speed, tangential speed, force integral; the same at the front.
B, V, PSI, Q, A, V_A, PSI_A, Q_A = range(8)
STATE_SIZE = 8
# The rates of both, each by its own clock; b and a times both; the rate of the slower clock; N, D.
B_RATE, V_RATE, PSI_RATE, Q_RATE, A_RATE, VA_RATE, PSIA_RATE, QA_RATE = range(8, 16)
BB, BV, BPSI, BQ, AA, AV, APSI, AQ = range(16, 24)
PACE, SLOWER, N, D = 24, 28, 29, 30  # PACE: four rates by the faster clock
SERIES_COLUMNS = 31

# Modes of motion.
STICK = 0  # the whole contact moves as one
LAID = 1  # slip ring, its front retreating through memory laid in stick
FLAT = 2  # slip ring, its front retreating through memory left by slip of the other sign
SLIDE = 5  # gross slip on a plate, of `plates`

# Clocks.
CONTACT = 0
FRONT = 1
START = 2  # clock of the contact, in the first step of slip after stick


@kernel
def multiply(s: Series, factor: int, first: int, out: int, k: int) -> None:
    """Extend the products of one series with four neighbours to order k."""
    t0, t1, t2, t3 = 0.0, 0.0, 0.0, 0.0
    for j in range(k + 1):
        f = s[j, factor]
        t0 += f * s[k - j, first]
        t1 += f * s[k - j, first + 1]
        t2 += f * s[k - j, first + 2]
        t3 += f * s[k - j, first + 3]
    s[k, out], s[k, out + 1], s[k, out + 2], s[k, out + 3] = t0, t1, t2, t3


@kernel
def multiply_both(s: Series, k: int) -> None:
    """Extend b and a times their states to order k: two `multiply` at once, to keep adders busy."""
    t0, t1, t2, t3 = 0.0, 0.0, 0.0, 0.0
    u0, u1, u2, u3 = 0.0, 0.0, 0.0, 0.0
    for j in range(k + 1):
        b, a = s[j, B], s[j, A]
        t0 += b * s[k - j, B]
        t1 += b * s[k - j, V]
        t2 += b * s[k - j, PSI]
        t3 += b * s[k - j, Q]
        u0 += a * s[k - j, A]
        u1 += a * s[k - j, V_A]
        u2 += a * s[k - j, PSI_A]
        u3 += a * s[k - j, Q_A]
    s[k, BB], s[k, BV], s[k, BPSI], s[k, BQ] = t0, t1, t2, t3
    s[k, AA], s[k, AV], s[k, APSI], s[k, AQ] = u0, u1, u2, u3


@kernel
def product(s: Series, one: int, other: int, k: int) -> float:
    """Return the coefficient of order k of the product of two series."""
    total = 0.0
    for j in range(k + 1):
        total += s[j, one] * s[k - j, other]
    return total


@kernel
def combine(s: Series, mode: int, sign: int, k: int) -> None:
    """Extend N and D to order k from the products of that order."""
    s[k, N] = sign * s[k, BPSI] - s[k, BV]
    s[k, D] = 2.0 * s[k, A] if mode == FLAT else s[k, AV] - sign * s[k, APSI]


@kernel
def stick_rates(s: Series, chi: float, k: int) -> None:
    """Extend the rates of a contact that sticks as a whole to order k."""
    multiply(s, B, B, BB, k)
    b4, force = 0.0, 0.0
    for j in range(k + 1):
        b4 += s[j, BB] * s[k - j, BB]
        force += s[j, BB] * s[k - j, PSI]
    write_contact_rates(s, chi, b4, force, k)


@kernel
def ring_rates(s: Series, mode: int, sign: int, chi: float, k: int) -> None:
    """Extend the rates of contact and front to order k, each by its own clock."""
    multiply_both(s, k)
    combine(s, mode, sign, k)
    b4, stuck, slipping, a4, laid = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(k + 1):
        b4 += s[j, BB] * s[k - j, BB]
        stuck += s[j, A] * s[k - j, N]
        slipping += s[j, B] * s[k - j, BV]
        a4 += s[j, AA] * s[k - j, AA]
        laid += s[j, A] * s[k - j, APSI]
    write_contact_rates(s, chi, b4, sign * (stuck + slipping), k)
    if mode == FLAT:
        s[k, A_RATE] = -1.0 if k == 0 else 0.0
        s[k, VA_RATE], s[k, PSIA_RATE], s[k, QA_RATE] = 0.0, 0.0, 0.0
    else:
        s[k, A_RATE] = -s[k, V_A]
        s[k, VA_RATE] = 2.5 * a4
        s[k, PSIA_RATE] = 7.5 * chi * s[k, AQ]
        s[k, QA_RATE] = -2.0 * laid


@kernel
def write_contact_rates(s: Series, chi: float, b4: float, force: float, k: int) -> None:
    """Write the rates of the contact of order k."""
    s[k, B_RATE] = s[k, V]
    s[k, V_RATE] = -2.5 * b4
    s[k, PSI_RATE] = -7.5 * chi * s[k, BQ]
    s[k, Q_RATE] = 2.0 * force


@kernel
def give_way(s: Series, mode: int, give: float, k: int) -> None:
    """Add to the rates of the normal speed, of order k, that of a plate which gives way."""
    s[k, V_RATE] -= 3.75 * give * product(s, BB, V, k)
    if mode == LAID:
        s[k, VA_RATE] += 3.75 * give * product(s, AA, V_A, k)


@kernel
def advance(s: Series, first: int, rates: int, slower: bool, k: int) -> None:
    """Give four variables their coefficients of order k + 1 from their rates of order k."""
    if slower:
        multiply(s, SLOWER, rates, PACE, k)
        rates = PACE
    for c in range(4):
        s[k + 1, first + c] = s[k, rates + c] / (k + 1)


@kernel
def quotient(s: Series, over: int, under: int, k: int) -> None:
    """Extend the rate of the slower clock to order k."""
    total = s[k, over]
    for j in range(k):
        total -= s[j, SLOWER] * s[k - j, under]
    s[k, SLOWER] = total / s[0, under]


@kernel
def starting_quotient(s: Series, sign: int, k: int) -> None:
    """Extend N/D to order k where both vanish, from their coefficients of order k + 1.

    The coefficient sought is itself part of D's: a_{k+1} = -v_a r_k/(k + 1) + ..., and so on.
    """
    if k == 0:
        s[0, SLOWER] = 1.0
        return
    s[k, SLOWER] = 0.0
    advance(s, A, A_RATE, True, k)
    multiply_both(s, k + 1)
    combine(s, LAID, sign, k + 1)
    total = s[k + 1, N]
    for j in range(k):
        total -= s[j, SLOWER] * s[k + 1 - j, D]
    turn = s[0, A] * (s[0, VA_RATE] - sign * s[0, PSIA_RATE])
    s[k, SLOWER] = total / (turn * (1.0 + 1.0 / (k + 1)))


@kernel
def expand(s: Series, mode: int, clock: int, sign: int, chi: float, give: float) -> None:
    """Expand the state in row 0 into Taylor series by the given clock."""
    for k in range(ORDER):
        if mode == STICK:
            stick_rates(s, chi, k)
            if give > 0.0:
                give_way(s, mode, give, k)
            advance(s, B, B_RATE, False, k)
            continue
        ring_rates(s, mode, sign, chi, k)
        if give > 0.0:
            give_way(s, mode, give, k)
        if clock == FRONT:
            quotient(s, D, N, k)
            advance(s, B, B_RATE, True, k)
            advance(s, A, A_RATE, False, k)
        else:
            advance(s, B, B_RATE, False, k)
            if clock == START:
                starting_quotient(s, sign, k)
            else:
                quotient(s, N, D, k)
            advance(s, A, A_RATE, True, k)
