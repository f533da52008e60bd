"""What would be observed of impacts whose parameters are known."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.laws import Law, Values
from carom.histories import Tangential
from carom.kinematics import Rebound
from carom.pairs import Pair

Array = NDArray[np.float64]


class Motion(NamedTuple):
    """Motion before the impacts, one a row, in SI units."""

    normal_speed: Array
    tangential_speed: Array
    spin: Array
    spin2: Array


def rebounds(law: Law, pair: Pair, motion: Motion, values: Values) -> Rebound:
    """Return the rebounds from a motion, of shape (batch, rows)."""
    normal, tangential, spin, spin2 = motion
    turning = spin + values["spin_offset"]
    before = Tangential(tangential + 0.0 * turning, turning, spin2)  # type: ignore[arg-type]
    velocity = np.asarray(before.contact_velocity(pair))
    after = law.contact_velocity_out(pair, normal, velocity, values)
    impulse = pair.tangential_mass * (velocity - after)
    return Rebound(pair, normal, before, values["restitution"] + 0.0 * turning, impulse)


def predicted(law: Law, pair: Pair, motion: Motion, values: Values, names: Sequence[str]) -> Array:
    """Return the observables of these names, of shape (batch, rows, names)."""
    rebound = rebounds(law, pair, motion, values)
    return np.stack([getattr(rebound, name) for name in names], axis=-1)
