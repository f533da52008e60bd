r"""The rebound against inertia over stiffness
==========================================

How the rebound depends on the bodies, for two incidences.

At :math:`\psi_1 = 1.2` the ball slides throughout while :math:`4\chi - 1 \le 1.2`, on a straight
line. For larger :math:`\chi` it sticks, and more of a tangential oscillation fits into the contact,
so that the ball is thrown back more and less in turn. At :math:`\psi_1 = 0.3` and
:math:`\chi = 1/2` or 4 the whole velocity comes back, :math:`\psi_2 = -\psi_1`: there :math:`F` is
a polynomial, and nothing ever slips.

Maw, Barber & Fawcett (1976), Wear 38:101; Barber (1979), ZAMP 30:468, (33), (36), (37).
"""

from pathlib import Path

import numpy as np

import carom
from carom.dimensionless.lossy.springs.march import march_rebound
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia
from carom.plots.legends import legend_above
from carom.plots.style import BLACK, DASHES, LINES, label, new_figure, save_figure, styled

SPEEDS = (1.2, 0.3)


@styled
def main(folder: str | Path = ".") -> str:
    """Check sliding, sticking throughout and energy along chi; draw both curves."""
    chi = np.linspace(0.05, 6, 1200)
    figure, ((axis,),) = new_figure(height=68)
    axis.axhline(0, color="0.5", lw=0.5)
    worst = 0.0
    for psi, color, dash in zip(SPEEDS, LINES, DASHES, strict=False):
        out = carom.rebound(psi, chi)
        assert np.all(np.abs(out) <= psi * (1 + 1e-12)), "friction cannot add energy"
        axis.plot(chi, out, color=color, ls=dash, label=rf"$\psi_1 = {psi:g}$")
        for at in (0.3, 0.8, 1.44, 2.5, 5.0):
            marched = march_rebound(psi, Inertia(at), ELASTIC)[0]
            worst = max(worst, abs(marched - carom.rebound(psi, at)))
            axis.plot(at, marched, "x", color=BLACK, ms=4, mew=0.8, zorder=4)
    assert worst < 2e-5, f"annuli differ by {worst:.1e}"
    slides = np.linspace(0.05, 0.55, 20)
    np.testing.assert_allclose(carom.rebound(1.2, slides), 1.2 - 4 * slides, atol=1e-12)
    returned = carom.rebound(0.3, [0.5, 4.0])
    np.testing.assert_allclose(returned, -0.3, atol=1e-12, err_msg="chi = 1/2 and 4")

    end = 1.2 - 4 * 0.55
    axis.annotate(
        r"slides throughout, $\psi_1 - 4\chi$",
        (0.3, 0.0),
        xytext=(0.75, 0.62),
        arrowprops={"arrowstyle": "-", "lw": 0.5},
    )
    axis.plot(0.55, end, "o", color=LINES[0])
    axis.annotate(
        r"$4\chi - 1 = \psi_1$",
        (0.55, end),
        xytext=(1.1, -1.3),
        arrowprops={"arrowstyle": "-", "lw": 0.5},
    )
    axis.plot([0.5, 4], returned, "s", mfc="white", mec=LINES[1], label=r"$\psi_2 = -\psi_1$")
    axis.plot([], [], "x", color=BLACK, ms=4, mew=0.8, label="annuli, small steps")
    axis.set(xlim=(0, 6), ylim=(-1.4, 1.2), xlabel=label("chi"))
    axis.set_ylabel(label("psi_out"))
    legend_above(axis, 2)
    save_figure(figure, Path(folder) / "rebound_against_chi.png")
    return f"sliding and sticking throughout are exact; annuli differ by {worst:.0e}"


if __name__ == "__main__":
    print(main())
