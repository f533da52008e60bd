"""Contact laws that soften, as their papers define them, integrated in SI units.

Thornton & Yin (1991): dT = theta k_t dU +- (1 - theta) mu dN with turning points T*, T** that move
by mu dN. Walton & Braun (1986): dT = K dU, K = K_0 (1 - (T - T*)/(mu N - T*))^(1/3), T* in
proportion to N. By SciPy's LSODA and Dormand-Prince, from event to event.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from tests.oracles.dem_contact import (
    DEEPEST,
    FRICTION,
    G_EFF,
    HERTZ,
    LEAST,
    MASS,
    RADIUS,
    SLOWEST,
    SPEED,
)

TIME = DEEPEST / SPEED
K_1 = 2 * HERTZ * np.sqrt(DEEPEST)  # of the linear law; no matter which
FIRST, BACK, AGAIN = 0, 1, 2
D, V, W, T, UPPER, LOWER = range(6)  # the state: penetration, speeds, force, T*, T**


@dataclass(frozen=True)
class Thornton:
    method = "DOP853"

    def normal(self, y, deepest):
        d = max(y[D], 0.0)
        return HERTZ * d**1.5, 1.5 * HERTZ * np.sqrt(d) * y[V]

    def tangential_rate(self, branch, y, n, n_rate):
        limit = max(FRICTION * n, 1e-300)
        gone = (y[T] / limit, (y[UPPER] - y[T]) / (2 * limit), (y[T] - y[LOWER]) / (2 * limit))
        theta = np.cbrt(np.clip(1 - gone[branch], 0, 1))
        elastic = 8 * G_EFF * np.sqrt(RADIUS * max(y[D], 0.0)) * y[W]
        if abs(elastic) < FRICTION * n_rate:
            theta = 1.0
        return theta * elastic + (-1) ** branch * (1 - theta) * FRICTION * n_rate

    def turning_rates(self, y, n, n_rate):
        return FRICTION * n_rate, -FRICTION * n_rate

    def at_touch(self, w, n):
        return min(w / SLOWEST, 1.0) * FRICTION * n  # T/(mu N) = psi until it slides

    def parts(self, y, n):
        return y[D] - LEAST * DEEPEST


@dataclass(frozen=True)
class Walton:
    restitution: float
    stiffness: float  # K_0
    method = "LSODA"

    def normal(self, y, deepest):
        if deepest is None:
            return K_1 * y[D], K_1 * y[V]
        k_2 = K_1 / self.restitution**2
        return K_1 * deepest + k_2 * (y[D] - deepest), k_2 * y[V]

    def tangential_rate(self, branch, y, n, n_rate):
        limit = FRICTION * n
        gone = (
            y[T] / limit,
            (y[UPPER] - y[T]) / (limit + y[UPPER]),
            (y[T] - y[LOWER]) / (limit - y[LOWER]),
        )
        return self.stiffness * np.cbrt(np.clip(1 - gone[branch], 0, 1)) * y[W]

    def turning_rates(self, y, n, n_rate):
        return y[UPPER] * n_rate / n, y[LOWER] * n_rate / n

    def at_touch(self, w, n):
        """Return T = (1 - x^3) mu N, whose rate is K_0 x w: what keeps T in proportion to N."""
        ratio = self.stiffness * w / (FRICTION * K_1 * SPEED)
        return (1 - brentq(lambda x: 1 - x**3 - ratio * x, 0, 1) ** 3) * FRICTION * n

    def parts(self, y, n):
        return n - 1e-10 * K_1 * DEEPEST


def stretch(law, ratio, t, y, branch, slip, deepest, precision=1e-10):
    """Return the motion until something happens."""

    def forces(y):
        n, n_rate = law.normal(y, deepest)
        return n, n_rate, law.tangential_rate(branch, y, n, n_rate)

    def rates(t, y):
        n, n_rate, t_rate = forces(y)
        t_rate = slip * FRICTION * n_rate if slip else t_rate
        turning = law.turning_rates(y, n, n_rate)
        return np.array([y[V], -n / MASS, -ratio * y[T] / MASS, t_rate, *turning])

    def parts(t, y):
        return 1.0 if deepest is None else law.parts(y, forces(y)[0])

    def turns(t, y):
        return y[V] if deepest is None else 1.0

    def reverses(t, y):
        return y[W] if branch == BACK else -y[W]

    def slides_or_sticks(t, y):
        n, n_rate, t_rate = forces(y)
        if slip:
            return FRICTION * n_rate - slip * t_rate - 1e-12 * K_1 * SPEED
        return abs(y[T]) - FRICTION * n * (1 + 1e-10)

    def continues(t, y):
        return y[T] - y[UPPER] if branch == AGAIN and isinstance(law, Thornton) else -1.0

    events = [parts, turns, reverses, slides_or_sticks, continues]
    for event, direction in zip(events, (-1, -1, 1, 1, 1), strict=True):
        event.terminal, event.direction = True, direction
    force = FRICTION * K_1 * DEEPEST
    scale = np.array([DEEPEST, SPEED, SLOWEST, force, force, force])
    return solve_ivp(
        rates,
        (t, t + 9 * TIME),
        y,
        method=law.method,
        rtol=precision,
        atol=precision * 1e-2 * scale,
        events=events,
        max_step=TIME / 20,
    )


def rebound(law, psi, ratio):
    t, y = 0.0, np.zeros(6)
    y[D], y[V], y[W] = LEAST * DEEPEST, SPEED, psi * SLOWEST
    n, _ = law.normal(y, None)
    y[T:] = law.at_touch(y[W], n), FRICTION * n, -FRICTION * n
    branch, slip, deepest = FIRST, 0, None
    for _ in range(40):
        run = stretch(law, ratio, t, y, branch, slip, deepest)
        assert run.status == 1, run.message
        t, y = run.t[-1], run.y[:, -1].copy()
        if slip:
            y[T] = slip * FRICTION * law.normal(y, deepest)[0]
        parts, turns, reverses, slides_or_sticks, _ = (len(times) > 0 for times in run.t_events)
        if parts:
            return y[W] / SLOWEST
        if turns:
            deepest = y[D]
        elif reverses:
            y[LOWER if branch == BACK else UPPER] = y[T]
            branch, slip = AGAIN if branch == BACK else BACK, 0
        elif slides_or_sticks:
            slip = 0 if slip else int(np.sign(y[T]))
        else:
            branch = FIRST
    raise AssertionError("the twin does not part")
