"""Vary inputs and store the results
=================================

`carom.sweep` solves every combination of a grid and writes the results to disk, block by block.

With `resume=True` a sweep that was interrupted continues; no block that was finished is repeated.
The store is an xarray dataset with names, units and a status for every point. It needs the extra
`[cluster]`; without it leave `store` out and use `carom.save(found, "rebounds.nc")`.
"""

import numpy as np

import carom
from carom.plots.style import DASHES, LINES, new_figure, save_figure, style

case = {"first": {"radius": "5 mm", "material": "steel"}, "speed": "1 m/s"}
axes = {
    "angle": {"from": "1 deg", "to": "85 deg", "points": 85},
    "friction": [0.1, 0.2, 0.4],
    "second.material": ["steel", "pmma"],
}
carom.sweep(case, carom.Grid(axes), store="sweep_store.zarr", resume=True)
found = carom.read("sweep_store.zarr")
print(found.rebound_angle.dims, found.rebound_angle.size, "impacts")

with style():
    figure, ((axis,),) = new_figure()
    on_steel = found.sel(second_material="steel")
    for mu, color, dash in zip(found.friction.values, LINES, DASHES, strict=False):
        line = np.degrees(on_steel.rebound_angle.sel(friction=mu))
        axis.plot(np.degrees(found.angle), line, color=color, ls=dash, label=rf"$\mu$ = {mu:g}")
    axis.set(xlabel="angle of incidence (deg)", ylabel="angle of rebound (deg)", xlim=(0, 85))
    axis.legend()
    save_figure(figure, "sweep_store.png")

# %%
# Check: every point was solved, and one of them is the impact by itself.
assert int(found.status.max()) == 0
ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="pmma"), friction=0.2)
alone = carom.impact(pair, speed="1 m/s", angle=float(found.angle[30])).rebound_angle
stored = found.rebound_angle.sel(friction=0.2, second_material="pmma")[30]
np.testing.assert_allclose(stored, alone, rtol=1e-9)
