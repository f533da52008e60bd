r"""Make a film of an impact
========================

`hit.animate` stores a film of the contact patch: stick and slip, traction, and the force beside it.

A rod is dropped on its end at 40 degrees. Its foot did not slide before. The impact turns the rod
and drives the foot away from under it, and friction resists. The film ends when the foot leaves.
With ffmpeg, a name that ends in .mp4 gives a finer film.
"""

import numpy as np
from PIL import Image

import carom

size = {"length": "60 mm", "radius": "3 mm", "angle": "40 deg"}
rod = carom.shapes.rod(**size, material="bearing steel")
pair = carom.Pair(rod, carom.HalfSpace("bearing steel"), friction=0.5)
hit = carom.impact(pair, normal_speed=0.1)
hit.animate("animation.gif", frames=12)
print(f"turns with {hit.spin_out:.2f} rad/s")

# %%
# Check: the moment of the forces turns the rod, and the frames differ.
seen, (x, z) = hit.history(4001), rod.contact
forces = [seen[name].values for name in ("normal_force", "tangential_force")]
push, rub = (np.trapezoid(force, seen.time.values) for force in forces)
turned = (x * push + z * rub) / rod.inertia  # spin as V_x = v_x - z spin has it
np.testing.assert_allclose(hit.spin_out, turned, rtol=1e-5)
assert [phase.kind for phase in hit.phases] == ["stick", "slip", "gross slip"]
pictures = set()
with Image.open("animation.gif") as film:
    for frame in range(film.n_frames):
        film.seek(frame)
        pictures.add(film.convert("RGB").tobytes())
assert len(pictures) == 12, "each frame is another picture"
