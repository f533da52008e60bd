"""Which parameters the data can tell, and why not the others."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.fitting.curves import THROUGHOUT, regimes
from carom.fitting.errors import Loss
from carom.fitting.estimation import Best, estimate
from carom.fitting.information import WEAK, Information
from carom.fitting.laws import half_ratio
from carom.fitting.model import OFFSET, Model

Array = NDArray[np.float64]

HELD_FIRST = (OFFSET, "restitution", "tangential_restitution", "kappa", "friction")
EXAMPLES = {"restitution": 0.98, "kappa": 0.82, "friction": 0.1, OFFSET: 0.0}
EXAMPLES |= {"tangential_restitution": 0.4}
MEMBER = 0.25  # part of a direction that a parameter of a group has at least
WORSE = 0.5  # rise of the loss at which a starting value contradicts the data


@dataclass(frozen=True, eq=False)
class Settled:
    """The best fit of what the data tell, and the groups of parameters that they do not tell.

    Of each group the first parameter is held; `whole` is the fit before anything was held.
    """

    best: Best
    groups: tuple[tuple[str, ...], ...]
    whole: Best


def settle(model: Model, loss: Loss, start: Mapping[str, float]) -> Settled:
    """Fit, and hold one parameter after the other until the data tell all that are free."""
    whole = best = estimate(model, loss)
    groups: list[tuple[str, ...]] = []
    while len(best.model.free):
        group = weak_group(best.information, best.model.free)
        if not group or len(best.model.free) == 1:
            return Settled(best, (*groups, *((group,) if group else ())), whole)
        groups.append(group)
        best = _held(best, group[0], start[group[0]], loss)
    return Settled(best, tuple(groups), whole)


def weak_group(told: Information, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the parameters of a direction in which the values hardly change, to be held first."""
    alone = np.sqrt(np.diag(told.matrix)) < WEAK
    if alone.any():
        return (names[int(np.argmax(alone))],)
    sizes, directions = np.linalg.eigh(told.matrix)
    if sizes[0] >= WEAK**2:
        return ()
    members = [n for n, part in zip(names, directions[:, 0], strict=True) if abs(part) > MEMBER]
    return tuple(sorted(members, key=HELD_FIRST.index))


def _held(best: Best, name: str, start: float, loss: Loss) -> Best:
    """Return the fit with a parameter held where it starts, or where it was if that is worse."""
    at_start = estimate(best.model.holding(name, start), loss)
    found = float(best.model.values(best.at[np.newaxis])[name][0, 0])
    if abs(at_start.sum - best.sum) < WORSE * best.spread or at_start.estimated.any():
        return at_start
    return estimate(best.model.holding(name, found), loss)


def row_regimes(best: Best, at: Array | None = None) -> NDArray[np.int8]:
    """Return the place of each row's regime in `carom.curves.REGIMES`, by default at the fit."""
    model, problem = best.model, best.model.problem
    point = best.at if at is None else at
    values = {name: float(v[0, 0]) for name, v in model.values(point[np.newaxis]).items()}
    motion = problem.motion
    velocity = problem.contact_velocity + problem.pair.first.radius * values[OFFSET]
    psi = values["kappa"] * velocity / (values["friction"] * motion.normal_speed)
    chi = half_ratio(problem.pair) * values["kappa"]
    return regimes(psi, chi, values["restitution"])


def reason(group: tuple[str, ...], best: Best) -> str:
    """Return why the data do not tell a group of parameters."""
    if len(group) > 1:
        return _together(group)
    name = group[0]
    found = row_regimes(best)
    if name == "kappa" and np.all(found == THROUGHOUT):
        return "every row slips throughout, where the stiffness does not matter"
    if name == "friction" and np.all(found == 0):
        return "every row sticks from the first touch, where friction hardly matters"
    if name == "restitution":
        return "nothing that was measured depends on it; measure normal_restitution"
    return "over its whole range it changes the values by less than their scatter"


def _together(group: tuple[str, ...]) -> str:
    others = f"fix one of them, e.g. fixed={{'{group[0]}': {EXAMPLES[group[0]]}}}"
    if set(group) == {"friction", "restitution"}:
        return f"only friction (1 + restitution) enters; {others}, or measure normal_restitution"
    *most, last = sorted(group)
    return f"{', '.join(most)} and {last} change the values only together; {others}"
