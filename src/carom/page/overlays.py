"""What contact laws give over a view, as curves and as JSON holds them; remembered by bodies."""

from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from functools import lru_cache
from itertools import count
from time import monotonic
from typing import Any

import numpy as np

from carom.dem.base import ContactLaw
from carom.dimensionless.law import Law
from carom.dimensionless.numerics.threads import available_cores
from carom.page.limits import LAW_SECONDS, MOST_FOLLOWERS
from carom.page.outcomes import Outcome, outcome_of
from carom.page.views import View
from carom.quantities.arrays import Array
from carom.quantities.units import or_none
from carom.verify.entries import damped, named

POINTS, POINTS_OF_LAWS = 241, 61
MARGIN = 1.15  # beyond the present psi_1
FORCE_STEPS = 400
DRAWN_EVERY = 2  # of these steps
KEPT_CURVES = 256
GLANCE_SECONDS = 0.1
CURVE_DECIMALS = 7  # one may zoom
KEY_DIGITS = 12  # by which curves are kept

_solvers = ThreadPoolExecutor(max(1, available_cores() - 1), "carom-law")  # answers go first
_at_work: dict[tuple[Outcome, str], Future["LawCurve"]] = {}


class Followers:
    """Requests that wait for contact laws: the latest count, as a slider that moves asks often."""

    def __init__(self) -> None:
        self._numbers = count()
        self._latest = 0

    def joined(self) -> Callable[[], bool]:
        """Return what tells a request that joins when it is to give up."""
        number = self._latest = next(self._numbers)
        return lambda: number <= self._latest - MOST_FOLLOWERS

    def dismiss(self) -> None:
        """Let all give up."""
        for _ in range(MOST_FOLLOWERS):
            self.joined()


followers = Followers()


@dataclass(frozen=True, eq=False)
class LawCurve:
    """What a contact law gives: its rebounds, and its force in time, both as they are drawn."""

    label: str
    psi_in: Array
    psi_out: Array
    at: float  # psi_2 at the present psi_1
    share: Array  # times, of the exact duration
    force: Array  # in the unit of the page


def laws(view: View) -> dict[str, Any]:
    """Return the contact laws of a view, "slow" those that take too long."""
    outcome, labels = outcome_of(view), view.laid_over
    curves = law_curves(outcome, labels, LAW_SECONDS, followers.joined())
    solved = [
        {
            "label": law.label,
            "psi": _fine(law.psi_in),
            "out": _fine(law.psi_out),
            "at": or_none(law.at),
            "off": or_none(law.at - outcome.psi_out),
            "share": _fine(law.share),
            "force": _fine(law.force),
        }
        for law in curves
        if law is not None
    ]
    slow = [label for label, law in zip(labels, curves, strict=True) if law is None]
    return {"laws": solved, "slow": slow}


def _fine(values: Array) -> list[float | None]:
    return [or_none(value) for value in np.round(values, CURVE_DECIMALS).tolist()]


def places(outcome: Outcome) -> Array:
    """Return the psi_1 over which curves are drawn: all regimes, and the present point."""
    low, high = _span(outcome)
    grid = np.linspace(0.0, _regimes(outcome.chi), POINTS)
    return np.unique(np.concatenate([-grid[-grid >= low], grid, [low, high]]))


def law_curves(
    outcome: Outcome,
    labels: Sequence[str],
    seconds: float = LAW_SECONDS,
    given_up: Callable[[], bool] = lambda: False,
) -> list[LawCurve | None]:
    """Return what the contact laws of these names give in the place of the exact one.

    None in the place of those that take longer, which may be asked for again; fewer are waited for
    once `given_up` is true.
    """
    end = monotonic() + seconds
    begun = [_begun(outcome, label) for label in labels]
    while True:
        _, late = wait(begun, max(0.0, min(GLANCE_SECONDS, end - monotonic())))
        if not late or monotonic() >= end or given_up():
            break
        rows = zip(labels, begun, strict=True)  # another request may have cancelled what it shares
        begun = [_begun(outcome, name) if law.cancelled() else law for name, law in rows]
    for future in late:  # the page may have moved on
        future.cancel()
    return [law.result() if law.done() and not law.cancelled() else None for law in begun]


def _begun(outcome: Outcome, label: str) -> Future[LawCurve]:
    """Return a law at work, only once even if it is asked for again meanwhile."""
    curve = _at_work.get((outcome, label))
    if curve is None or curve.cancelled():
        curve = _at_work[outcome, label] = _solvers.submit(_of_law, outcome, label)
        curve.add_done_callback(lambda _: _at_work.pop((outcome, label), None))
    return curve


def _whole(outcome: Outcome, psi: Array, out: Array) -> tuple[Array, Array]:
    """Return a curve that is there for psi_1 >= 0, as far as it is drawn."""
    low, high = _span(outcome)
    both = np.concatenate([-psi[:0:-1], psi]), np.concatenate([-out[:0:-1], out])
    shown = (both[0] >= low) & (both[0] <= high)
    return both[0][shown], both[1][shown]


@lru_cache(maxsize=KEPT_CURVES)
def _of_law(outcome: Outcome, label: str) -> LawCurve:
    law = named(label)[0].law
    if outcome.restitution != 1.0:
        law = damped(law, outcome.restitution)
    grid = np.linspace(0.0, _regimes(outcome.chi), POINTS_OF_LAWS)
    half = _half(law, round(outcome.chi, KEY_DIGITS), round(outcome.kappa, KEY_DIGITS))
    at, share, force = float("nan"), np.array([]), np.array([])
    if np.isfinite(outcome.psi_in):
        at = float(_rebound(law, outcome.psi_in, outcome.chi, outcome.kappa))
        if isinstance(law, ContactLaw):  # a hard sphere has no contact to follow
            course = law.history(
                outcome.psi_in, outcome.chi, kappa=outcome.kappa, steps=FORCE_STEPS
            )
            share = course["time"][::DRAWN_EVERY] / outcome.lasts
            force = (course["tangential_force"] * outcome.force_scale)[::DRAWN_EVERY]
    return LawCurve(label, *_whole(outcome, grid, half), at, share, force)


@lru_cache(maxsize=KEPT_CURVES)
def _half(law: Law, chi: float, kappa: float) -> Array:
    """Return psi_2 of a law over the regimes; beyond them every law slides."""
    grid = np.linspace(0.0, _regimes(chi), POINTS_OF_LAWS)
    return _rebound(law, grid, chi, kappa)


def _rebound(law: Law, psi: float | Array, chi: float, kappa: float) -> Array:
    """Return psi_2 of a law, NaN without a word where it leaves an impact unsolved."""
    out, _ = law.rebound(psi, chi, kappa=kappa, threads=1, return_status=True)
    return np.asarray(out)


def _regimes(chi: float) -> float:
    """Return a psi_1 beyond all regimes."""
    return float(np.ceil(2.0 * max(4.0 * chi, 1.5)) / 2.0)


def _span(outcome: Outcome) -> tuple[float, float]:
    """Return the psi_1 between which curves are drawn: all regimes, and the present point."""
    regimes = _regimes(outcome.chi)
    point = outcome.psi_in if np.isfinite(outcome.psi_in) else 0.0
    reach = np.ceil(MARGIN * abs(point)) if abs(point) > regimes / MARGIN else regimes
    return (-reach if point < 0.0 else 0.0), max(reach, regimes)
