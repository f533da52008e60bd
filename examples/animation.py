"""The patch through an impact, a film
===================================

The contact patch through one impact as a film: stick and slip, traction, and the force beside it.

The contact slides, sticks, slips from the edge inwards and slides back. Meanwhile the traction in
the middle still pushes the other way. With ffmpeg, a name that ends in .mp4 gives a finer film.

Barber (1979), ZAMP 30:468.
"""

from pathlib import Path

import numpy as np
from PIL import Image

import carom

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
FRAMES = 12


def main(folder: str | Path = ".") -> str:
    """Check the forces on the frames by adding up their tractions; store the film."""
    hit = carom.impact(PAIR, speed="2 m/s", angle="25 deg")
    for share in (0.2, 0.4, 0.6, 0.9):
        line = np.linspace(-1, 1, 201) * hit.max_radius
        patch = hit.fields(share * hit.duration, line, line)
        area = (line[1] - line[0]) ** 2
        added = [float(patch[name].sum()) * area for name in ("pressure", "traction_x")]
        told = [float(patch.normal_force), float(patch.tangential_force)]
        np.testing.assert_allclose(added, told, atol=2e-3 * hit.max_force, err_msg="force")
    path = hit.animate(Path(folder) / "animation.gif", frames=FRAMES)
    with Image.open(path) as film:
        assert film.n_frames == FRAMES, f"{film.n_frames} frames"
        pictures = []
        for frame in range(FRAMES):
            film.seek(frame)
            pictures.append(film.convert("RGB").tobytes())
    assert len(set(pictures)) == FRAMES, "each frame is another picture"
    return f"{FRAMES} frames; their tractions add up to the forces"


if __name__ == "__main__":
    print(main())
