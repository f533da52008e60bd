r"""How long the contact sticks
===========================

The normal velocity at which a contact begins to stick and at which it stops, for three bodies.

Below :math:`\psi_1 = 1` the contact sticks from the first touch. Above, the thin lines show where
gross slip gives way to stick, (34). Stick ends where the memory reaches :math:`|g| = 1`. This is
always before maximum penetration, :math:`V_z = 0`, in slip against the first motion; at
:math:`\psi_1 = 2\chi` both meet, and beyond it gross slip outlasts the approach. Circles: whole
impacts.

Barber (1979), ZAMP 30:468, section 6 and equations (26), (34).
"""

import numpy as np
from scipy.optimize import brentq
from scipy.special import hyp2f1

import carom
from carom.plots.legends import legend_above
from carom.plots.style import BLACK, DASHES, LINES, new_figure, save_figure, style

CHIS = (0.8, 1.44, 2.5)


def transition_speed(psi, chi):
    """The speed at which gross slip ends, (34)."""
    return (psi - 2 * chi) / (1 - 2 * chi)


def pair(x, chi):
    """Return h_1 and h_2 of (20) and (22), and their derivatives."""
    root = np.sqrt(240 * chi + 1)
    a, b = (11 + root) / 20, (11 - root) / 20
    h = np.array([hyp2f1(a, b, 0.6, x), x**0.4 * hyp2f1(a + 0.4, b + 0.4, 1.4, x)])
    slope = [
        a * b / 0.6 * hyp2f1(a + 1, b + 1, 1.6, x),
        0.4 * x**-0.6 * hyp2f1(a + 0.4, b + 0.4, 0.4, x),
    ]
    return h, np.array(slope)


def stick_phase(psi, chi):
    """Return the speeds at which stick begins and ends, in closed form."""
    start, shares = 1.0, np.array([psi, 0])
    if psi > 1:  # g = 1 where gross slip ends, with the slope that keeps the force continuous
        start = transition_speed(psi, chi)
        conditions = [1, 0.5 * (1 - 2 * chi) / start**2]
        shares = np.linalg.solve(np.array(pair(1 - start**2, chi)), conditions)
    end = brentq(
        lambda v: shares @ pair(1 - v**2, chi)[0] + 1, 1e-6, start * (1 - 1e-9), xtol=1e-14
    )
    return start, end


with style():
    figure, ((axis,),) = new_figure(height=72)
    worst = 0.0
    for chi, color, dash in zip(CHIS, LINES, DASHES, strict=False):
        psi = np.concatenate([np.linspace(0.01, 0.999, 17), np.linspace(1.001, 1.999 * chi, 17)])
        starts, ends = np.array([stick_phase(at, chi) for at in psi]).T
        assert np.all((ends > 0) & (ends < starts)), "stick ends before maximum penetration"
        axis.plot(psi, ends, color=color, ls=dash, label=rf"end, $\chi = {chi:g}$")
        axis.plot(psi, starts, color=color, ls=dash, lw=0.6)
        for at, closed in zip(psi[1::4], np.column_stack([starts, ends])[1::4], strict=True):
            impact = carom.solve(at, chi)
            place = next(i for i, p in enumerate(impact.phases) if p.kind == "stick")
            phase, after = impact.phases[place], impact.phases[place + 1]
            assert (after.kind, after.sign) == ("slip", -1), "first slip is against the motion"
            state = impact.at([phase.start, phase.end])
            worst = max(worst, np.abs(state.speed - closed).max())
            np.testing.assert_allclose(state.psi[1] / state.speed[1], -1, atol=1e-8, err_msg="|g|")
            if at > 1:
                np.testing.assert_allclose(state.speed[0], transition_speed(at, chi), atol=1e-9)
            axis.plot(at, state.speed[1], "o", mfc="white", mec=color, mew=0.8, clip_on=False)
    assert worst < 1e-9, f"stick of whole impacts differs by {worst:.1e}"
    axis.plot([], [], color=BLACK, lw=0.6, label="begin (thin)")
    axis.plot([], [], "o", mfc="white", mec=BLACK, mew=0.8, label="end in whole impacts")
    axis.text(0.1, 1.02, "stick from the first touch", va="bottom", fontsize=6.5)
    axis.set(xlim=(0, 5), ylim=(0, 1.1), xlabel=r"$\psi_1$")
    axis.set_ylabel("$V_z/V_1$")
    legend_above(axis, 2)
    save_figure(figure, "end_of_stick.png")
    print(f"begin and end of stick are those of the closed form within {worst:.0e}")
