"""What was measured: rows of motion before, responses after, their errors."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from carom.bodies.pairs import Pair
from carom.datasets.observables import convert_observables
from carom.fitting.laws import IncomingMotion
from carom.io.user_table import Mask, UserTable
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY

ONE = np.radians(0.1)  # incidences that are one
NOTHING = 1e-9  # part of the speed that is no tangential speed
STEEPEST = np.radians(89.9)


@dataclass(frozen=True, eq=False)
class FitProblem:
    """Measured rebounds in SI units: `measured` and `errors` have the shape (rows, responses).

    NaN stands for what was not measured, and for errors that are not known; `doi` is that of the
    publication, if the data tell it. If nobody `knows_friction`, that of the pair is a guess.
    """

    pair: Pair
    before: Mapping[str, Array]
    before_errors: Mapping[str, Array]
    responses: tuple[str, ...]
    measured: Array
    errors: Array
    rows: UserTable
    ignored: tuple[str, ...] = ()
    knows_friction: bool = True
    doi: str = ""

    @property
    def present(self) -> Mask:
        """Where there is a measured value."""
        return np.isfinite(self.measured)

    @property
    def count(self) -> int:
        """The number of measured values."""
        return int(self.present.sum())

    @property
    def all_errors_known(self) -> bool:
        """Whether every measured value has a standard deviation."""
        return bool(np.all(np.isfinite(self.errors) | ~self.present))

    @property
    def has_speeds(self) -> bool:
        """Whether speeds are known, not only ratios of them."""
        return bool({"speed", "normal_speed"} & set(self.before))

    @property
    def scales_with_speed(self) -> tuple[bool, ...]:
        """Which responses are speeds or spins."""
        return tuple(GLOSSARY[name].unit in ("m/s", "rad/s") for name in self.responses)

    @property
    def is_normal(self) -> bool:
        """Whether every impact is a normal one, and nothing moves sideways."""
        sideways = np.abs(self.contact_velocity) > NOTHING * self.motion.normal_speed
        return not bool(sideways.any())

    @property
    def is_one(self) -> bool:
        """Whether every impact that was measured has the same incidence, to either side."""
        slopes = np.abs(self.contact_velocity / self.motion.normal_speed)
        return bool(np.ptp(np.arctan(slopes[self.present.any(axis=1)])) < ONE)

    @cached_property
    def motion(self) -> IncomingMotion:
        """The motion before, as it was measured."""
        return self.moved({})

    @cached_property
    def contact_velocity(self) -> Array:
        """Tangential velocity of the contact point before."""
        motion = self.motion
        radius2 = self.pair.moving[1].radius if len(self.pair.moving) > 1 else 0.0
        return (
            motion.tangential_speed + self.pair.first.radius * motion.spin + radius2 * motion.spin2
        )

    @cached_property
    def sizes(self) -> Array:
        """What each response is of the order of: 1, the speed, or the spin that rolls with it."""
        motion = self.motion
        speed = float(np.median(np.hypot(motion.normal_speed, motion.tangential_speed)))
        units = {"rad/s": speed / self.pair.first.radius, "m/s": speed}
        return np.array([units.get(GLOSSARY[name].unit, 1.0) for name in self.responses])

    def moved(self, changes: Mapping[str, Array]) -> IncomingMotion:
        """Return the motion before with some of its columns changed by so much."""
        known = {name: values + changes.get(name, 0.0) for name, values in self.before.items()}
        for name in {"angle", "contact_angle"} & set(known):
            known[name] = np.clip(known[name], -STEEPEST, STEEPEST)
        if not self.has_speeds:
            known["normal_speed"] = np.ones(len(self.measured))
        speeds = (
            convert_observables(self.pair, known=known, wanted=name)
            for name in ("normal_speed", "tangential_speed")
        )
        spins = (known.get(name, np.zeros(len(self.measured))) for name in ("spin", "spin2"))
        return IncomingMotion(*speeds, *spins)

    @cached_property
    def shaken(self) -> tuple[tuple[IncomingMotion, IncomingMotion], ...]:
        """The motion with each of its uncertain columns one standard deviation up, and down."""
        return tuple(
            (self.moved({name: error}), self.moved({name: -error}))
            for name, error in self.before_errors.items()
        )
