r"""The rebound curve
=================

How a sphere rebounds: the velocity of its contact point after the impact against that before.

At small :math:`\psi_1` the contact sticks, and the ball may go back where it came from. The curves
dip and then rise along the straight lines :math:`\psi_2 = \psi_1 - 4\chi` of sliding throughout.
Marks are the borders 1, :math:`2\chi` and :math:`4\chi - 1` of the regimes. Crosses are the method
of the first solution, annuli and small steps, refined until it converges.

Maw, Barber & Fawcett (1976), Wear 38:101; borders after (34) of Barber (1979), ZAMP 30:468.
"""

from pathlib import Path

import numpy as np

import carom
from carom.dimensionless.lossy.springs.march import march_rebound
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia
from carom.plots import plot_curve, save_figure
from carom.plots.legends import legend_above
from carom.plots.style import BLACK, styled

CHIS = (0.5, 1.0, 1.44, 2.0)


@styled
def main(folder: str | Path = ".") -> str:
    """Check the curves against annuli and against the straight lines; draw them."""
    psi = np.linspace(0, 8.5, 426)
    curves = carom.curve(CHIS, psi)
    figure = plot_curve(curves)
    axis = figure.axes[0]
    worst = 0.0
    for chi in CHIS:
        out = curves.psi_out.sel(chi=chi)
        slides = psi >= max(4 * chi - 1, 1.0)
        straight = psi[slides] - 4 * chi
        np.testing.assert_allclose(out[slides], straight, atol=1e-12, err_msg="psi_1 - 4 chi")
        assert np.all(np.abs(out) <= psi + 1e-12), "friction cannot add energy"
        for at in (0.6, 1.5 * chi, 3.4 * chi):
            marched = march_rebound(at, Inertia(chi), ELASTIC)[0]
            worst = max(worst, abs(marched - carom.rebound(at, chi)))
            axis.plot(at, marched, "x", color=BLACK, ms=4, mew=0.8, zorder=4)
    stuck = carom.rebound(np.linspace(0, 1, 11), 0.5)
    np.testing.assert_allclose(stuck, -np.linspace(0, 1, 11), atol=1e-12, err_msg="chi = 1/2")
    assert worst < 1e-5, f"annuli differ by {worst:.1e}"
    axis.plot([], [], "x", color=BLACK, ms=4, mew=0.8, label="annuli")
    legend_above(axis, 3)
    save_figure(figure, Path(folder) / "rebound_curves.png")
    return f"psi_2 = psi_1 - 4 chi in sliding; annuli and small steps differ by {worst:.0e}"


if __name__ == "__main__":
    print(main())
