"""Whether one impulse explains all changes of velocity and spin; if not, which unit or sign may.

The impulse J on the contact point gives m_n (v_t - v_t') = I_1 (omega_1 - omega_1')/R_1 =
I_2 (omega_2 - omega_2')/R_2 = J. Where these differ, a unit or a sign is wrong, or angular
momentum about the contact point is not conserved.
"""

from math import pi
from typing import Any

import numpy as np

from carom.histories import Tangential, inertia
from carom.pairs import Pair
from carom.quantities import InputError
from carom.readings import Results
from carom.results import Finding

UNITS = {  # by the ratio of the impulse in the spins to that in the speeds
    30.0 / pi: "in rpm; head the columns 'spin [rpm]' and 'spin_out [rpm]'",
    180.0 / pi: "in deg/s; head the columns 'spin [deg/s]' and 'spin_out [deg/s]'",
    0.5 / pi: "in turns/s; head the columns 'spin [turn/s]' and 'spin_out [turn/s]'",
    1e-3: "in mm/s; head the columns 'normal_speed [mm/s]' and so on",
    1e-2: "in cm/s; head the columns 'normal_speed [cm/s]' and so on",
    1.0 / 3.6: "in km/h; head the columns 'normal_speed [km/h]' and so on",
}
CAUSES = {
    -1.0: "spin has the opposite sign? Positive spin adds to the tangential speed of the contact",
    2.0: "is the radius in the case a diameter?",
    0.5: "is the radius in the case half of what it was?",
    0.8: "is the moment of inertia in the results that of a disc?",
}
CLOSE = 0.02  # how near a ratio is to one that is known, relative


def momentum_audit(
    results: Results,
    pair: Pair,
    before: Tangential,
    after: Tangential,
    normal_speed: Any,
    limit: float,
) -> Finding:
    """Return whether spins and speeds changed by the same impulse, in units of psi.

    Raises InputError if all differ by a factor that is one of units.
    """
    linear = pair.normal_mass * (before.tangential_speed - after.tangential_speed)
    spins = zip(pair.moving, before[1:], after[1:], strict=False)
    angular = [(was - now) * inertia(body) / body.radius for body, was, now in spins]
    unit = pair.tangential_mass * pair.scales(normal_speed).tangential_speed
    off = np.max([np.abs(linear - other) for other in angular], axis=0) / unit
    ratio = _constant_ratio(angular[0], linear, limit * unit)
    _refuse_units(ratio)
    name, value, worst = "angular momentum", float(off.max()), int(np.argmax(off))
    if value <= limit:
        return Finding(name, value, limit, True, "speeds and spins changed by one impulse")
    where = results.named(off > limit)
    verdict = f"speeds and spins changed by different impulses in {where}"
    verdict += f", most in {results.one(worst)}{_cause(ratio)}"
    return Finding(name, value, limit, False, verdict)


def _constant_ratio(angular: Any, linear: Any, small: Any) -> float:
    """Return the ratio of two impulses if it is the same in all rows, else 1."""
    size = float(linear @ linear)
    if size == 0.0:
        return 1.0
    ratio = float(angular @ linear) / size
    if ratio == 0.0:
        return 1.0
    spread = np.abs(angular - ratio * linear)
    allowed = np.maximum(CLOSE * np.abs(ratio * linear), np.maximum(abs(ratio), 1.0) * small)
    return ratio if np.all(spread <= allowed) else 1.0


def _refuse_units(ratio: float) -> None:
    for factor, words in UNITS.items():
        if abs(abs(ratio) / factor - 1.0) < CLOSE:
            wrong = "spins" if "spin" in words else "speeds"
            raise InputError(
                f"{wrong}: the spins change {abs(ratio):.4g} times as much as the speeds tell in "
                f"every row; the {wrong} seem to be {words}"
            )


def _cause(ratio: float) -> str:
    """Return what may be wrong if the impulses differ by the same factor in all rows."""
    if abs(ratio - 1.0) < CLOSE:
        return ""
    known = (words for factor, words in CAUSES.items() if abs(ratio / factor - 1.0) < CLOSE)
    return f", by the same factor {ratio:.4g}; {next(known, 'check units and sizes')}"
