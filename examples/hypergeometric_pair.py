"""The two solutions of the stick phase
====================================

The two solutions of the equation of stick, and how stick after gross slip mixes them.

From the first touch only :math:`h_1` counts, since :math:`h_2` rises like :math:`b^2`. After gross
slip :math:`g = 1`, and its slope fixes the shares of both. Each grows like :math:`(1 - x)^{-1/2}`.
Thin: the series (21) cut after 5, 20 and 80 terms. It serves for :math:`x` up to 0.95, as the paper
says, and not beyond.

Barber (1979), ZAMP 30:468, equations (19) to (22), with (35) corrected.
"""

from pathlib import Path

import numpy as np
from scipy.special import hyp2f1, poch

import carom
from carom.plots.style import (
    BLACK,
    BLUE,
    DASHES,
    DOUBLE,
    VERMILION,
    new_figure,
    save_figure,
    styled,
)

CHI, PSI = 1.44, 2.0
ROOT = np.sqrt(240 * CHI + 1)
ALPHA, BETA, GAMMA = (11 + ROOT) / 20, (11 - ROOT) / 20, 0.6
SECOND = (ALPHA - GAMMA + 1, BETA - GAMMA + 1, 2 - GAMMA)


def h_1(x):
    """Return the first solution of (20)."""
    return hyp2f1(ALPHA, BETA, GAMMA, x)


def h_2(x):
    """Return the second solution of (20)."""
    return x**0.4 * hyp2f1(*SECOND, x)


def cut(x, terms, a, b, c):
    """Return the series (21), cut after some terms."""
    n = np.arange(terms)[:, np.newaxis]
    return (poch(a, n) * poch(b, n) / poch(c, n) / poch(1, n) * x**n).sum(axis=0)


def derivative(h, x, step=1e-4):
    """Return the derivative, by a difference of the fourth order."""
    near = h(x + step) - h(x - step)
    return (8 * near - (h(x + 2 * step) - h(x - 2 * step))) / (12 * step)


@styled
def main(folder: str | Path = ".") -> str:
    """Check the Wronskian, (19), the range of (21), and stick after gross slip; draw."""
    x = np.linspace(0.02, 0.98, 400)
    slopes = [derivative(h, x) for h in (h_1, h_2)]
    wronskian = h_1(x) * slopes[1] - h_2(x) * slopes[0]
    np.testing.assert_allclose(wronskian, 0.4 * x**-0.6 * (1 - x) ** -1.5, rtol=1e-4)  # Abel's
    for h, first in zip((h_1, h_2), slopes, strict=True):
        second = derivative(lambda at, h=h: derivative(h, at), x)
        left = 10 * x * (1 - x) * second + 3 * (2 - 7 * x) * first + 3 * (2 * CHI - 1) * h(x)
        assert np.abs(left / (1 + np.abs(second)))[20:-20].max() < 1e-4, "(19)"
    enough = np.abs(cut(np.array([0.95]), 80, ALPHA, BETA, GAMMA) / h_1(0.95) - 1)[0]
    assert enough < 1e-2, f"80 terms of (21) leave {enough:.1e} at x = 0.95"

    start = 1 - ((PSI - 2 * CHI) / (1 - 2 * CHI)) ** 2  # (34)
    slope = 0.5 * (1 - 2 * CHI) / (1 - start)  # dg/dx, from b g' = (5/2)(1 - 2 chi) x/(1 - x)
    at_start = np.array([start])
    pair = np.array([[h(at_start)[0], derivative(h, at_start)[0]] for h in (h_1, h_2)])
    shares = np.linalg.solve(pair.T, [1.0, slope])
    impact = carom.solve(PSI, CHI)
    state = impact.at(np.linspace(impact.phases[1].start, impact.phases[1].end, 200))
    after = 1 - state.speed**2
    mixed = shares[0] * h_1(after) + shares[1] * h_2(after)
    error = np.abs(mixed - state.psi / state.speed).max()
    assert error < 1e-8, f"g after gross slip is not the mixture: {error:.1e}"

    figure, (axes,) = new_figure(1, 2, width=DOUBLE, height=62, sharex=True)
    fine = np.concatenate([np.linspace(0, 0.97, 400), 1 - np.geomspace(0.03, 1e-5, 100)])
    for h, color, dash, name in ((h_1, BLUE, "-", "$h_1$"), (h_2, VERMILION, DASHES[1], "$h_2$")):
        axes[0].plot(fine, h(fine), color=color, ls=dash, label=name)
    for terms, tone, place in ((5, "0.6", 0.86), (20, "0.4", 0.975), (80, "0.2", 0.985)):
        axes[0].plot(fine, cut(fine, terms, ALPHA, BETA, GAMMA), color=tone, lw=0.7)
        axes[0].plot(fine, fine**0.4 * cut(fine, terms, *SECOND), color=tone, lw=0.7)
        height = cut(np.array([place]), terms, ALPHA, BETA, GAMMA)[0]
        axes[0].annotate(
            f"{terms} terms",
            (place, height),
            xytext=(0.5, height - 0.7),
            arrowprops={"arrowstyle": "-", "lw": 0.4},
        )
    axes[0].plot([], [], color="0.4", lw=0.7, label="series (21), cut")
    axes[0].axvline(0.95, color=BLACK, lw=0.6, ls=DASHES[2], label="$x = 0.95$")
    axes[0].set(ylim=(-6, 2), ylabel=rf"solutions for $\chi$ = {CHI:g}")
    axes[1].plot(fine, h_1(fine), color=BLUE, label=r"stick from the touch, $\psi_1 = 1$: $h_1$")
    axes[1].plot([0, start], [1, 1], color=BLACK, lw=2, label=rf"gross slip, $\psi_1 = {PSI:g}$")
    axes[1].plot(
        fine[fine > start],
        shares[0] * h_1(fine[fine > start]) + shares[1] * h_2(fine[fine > start]),
        color=VERMILION,
        ls=DASHES[1],
        label=rf"stick after it: ${shares[0]:.2f}\,h_1 {shares[1]:+.2f}\,h_2$",
    )
    axes[1].set(ylim=(-2, 1.2), ylabel="$g$")
    for axis in axes:
        axis.axhline(0, color="0.5", lw=0.5)
        axis.set(xlim=(0, 1), xlabel="$x = cb^5 = 1 - (V_z/V_1)^2$")
        axis.legend(loc="lower left", borderaxespad=0.8)
    save_figure(figure, Path(folder) / "hypergeometric_pair.png")
    return f"(19)-(22) hold; g after gross slip is the mixture within {error:.0e}"


if __name__ == "__main__":
    print(main())
