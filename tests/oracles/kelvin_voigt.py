"""Normal impact of Kelvin & Voigt springs by power series at 40 digits; run, it prints its table.

Springs bear D - s, D = d + alpha v, and let go where that is zero. With d(clock) = dt/(2 b):
b' = v, v' = -(5/2) b^2 (b^2 + (3/2) alpha v) while loading, b^2 = d; then b' = v - (5/4) alpha b^3,
v' = -(5/2) b^4 with b^2 = D.
"""

from functools import partial

from mpmath import mp

TERMS = 45
ALPHAS = ("1e-6", "1e-4", "1e-3", "0.01", "0.05", "0.1", "0.2", "0.45", "1")


def series(b, v, drag, recession):
    """Return the power series of b, v and time in the clock, the highest power first."""
    b, v, t, square, load = [b], [v], [mp.mpf(0)], [], []
    for k in range(TERMS):
        square.append(mp.fdot(b, b[::-1]))
        load.append(square[k] + drag * v[k])
        b.append((v[k] - recession * mp.fdot(square, b[::-1])) / (k + 1))
        v.append(-mp.mpf(5) / 2 * mp.fdot(square, load[::-1]) / (k + 1))
        t.append(2 * b[k] / (k + 1))
    return [row[::-1] for row in (b, v, t)]


def horner(row, x):
    total = mp.mpf(0)
    for coefficient in row:
        total = total * x + coefficient
    return total


def part(b, v, drag, recession, falls, stride):
    """Return b, v and elapsed time where b (`falls` 0) or v (1) comes down to zero."""
    time = mp.mpf(0)
    while True:
        rows = series(b, v, drag, recession)
        ahead = [horner(row, stride) for row in rows]
        if ahead[falls] <= 0:
            fall = partial(horner, rows[falls])
            clock = mp.findroot(fall, (0, stride), solver="anderson")
            b, v, dt = (horner(row, clock) for row in rows)
            return b, v, time + dt
        b, v, time = ahead[0], ahead[1], time + ahead[2]


def impact(alpha, stride):
    """Return restitution, duration, largest b^2 and its time."""
    peak, v, loading = part(mp.mpf(0), mp.mpf(1), mp.mpf(3) / 2 * alpha, 0, 1, stride)
    _, v, unloading = part(peak, v, 0, mp.mpf(5) / 4 * alpha, 0, stride)
    return -v, loading + unloading, peak**2, loading


if __name__ == "__main__":
    with mp.workdps(40):
        for alpha in ALPHAS:
            hit = impact(mp.mpf(alpha), mp.mpf("0.06"))
            print(alpha, *(mp.nstr(value, 30) for value in hit), sep=",")
