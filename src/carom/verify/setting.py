"""What a tuning is for: bodies or chi, and a range of incidence."""

from math import tan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.cases import Case, losses_of, motion_of, pair_of
from carom.bodies.kinematics import approach, slope
from carom.bodies.losses import KelvinVoigt, LossLaw
from carom.bodies.pairs import Pair, with_friction
from carom.dem.damping import damped_restitution
from carom.dimensionless.numerics.hertz import DURATION
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import finite, positive

POINTS = 61
SPEEDS = ("speed", "angle", "normal_speed", "tangential_speed")
SPEED = 1.0  # m/s, of a case without one: k_n of linear springs depends on it


class Setting(NamedTuple):
    """chi, kappa, incidences and wanted e of a tuning; with bodies also them, V_1 and t_c in SI."""

    chi: float
    kappa: float | None
    psi: NDArray[np.float64]
    restitution: float = 1.0
    pair: Pair | None = None
    normal_speed: float | None = None
    duration: float | None = None


def setting_of(
    case: Case | None,
    chi: str | None,
    kappa: str | None,
    start: str,
    stop: str | None,
    restitution: str | None,
) -> Setting:
    """Return what a tuning is for, from a case and angles, or from chi and psi_1.

    A restitution takes the place of that of the case; without either it is 1.

    Raises InputError if neither or both are given, or a range is empty.
    """
    if case is None and chi is None:
        raise InputError("case: missing; give a case file, or --chi, e.g. --chi 1.44")
    wanted = damped_restitution("restitution", "1" if restitution is None else restitution)
    if case is None:
        if wanted != 1.0:
            raise refusal(
                "restitution", restitution, "it needs a case file, as dampings depend on the bodies"
            )
        ratio = positive("chi", chi)
        last = 4.0 * ratio if stop is None else finite("psi_in", stop)
        own = None if kappa is None else positive("kappa", kappa)
        return Setting(ratio, own, _range(finite("psi_in", start), last, start, stop))
    for name, value in (("chi", chi), ("kappa", kappa)):
        if value is not None:
            raise refusal(name, value, "it follows from the case; leave it out")
    if restitution is None and (told := constant_restitution(losses_of(case))) is not None:
        wanted = damped_restitution("restitution", told)
    pair, motion = pair_of(case), motion_of(case)
    with_friction(pair, "without friction there is nothing to tune")
    given = {name: motion.get(name) for name in SPEEDS}
    speed = approach(**given)[0] if any(value is not None for value in given.values()) else SPEED
    per_slope = pair.kappa / pair.friction  # psi_1 = kappa tan(angle)/mu
    last = 4.0 * pair.chi if stop is None else per_slope * tan(slope(stop))
    psi = _range(per_slope * tan(slope(start)), last, start, stop)
    duration = DURATION * pair.scales(speed).time
    return Setting(pair.chi, pair.kappa, psi, wanted, pair, speed, duration)


def constant_restitution(losses: LossLaw | None) -> float | None:
    """Return the restitution of a law of losses, None without losses.

    Raises InputError if it depends on the speed.
    """
    if losses is None:
        return None
    if isinstance(losses, KelvinVoigt) and losses.restitution is not None:
        return float(losses.restitution)
    raise refusal("losses", losses, "give a restitution that is the same at all speeds")


def _range(first: float, last: float, start: str, stop: str | None) -> NDArray[np.float64]:
    """Return psi_1 from the first to the last; `start` and `stop` are how they were given."""
    if first < 0.0:
        raise refusal("from", start, "must not be negative")
    if first >= last and stop is None:
        raise refusal(
            "from", start, f"at psi_1 = {first:.4g} the contact slides throughout; give a lower one"
        )
    if first >= last:
        raise refusal("to", stop, f"must be above --from, {start}")
    return np.linspace(first, last, POINTS)[0 if first > 0.0 else 1 :]
