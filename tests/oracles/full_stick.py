"""A body struck off its centre whose contact never slides: a linear problem along d(t)."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

ROOT = 1e-14  # of the depth, below which the edge no longer recedes


def rebound(kappa, tangential, mixed, sliding):
    """Return e and V_t'/V_n of b_tt and b_nt over b_nn and V_t/V_n before.

    In units of d_max and V_n: v' = -(5/4) (P + b_nt F), w' = -(5/4) (b_tt F + b_nt P), P = d^(3/2),
    F = (3/2) kappa S, S = integral of U - U(touch) over 0 < x < sqrt(d). What a spring bears where
    it is let go is lost: S' = w sqrt(d) + (U - U(touch of the edge)) (sqrt(d))' while unloading.
    """

    def rates(y):
        depth, speed, slide, _, pulled = y
        load, force = max(depth, 0.0) ** 1.5, 1.5 * kappa * pulled
        slows = 1.25 * (load + mixed * force), 1.25 * (tangential * force + mixed * load)
        return [speed, -slows[0], -slows[1], slide, slide * np.sqrt(max(depth, 0.0))]

    def turns(_, y):
        return y[1]

    def parts(_, y):
        return y[0] - 1e-9

    turns.terminal = parts.terminal = True
    turns.direction = -1
    exact = {"rtol": 1e-9, "atol": 1e-11}
    start = [0.0, 1.0, sliding, 0.0, 0.0]
    load = solve_ivp(
        lambda _, y: rates(y), (0, 50), start, events=turns, dense_output=True, **exact
    )
    end = load.t[-1]

    def touched(depth):
        if depth >= load.y[0, -1]:
            return load.y[3, -1]
        return load.sol(brentq(lambda t: load.sol(t)[0] - depth, 0.0, end))[3]

    def unload(_, y):
        depth, rate = max(y[0], ROOT), rates(y)
        rate[4] += (y[3] - touched(depth)) * y[1] / (2.0 * np.sqrt(depth))
        return rate

    start = [*load.y[:1, -1], -1e-12, *load.y[2:, -1]]
    back = solve_ivp(unload, (0, 50), start, events=parts, **exact)
    assert np.all(np.diff(back.y[0]) < 0.0)  # it does not load again
    return -back.y[1, -1], back.y[2, -1]
