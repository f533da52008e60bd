r"""Use the exact law in LAMMPS
===========================

Two lines of a LAMMPS input ask for the exact contact; `ExactContactLaw` is the same law in Python.

`carom lammps build` compiles the plugin once, and `carom lammps examples inputs` writes inputs that
run as they stand. The picture shows what to expect of the law in time steps: with 16 springs and
100 steps in a contact it differs from the exact rebound by 0.001.
"""

import numpy as np

import carom
from carom.plots.style import BLUE, VERMILION, new_figure, save_figure, style

glass = carom.material("soda-lime-glass")
ball = carom.Sphere(radius="1 mm", material=glass)
pair = carom.Pair(ball, ball, friction=0.2)
print("pair_style carom")
print(f"pair_coeff * * young {glass.young:g} poisson {glass.poisson:g} friction {pair.friction:g}")

psi = np.linspace(0, 6, 37)
exact = carom.rebound(psi, pair.chi)
laws = {"carom, 16 springs": carom.dem.ExactContactLaw(16), "mindlin": carom.dem.LammpsMindlin()}
with style():
    figure, ((axis,),) = new_figure()
    axis.plot(psi, exact, "k", label="exact")
    for (name, law), mark, color in zip(laws.items(), "ox", (BLUE, VERMILION), strict=True):
        stepped = law.rebound(psi, pair.chi, steps=100)
        axis.plot(psi, stepped, mark, color=color, ms=3, label=f"{name}, 100 steps")
    axis.set(xlabel=r"$\psi_1$", ylabel=r"$\psi_2$", xlim=(0, 6))
    axis.legend()
    save_figure(figure, "exact_law.png")

# %%
# Check: the springs are as exact as they say, and the usual law is not.
stepped, usual = (law.rebound(psi, pair.chi, steps=100) for law in laws.values())
np.testing.assert_allclose(stepped, exact, atol=2e-3)
assert np.abs(usual - exact).max() > 0.4
