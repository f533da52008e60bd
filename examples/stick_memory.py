r"""What a contact that sticks lays down
====================================

The memory of a contact that sticks from the first touch, for five ratios of inertia to stiffness.

All tractions follow from the memory, :math:`g = \psi_1 F(\alpha, \beta; 3/5; c b^5)`. With
:math:`\chi = 1/2` it is the constant :math:`\psi_1`, and with :math:`\chi = 4` it is a straight
line in :math:`x = c b^5`. Otherwise :math:`F` grows without bound towards maximum penetration,
upwards or downwards in turn as :math:`\chi` grows. Thick: where the contact still sticks for
:math:`\psi_1 = 0.3`, that is while :math:`|g| < 1`. Circles: whole impacts.

Barber (1979), ZAMP 30:468, equations (15), (17)-(19), (21)-(27), (36), (37).
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import gamma, hyp2f1

import carom
from carom.plots.legends import legend_above
from carom.plots.style import BLACK, DASHES, LINES, new_figure, save_figure, style

CHIS = (0.3, 0.5, 1.44, 4.0, 6.0)
PSI = 0.3


def series(x, chi):
    """F(alpha, beta; 3/5; x), (21) and (22)."""
    root = np.sqrt(240 * chi + 1)
    return hyp2f1((11 + root) / 20, (11 - root) / 20, 0.6, x)


def stepped(b, chi):
    """F by stepping (15) with c = 1 from b[0]."""

    def slope(b, h):
        x = b**5
        curvature = (1 + 6.5 * x) * b * h[1] - 7.5 * x * (2 * chi - 1) * h[0]
        return [h[1], curvature / ((1 - x) * b**2)]

    start = [1 + 0.5 * (1 - 2 * chi) * b[0] ** 5, 2.5 * (1 - 2 * chi) * b[0] ** 4]
    return solve_ivp(slope, (b[0], b[-1]), start, "DOP853", b, rtol=1e-11, atol=1e-12).y[0]


def growth(chi):
    """The limit of F sqrt(1 - x) at x = 1 (Gauss)."""
    root = np.sqrt(240 * chi + 1)
    alpha, beta = (11 + root) / 20, (11 - root) / 20
    if abs(beta - round(beta)) < 1e-12:  # then F is a polynomial
        return 0.0
    return gamma(0.6) * gamma(0.5) / (gamma(alpha) * gamma(beta))


with style():
    b = np.linspace(0.02, 0.985, 200)
    x = b**5
    figure, ((axis,),) = new_figure(height=68)
    axis.axhspan(-1 / PSI, 1 / PSI, color="0.94", lw=0)
    axis.axhline(0, color="0.5", lw=0.5)
    worst = 0.0
    for chi, color, dash in zip(CHIS, LINES, DASHES, strict=True):
        found = series(x, chi)
        np.testing.assert_allclose(found, stepped(b, chi), rtol=1e-7, atol=1e-8, err_msg="(15)")
        near = series(1 - 1e-12, chi) * 1e-6
        np.testing.assert_allclose(near, growth(chi), atol=1e-5, err_msg="growth")
        impact = carom.solve(PSI, chi)
        until = min(impact.phases[0].end, impact.duration / 2)  # stick may outlast the turning
        end = 1 - impact.at(until).speed[0] ** 2
        lasts = chi in (0.5, 4.0)
        np.testing.assert_allclose(abs(PSI * series(end, chi)) < 0.99, lasts, err_msg="|g| = 1")
        laid = np.linspace(0.05, 0.98 * end, 15) ** 0.2
        memory = impact.memory(0.9999999 * until).g(laid**2) / PSI
        worst = max(worst, np.abs(memory - series(laid**5, chi)).max())
        fine = np.concatenate([np.linspace(0, 0.98, 400), 1 - np.geomspace(0.02, 1e-5, 200)])
        whole, sticking = series(fine, chi), fine <= end
        axis.plot(fine, whole, color=color, lw=0.5)
        axis.plot(fine[sticking], whole[sticking], color=color, ls=dash, lw=1.6)
        axis.plot(laid[::2] ** 5, memory[::2], "o", mfc="white", mec=color, mew=0.7, ms=2.8)
        axis.plot([], [], color=color, ls=dash, lw=1.6, label=rf"$\chi$ = {chi:g}")
    np.testing.assert_allclose(series(x, 0.5), 1, rtol=1e-15, err_msg="(37)")
    np.testing.assert_allclose(series(x, 4.0), 1 - 3.5 * x, rtol=1e-12)
    assert worst < 1e-10, f"the memory of whole impacts differs by {worst:.1e}"
    axis.plot([], [], color=BLACK, lw=0.5, label="thin: $|g| > 1$")
    axis.plot([], [], "o", mfc="white", mec=BLACK, mew=0.7, ms=2.8, label="whole impacts")
    axis.text(0.02, 1 / PSI - 0.12, rf"$|g| < 1$ for $\psi_1 = {PSI:g}$", va="top")
    axis.set(xlim=(0, 1), ylim=(-4.6, 4.6))
    axis.set(xlabel="$x = cb^5 = (b/b_{max})^5$", ylabel=r"$g/\psi_1 = F(\alpha, \beta; 3/5; x)$")
    legend_above(axis, 3)
    save_figure(figure, "stick_memory.png")
    print(f"F by series, by stepping (15) and from whole impacts, the last within {worst:.0e}")
