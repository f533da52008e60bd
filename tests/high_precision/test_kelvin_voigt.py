"""Normal impact of Kelvin & Voigt springs against power series at 40 digits.

Springs bear D - s, D = d + alpha v, and let go where that is zero. With d(clock) = dt/(2 b):
b' = v, v' = -(5/2) b^2 (b^2 + (3/2) alpha v) while loading, b^2 = d; then b' = v - (5/4) alpha b^3,
v' = -(5/2) b^4 with b^2 = D. `generate` made TABLE; run this file to print it again.
"""

import mpmath as mp
import pytest
from scipy.special import beta
from tests.oracles.march import motion

from carom.dimensionless.numerics import hertz

TERMS = 45

# alpha, restitution, duration, largest b^2, its time
TABLE = [
    (
        "1e-6",
        "0.999998108297074864537696239395",
        "2.94327474110608010186377107518",
        "0.999999243318357358765282115404",
        "1.47163716204192268699260538197",
    ),
    (
        "1e-4",
        "0.999810858694227770822391906412",
        "2.94323086529316996061220657019",
        "0.999924338752814766042400899234",
        "1.47159458267299467624173941428",
    ),
    (
        "1e-3",
        "0.998111218305156711168777524515",
        "2.94283225114521915527803489561",
        "0.999244015736712340625179283909",
        "1.47120772923838684551709281695",
    ),
    (
        "0.01",
        "0.981371609939200244115304824445",
        "2.93887134963297834856797268283",
        "0.992502373139721106056058951676",
        "1.46736198652138223425060908839",
    ),
    (
        "0.05",
        "0.91224172035843163045898756541",
        "2.92179990294291061363768351507",
        "0.963831094296967884329914753401",
        "1.45075291049586557592203982735",
    ),
    (
        "0.1",
        "0.836404652176792274528172491169",
        "2.90158915191212801190313581028",
        "0.93069587979138040100742805065",
        "1.43102411868104061886041363501",
    ),
    (
        "0.2",
        "0.712382433649457977446690633665",
        "2.86442300773268560600313024531",
        "0.872045107390488178154503182796",
        "1.39458821407183091593504781132",
    ),
    (
        "0.45",
        "0.505932242030271667667419360983",
        "2.7860668205194380764626295765",
        "0.757949515255600387782721461785",
        "1.31732489406100635089718415233",
    ),
    (
        "1",
        "0.287230201467896573168189708025",
        "2.65907259723084280452815197012",
        "0.599265075186471385218558056318",
        "1.19184174832027384988803555925",
    ),
]


def series(b, v, drag, recession):
    """Return the power series of b, v and time in the clock."""
    b, v, t, square, load = [b], [v], [mp.mpf(0)], [], []
    for k in range(TERMS):
        square.append(mp.fdot(b, b[::-1]))
        load.append(square[k] + drag * v[k])
        b.append((v[k] - recession * mp.fdot(square, b[::-1])) / (k + 1))
        v.append(-mp.mpf(5) / 2 * mp.fdot(square, load[::-1]) / (k + 1))
        t.append(2 * b[k] / (k + 1))
    return [row[::-1] for row in (b, v, t)]


def horner(row, x):
    """Return a polynomial at x, the highest power first."""
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
            clock = mp.findroot(
                lambda z, row=rows[falls]: horner(row, z), (0, stride), solver="anderson"
            )
            b, v, dt = (horner(row, clock) for row in rows)
            return b, v, time + dt
        b, v, time = ahead[0], ahead[1], time + ahead[2]


def impact(alpha, stride):
    """Return restitution, duration, largest b^2 and its time."""
    peak, v, loading = part(mp.mpf(0), mp.mpf(1), mp.mpf(3) / 2 * alpha, 0, 1, stride)
    _, v, unloading = part(peak, v, 0, mp.mpf(5) / 4 * alpha, 0, stride)
    return -v, loading + unloading, peak**2, loading


def generate():
    with mp.workdps(40):
        for alpha in ("1e-6", "1e-4", "1e-3", "0.01", "0.05", "0.1", "0.2", "0.45", "1"):
            row = [mp.nstr(value, 30) for value in impact(mp.mpf(alpha), mp.mpf("0.06"))]
            print(f"    ({', '.join(repr(text) for text in (alpha, *row))}),")


@pytest.mark.parametrize("row", TABLE, ids=lambda row: row[0])
def test_rows_of_the_marching_method(row):
    """Equal steps of the clock, any number of them, end where the table does, to 1e-11."""
    alpha, *truth = map(float, row)
    for steps in (100, 1000):
        _, time, edge, limit, _, speed = motion(alpha, steps)
        peak = steps // 2
        found = -speed[-1], time[-1], edge[peak] ** 2, time[peak]
        assert found == pytest.approx(truth, rel=1e-11)
        assert edge[peak] == max(edge)
        assert edge[-1] == limit[-1] == 0.0


@pytest.mark.parametrize("row", TABLE[2::6], ids=lambda row: row[0])
def test_table_does_not_depend_on_the_strides_of_the_series(row):
    with mp.workdps(40):
        for value, text in zip(impact(mp.mpf(row[0]), mp.mpf("0.1")), row[1:], strict=True):
            assert abs(value / mp.mpf(text) - 1) < mp.mpf("1e-28")


def test_small_losses():
    """1 - e = (3/2) B(3/5, 3/2) alpha, the duration and depth are Hertz's, to the next order."""
    alpha, restitution, duration, depth, half = (mp.mpf(text) for text in TABLE[0])
    assert abs((1 - restitution) / alpha - 1.5 * beta(0.6, 1.5)) < 5 * alpha
    assert abs(duration - hertz.DURATION) < 2 * alpha
    assert abs(depth - 1) < 2 * alpha
    assert abs(half - hertz.HALF) < 2 * alpha


if __name__ == "__main__":
    generate()
