"""Work of friction per area at a radius, integrated over the time, or over the contact radius."""

import numpy as np
from scipy.integrate import quad


def over_the_radius(r):
    """Return the integral of b sqrt(b^2 - r^2)/sqrt(1 - b^5) db, from r to 1."""

    def smooth(b):
        return b * np.sqrt((b + r) / (1.0 + b + b**2 + b**3 + b**4))

    return quad(smooth, r, 1.0, weight="alg", wvar=(0.5, -0.5), epsrel=1e-12, limit=400)[0]


def at_radius(solution, r):
    """Integrate the power at a radius over the time, from the states of the solution alone."""

    def state(t):
        now = solution.at(t)
        return now.stick_radius[0] - r, now.contact_radius[0] - r, now.psi[0], now.speed[0]

    def slides(t):
        stuck, inside, _, _ = state(t)
        return stuck < 0.0 < inside

    total = 0.0
    for phase in (phase for phase in solution.phases if phase.sign):
        scan = np.linspace(phase.start, phase.end, 400)[1:-1]
        inside = scan[[slides(t) for t in scan]]
        if inside.size == 0:
            continue
        ends = []
        for first, last in ((inside[0], phase.start), (inside[-1], phase.end)):
            outer = first + np.clip(last - first, scan[0] - scan[1], scan[1] - scan[0])
            for _ in range(60):
                middle = 0.5 * (first + outer)
                first, outer = (middle, outer) if slides(middle) else (first, middle)
            ends.append(first)

        def power(phi, sign=phase.sign, start=ends[0], length=ends[1] - ends[0]):
            stuck, _, psi, speed = state(start + length * np.sin(phi) ** 2)
            a = stuck + r
            edge = 1.0 - speed**2  # b^5
            shape = 2.0 / np.pi * np.arccos(min(max(a, 0.0) / r, 1.0))
            root = np.sqrt(max(edge**0.4 - r * r, 0.0))
            return (sign * psi - speed) * shape * root * length * np.sin(2.0 * phi)

        total += quad(power, 0.0, 0.5 * np.pi, epsabs=1e-11, epsrel=1e-10, limit=200)[0]
    return total
