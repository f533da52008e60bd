r"""Rank the contact laws of DEM codes
==================================

`carom.verify.rank` runs the contact laws in use and says how far each rebound is from the exact
one.

All laws obey Coulomb's law when the ball slides throughout. They differ in how a contact that
sticks gives back what its tangential spring has stored. Linear springs with the stiffness ratio of
elastic bodies, :math:`k_t/k_n = \kappa` (Mindlin 1949), are better than Hertz-Mindlin as most codes
have it. With :math:`k_t/k_n = 2/7` the contact point bounces back. More in docs/laws.md.
"""

import numpy as np

import carom

ranking = carom.verify.rank()  # of solid spheres; rank(chi=pair.chi, kappa=pair.kappa) of yours
for standing in ranking.standings:
    print(f"{standing.entry.label:35} psi_2 wrong by up to {standing.max_error:.3f}")
ranking.plot("dem_laws.png")

# %%
# Check: the errors that curves computed independently have at :math:`\chi` = 1.4412.
published = {
    "linear spring, k_t/k_n = kappa": 0.176,
    "mindlin_rescale": 0.427,
    "mindlin_rescale/force": 0.430,
    "mindlin/force": 0.468,
    "mindlin": 0.576,
    "linear spring, k_t/k_n = 2/7": 1.385,
}
errors = {standing.entry.label: standing.max_error for standing in ranking.standings}
assert ranking.standings[0].entry.label.startswith("exact"), "the exact law is the best"
for law, expected in published.items():
    np.testing.assert_allclose(errors[law], expected, atol=5.1e-4, err_msg=law)
