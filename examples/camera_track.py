"""Get speeds and spins from a video
=================================

`carom.track` turns positions of a ball and of a mark on it into the motion before and after impact.

A steel ball strikes a steel plate at nine angles and is filmed at 1000 frames a second, with 10
pixels a millimetre. The impacts are calculated here, and every position gets noise of 0.2 pixels.
`track` finds where the two parabolas meet, and the motion there, with standard errors. `fit` takes
the table as it is. Exports of Tracker, DeepLabCut and SLEAP are read as they are.
"""

import numpy as np

import carom
from carom.plots.style import BLUE, DOUBLE, VERMILION, new_figure, save_figure, style

ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.15)
angles = np.radians([8.0, 14.0, 20.0, 26.0, 32.0, 38.0, 45.0, 55.0, 65.0])
losses, random = carom.KelvinVoigt(restitution=0.95), np.random.default_rng(1)
hits = [carom.impact(pair, speed=1.5, angle=angle, losses=losses) for angle in angles]


def filmed(hit):
    """Return positions in pixels, y downwards, of a ball that flies, strikes and flies on."""
    time = (np.arange(-12, 12) + 0.37) / 1000.0  # s
    before, reach = time < 0.0, 0.7 * ball.radius
    x = time * np.where(before, hit.tangential_speed, hit.tangential_speed_out)
    y = time * np.where(before, -hit.normal_speed, hit.normal_speed_out) - 4.9033 * time**2
    turned = 0.4 + time * np.where(before, hit.spin, hit.spin_out)
    mark = x + reach * np.cos(turned), y + reach * np.sin(turned)
    places = {"x": x, "y": -y, "mark_x": mark[0], "mark_y": -mark[1]}
    return {name: 1e4 * value + random.normal(0, 0.2, 24) for name, value in places.items()}


# %%
# These positions stand for files: `carom.track("video.csv", ...)`.
tracks = [{"frame": np.arange(24), **filmed(hit)} for hit in hits]
motions = carom.track(tracks, frame_rate=1000.0, pixels_per_mm=10.0)
found = carom.fit(motions, pair=pair)
print(f"friction {found.friction} and kappa {found.kappa} from nine tracks")

with style():
    figure, ((path, spins),) = new_figure(1, 2, width=DOUBLE, height=66)
    path.plot(0.1 * tracks[4]["x"], -0.1 * tracks[4]["y"], "o", color=BLUE, label="centre")
    path.plot(0.1 * tracks[4]["mark_x"], -0.1 * tracks[4]["mark_y"], "x", label="mark")
    path.set(title="the track at 32 degrees", xlabel="$x$ (mm)", ylabel="$y$ (mm)")
    path.legend()
    bars = {"fmt": "o", "color": BLUE, "label": "from the tracks, 95 %"}
    spins.plot(np.degrees(angles), [hit.spin_out for hit in hits], color=VERMILION, label="truth")
    spins.errorbar(np.degrees(angles), motions.spin_out, 2.0 * motions.spin_out_error, **bars)
    spins.set(title="spin after", xlabel=r"$\theta$ (deg)", ylabel=r"$\omega'$ (rad/s)")
    spins.legend()
    save_figure(figure, "camera_track.png")

# %%
# Check: standard errors are those by which the numbers miss the truth, and so are the intervals.
names = ("normal_speed", "tangential_speed", "spin")
names = (*names, *(f"{name}_out" for name in names))
truth = {name: np.array([getattr(hit, name) for hit in hits]) for name in names}
off = [(motions[n] - truth[n]).values / motions[f"{n}_error"].values for n in names]
assert np.abs(off).max() < 4.0
assert 0.7 < np.sqrt(np.mean(np.square(off))) < 1.3
assert found.friction.low < 0.15 < found.friction.high
assert found.kappa.low < pair.kappa < found.kappa.high
