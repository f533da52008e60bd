"""Find the energy of a swinging force
===================================

`carom.load_path` takes a force that swings at constant load, and returns its loop and friction
work.

The first push of the force :math:`F_x`, with the displacement :math:`U`, runs along the curve of
Cattaneo and Mindlin. Every later swing is that curve, twice as large in both directions, so the
loop closes at once. For small amplitudes the energy per cycle goes with their third power: what
slips is a thin ring, and it slips little.

Mindlin & Deresiewicz (1953), J. Appl. Mech. 20:327; Johnson (1985), section 7.4.
"""

import numpy as np

import carom
from carom.classical import loop_energy
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, style

ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
load, n = 10.0, 100
most = pair.friction * load

paths, lost = {}, {}
half = np.cos(np.linspace(0, np.pi, n))  # steps that are small where the force turns
swing = np.concatenate([np.sin(np.linspace(0, np.pi / 2, n)), half, half[::-1]])
for share in (0.3, 0.6, 0.9, 1.0):
    force = share * most * swing
    paths[share] = path = carom.load_path(pair, normal_force=load, tangential_force=force)
    lost[share] = path.frictional_work[-1] - path.frictional_work[n - 1]
    print(f"{share:g} of mu F_z: {1e9 * lost[share]:.2f} nJ a cycle")

# %%
# Check: the doubling rule, that loops close, and their energy, with 4/G* for Johnson's (2 - nu)/G
# of both bodies.
unit = 3 * most / (4 * path.contact_radius[0] * pair.effective_shear_modulus)
for share, path in paths.items():
    moved, down = path.displacement, slice(n, 2 * n)
    first = unit * (1 - (1 - share * swing[:n]) ** (2 / 3))
    np.testing.assert_allclose(moved[:n], first, atol=1e-10 * unit)
    drop = np.maximum(1 - share * (1 - swing[down]) / 2, 0)
    doubled = moved[n - 1] - 2 * unit * (1 - drop ** (2 / 3))
    np.testing.assert_allclose(moved[down], doubled, atol=1e-10 * unit, err_msg="doubling")
    np.testing.assert_allclose(moved[-1], moved[n - 1], atol=1e-10 * unit, err_msg="loop closes")
    area = np.trapezoid(share * most * swing[n:], moved[n:])
    np.testing.assert_allclose(area, lost[share], rtol=2e-3, err_msg="area of the loop")
    bracket = 1 - (1 - share) ** (5 / 3) - 5 / 6 * share * (1 + (1 - share) ** (2 / 3))
    np.testing.assert_allclose(lost[share], 4.8 * most * unit * bracket, rtol=1e-9)
shares = np.geomspace(0.02, 1, 200)
cycles, thin = loop_energy(pair, load, shares * most), 4 / 27 * most * unit * shares**3
np.testing.assert_allclose(cycles[0], thin[0], rtol=0.05, err_msg="third power")

with style():
    figure, ((left, right),) = new_figure(1, 2, width=DOUBLE, height=66)
    for (share, path), color, dash in zip(paths.items(), LINES, DASHES, strict=False):
        force = share * most * swing
        left.plot(1e9 * path.displacement, force, color=color, ls=dash, label=f"{share:g}")
        right.plot(share, 1e9 * lost[share], "o", color=color)
    left.legend(title=r"largest $F_x/\mu F_z$", loc="upper left")
    left.set(title="loops", xlabel="$U$ (nm)", ylabel="$F_x$ (N)")
    right.loglog(shares, 1e9 * cycles, "k", label="closed form")
    right.loglog(shares, 1e9 * thin, color="0.5", ls=DASHES[1], lw=0.8, label="third power")
    right.legend(loc="upper left")
    right.set(title="energy of a loop", xlabel=r"largest $F_x/\mu F_z$")
    right.set_ylabel("energy per cycle (nJ)")
    save_figure(figure, "hysteresis_loops.png")
