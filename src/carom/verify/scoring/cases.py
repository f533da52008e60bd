"""What results are scored against: bodies, motion, restitution; and the results of own laws."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom.bodies import cases
from carom.bodies.checks import alike, with_friction
from carom.bodies.losses import KelvinVoigt
from carom.bodies.pairs import Pair
from carom.dem import FunctionLaw
from carom.dimensionless.law import LawStatus
from carom.impacts.exact import Impact
from carom.impacts.solve import impact
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import number, positive
from carom.verify.entries import as_law, called
from carom.verify.errors import INCIDENCES, SOLID_CHI, Impacts, constant_restitution, losses_of

CHI_TOLERANCE = 0.01  # relative: numbers are rounded
WRONG_SIGN = (
    "every impact gains speed: has the force the opposite sign? It acts on the first body, so that "
    "friction that slows V_x > 0 is negative"
)


@dataclass(frozen=True)
class ScoredCase:
    """The bodies, perhaps their motion, as a user gives them, or chi; and the exact restitution."""

    case: Any
    restitution: float = 1.0
    chi: Any = None

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


def scored_case(case: Any, chi: Any, own: Any, restitution: Any) -> ScoredCase:
    """Return the case, or that which the file holds, `own`; both must have the same bodies."""
    chosen = _chosen(case, chi, own)
    return ScoredCase(chosen, _restitution((chosen, own), restitution), chi)


def _chosen(case: Any, chi: Any, own: Any) -> Any:
    if own is None:
        return case
    bodies = ScoredCase(own).pair
    if chi is not None:
        if abs(positive("chi", chi) / bodies.chi - 1.0) > CHI_TOLERANCE:
            allowed = f"the bodies in the results have chi = {bodies.chi:.4g}; leave it out"
            raise refusal("chi", chi, allowed)
        return case
    if case is not None and not alike(ScoredCase(case).pair, bodies, friction=True):
        raise InputError("case: its bodies differ from those in the results; leave it out")
    return own if case is None else case


def _restitution(sources: Iterable[Any], restitution: Any) -> float:
    """Return the restitution that is asked for, or that of the cases, or 1."""
    values = set(map(_restitution_of, sources)) - {None}
    if len(values) > 1:
        both = " and ".join(f"{each:g}" for each in sorted(filter(None, values)))
        raise InputError(
            f"restitution: the case and the results have {both}; leave one of them out"
        )
    if restitution is None:
        return values.pop() or 1.0 if values else 1.0
    if values:
        raise refusal("restitution", restitution, "the case has its own; leave one of them out")
    number("restitution", restitution, "1")  # one, and no array of them
    return float(KelvinVoigt(restitution=restitution).restitution)


def _restitution_of(case: Any) -> float | None:
    """Return the restitution of a case, None if it says nothing of it; an impact always has one."""
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


def results_of(law_or_function: Any, case: Any, chi: Any, restitution: Any) -> LawResults:
    """Return the results of a law or function for a case or chi, or raise InputError."""
    law, kappa = as_law(law_or_function), None
    scored = scored_case(case, None, None, restitution)
    if case is None:
        chi = SOLID_CHI if chi is None else chi
    else:
        if chi is not None:
            raise InputError("chi: it follows from the case; leave one of them out")
        pair = scored.pair
        chi, kappa = pair.chi, pair.kappa
        if isinstance(law, FunctionLaw) and law.pair is None:
            law = replace(law, pair=pair)
    impacts = Impacts.of(INCIDENCES, chi, kappa)
    psi, chi, kappa = impacts
    psi_out, status = law.rebound(psi, chi, kappa=kappa, return_status=True)
    impacts.refuse_failure(law, psi_out)
    if np.any(status):
        first = int(np.argmax(status != LawStatus.SOLVED))
        why = LawStatus(int(status[first])).message
        raise InputError(f"{called(law)}: psi_1 = {psi[first]:g}, chi = {chi:g}: {why}")
    e = scored.restitution
    if restitution is None and e == 1.0:
        e = impacts.restitution(law)
    notes = (WRONG_SIGN,) if isinstance(law, FunctionLaw) and np.all(psi_out > psi) else ()
    columns = {"psi_1": psi, "psi_2": psi_out}
    return LawResults(columns, called(law), chi, None if e == 1.0 else e, notes)
