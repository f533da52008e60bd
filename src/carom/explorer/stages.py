"""The balls on their way: where they are and how far they have turned, before, during and after."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.bodies.shapes import Cup, HalfSpace, Sphere
from carom.dem.base import SOLID
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.solution import Solution
from carom.dimensionless.states import History
from carom.impacts.curves import SOLID_SPHERE
from carom.impacts.exact import Impact
from carom.quantities.arrays import Array

BEFORE = AFTER = 0.6  # of the contact's duration that is shown besides
DEEPEST, WIDEST = 0.3, 6.0  # radii that the bodies may approach, and travel sideways
STEEPEST = 0.7  # angle by which a body may travel around another, in rad
SLAB = 0.3  # ball radii that a plate is thick of which no thickness is known
BENT = {
    "plane": "",
    "plate": ", plate to scale",
    "cup": ", paths bent",
    "sphere": ", paths bent, centre of mass at rest",
}


@dataclass(frozen=True, eq=False)
class Body:
    """A body as it is drawn: its radius, and along time its place and the angle it has turned.

    Of a plate the radius is its thickness.
    """

    kind: str
    radius: float
    x: Array
    y: Array
    turn: Array

    def moving(self) -> dict[str, Any]:
        """Return the body as JSON can hold it."""
        path = {"x": short(self.x), "y": short(self.y), "turn": short(self.turn)}
        return {"kind": self.kind, "radius": self.radius, **path}


@dataclass(frozen=True, eq=False)
class MovingBodies:
    """Both bodies, lengths in radii of the first, their motion magnified, counter-clockwise turns.

    The motion is uniform before and after; turns are magnified like paths, so that what rolls looks
    as if it rolled.
    """

    time: Array  # shares of the duration
    bodies: tuple[Body, ...]
    caption: str

    def moving(self) -> dict[str, Any]:
        """Return the stage as JSON can hold it."""
        return {
            "time": short(self.time),
            "caption": self.caption,
            "bodies": [body.moving() for body in self.bodies],
        }


def stage_of_bodies(hit: Impact, column: Mapping[str, Array]) -> MovingBodies:
    """Return the bodies of an impact from its history, which is evenly spaced in time."""
    pair, radius, duration = hit.pair, hit.pair.first.radius, hit.duration
    time = column["time"] / duration
    along = _travelled(time, column["tangential_speed"], duration) / radius
    speed = column["normal_velocity"]
    closer = _continued(time, column["penetration"], speed[0], speed[-1], duration)
    closer /= radius
    turns = [_travelled(time, column[name], duration) for name in ("spin", "spin2")]
    kind, size = _shape(pair.second, radius)
    fallen = _travelled(time, speed, duration) / radius if kind == "plate" else closer
    magnified = _magnification(kind, size, fallen, along)
    place = _placed(kind, size, magnified * along, magnified * closer)
    sunk = magnified * (fallen - closer)  # a plate, in its middle
    first_turn, second_turn = (magnified * turn for turn in turns)
    share = pair.normal_mass / pair.first.mass  # of the relative motion, the first body's
    height = {"plane": 0.0, "plate": 0.0, "sphere": -size, "cup": size}[kind]  # of the second body
    rest = (1.0 - share) * (place - [0.0, 1.0 - height])
    x, y = place.T - rest.T
    first = Body("sphere", 1.0, x, y + height - sunk, first_turn)
    second = Body(kind, size, -rest[:, 0], height - rest[:, 1] - sunk, second_turn)
    caption = f"motion magnified {magnified:.3g} times{BENT[kind]}"
    return MovingBodies(_wide(time), (first, second), caption)


def _placed(kind: str, size: float, along: Array, closer: Array) -> Array:
    """Return where the first centre is as seen from the second body's.

    Paths follow the surface of the second body, so that the bodies overlap by `closer` wherever
    they are: what is magnified is small against both radii.
    """
    if kind in ("plane", "plate"):
        return np.column_stack([along, 1.0 - closer])
    outside = 1.0 if kind == "sphere" else -1.0
    reach = size + outside - outside * closer
    angle = along / (size + outside)
    return np.column_stack([reach * np.sin(angle), outside * reach * np.cos(angle)])


def stage_of_numbers(
    solution: Solution | LossySolution, history: History, friction: float
) -> MovingBodies:
    """Return a solid sphere without spin on a plane, its friction given, as psi and chi move it."""
    time, duration = history.time / solution.duration, solution.duration
    slope = friction / (SOLID * solution.chi)
    lost = solution.psi_in - history.psi
    along = _travelled(time, slope * (solution.psi_in - SOLID_SPHERE * lost), duration)
    turn = _travelled(time, -slope * (1.0 - SOLID_SPHERE) * lost, duration)
    closer = _continued(time, history.penetration, 1.0, history.centre_speed[-1], duration)
    gives = bool(np.any(history.centre_speed != history.speed))
    fallen = _travelled(time, history.centre_speed, duration) if gives else closer
    kind, size = ("plate", SLAB) if gives else ("plane", 1.0)
    scale = ", plate not to scale" if gives else ""
    magnified = _magnification(kind, size, fallen, along)
    still = np.zeros(along.size)
    plane = Body(kind, size, still, magnified * (closer - fallen), still)
    first = Body("sphere", 1.0, magnified * along, 1.0 - magnified * fallen, magnified * turn)
    return MovingBodies(
        _wide(time), (first, plane), f"drawn as a solid sphere, friction {friction:g}{scale}"
    )


def _shape(second: object, radius: float) -> tuple[str, float]:
    if isinstance(second, Sphere | Cup):
        return ("sphere" if isinstance(second, Sphere) else "cup"), second.radius / radius
    if isinstance(second, HalfSpace) and second.thickness is not None:
        return "plate", second.thickness / radius
    return "plane", 1.0


def _magnification(kind: str, size: float, closer: Array, along: Array) -> float:
    """Return by how much motion is magnified, so that it stays within the picture and a cup."""
    depth, travel = float(closer.max()), float(np.abs(along).max())
    deep, wide = DEEPEST, 0.5 * WIDEST
    if kind == "sphere":
        deep, wide = DEEPEST * min(1.0, size), STEEPEST * (1.0 + size)
    elif kind == "cup":
        lifted = float(-closer.min()) / depth  # before and after
        deep, wide = min(DEEPEST, 0.5 * (size - 1.0) / lifted), STEEPEST * (size - 1.0)
    return min(deep / depth, wide / travel if travel else np.inf)


def _wide(time: Array) -> Array:
    step = time[1] - time[0]
    more = round(float(BEFORE / step))
    return np.asarray(np.arange(-more, time.size + more) * step)


def _travelled(time: Array, speed: Array, duration: float) -> Array:
    """Return the integral of a speed over time, from the first touch, uniform outside."""
    steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(time) * duration
    path = np.concatenate([[0.0], np.cumsum(steps)])
    return _continued(time, path, speed[0], speed[-1], duration)


def _continued(time: Array, path: Array, before: float, after: float, duration: float) -> Array:
    """Return a path with what lies before and after the contact at constant speed."""
    wide = _wide(time) * duration
    more = (wide.size - time.size) // 2
    ahead, behind = wide[:more] * before, (wide[-more:] - duration) * after
    return np.concatenate([path[0] + ahead, path, path[-1] + behind])


def short(values: Array) -> list[Any]:
    """Return numbers for the page, to what a picture shows."""
    rounded: list[Any] = np.round(values, 5).tolist()
    return rounded


def precise(values: Array) -> list[float]:
    """Return numbers for the page of which the smallest still have a sign."""
    return [float(f"{value:.6g}") for value in values.tolist()]
