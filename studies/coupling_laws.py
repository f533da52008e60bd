"""Laws of friction and surfaces under which the study of the coupling computes impacts.

Each law is a patch that limits the traction in its own way, or a surface that shears.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import beta as euler_beta

from carom.halfspace.compliance import Compliance
from carom.halfspace.quasistatic import ContactState, ContactStep, Patch

Array = NDArray[np.float64]


class Impact(NamedTuple):
    """One impact to be computed; `law` is a key of LAWS."""

    series: str
    case: str
    x: float
    kappa: float
    beta: float
    friction: float
    law: str
    strength: float
    scale: float
    elements: int
    steps: int


class PressurePatch(Patch):
    """Friction falls with pressure as p^-strength; the impulse of gross sliding stays Coulomb's."""

    def __init__(self, compliance: Compliance, impact: Impact) -> None:
        super().__init__(compliance)
        self.power = n = impact.strength
        over_time = euler_beta(1.0 - n / 5.0, 0.5) / euler_beta(1.0, 0.5)
        self.unit = 2.0 / np.pi * ((1.0 - n / 3.0) / over_time) ** (1.0 / n)

    def bound(self, pressure: Array) -> Array:
        return self.unit**self.power * pressure ** (1.0 - self.power)


class SlipPatch(Patch):
    """Friction falls from `strength` times its value as slip adds up, by e in each `scale`."""

    def __init__(self, compliance: Compliance, impact: Impact) -> None:
        super().__init__(compliance)
        self.excess, self.scale = impact.strength - 1.0, impact.scale
        self.left = np.ones_like(self.grid.apart)  # of the excess

    def bound(self, pressure: Array) -> Array:
        return pressure * (1.0 + self.excess * self.left)

    def advance(
        self, state: ContactState, depth: float, displacement: Array, length: float = 1.0
    ) -> ContactStep:
        step = super().advance(state, depth, displacement, length)
        slid = np.where(step.slips, np.hypot(*step.moved), 0.0)
        self.left = np.where(step.touching, self.after(slid, length), 1.0)
        return step

    def after(self, slid: Array, length: float) -> Array:
        """Return what is left of the excess after a step with so much slip."""
        return self.left * np.exp(-slid / self.scale)


class SpeedPatch(SlipPatch):
    """Friction falls from `strength` times its value with the speed of slip, by e in `scale`."""

    def after(self, slid: Array, length: float) -> Array:
        return 0.5 * (self.left + np.exp(-slid / (length * self.scale)))  # the mean is steadier


class SoftCompliance(Compliance):
    """A layer on the surface that shears by `layer` times the traction."""

    def __init__(self, *given: object, layer: float) -> None:
        super().__init__(*given)
        self.layer: float | Array = layer
        nearest = self._tangential_inverse.inverse(self.rough)
        softer = nearest._replace(along=nearest.along + layer, across=nearest.across + layer)
        self._tangential_inverse = softer.inverse(self.rough)
        self.tangential_diagonal += layer

    def tangential(self, traction: Array) -> Array:
        return super().tangential(traction) + self.layer * traction


class AsperityPatch(Patch):
    """The layer is of asperities: its compliance is `scale` over the pressure."""

    def __init__(self, compliance: Compliance, impact: Impact) -> None:
        super().__init__(compliance)
        self.scale = impact.scale

    def bound(self, pressure: Array) -> Array:
        self.compliance.layer = self.scale / np.where(pressure > 0.0, pressure, np.inf)
        return pressure


LAWS: dict[str, Callable[[Compliance, Impact], Patch]] = {
    "coulomb": lambda compliance, impact: Patch(compliance),
    "layer": lambda compliance, impact: Patch(compliance),
    "pressure": PressurePatch,
    "slip": SlipPatch,
    "speed": SpeedPatch,
    "asperities": AsperityPatch,
}
