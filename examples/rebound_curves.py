r"""Draw rebound curves
===================

`carom.curve` gives the velocity of the contact point after the impact against that before.

At small :math:`\psi_1` the contact sticks, and the ball may go back where it came from. The curves
dip and then rise along the straight lines :math:`\psi_2 = \psi_1 - 4\chi` of sliding throughout.
Marks are the borders 1, :math:`2\chi` and :math:`4\chi - 1` of the regimes. Crosses are a second
method, that of 1976: a contact divided into rings, followed in small steps.

Maw, Barber & Fawcett (1976), Wear 38:101; borders after (34) of Barber (1979), ZAMP 30:468.
"""

import numpy as np

import carom
from carom.dimensionless.lossy.springs.march import march_rebound
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia
from carom.plots.legends import legend_above
from carom.plots.style import style

chis, psi = (0.5, 1.0, 1.44, 2.0), np.linspace(0, 8.5, 426)
curves = carom.curve(chis, psi)
print(curves.psi_out.sel(chi=1.44, psi_in=[0.5, 2, 6], method="nearest").values)
figure = carom.plots.plot_curve(curves)

# %%
# Check: the curves against rings in small steps, the straight lines, and what is exact.
(axis,) = figure.axes
for chi in chis:
    out = curves.psi_out.sel(chi=chi)
    slides = psi >= max(4 * chi - 1, 1.0)
    np.testing.assert_allclose(out[slides], psi[slides] - 4 * chi, atol=1e-12, err_msg="(33)")
    assert np.all(np.abs(out) <= psi + 1e-12), "friction cannot add energy"
    for at in (0.6, 1.5 * chi, 3.4 * chi):
        marched = march_rebound(at, Inertia(chi), ELASTIC)[0]
        np.testing.assert_allclose(marched, carom.rebound(at, chi), atol=1e-5)
        axis.plot(at, marched, "kx", ms=4, mew=0.8, zorder=4)
axis.plot([], [], "kx", ms=4, mew=0.8, label="rings in small steps")
with style():
    legend_above(axis, 3)
carom.plots.save_figure(figure, "rebound_curves.png")

# %%
# With :math:`\chi` = 1/2 or 4 nothing ever slips while :math:`\psi_1` is small, and the whole
# velocity comes back, (36) and (37).
stuck = np.linspace(0, 0.4, 5)
for chi in (0.5, 4.0):
    returned = carom.rebound(stuck, chi)
    np.testing.assert_allclose(returned, -stuck, atol=1e-12, err_msg="(36), (37)")
