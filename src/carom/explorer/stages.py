"""The balls on their way: where they are and how far they have turned, before, during and after."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Cup, Sphere
from carom.dimensionless.solution import Solution
from carom.dimensionless.states import History
from carom.exact_impacts import Impact
from carom.laws.dem.base import SOLID

Array = NDArray[np.float64]

BEFORE = AFTER = 0.6  # of the contact's duration that is shown besides
DEEPEST, WIDEST = 0.3, 6.0  # radii that the bodies may approach, and travel sideways
SOLID_SPHERE = 2.0 / 7.0  # m_t/m_n of a solid sphere on a fixed body


@dataclass(frozen=True, eq=False)
class Body:
    """A body as it is drawn: its radius, and along time its place and the angle it has turned."""

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
class Stage:
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


def stage_of_bodies(hit: Impact, column: Mapping[str, Array]) -> Stage:
    """Return the bodies of an impact from its history, which is evenly spaced in time."""
    pair, radius, duration = hit.pair, hit.pair.first.radius, hit.duration
    time = column["time"] / duration
    along = _travelled(time, column["tangential_speed"], duration)
    closer = _continued(time, column["penetration"], hit.normal_speed, -hit.normal_speed, duration)
    turns = [_travelled(time, column[name], duration) for name in ("spin", "spin2")]
    magnified = _magnification(radius, hit.max_penetration, along)
    along, closer = (magnified * path / radius for path in (along, closer))
    turns = [magnified * turn for turn in turns]
    second = pair.second
    kind, size = _shape(second, radius)
    share = pair.normal_mass / pair.first.mass  # of the relative motion, the first body's
    height = 1.0 - closer if kind != "sphere" else 1.0 - share * closer
    first = Body("sphere", 1.0, share * along, height, turns[0])
    still = np.zeros(along.size)
    if kind == "sphere":
        rest = 1.0 - share
        other = Body(kind, size, -rest * along, -size + rest * closer, turns[1])
    else:
        other = Body(kind, size, still, still + (size if kind == "cup" else 0.0), still)
    return Stage(_wide(time), (first, other), f"motion magnified {magnified:.3g} times")


def stage_of_numbers(solution: Solution, history: History, friction: float) -> Stage:
    """Return a solid sphere without spin on a plane, its friction given, as psi and chi move it."""
    time, duration = history.time / solution.duration, solution.duration
    slope = friction / (SOLID * solution.chi)
    lost = solution.psi_in - history.psi
    along = _travelled(time, slope * (solution.psi_in - SOLID_SPHERE * lost), duration)
    turn = _travelled(time, -slope * (1.0 - SOLID_SPHERE) * lost, duration)
    closer = _continued(time, history.penetration, 1.0, -1.0, duration)
    magnified = _magnification(1.0, 1.0, along)
    still = np.zeros(along.size)
    first = Body("sphere", 1.0, magnified * along, 1.0 - magnified * closer, magnified * turn)
    plane = Body("plane", 1.0, still, still, still)
    return Stage(_wide(time), (first, plane), f"drawn as a solid sphere, friction {friction:g}")


def _shape(second: object, radius: float) -> tuple[str, float]:
    if isinstance(second, Sphere | Cup):
        return ("sphere" if isinstance(second, Sphere) else "cup"), second.radius / radius
    return "plane", 1.0


def _magnification(radius: float, depth: float, along: Array) -> float:
    travel = float(np.ptp(along))
    sideways = WIDEST * radius / travel if travel else np.inf
    return min(DEEPEST * radius / depth, sideways)


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


def short(values: Array) -> list[float]:
    """Return numbers for the page, to what a picture shows."""
    return [float(value) for value in np.round(values, 5)]
