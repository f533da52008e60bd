"""What is refused of measured rebounds, and how it is said."""

from collections.abc import Collection, Mapping

import numpy as np
from numpy.typing import NDArray

from carom.fitting.prediction import Motion
from carom.quantities import InputError
from carom.readings import ERROR, Results

Array = NDArray[np.float64]

MOST = 1.5  # normal restitution that scatter may reach; beyond it is a percentage
NOTHING = 1e-9  # part of the speed that is no tangential speed
RELATIVE = ("tangential_restitution", "contact_restitution", "contact_beta")


def check_before(
    rows: Results, before: Mapping[str, Array], responses: Collection[str], scaled: Collection[str]
) -> None:
    """Raise InputError if the motion before is missing, said twice, or out of range."""
    ways = [n for n in ("tangential_speed", "angle", "contact_angle", "psi_in") if n in before]
    if not ways:
        rows.require("angle")
    if len(ways) > 1:
        raise InputError(
            f"data: {' and '.join(ways)} say the same twice; leave all but one of them out"
        )
    for name in ("speed", "normal_speed"):
        if name in before:
            rows.refuse(name, before[name] <= 0.0, "must be positive: the bodies must approach")
    needing = sorted(set(scaled) & {*before, *responses})
    if needing and not {"speed", "normal_speed"} & set(before):
        raise InputError(
            f"speed: column missing; {needing[0]} needs speed and angle, or normal_speed"
        )
    for name in before:
        if name + ERROR in rows.columns:
            negative = ~(rows[name + ERROR] >= 0.0)
            rows.refuse(name + ERROR, negative, "a standard deviation is zero or positive")


def check_responses(rows: Results, motion: Motion, velocity: Array) -> None:
    """Raise InputError for responses that contradict the motion before, or are out of range."""
    for name in RELATIVE:
        if name in rows.columns:
            basis = motion.tangential_speed if name == RELATIVE[0] else velocity
            rested = np.abs(basis) <= NOTHING * motion.normal_speed
            allowed = "nothing moved sideways there before; write '-', or give tangential_speed_out"
            rows.refuse(name, rested & np.isfinite(rows[name]), allowed)
    if "normal_restitution" in rows.columns:
        values = rows["normal_restitution"]
        rows.refuse(
            "normal_restitution",
            (values < 0.0) | (values > MOST),
            "must lie between 0 and 1, 0.98 for 98 percent",
        )
    if "normal_speed_out" in rows.columns:
        ratio = rows["normal_speed_out"] / motion.normal_speed
        allowed = "must be positive and no larger than the normal speed before, but for scatter"
        rows.refuse("normal_speed_out", (ratio < 0.0) | (ratio > MOST), allowed)
    _check_sense(rows, motion, velocity)


def _check_sense(rows: Results, motion: Motion, velocity: Array) -> None:
    """Raise InputError if friction drove the spin on in every row: its sign is another's."""
    if "spin_out" not in rows.columns:
        return
    change = (rows["spin_out"] - motion.spin) * np.sign(velocity)
    moving = np.isfinite(change) & (np.abs(velocity) > 0.05 * motion.normal_speed)
    if moving.sum() > 1 and np.all(change[moving] > 0.0):
        raise InputError(
            f"spin_out: friction would have driven the contact point on in {rows.named(moving)}; "
            "positive spin adds to its tangential speed, so change the signs of the spins"
        )
