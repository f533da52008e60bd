"""The stick phase of Barber (1979) in closed form by mpmath: equations (15)-(27) and (33)-(37).

Lengths in d_max, time in d_max/V_1, tangential displacement in mu d_max/kappa. In z = (1 - v)/2,
x = 4 z (1 - z), the solutions v h_1 and v h_2 of (20) are regular up to the turning point:

    v h_1 = F(-n, n + 1/5; 3/5; z),  v h_2 ~ z^(2/5) F(2/5 - n, n + 3/5; 7/5; z),

with n = (sqrt(240 chi + 1) - 1)/10 (Abramowitz & Stegun 15.3.24). The force follows from
psi' = -(15/4) chi Q, the displacement from U' = psi by Gauss's quadrature in z^(1/5).
After gross slip psi and Q are continuous; that is not the g' = 0 printed in (35).
"""

from functools import cached_property

import mpmath as mp
import numpy as np
from mpmath.calculus.quadrature import GaussLegendre

DIGITS = 30
ROUNDING = 2e-15  # |g| must pass 1 by more than this: where it only touches, stick goes on
NODES, WEIGHTS = zip(*GaussLegendre(mp.mp).calc_nodes(5, 100), strict=True)  # 48 of them


def transition_speed(psi, chi):
    """Return the speed v = V_z/V_1 at which gross slip from the first touch ends, (34)."""
    return (abs(psi) - 2.0 * chi) / (1.0 - 2.0 * chi)


def root_of_depth(z):
    return mp.power(4 * z * (1 - z), mp.mpf(1) / 5)


class Stick:
    """A stick phase; its functions take speeds v or places x = d^(5/2), floats or arrays."""

    def __init__(self, psi, chi, slides_first=False):
        from_touch = abs(psi) < 1 or (abs(psi) == 1 and chi >= 0.5)
        if not (1 < abs(psi) < 2 * chi if slides_first else from_touch):
            raise ValueError(f"psi = {psi}, chi = {chi}: there is no such phase of stick")
        self.chi, self.sign, self.slides_first = mp.mpf(chi), int(np.sign(psi)), slides_first
        with mp.workdps(DIGITS):
            self.psi_1 = mp.mpf(psi)
            self.n = (mp.sqrt(240 * self.chi + 1) - 1) / 10
            self.first = (
                (abs(self.psi_1) - 1) / (2 * self.chi - 1) / 2 if slides_first else mp.mpf(0)
            )
            self.shares = self.continuous() if slides_first else (self.psi_1, mp.mpf(0))

    @classmethod
    def from_touch(cls, psi, chi):
        return cls(psi, chi)

    @classmethod
    def after_gross_slip(cls, psi, chi):
        return cls(psi, chi, slides_first=True)

    def continuous(self):
        """Return the shares of both solutions that carry on psi and Q of gross slip."""
        z = self.first
        pair = [(self.psi_at(z, unit), self.force_at(z, unit)) for unit in ((1, 0), (0, 1))]
        slid = mp.matrix([1 - 2 * z, 2 * root_of_depth(z) ** 3 / 3])
        return tuple(self.sign * mp.lu_solve(mp.matrix(pair).T, slid))

    def psi_at(self, z, shares):
        n, fifth = self.n, mp.mpf(1) / 5
        total = shares[0] * mp.hyp2f1(-n, n + fifth, 3 * fifth, z)
        if shares[1]:
            total += (
                shares[1] * z ** (2 * fifth) * mp.hyp2f1(2 * fifth - n, n + 3 * fifth, 7 * fifth, z)
            )
        return total

    def force_at(self, z, shares):
        n, fifth = self.n, mp.mpf(1) / 5
        total = (
            2
            * shares[0]
            / 3
            * root_of_depth(z) ** 3
            * mp.hyp2f1(1 - n, n + 6 * fifth, 8 * fifth, z)
        )
        if shares[1]:
            slope = (4 - 4 * z) ** (3 * fifth) * mp.hyp2f1(
                2 * fifth - n, n + 3 * fifth, 2 * fifth, z
            )
            total -= shares[1] * slope / (15 * self.chi)
        return total

    def g_at(self, z):
        psi, v = self.psi_at(z, self.shares), 1 - 2 * z
        if v:
            return psi / v
        if abs(psi) > mp.mpf(10) ** (5 - DIGITS):
            return mp.inf * mp.sign(psi)
        return 3 * self.chi * self.force_at(z, self.shares)  # dpsi/dv

    def displacement_at(self, z):
        before, chi = mp.mpf(0), self.chi
        if self.slides_first:  # (33), integrated
            x = 4 * self.first * (1 - self.first)
            time = mp.betainc(mp.mpf(2) / 5, mp.mpf(1) / 2, 0, x) * 2 / 5
            slid = (abs(self.psi_1) - 2 * chi) * time + 2 * chi * root_of_depth(self.first) ** 2
            before = self.sign * slid
        start, end = mp.root(self.first, 5), mp.root(z, 5)
        roots = [start + (end - start) * (1 + node) / 2 for node in NODES]
        rates = [w * self.psi_at(w**5, self.shares) / (1 - w**5) ** mp.mpf("0.6") for w in roots]
        return before + mp.power(4, mp.mpf("0.4")) * (end - start) * mp.fdot(WEIGHTS, rates)

    def values(self, function, v, x):
        def value(place):
            with mp.workdps(DIGITS):
                speed = mp.mpf(place) if x is None else mp.sqrt(1 - mp.mpf(place))
                return float(function((1 - speed) / 2))

        actual = np.vectorize(value, otypes=[float])(v if x is None else x)
        return actual if actual.ndim else float(actual)

    def psi(self, v=None, *, x=None):
        """Return psi = g v, (25)."""
        return self.values(lambda z: self.psi_at(z, self.shares), v, x)

    def g(self, v=None, *, x=None):
        """Return g = psi/v, (27)."""
        return self.values(self.g_at, v, x)

    def force(self, v=None, *, x=None):
        """Return Q = (2/3) F_x/(mu P_max), (12)."""
        return self.values(lambda z: self.force_at(z, self.shares), v, x)

    def displacement(self, v=None, *, x=None):
        """Return U = integral of g dd, in units of mu d_max/kappa."""
        return self.values(self.displacement_at, v, x)

    @property
    def start(self):
        """The speed v at which the phase starts, (34)."""
        return float(1 - 2 * self.first)

    @cached_property
    def end(self):
        """The speed at which |g| = 1 ends the phase, found by a scan; None at the turning point."""
        points = 24 + int(16 * self.n)
        speeds = self.start * np.cos(np.linspace(0.0, 0.5 * np.pi, points))[1:-1]
        speeds = np.append(speeds, 1e-12 * self.start)
        beyond = next((i for i, v in enumerate(speeds) if abs(self.g(v)) > 1.0 + ROUNDING), None)
        if beyond is None:
            return None
        inside = speeds[beyond - 1] if beyond else self.start * (1 - 1e-14)
        sign = np.sign(self.psi(speeds[beyond]))
        with mp.workdps(DIGITS):
            return float(
                mp.findroot(
                    lambda v: sign * self.psi_at((1 - v) / 2, self.shares) - v,
                    (mp.mpf(inside), mp.mpf(speeds[beyond])),
                    solver="anderson",
                    tol=1e-40,
                )
            )

    @property
    def slip_sign(self):
        """The sign of the slip that starts at the end, that of g there; 0 without an end."""
        return 0 if self.end is None else int(np.sign(self.psi(self.end)))
