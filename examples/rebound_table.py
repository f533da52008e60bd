r"""Take the rebound to a C program
===============================

`carom curve --export c` writes the exact rebound of a pair as a C header without dependencies.

The function `carom_rebound` in it returns :math:`\psi_2` for :math:`\psi_1` to 1e-9 or better,
from a table of polynomials of 11 kB. `carom.laws.ReboundLaw` is the same table in Python.
"""

from pathlib import Path

import numpy as np

import carom
from carom.cli import main
from carom.plots.style import new_figure, save_figure, style

ball = carom.Sphere(radius="2 mm", material="soda-lime-glass")
pair = carom.Pair(ball, ball, friction=0.2)
main(["curve", "--chi", f"{pair.chi:.17g}", "--export", "c", "--output", "rebound_table.h"])
header = Path("rebound_table.h").read_text(encoding="utf-8")
print(next(line for line in header.splitlines() if "double carom_rebound" in line))

law = carom.laws.ReboundLaw(pair.chi)  # the same in Python
psi = np.linspace(0, 8, 801)
with style():
    figure, ((above,), (below,)) = new_figure(2, 1, height=84, sharex=True)
    above.plot(psi, law(psi))
    above.set(ylabel=r"$\psi_2$", xlim=(0, 8))
    below.plot(psi, 1e12 * (law(psi) - carom.rebound(psi, pair.chi)))
    below.set(xlabel=r"$\psi_1$", ylabel=r"error of the table ($10^{-12}$)")
    save_figure(figure, "rebound_table.png")

# %%
# Check: the table is as exact as it says, and the header is as large as it says.
np.testing.assert_allclose(law(psi), carom.rebound(psi, pair.chi), atol=1e-9)
assert 9_000 < len(header) < 13_000
