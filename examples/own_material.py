"""Use a material of your own
==========================

Give `carom.Material` its elastic constants and density, or change a value of the catalogue.

A soft ball is in contact for longer and presses less. The angle of rebound hardly depends on the
modulus: only Poisson's ratio, the shape and the friction count.
"""

import numpy as np

import carom

nylon = carom.Material(young="2.8 GPa", poisson=0.39, density=1140, name="nylon")
scratched = carom.material("float glass", flaw_size="20 um")  # and all else of the catalogue

hits = {}
for name, material in {"nylon": nylon, "steel": "steel", "glass": scratched}.items():
    ball = carom.Sphere(radius="5 mm", material=material)
    pair = carom.Pair(ball, carom.HalfSpace(material=material), friction=0.2)
    hits[name] = hit = carom.impact(pair, speed="0.5 m/s", angle="25 deg")
    print(f"{name}: {1e6 * hit.duration:.0f} us in contact, up to {hit.max_force:.0f} N", end=", ")
    print(f"leaves at {np.degrees(hit.rebound_angle):.1f} deg")

figure = carom.plots.plot_forces({name: hit.history() for name, hit in hits.items()})
carom.plots.save_figure(figure, "own_material.png")

# %%
# Check: the duration of Hertz's contact scales as the modulus and the density have it.
soft, stiff = nylon, carom.material("steel")
plane = [each.young / (1 - each.poisson**2) for each in (soft, stiff)]
longer = ((soft.density / stiff.density) * (plane[1] / plane[0])) ** 0.4
np.testing.assert_allclose(hits["nylon"].duration / hits["steel"].duration, longer, rtol=1e-12)
assert hits["glass"].pair.second.material.flaw_size == 20e-6
