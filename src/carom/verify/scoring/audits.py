"""What any result must obey, whatever its law: findings that name the rows that do not."""

import numpy as np

from carom.readings import SHOWN, Array
from carom.results import Finding
from carom.verify.scoring.points import Points

ROUNDING = 1e-12  # of psi; what is smaller is no gain of energy
SAME = 1e-3  # of ratios that should be one
PRINTED = 1e-3  # of the limit; so much is due to numbers that were rounded when printed


def energy_audit(points: Points, unit: Array, symbol: str, limit: float) -> Finding:
    """Return whether an impact gains energy: neither psi_2^2 over psi_1^2, nor all of it together.

    `unit` is what a change of energy is divided by to be one of psi^2, `symbol` the name of its own
    unit. The value is by how much |psi_2| would be too large if the contact point had all of it.
    """
    name, before = "energy gain", np.abs(points.psi_in)
    change = np.maximum(points.energy_change, unit * (points.psi_out**2 - before**2))
    excess = np.sqrt(np.maximum(before**2 + change / unit, 0.0)) - before
    gains = excess > ROUNDING * np.maximum(1.0, before)
    if not gains.any():
        return Finding(name, 0.0, limit, True, "no impact gains energy")
    order = np.argsort(-np.where(gains, change, -np.inf))
    largest = [
        f"{points.one(i)}: {change[i]:.6g} {symbol}" for i in order[: min(SHOWN, gains.sum())]
    ]
    more = f"; and {gains.sum() - SHOWN} more" if gains.sum() > SHOWN else ""
    value = float(excess.max())
    return Finding(name, value, limit, value <= limit, f"gained in {'; '.join(largest)}{more}")


def friction_audit(points: Points, restitution: Array, limit: float) -> Finding:
    """Return whether friction can give the impulse: |psi_1 - psi_2| <= 2 (1 + e) chi."""
    needed = np.abs(points.psi_in - points.psi_out)
    excess = needed - 2.0 * (1.0 + restitution) * points.chi
    name, value, worst = "friction impulse", max(float(excess.max()), 0.0), int(np.argmax(excess))
    above = excess > PRINTED * limit
    if not above.any():
        verdict = "no tangential impulse exceeds mu times the normal one"
        return Finding(name, value, limit, True, verdict)
    verdict = f"above mu times the normal impulse in {points.named(above)}, most in "
    return Finding(name, value, limit, value <= limit, verdict + points.one(worst))


def restitution_audit(points: Points, restitution: Array, limit: float) -> Finding:
    """Return whether the normal impact is elastic, as in the exact answer."""
    off = np.abs(restitution - 1.0)
    name, value, worst = "restitution error", float(off.max()), int(np.argmax(off))
    if value <= limit:
        return Finding(name, value, limit, True, "the normal impact is elastic")
    where = f"in {points.named(off > limit)}, most in {points.one(worst)}"
    verdict = f"e = {restitution[worst]:.6g}, not 1, {where}; let the normal contact be undamped"
    return Finding(name, value, limit, False, verdict)


def notes_on(points: Points) -> tuple[str, ...]:
    """Return what may be wrong with all points: the sign of psi_2, or chi.

    Who slips throughout loses 4 chi of psi_1: that tells the chi of the results.
    """
    notes = []
    if 2.0 * np.linalg.norm(points.psi_out + points.exact) < np.linalg.norm(points.error):
        notes.append("psi_2 has the opposite sign? Before and after count along the same axis")
    slides = np.abs(points.psi_in) > np.maximum(4.0 * points.chi, 1.0)
    ratio = np.abs(points.psi_in - points.psi_out)[slides] / (4.0 * points.chi[slides])
    if ratio.size > 1 and np.ptp(ratio) < SAME and abs(ratio[0] - 1.0) > SAME:
        times = f"{ratio[0]:.4g} times"
        notes.append(f"in gross slip psi_1 - psi_2 is {times} 4 chi: is chi {times} as large?")
    return tuple(notes)
