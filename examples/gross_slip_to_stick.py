r"""From gross slip to stick
========================

How gross slip ends: the contact stops slipping everywhere at once.

In the plane of both velocities gross slip is a straight line of slope :math:`2\chi`, (33). It ends
where it meets :math:`\psi = V_z/V_1`, (32), at the speed (34). The stick that follows starts with a
slope of :math:`g` that is zero by (35). Continuity of the force requires
:math:`b\,g' = \frac{5}{2}(1 - 2\chi)\,x/(1 - x)` instead. Grey: with the
slope of zero.

Barber (1979), ZAMP 30:468, equations (31) to (35).
"""

import numpy as np
from scipy.integrate import solve_ivp

import carom
from carom.plots.style import BLACK, DASHES, DOUBLE, LINES, new_figure, save_figure, style

CHI = 1.44
SPEEDS = (0.6, 1.2, 1.6, 2.2)


def transition_speed(psi, chi):
    """The speed at which gross slip ends, (34)."""
    return (psi - 2 * chi) / (1 - 2 * chi)


def stepped(v, v_end):
    """Speed and g after the transition, by stepping psi' = -(15/4) chi Q, Q' = psi sqrt(d)."""
    d = (1 - v**2) ** 0.4

    def motion(_, s):
        return [s[1], -1.25 * s[0] ** 1.5, -3.75 * CHI * s[3], s[2] * s[0] ** 0.5]

    run = solve_ivp(motion, (0, 1), [d, v, v, 2 / 3 * d**1.5], "DOP853", rtol=1e-12, atol=1e-14,
                    events=lambda t, s: s[1] - v_end, dense_output=True)  # fmt: skip
    states = run.sol(np.linspace(0, run.t_events[0][0], 40))
    return states[1], states[2] / states[1]


def by_15(x, first_slope):
    """Return g by (15) at places x, from g = 1 and dg/dx at the first of them."""

    def slope(x, h):
        left = 3 * (2 - 7 * x) * h[1] + 3 * (2 * CHI - 1) * h[0]
        return [h[1], -left / (10 * x * (1 - x))]

    start = [1, first_slope]
    return solve_ivp(slope, (x[0], x[-1]), start, "DOP853", x, rtol=1e-12, atol=1e-14).y[0]


with style():
    figure, (axes,) = new_figure(1, 3, width=DOUBLE, height=72)
    v = np.linspace(1, 0, 201)
    axes[0].plot(v, v, color="0.5", lw=0.8)
    for psi, color, dash in zip(SPEEDS, LINES, DASHES, strict=False):
        impact = carom.solve(psi, CHI)
        h = impact.history(800)
        approaching = h.speed >= 0
        axes[0].plot(h.speed[approaching], h.psi[approaching], color=color, ls=dash)
        axes[0].text(1.04, psi, rf"$\psi_1 = {psi:g}$", color=color, va="center", ha="right")
        if psi > 1:
            sliding = h.time <= impact.phases[0].end
            line = psi - 2 * CHI * (1 - h.speed[sliding])
            np.testing.assert_allclose(h.psi[sliding], line, atol=1e-12, err_msg="(33)")
            axes[0].plot(*2 * [transition_speed(psi, CHI)], "o", color=color)
    axes[0].plot([], [], "o", color=BLACK, label="gross slip ends, (34)")
    axes[0].legend(loc="lower left")
    axes[0].text(1.04, 0.92, r"$\psi = V_z/V_1$", color="0.4", va="center", ha="right")
    axes[0].set(
        title="while it slips",
        xlim=(1.5, 0),
        xticks=[1, 0.5, 0],
        xlabel="$V_z/V_1$",
        ylabel=r"$\psi$",
    )
    axes[0].axhline(0, color="0.5", lw=0.5)

    worst = 0.0
    for chi, color, dash in zip((0.8, CHI, 3.0), LINES, DASHES, strict=False):
        psi = np.linspace(1, 4 * chi - 1, 60)
        speed_34 = (psi - 2 * chi) / (1 - 2 * chi)
        axes[1].plot(psi, speed_34, color=color, ls=dash, label=rf"$\chi = {chi:g}$")
        for at in psi[2:-1:8]:
            impact = carom.solve(at, chi)
            then = impact.at(impact.phases[0].end)
            worst = max(worst, abs(then.speed[0] - transition_speed(at, chi)))
            worst = max(worst, abs(then.psi[0] - then.speed[0]))
            axes[1].plot(at, then.speed[0], "o", mfc="white", mec=color, mew=0.8)
    assert worst < 1e-11, f"(32), (34) differ from whole impacts by {worst:.1e}"
    axes[1].plot([], [], "o", mfc="white", mec=BLACK, mew=0.8, label="whole impacts")
    axes[1].axhline(0, color="0.5", lw=0.5)
    axes[1].set(
        title="where gross slip ends", ylim=(-1.05, 1.05), xlabel=r"$\psi_1$", ylabel="$V_z/V_1$"
    )

    for psi, color, dash in zip(SPEEDS[1:], LINES[1:], DASHES[1:], strict=False):
        start = transition_speed(psi, CHI)
        x = np.linspace(1 - start**2, 1 - (0.3 * start) ** 2, 100)
        corrected = 0.5 * (1 - 2 * CHI) / (1 - x[0])  # b g' = (5/2) (1 - 2 chi) x/(1 - x)
        speed, g = stepped(start, 0.3 * start)
        np.testing.assert_allclose(by_15(1 - speed**2, corrected), g, atol=1e-9, err_msg="slope")
        axes[2].plot([0, x[0]], [1, 1], color=BLACK, lw=1.6)
        axes[2].plot(x, by_15(x, corrected), color=color, ls=dash, label=rf"$\psi_1 = {psi:g}$")
        axes[2].plot(x, by_15(x, 0), color="0.6", ls=dash, lw=0.9)
    axes[2].axhline(0, color="0.5", lw=0.5)
    axes[2].plot([], [], color=BLACK, lw=1.6, label="gross slip, $g = 1$")
    axes[2].plot([], [], color="0.6", lw=0.9, label="slope 0 (printed)")
    axes[1].legend(loc="upper right")
    axes[2].set(xlim=(0, 1), ylim=(-1.7, 1.15), xlabel="$x = (b/b_{max})^5$", ylabel="$g$")
    axes[2].set_title("the stick after it")
    axes[2].legend(loc="lower left")
    save_figure(figure, "gross_slip_to_stick.png")
    print(f"(32)-(34) within {worst:.0e} of whole impacts; slope after the transition corrected")
