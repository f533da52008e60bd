r"""Map which phases follow each other
==================================

`carom.regime_map` says which phases an impact has, for every incidence and all bodies.

Below :math:`\psi_1 = 1` the contact sticks from the first touch, beyond :math:`4\chi - 1` it slides
throughout. What follows the first phase is richer than the usual solid sphere, :math:`\chi = 1.44`,
suggests: slip that turns back, rings that close, stick that returns.

The colour of a region is that of its regime, how the impact begins, the darker the more often slip
reverses. The letters in it are the phases in their order. The borders are curves that bisection
finds between the points of the map, so that narrow regions appear as well.

Maw, Barber & Fawcett (1976), Wear 38:101; borders after (34) of Barber (1979), ZAMP 30:468.
"""

import numpy as np

import carom

psi, chi = np.linspace(0.02, 6.02, 151), np.linspace(0.103, 5.003, 121)
found = carom.regime_map(psi, chi)
names = found.sequence_name.values[found.sequence.values].astype(str)
print(f"at psi_1 = {psi[50]:.2f} and chi = {chi[33]:.2f}: {names[33, 50]}")
carom.plots.save_figure(carom.plots.plot_regime_map(found), "regime_map.png")

# %%
# Check: the borders, and the section of solid spheres.
begins = np.char.startswith(names, "stick")
np.testing.assert_array_equal(begins, np.broadcast_to(psi < 1, names.shape), "border 1")
throughout = psi > np.where(chi > 0.5, 4 * chi - 1, 1.0)[:, np.newaxis]
np.testing.assert_array_equal(names == "gross slip +", throughout, "border 4 chi - 1")
grips = np.char.startswith(names, "gross slip +, stick")
np.testing.assert_array_equal(grips, (psi > 1) & (psi < 2 * chi[:, np.newaxis]), "2 chi")
expected = {
    0.5: "stick, slip -, gross slip -",
    2.0: "gross slip +, stick, slip -, gross slip -",
    4.0: "gross slip +, slip -, gross slip -",
    6.0: "gross slip +",
}
section = carom.regime_map(list(expected), [1.44])
told = [str(section.sequence_name.values[code]) for code in section.sequence.values[0]]
assert told == list(expected.values()), told
