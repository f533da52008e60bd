"""What results are scored against: bodies, their motion, and the restitution they leave."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from carom.bodies.cases import check_case, losses_of, motion_of, pair_of, read_case
from carom.bodies.losses import KelvinVoigt
from carom.bodies.pairs import Pair, alike, with_friction
from carom.bodies.shapes import describe
from carom.impacts.exact import Impact
from carom.impacts.solve import impact
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import number, positive
from carom.verify import errors
from carom.verify.setting import constant_restitution

ROUNDED = 0.01  # part of chi by which a number that is told may be rounded


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
            pair = pair_of(_content(self.case))
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
        motion = motion_of(_content(self.case))
        hit: Impact = impact(pair, losses=errors.losses_of(self.restitution), **motion)
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


def _restitution(cases: Iterable[Any], restitution: Any) -> float:
    """Return the restitution that is given, or that of the cases, or 1."""
    told = {each for each in map(_told, cases) if each is not None}
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
    losses = case.losses if isinstance(case, Impact) else losses_of(_content(case))
    return 1.0 if losses is None and isinstance(case, Impact) else constant_restitution(losses)


def _content(case: Any) -> Mapping[str, Any]:
    if case is None:
        raise InputError("case: missing; give the bodies, --case with a file as for carom impact")
    if isinstance(case, str | Path):
        return read_case(Path(case), losses=True)
    check_case(case, losses=True)
    return dict(case)
