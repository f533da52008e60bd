"""Contact laws as DEM codes define them, integrated in SI units from event to event.

The stored displacement or force as the code keeps it, SciPy's Dormand-Prince of order 8.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from tests.oracles.dem_contact import (
    DEEPEST,
    DURATION,
    E_STAR,
    FRICTION,
    G_EFF,
    HERTZ,
    LEAST,
    MASS,
    RADIUS,
    SLOWEST,
    SPEED,
    damping_ratio,
)

E = 0.8
BETA = damping_ratio(E)
LINEAR = MASS * (np.pi / DURATION) ** 2  # k_n of a linear spring


def radius(d):
    return np.sqrt(RADIUS * max(d, 1e-3 * LEAST * DEEPEST))


def mindlin(d):
    return 8 * G_EFF * radius(d)


def normal_dashpot(d):
    return 2 * np.sqrt(5 / 6) * BETA * np.sqrt(2 * E_STAR * radius(d) * MASS)


def tangential_dashpot(d):
    return 2 * np.sqrt(5 / 6) * BETA * np.sqrt(mindlin(d) * MASS)


def hertz(d):
    return HERTZ * max(d, 0.0) ** 1.5


def tsuji_dashpot(d):
    e = E
    alpha = 1.2728 - 4.2783 * e + 11.087 * e**2 - 22.348 * e**3 + 27.467 * e**4
    alpha += -18.022 * e**5 + 4.8218 * e**6
    return alpha * np.sqrt(MASS * hertz(d) / max(d, 1e-3 * LEAST * DEEPEST))


def nothing(d):
    return 0.0


@dataclass(frozen=True)
class Code:
    """What a code computes: forces in N of lengths in m and speeds in m/s."""

    force_stored: bool = False
    shrinks: bool = False  # what is stored, with the radius while the contact unloads
    stiffness: Callable[[float], float] = mindlin
    elastic: Callable[[float], float] = hertz
    normal_dashpot: Callable[[float], float] = nothing
    dashpot: Callable[[float], float] = nothing
    limits_sum: bool = True  # else the spring alone

    def normal(self, y):
        return self.elastic(y[0]) + self.normal_dashpot(y[0]) * y[1]

    def spring(self, y):
        return y[3] if self.force_stored else self.stiffness(y[0]) * y[3]

    def limited(self, y):
        return self.spring(y) + (self.dashpot(y[0]) * y[2] if self.limits_sum else 0.0)

    def over(self, y):
        return abs(self.limited(y)) - FRICTION * abs(self.normal(y))

    def at_limit(self, y, slip):
        """Return the state with what a sliding contact stores."""
        force = slip * FRICTION * abs(self.normal(y))
        force -= self.dashpot(y[0]) * y[2] if self.limits_sum else 0.0
        return np.array([*y[:3], force if self.force_stored else force / self.stiffness(y[0])])

    def rates(self, y, slip):
        force = slip * FRICTION * abs(self.normal(y))
        if slip == 0:
            force = self.spring(y) + self.dashpot(y[0]) * y[2]
        growth = self.stiffness(y[0]) * y[2] if self.force_stored else y[2]
        if self.shrinks and y[1] < 0:
            growth += y[3] * y[1] / (2 * max(y[0], 1e-3 * LEAST * DEEPEST))
        stored = growth if slip == 0 else 0.0
        return np.array([y[1], -self.normal(y) / MASS, -3.5 * force / MASS, stored])

    def would_grow(self, y, slip):
        """Return how fast the force would outgrow its limit, if the contact stuck."""
        y = self.at_limit(y, slip)
        small = 1e-7 * max(y[0], 1e-3 * LEAST * DEEPEST) / SPEED * self.rates(y, 0)
        excess = [
            slip * self.limited(z) - FRICTION * abs(self.normal(z)) for z in (y + small, y - small)
        ]
        return excess[0] - excess[1]

    def touch(self, psi):
        d = LEAST * DEEPEST
        along = psi * SLOWEST * d / SPEED
        stored = 2 / 3 * self.stiffness(d) * along if self.force_stored else along
        return np.array([d, SPEED, psi * SLOWEST, stored])


def events(code, slip, loading):
    """Return the instants that end a stretch of motion: parting, turning, sliding or sticking."""
    actual = [
        lambda t, y: 1.0 if loading else y[0] - LEAST * DEEPEST,
        lambda t, y: y[1] if loading else 1.0,
        (lambda t, y: code.would_grow(y, slip)) if slip else (lambda t, y: code.over(y)),
    ]
    for event, direction in zip(actual, (-1, -1, -1 if slip else 1), strict=True):
        event.terminal, event.direction = True, direction
    return actual


def rebound(code, psi, precision=1e-11):
    t, y, loading = 0.0, code.touch(psi), True
    slip = int(np.sign(code.limited(y))) if code.over(y) > 0 else 0
    if slip and code.would_grow(y, slip) < 0:  # what it stores at touch tears it off at once
        y = code.at_limit(y, slip)
        y[3], slip = y[3] - slip * 1e-9 * abs(y[3]), 0
    stored = hertz(DEEPEST) if code.force_stored else SLOWEST * DEEPEST / SPEED
    scale = precision * 1e-2 * np.array([DEEPEST, SPEED, SLOWEST, stored])
    for _ in range(40):
        run = solve_ivp(
            lambda t, y, slip=slip: code.rates(y, slip),
            (t, 5 * DURATION),
            y,
            method="DOP853",
            rtol=precision,
            atol=scale,
            events=events(code, slip, loading),
            max_step=DURATION / 40,
        )
        assert run.status == 1, run.message
        t, y = run.t[-1], run.y[:, -1]
        y = code.at_limit(y, slip) if slip else y
        parts, turns, _ = (len(times) > 0 for times in run.t_events)
        if parts:
            return y[2] / SLOWEST
        if turns:
            loading = False
        else:
            slip = 0 if slip else int(np.sign(code.limited(y)))
    raise AssertionError("the twin does not part")
