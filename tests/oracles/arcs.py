"""The oblique impact of two springs side by side, as arcs of sines."""

import numpy as np
from scipy.optimize import brentq


class Arcs:
    """Two springs side by side, the tangential one with a slider (Maw, Barber & Fawcett 1976).

    In the clock of the loading spring N = sin t, then cos((t - pi/2)/e); psi' = -2 chi T and, in
    stick, T' = rho psi: arcs of sines of frequency sqrt(2 chi rho), between them arcs of slip.
    """

    def __init__(self, chi, rho, restitution):
        self.chi, self.rho, self.e = chi, rho, restitution
        self.frequency = np.sqrt(2 * chi * rho)
        self.end = np.pi / 2 * (1 + restitution)

    def phase(self, t):
        return np.where(t < np.pi / 2, t - np.pi / 2, (t - np.pi / 2) / self.e)

    def normal(self, t):
        return np.cos(self.phase(t))

    def normal_rate(self, t):
        return -np.sin(self.phase(t)) / np.where(t < np.pi / 2, 1.0, self.e)

    def impulse(self, t):
        return 1 + np.sin(self.phase(t)) * np.where(t < np.pi / 2, 1.0, self.e)

    def stick(self, t, t0, psi, force):
        """Return psi and T at t of a contact that sticks from t0."""
        turn, w = self.frequency * (t - t0), self.frequency
        return (
            psi * np.cos(turn) - 2 * self.chi / w * force * np.sin(turn),
            force * np.cos(turn) + self.rho / w * psi * np.sin(turn),
        )

    def slip(self, t, t0, psi, sign):
        return psi - 2 * self.chi * sign * (self.impulse(t) - self.impulse(t0))

    def rebound(self, psi):
        t0, force, sign = 0.0, 0.0, 1 if self.rho * psi > 1 else 0
        for _ in range(20):

            def excess(t, t0=t0, psi=psi, force=force, sign=sign):
                if sign:
                    outgrowth = sign * self.rho * self.slip(t, t0, psi, sign) - self.normal_rate(t)
                    return -outgrowth
                return np.abs(self.stick(t, t0, psi, force)[1]) - self.normal(t)

            times = np.linspace(t0, self.end, 4001)[1:-1]
            beyond = np.flatnonzero(excess(times) > 0.0)
            if beyond.size == 0:
                final = self.slip(self.end, t0, psi, sign) if sign else None
                return final if sign else self.stick(self.end, t0, psi, force)[0]
            late = times[beyond[0]]
            early = times[beyond[0] - 1] if beyond[0] else t0
            t = brentq(excess, early, late, xtol=1e-15) if excess(early) < 0.0 else early
            if sign:
                psi, force, sign = self.slip(t, t0, psi, sign), sign * self.normal(t), 0
            else:
                psi, force = self.stick(t, t0, psi, force)
                sign = int(np.sign(force))
            t0 = t
        raise AssertionError("no end")
