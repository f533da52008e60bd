"""The foot of a rod through an impact, a film
===========================================

The contact of a rod that is dropped on its end, at 40 degrees: stick, slip, traction and force.

The foot did not slide before. The impact turns the rod and drives the foot away from under it, and
friction resists. The film ends when the foot leaves.
"""

from pathlib import Path

import numpy as np
from PIL import Image

import carom

SIZE = {"length": "60 mm", "radius": "3 mm", "angle": "40 deg"}
ROD = carom.shapes.rod(**SIZE, material="bearing steel")
PAIR = carom.Pair(ROD, carom.HalfSpace("bearing steel"), friction=0.5)
FRAMES = 12


def main(folder: str | Path = ".") -> str:
    """Check the spin by the moment of the forces, and where the foot slides; store the film."""
    hit = carom.impact(PAIR, normal_speed=0.1)
    seen, (x, z) = hit.history(4001), ROD.contact
    forces = [seen[name].values for name in ("normal_force", "tangential_force")]
    push, rub = (np.trapezoid(force, seen.time.values) for force in forces)
    turned = (x * push + z * rub) / ROD.inertia  # spin as V_x = v_x - z spin has it
    np.testing.assert_allclose(hit.spin_out, turned, rtol=1e-5)
    assert [phase.kind for phase in hit.phases] == ["stick", "slip", "gross slip"]
    path = hit.animate(Path(folder) / "rod_film.gif", frames=FRAMES)
    with Image.open(path) as film:
        assert film.n_frames == FRAMES, f"{film.n_frames} frames"
    return f"{FRAMES} frames; the moment of the forces turns the rod by {hit.spin_out:.2f} rad/s"


if __name__ == "__main__":
    print(main())
