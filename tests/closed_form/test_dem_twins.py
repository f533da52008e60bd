"""Contact laws are what their codes define, integrated anew in SI units from those definitions.

Twins: steel sphere on a steel half-space, the stored displacement or force as the code keeps it,
SciPy's Dormand-Prince of order 8 from event to event; none of the powers and units of the package.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import carom

YOUNG, POISSON, DENSITY, RADIUS, FRICTION, SPEED = 210e9, 0.3, 7850.0, 5e-3, 0.2, 0.5
SHEAR = YOUNG / (2 * (1 + POISSON))
MASS = DENSITY * 4 / 3 * np.pi * RADIUS**3
E_STAR = YOUNG / (2 * (1 - POISSON**2))
G_EFF = SHEAR / (2 * (2 - POISSON))  # of LAMMPS and LIGGGHTS
KAPPA = 4 * G_EFF / E_STAR
CHI = KAPPA / 2 * 3.5  # solid sphere: m_n/m_t = 1 + m R^2/I
HERTZ = 4 / 3 * E_STAR * np.sqrt(RADIUS)
DEEPEST = (1.25 * MASS * SPEED**2 / HERTZ) ** 0.4
DURATION = 2.94327518432470 * DEEPEST / SPEED
SLOWEST = FRICTION * SPEED / KAPPA  # V_x of psi = 1
LEAST = 1e-9  # penetration at both ends, in units of the deepest
E = 0.8
BETA = -np.log(E) / np.sqrt(np.pi**2 + np.log(E) ** 2)
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
    found = [
        lambda t, y: 1.0 if loading else y[0] - LEAST * DEEPEST,
        lambda t, y: y[1] if loading else 1.0,
        (lambda t, y: code.would_grow(y, slip)) if slip else (lambda t, y: code.over(y)),
    ]
    for event, direction in zip(found, (-1, -1, -1 if slip else 1), strict=True):
        event.terminal, event.direction = True, direction
    return found


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


DAMPED = Code(normal_dashpot=normal_dashpot)
HALF = {"restitution": E, "tangential_damping": 0.5}
CODES = {
    "mindlin": Code(),
    "mindlin/force": Code(force_stored=True),
    "mindlin_rescale": Code(shrinks=True),
    "mindlin_rescale/force": Code(force_stored=True, shrinks=True),
}
ALL = (0.3, 0.8, 1.3, 3.0, 4.6)

CASES = [
    *((carom.dem.LammpsMindlin(name), code, ALL) for name, code in CODES.items()),
    *(
        (
            carom.dem.LammpsMindlin(name, restitution=E),
            replace(code, normal_dashpot=normal_dashpot),
            (0.3, 3.0),
        )
        for name, code in CODES.items()
    ),
    *(
        (
            carom.dem.LammpsMindlin(name, stiffness=2 / 3, **HALF),
            replace(
                code,
                stiffness=lambda d: 2 / 3 * mindlin(d),
                normal_dashpot=normal_dashpot,
                dashpot=lambda d: 0.5 * normal_dashpot(d),
            ),
            (0.8, 1.3, 4.6),
        )
        for name, code in CODES.items()
    ),
    (
        carom.dem.LammpsMindlin("mindlin", restitution=E, damping="tsuji"),
        Code(normal_dashpot=tsuji_dashpot),
        (0.8, 3.0),
    ),
    (
        carom.dem.HertzLinearHistory(1.2, **HALF),
        replace(
            DAMPED,
            stiffness=lambda d: 1.2 * mindlin(DEEPEST),
            dashpot=lambda d: 0.5 * normal_dashpot(d),
        ),
        ALL,
    ),
    (
        carom.dem.LinearSpring(0.5, **HALF),
        Code(
            stiffness=lambda d: 0.5 * LINEAR,
            elastic=lambda d: LINEAR * d,
            normal_dashpot=lambda d: 2 * BETA * np.sqrt(LINEAR * MASS),
            dashpot=lambda d: BETA * np.sqrt(LINEAR * MASS),
        ),
        ALL,
    ),
    (
        carom.dem.LiggghtsHertz(E),
        replace(DAMPED, dashpot=tangential_dashpot, limits_sum=False),
        ALL,
    ),
    (carom.dem.EdemHertzMindlin(E), replace(DAMPED, dashpot=tangential_dashpot), ALL),
]


@pytest.mark.parametrize(("law", "code", "psi"), CASES, ids=[str(case[0]) for case in CASES])
def test_law_is_what_the_code_defines(law, code, psi):
    twin = [rebound(code, each) for each in psi]
    assert np.allclose(law.rebound(psi, CHI, kappa=KAPPA), twin, rtol=0.0, atol=1e-8)
