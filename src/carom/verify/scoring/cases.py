"""What results are scored against: bodies, motion, restitution; and the results of own laws."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom.bodies import cases
from carom.bodies.losses import KelvinVoigt
from carom.bodies.pairs import Pair, alike, with_friction
from carom.bodies.shapes import describe
from carom.dem import FunctionLaw
from carom.dem.base import Law
from carom.dem.status import LawStatus
from carom.impacts.exact import Impact
from carom.impacts.solve import impact
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import number, positive
from carom.verify.entries import called
from carom.verify.errors import INCIDENCES, Impacts, as_law, constant_restitution, losses_of
from carom.verify.ranking import CHI

ROUNDED = 0.01  # part of chi by which a number that is told may be rounded
WRONG_SIGN = (
    "every impact gains speed: has the force the opposite sign? It acts on the first body, so that "
    "friction that slows V_x > 0 is negative"
)


@dataclass(frozen=True)
class Given:
    """What is given as a case, and the restitution of the exact impact."""

    case: Any
    restitution: float = 1.0

    @cached_property
    def pair(self) -> Pair:
        """The bodies; InputError without friction, for which psi is infinite."""
        if isinstance(self.case, Pair | Impact):
            pair = self.case.pair if isinstance(self.case, Impact) else self.case
        else:
            pair = cases.pair_of(_content(self.case))
        return with_friction(pair, "without friction psi is infinite, and nothing can be scored")

    @cached_property
    def impact(self) -> Impact:
        """The exact impact; InputError if there is no motion."""
        pair = self.pair
        if isinstance(self.case, Impact):
            return self.case
        if isinstance(self.case, Pair):
            raise InputError(
                "case: a history needs the speeds, too; give a case that has them, or an Impact"
            )
        motion = cases.motion_of(_content(self.case))
        hit: Impact = impact(pair, losses=losses_of(self.restitution), **motion)
        return hit

    @property
    def inputs(self) -> dict[str, Any]:
        """The bodies, as results tell them."""
        bodies = {"first": describe(self.pair.first), "second": describe(self.pair.second)}
        return {**bodies, "friction": self.pair.friction}


def given_of(case: Any, chi: Any, own: Any, restitution: Any) -> Given:
    """Return what is given as a case, or what the file holds; both must have the same bodies."""
    chosen = _chosen(case, chi, own)
    return Given(chosen, _restitution((chosen, own), restitution))


def _chosen(case: Any, chi: Any, own: Any) -> Any:
    if own is None:
        return case
    bodies = Given(own).pair
    if chi is not None:
        if abs(positive("chi", chi) / bodies.chi - 1.0) > ROUNDED:
            allowed = f"the bodies in the results have chi = {bodies.chi:.4g}; leave it out"
            raise refusal("chi", chi, allowed)
        return case
    if case is not None and not alike(Given(case).pair, bodies, friction=True):
        raise InputError("case: its bodies differ from those in the results; leave it out")
    return own if case is None else case


def _restitution(given: Iterable[Any], restitution: Any) -> float:
    """Return the restitution that is given, or that of the cases, or 1."""
    told = {each for each in map(_told, given) if each is not None}
    if len(told) > 1:
        both = " and ".join(f"{each:g}" for each in sorted(told))
        raise InputError(
            f"restitution: the case and the results have {both}; leave one of them out"
        )
    if restitution is None:
        return told.pop() if told else 1.0
    if told:
        raise refusal("restitution", restitution, "the case has its own; leave one of them out")
    number("restitution", restitution, "1")  # one, and no array of them
    return float(KelvinVoigt(restitution=restitution).restitution)


def _told(case: Any) -> float | None:
    """Return the restitution that a case tells, or None; an impact always does."""
    if case is None or isinstance(case, Pair):
        return None
    losses = case.losses if isinstance(case, Impact) else cases.losses_of(_content(case))
    return 1.0 if losses is None and isinstance(case, Impact) else constant_restitution(losses)


def _content(case: Any) -> Mapping[str, Any]:
    if case is None:
        raise InputError("case: missing; give the bodies, --case with a file as for carom impact")
    if isinstance(case, str | Path):
        return cases.read_case(Path(case), losses=True)
    cases.check_case(case, losses=True)
    return dict(case)


class LawResults(NamedTuple):
    """Columns psi_1 and psi_2 of a law, its name, and what it is to be scored against."""

    columns: Mapping[str, Array]
    name: str
    chi: float
    restitution: float | None
    notes: tuple[str, ...]


def results_of(given: Any, case: Any, chi: Any, restitution: Any) -> LawResults:
    """Return the results of a law, or of a function, for the bodies of a case or for a chi.

    A function sees the bodies of the case if it has none of its own.

    Raises InputError if it is no law, or leaves an impact unsolved.
    """
    law, kappa = as_law(given), None
    known = given_of(case, None, None, restitution)
    if case is None:
        chi = CHI if chi is None else chi
    else:
        law, chi, kappa = _with_bodies(law, known, chi)
    met = Impacts.of(INCIDENCES, chi, kappa)
    psi_out, status = law.rebound(met.psi, met.chi, kappa=met.kappa, return_status=True)
    met.refuse_failure(law, psi_out)
    if np.any(status):
        first = int(np.argmax(status != LawStatus.SOLVED))
        why = LawStatus(int(status[first])).message
        where = f"psi_1 = {met.psi[first]:g}, chi = {met.chi:g}"
        raise InputError(f"{called(law)}: {where}: {why}")
    told = known.restitution
    if restitution is None and told == 1.0:
        told = met.restitution(law)
    columns = {"psi_1": met.psi, "psi_2": psi_out}
    notes = (WRONG_SIGN,) if isinstance(law, FunctionLaw) and np.all(psi_out > met.psi) else ()
    return LawResults(columns, called(law), met.chi, None if told == 1.0 else told, notes)


def _with_bodies(law: Law, known: Given, chi: Any) -> tuple[Law, float, float]:
    """Return a law that sees the bodies of a case, their chi and their kappa."""
    if chi is not None:
        raise InputError("chi: it follows from the case; leave one of them out")
    pair = known.pair
    if isinstance(law, FunctionLaw) and law.pair is None:
        law = replace(law, pair=pair)
    return law, pair.chi, pair.kappa
