"""Many impacts of one pair as a DEM program is asked to compute them, and how they come out."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isclose
from typing import Any, NamedTuple

import numpy as np

from carom.bodies.checks import checked_scales, with_friction
from carom.bodies.materials import set_fields
from carom.bodies.pairs import Pair, Scales
from carom.bodies.shapes import HalfSpace, Sphere
from carom.dem.base import ContactLaw
from carom.dimensionless.numerics import hertz
from carom.quantities.arrays import Array, along_the_same, finite_line, numbers
from carom.quantities.refusals import InputError, checked_type, refusal
from carom.quantities.units import counted, positive

MOST_STEPS = 10_000_000
SOLID_GYRATION_RATIO = 0.4
BEFORE = ("normal_speed", "tangential_speed", "spin")
AFTER = ("normal_speed_out", "tangential_speed_out", "spin_out")


class Outcomes(NamedTuple):
    """How first bodies leave, relative to the second: m/s, positive apart, m/s, rad/s; (n,)."""

    normal_speed: Array
    tangential_speed: Array
    spin: Array


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """Impacts of one pair at one normal speed, with one contact law, in fixed time steps.

    The second body does not spin, so that psi_1 = kappa (v_t + R omega)/(mu V_1). `scales` are
    those of Hertz's impact.

    Parameters
    ----------
    pair : Pair
        A solid sphere against a half-space or another solid sphere, with friction.
    law : ContactLaw
        A law of `carom.dem`.
    normal_speed : float
        V_1 in m/s.
    tangential_speed, spin : tuple of float, length n
        v_t in m/s of the first body relative to the second, and spin of the first body in rad/s.
    steps : int
        Time steps per duration of Hertz's contact, whatever the law, 10 to ten million.

    Raises
    ------
    InputError
        If lengths differ, no impact is given, a value is out of range, or the pair is one that DEM
        programs do not have: a cup, a hollow sphere, no friction.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> experiment = carom.verify.Experiment(
    ...     pair=pair, law=carom.dem.LammpsMindlin(), normal_speed=0.1,
    ...     tangential_speed=(0.05, 0.0), spin=(0.0, 10.0), steps=1000,
    ... )
    >>> experiment.psi_in.round(3)
    array([2.059, 2.059])
    """

    pair: Pair
    law: ContactLaw
    normal_speed: float
    tangential_speed: tuple[float, ...]
    spin: tuple[float, ...] = field(default=())
    steps: int
    scales: Scales = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        _refuse_bodies(self.pair)
        allowed = "must be a contact law, e.g. carom.dem.LammpsMindlin()"
        checked_type("law", self.law, ContactLaw, allowed)
        along_the_same(tangential_speed=self.tangential_speed, spin=self.spin)
        speeds = _column("tangential_speed", self.tangential_speed)
        spins = _column("spin", self.spin) or (0.0,) * len(speeds)
        if not speeds:
            raise refusal("tangential_speed", self.tangential_speed, "give one value per impact")
        if len(spins) != len(speeds):
            counts = f"{len(spins)} values for {len(speeds)} of tangential_speed"
            raise InputError(f"spin: {counts}; give one of each per impact")
        speed = positive("normal_speed", self.normal_speed)
        scales = checked_scales(self.pair, speed)
        steps = counted("steps", self.steps, 10, MOST_STEPS)
        set_fields(self, normal_speed=speed, tangential_speed=speeds, spin=spins)
        set_fields(self, scales=scales, steps=steps)

    def __len__(self) -> int:
        return len(self.tangential_speed)

    @property
    def contact_velocity(self) -> Array:
        """Tangential velocity of the contact point before, V_x in m/s, (n,)."""
        return np.array(self.tangential_speed) + self.pair.first.radius * np.array(self.spin)

    @property
    def psi_in(self) -> Array:
        """Dimensionless incidence psi_1, (n,)."""
        return self.contact_velocity / self.scales.tangential_speed

    @property
    def duration(self) -> float:
        """Duration of Hertz's contact in s."""
        return hertz.DURATION * self.scales.time

    @property
    def time_step(self) -> float:
        """Time step in s."""
        return self.duration / self.steps


def psi_out(experiment: Experiment, outcomes: Outcomes) -> Array:
    """Return the dimensionless tangential velocity of the contact point after, psi_2, (n,).

    The spin of a second sphere follows from that of the first: both feel the same force at an arm
    of their own radius, M_1 K_1^2 d omega_1/R_1 = M_2 K_2^2 d omega_2/R_2.
    """
    first, second = experiment.pair.first, experiment.pair.second
    turned = first.radius * (outcomes.spin - np.array(experiment.spin))
    if isinstance(second, Sphere):
        turned = turned * (1.0 + first.mass / second.mass)
    moved = outcomes.tangential_speed - np.array(experiment.tangential_speed)
    velocity = experiment.contact_velocity + moved + turned
    return np.asarray(velocity / experiment.scales.tangential_speed)


def results_csv(experiment: Experiment, outcomes: Outcomes) -> str:
    """Return the impacts as `carom verify score` reads them: SI units, 17 digits."""
    normal = np.full(len(experiment), experiment.normal_speed)
    before = (normal, experiment.tangential_speed, experiment.spin)
    rows = [",".join(f"{value:.17g}" for value in row) for row in np.stack([*before, *outcomes]).T]
    return "\n".join([",".join((*BEFORE, *AFTER)), *rows]) + "\n"


def _refuse_bodies(pair: Pair) -> None:
    with_friction(pair, "without friction there is nothing to test")
    if not isinstance(pair.second, Sphere | HalfSpace):
        allowed = "must be a Sphere or HalfSpace; DEM codes have no cups"
        raise refusal("second body", pair.second, allowed)
    for body in pair.moving:
        if not isclose(body.gyration_ratio, SOLID_GYRATION_RATIO):
            allowed = "must be solid; DEM codes give every sphere K^2 = 2/5 R^2"
            raise refusal("sphere", body, allowed)


def _column(name: str, values: Any) -> tuple[float, ...]:
    if isinstance(values, tuple) and not values:
        return ()
    if np.ndim(numbers(name, values, "must be a sequence, one value per impact")) != 1:
        raise refusal(name, values, "must be a sequence, one value per impact")
    return tuple(finite_line(name, values).tolist())
