"""Parabolas through positions before and after an impact, and the motion where they meet."""

from typing import Any, NamedTuple

import numpy as np

from carom.fitting.track_files import Frames
from carom.quantities.arrays import Array

FEWEST = 3  # frames on each side
NEAR = 3  # frames from the lowest one at which the paths may part


class Motion(NamedTuple):
    """Parabolas x, v_x before, after, y, v_y before, after, and gravity, with their covariance.

    Times count from `origin`; the first frame after the impact is `split`.
    """

    numbers: Array
    covariance: Array
    origin: float
    split: int
    squares: float
    freedom: int


def parted(frames: Frames, tilt: float, gravity: float | None) -> Motion | None:
    """Return the parabolas with the least squares among those that part near the lowest frame."""
    height = frames.y * np.cos(tilt) - frames.x * np.sin(tilt)
    lowest, count = int(np.argmin(height)), len(height)
    splits = range(max(lowest - NEAR, FEWEST), min(lowest + NEAR + 1, count - FEWEST) + 1)
    motions = (parabolas(frames, split, gravity) for split in splits)
    turned = [motion for motion in motions if _turns(motion, tilt)]
    return min(turned, key=lambda motion: motion.squares, default=None)


def _turns(motion: Motion, tilt: float) -> bool:
    normal = motion.numbers[[5, 7]] * np.cos(tilt) - motion.numbers[[1, 3]] * np.sin(tilt)
    return bool(normal[0] < 0.0 < normal[1])


def parabolas(frames: Frames, split: int, gravity: float | None, *, bent: bool = False) -> Motion:
    """Return the least squares of parabolas that part at a frame; `bent` frees all curvatures."""
    origin = 0.5 * float(frames.time[split - 1] + frames.time[split])
    t = frames.time - origin
    before = np.arange(len(t)) < split
    sides = [side * power for side in (before, ~before) for power in (np.ones_like(t), t)]
    curves = [side * t**2 for side in (before, ~before)] if bent else []
    line, none = np.stack([*sides, *curves], axis=-1), np.zeros((len(t), len(sides) + len(curves)))
    fallen = -0.5 * t**2
    design = np.block([[line, none], [none, line]])
    free = np.concatenate([np.zeros_like(t), fallen])[:, np.newaxis]
    place = np.concatenate([frames.x, frames.y - (0.0 if gravity is None else gravity * fallen)])
    if gravity is None and not bent:
        design = np.hstack([design, free])
    sizes = np.maximum(np.linalg.norm(design, axis=0), 1e-300)
    inverse = np.linalg.pinv(design / sizes) / sizes[:, np.newaxis]
    numbers = inverse @ place
    freedom = len(place) - int(np.linalg.matrix_rank(design / sizes))
    squares = float(np.square(place - design @ numbers).sum())
    covariance = squares / max(freedom, 1) * inverse @ inverse.T
    if gravity is not None and not bent:
        numbers = np.append(numbers, gravity)
        covariance = np.pad(covariance, (0, 1))
    return Motion(numbers, covariance, origin, split, squares, freedom)


def at_impact(motion: Motion, tilt: float) -> tuple[Array, Array, float]:
    """Return normal and tangential speeds before and after, their errors, the time of impact."""
    cosine, sine = np.cos(tilt), np.sin(tilt)

    def of(numbers: Any) -> tuple[Any, Any]:
        x, y = numbers[:4].reshape(2, 2), numbers[4:8].reshape(2, 2)  # (side, power)
        normal, along = y * cosine - x * sine, x * cosine + y * sine
        time = (normal[0, 0] - normal[1, 0]) / (normal[1, 1] - normal[0, 1])
        fallen = numbers[8] * time
        away, onwards = normal[:, 1] - fallen * cosine, along[:, 1] - fallen * sine
        return np.array([-away[0], onwards[0], away[1], onwards[1]]), time

    values, time = of(motion.numbers)
    into = 1e-30j * np.eye(len(motion.numbers))  # the complex plane: no digit is lost in slopes
    slopes = np.stack([of(motion.numbers + step)[0].imag for step in into], axis=-1) / 1e-30
    errors = np.sqrt(np.einsum("ij,jk,ik->i", slopes, motion.covariance, slopes))
    return values, errors, float(time)
