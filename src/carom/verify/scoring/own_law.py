"""The results of a contact law that Carom runs itself: its rebounds at the bench's incidences."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from carom.dem import FunctionLaw
from carom.dem.base import Law
from carom.dem.status import LawStatus
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError
from carom.verify.entries import called
from carom.verify.errors import (
    INCIDENCES,
    as_law,
    checked_chi,
    kappa_or_solid,
    left_restitution,
    refuse_failure,
)
from carom.verify.ranking import CHI
from carom.verify.scoring.cases import Given, given_of

WRONG_SIGN = (
    "every impact gains speed: has the force the opposite sign? It acts on the first body, so that "
    "friction that slows V_x > 0 is negative"
)


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
        size = checked_chi(CHI if chi is None else chi)
    else:
        law, size, kappa = _with_bodies(law, known, chi)
    psi = np.array(INCIDENCES)
    psi_out, status = law.rebound(psi, size, kappa=kappa, return_status=True)
    refuse_failure(law, psi, size, kappa, psi_out)
    if np.any(status):
        first = int(np.argmax(status != LawStatus.SOLVED))
        why = f"psi_1 = {psi[first]:g}, chi = {size:g}: {LawStatus(int(status[first])).message}"
        raise InputError(f"{called(law)}: {why}")
    left = left_restitution(law, size, kappa_or_solid(kappa, size))
    told = known.restitution if restitution is not None or known.restitution != 1.0 else left
    columns = {"psi_1": psi, "psi_2": psi_out}
    notes = (WRONG_SIGN,) if isinstance(law, FunctionLaw) and np.all(psi_out > psi) else ()
    return LawResults(columns, called(law), size, None if told == 1.0 else told, notes)


def _with_bodies(law: Law, known: Given, chi: Any) -> tuple[Law, float, float]:
    """Return a law that sees the bodies of a case, their chi and their kappa."""
    if chi is not None:
        raise InputError("chi: it follows from the case; leave one of them out")
    pair = known.pair
    if isinstance(law, FunctionLaw) and law.pair is None:
        law = replace(law, pair=pair)
    return law, checked_chi(pair.chi), pair.kappa
