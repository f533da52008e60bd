"""Impacts as a camera sees them, with pixel noise, and as three programs export their tracks."""

from pathlib import Path

import numpy as np
import pandas as pd

import carom

RATE, PIXELS_PER_MM, NOISE = 1000.0, 10.0, 0.2
FRAMES, GRAVITY = 12, 9.80665  # on each side; m/s^2
MARK = 0.7  # of the radius, from the centre
BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.15)
ANGLES = np.radians([8.0, 14.0, 20.0, 26.0, 32.0, 38.0, 45.0, 55.0, 65.0])
NAMES = ("normal_speed", "tangential_speed", "normal_speed_out", "tangential_speed_out")
NAMES = (*NAMES, "spin", "spin_out")


def filmed(hit, seed, *, frames=FRAMES, tilt=0.0, noise=NOISE, phase=0.37):
    """Return positions in pixels, y downwards, of a ball that flies, strikes and flies on."""
    random = np.random.default_rng(seed)
    time = (np.arange(-frames, frames) + phase) / RATE
    is_before = time < 0.0
    normal = time * np.where(is_before, -hit.normal_speed, hit.normal_speed_out)
    along = time * np.where(is_before, hit.tangential_speed, hit.tangential_speed_out)
    turned = 0.4 + time * np.where(is_before, hit.spin, hit.spin_out)
    x = along * np.cos(tilt) - normal * np.sin(tilt)
    y = along * np.sin(tilt) + normal * np.cos(tilt) - 0.5 * GRAVITY * time**2
    reach = MARK * BALL.radius
    places = {
        "x": x,
        "y": y,
        "mark_x": x + reach * np.cos(turned),
        "mark_y": y + reach * np.sin(turned),
    }
    track = {"frame": np.arange(2 * frames)}
    for name, metres in places.items():
        pixels = 320.0 + (-1.0 if "y" in name else 1.0) * 1e3 * PIXELS_PER_MM * metres
        track[name] = pixels + random.normal(0.0, noise, pixels.shape)
    return track


def impacts():
    """Return the impacts that are filmed, with losses."""
    losses = carom.KelvinVoigt(restitution=0.95)
    return [carom.impact(PAIR, speed=1.5, angle=angle, losses=losses) for angle in ANGLES]


def as_tracker(track):
    """Return an export of Tracker: a name, tabs, times in s, lengths in m, y upwards."""
    metre = 1e-3 / PIXELS_PER_MM
    rows = zip(track["frame"] / RATE, metre * track["x"], -metre * track["y"], strict=True)
    lines = ("\t".join(f"{value:.9E}" for value in row) for row in rows)
    return "\n".join(["mass_A\t\t", "t\tx\ty", *lines]) + "\n"


def as_deeplabcut(track):
    """Return an export of DeepLabCut: scorer, body parts and coordinates above the columns."""
    parts = {"ball": ("x", "y"), "mark": ("mark_x", "mark_y")}
    sure = np.full(len(track["frame"]), 0.99)
    columns = {
        ("net", part, name): values
        for part, axes in parts.items()
        for name, values in zip(
            ("x", "y", "likelihood"), (*(track[a] for a in axes), sure), strict=True
        )
    }
    frame = pd.DataFrame(columns, index=track["frame"])
    frame.columns.names = ("scorer", "bodyparts", "coords")
    return frame.to_csv(float_format="%.4f", lineterminator="\n")


def as_sleap(track):
    """Return an export of SLEAP: points by name, x, y and score."""
    points = {"ball.x": "x", "ball.y": "y", "mark.x": "mark_x", "mark.y": "mark_y"}
    frame = pd.DataFrame({"track": "ball", "frame_idx": track["frame"], "instance.score": 0.97})
    for head, name in points.items():
        frame[head] = track[name]
        if head.endswith("y"):
            frame[head.replace(".y", ".score")] = 0.98
    return frame.to_csv(index=False, float_format="%.4f", lineterminator="\n")


def store(folder):
    """Write the track at 32 degrees as three programs export it."""
    track = filmed(impacts()[4], 4)
    exports = {"tracker.txt": as_tracker, "deeplabcut.csv": as_deeplabcut, "sleap.csv": as_sleap}
    for name, export in exports.items():
        Path(folder, f"track_{name}").write_text(export(track), encoding="utf-8", newline="\n")
